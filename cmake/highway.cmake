# Highway: vector instructions, chosen at run time. Only src/eval/tile_kernels.cpp uses it.
set(kernels ${PROJECT_SOURCE_DIR}/src/eval/tile_kernels.cpp)
if(NOT SWEEPFACE_SIMD)
  set_property(SOURCE ${kernels} APPEND PROPERTY COMPILE_DEFINITIONS SWEEPFACE_PLAIN_KERNELS)
elseif(CMAKE_SYSTEM_NAME STREQUAL "WASI")
  # WebAssembly has one set of vector instructions, for which Highway's headers suffice. They lie among system headers
  # that must not be found.
  find_path(HIGHWAY_INCLUDE hwy/highway.h PATHS /usr/include NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/highway)
  file(CREATE_LINK ${HIGHWAY_INCLUDE}/hwy ${PROJECT_BINARY_DIR}/highway/hwy SYMBOLIC)
  target_include_directories(sweepface_runtime SYSTEM PRIVATE ${PROJECT_BINARY_DIR}/highway)
  # What runs every frame is built for speed.
  set_property(SOURCE ${kernels} APPEND PROPERTY COMPILE_OPTIONS -O2)
  set_property(SOURCE ${kernels} PROPERTY SKIP_PRECOMPILE_HEADERS ON)
else()
  find_package(hwy 1 REQUIRED)
  target_link_libraries(sweepface_runtime PRIVATE hwy::hwy)
endif()
