# Builds the runtime library for wasm32-wasi with Debian's clang 19 and wasi-libc.
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
set(CMAKE_SYSTEM_NAME WASI)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_AR llvm-ar-19)
set(CMAKE_RANLIB llvm-ranlib-19)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_FLAGS_INIT "-stdlib=libc++ -msimd128 -mbulk-memory -mnontrapping-fptoint -msign-ext")
# Load time counts more than speed. Every engine that has SIMD has the other extensions as well.
set(CMAKE_CXX_FLAGS_RELEASE "-Oz -flto -fno-threadsafe-statics -fno-sized-deallocation -fno-math-errno -fcomplex-arithmetic=basic -fno-vectorize -fno-slp-vectorize -DNDEBUG" CACHE STRING "")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
