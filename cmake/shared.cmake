# libsweepface: what plays in one shared library, for languages that load one. It exports the C interface alone.
set(exports ${CMAKE_CURRENT_LIST_DIR}/shared.map)
add_library(sweepface_shared SHARED ${exports})
add_library(sweepface::shared ALIAS sweepface_shared)
# What was linked with one version works with the next while functions are only added (sweepface.h).
set_target_properties(sweepface_shared PROPERTIES EXPORT_NAME shared OUTPUT_NAME sweepface LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} LINK_DEPENDS ${exports})
target_include_directories(sweepface_shared PUBLIC
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_link_libraries(sweepface_shared PRIVATE $<LINK_LIBRARY:WHOLE_ARCHIVE,sweepface_runtime>)
# Where a project asks for fast mathematics GCC would link what rounds small numbers to 0 in the whole program.
target_link_options(sweepface_shared PRIVATE -O2 -fno-fast-math -fno-unsafe-math-optimizations)
if(NOT APPLE)
  target_link_options(sweepface_shared PRIVATE -Wl,--version-script=${exports})
endif()
