# Shared libraries, for languages that load them. They export only the C interface: libsweepface plays faces, and
# libsweepface_clips also reads other programs' clips.
function(sweepface_shared_library target output)
  set(exports ${PROJECT_SOURCE_DIR}/cmake/shared.map)
  add_library(sweepface_${target} SHARED ${exports} $<TARGET_OBJECTS:sweepface_runtime>)
  add_library(sweepface::${target} ALIAS sweepface_${target})
  # Programs linked with one version work with the next as long as functions are only added (sweepface.h).
  set_target_properties(sweepface_${target} PROPERTIES EXPORT_NAME ${target} OUTPUT_NAME ${output} LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} LINK_DEPENDS ${exports})
  target_include_directories(sweepface_${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(sweepface_${target} PRIVATE sweepface_runtime)  # for the libraries it links
  # If a project asks for fast math, GCC would link start-up code that rounds small numbers to 0 in the whole program.
  target_link_options(sweepface_${target} PRIVATE -O2 -fno-fast-math -fno-unsafe-math-optimizations)
  if(WIN32)  # sweepface.dll, and sweepface.lib for linkers
    set_target_properties(sweepface_${target} PROPERTIES PREFIX "" IMPORT_PREFIX "" IMPORT_SUFFIX .lib)
  elseif(NOT APPLE)
    target_link_options(sweepface_${target} PRIVATE -Wl,--version-script=${exports} -Wl,--as-needed)
  endif()
endfunction()

sweepface_shared_library(shared sweepface)
if(TARGET sweepface_convert)
  sweepface_shared_library(shared_clips sweepface_clips)
  target_link_libraries(sweepface_shared_clips PRIVATE $<BUILD_INTERFACE:sweepface_convert>)
  # Of the converting library, links only what this function calls.
  target_link_options(sweepface_shared_clips PRIVATE -Wl,-u,$<IF:$<PLATFORM_ID:Darwin>,_,>sweepface_clip_read)
endif()
