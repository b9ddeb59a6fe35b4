# Shared libraries for languages that load one. They export the C interface alone: libsweepface what plays, and
# libsweepface_clips what reads other programs' clips as well.
function(sweepface_shared_library target output)
  set(exports ${PROJECT_SOURCE_DIR}/cmake/shared.map)
  add_library(sweepface_${target} SHARED ${exports} $<TARGET_OBJECTS:sweepface_runtime>)
  add_library(sweepface::${target} ALIAS sweepface_${target})
  # What was linked with one version works with the next while functions are only added (sweepface.h).
  set_target_properties(sweepface_${target} PROPERTIES EXPORT_NAME ${target} OUTPUT_NAME ${output} LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} LINK_DEPENDS ${exports})
  target_include_directories(sweepface_${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(sweepface_${target} PRIVATE sweepface_runtime)  # for what it links
  # Where a project asks for fast mathematics GCC would link what rounds small numbers to 0 in the whole program.
  target_link_options(sweepface_${target} PRIVATE -O2 -fno-fast-math -fno-unsafe-math-optimizations)
  if(NOT APPLE)
    target_link_options(sweepface_${target} PRIVATE -Wl,--version-script=${exports})
  endif()
endfunction()

sweepface_shared_library(shared sweepface)
if(TARGET sweepface_convert)
  sweepface_shared_library(shared_clips sweepface_clips)
  target_link_libraries(sweepface_shared_clips PRIVATE $<BUILD_INTERFACE:sweepface_convert>)
  # Of what converts only what that one calls.
  target_link_options(sweepface_shared_clips PRIVATE -Wl,-u,$<IF:$<PLATFORM_ID:Darwin>,_,>sweepface_clip_read)
endif()
