# Builds the runtime library for wasm32-wasi with Debian's standard library, which has neither exceptions nor files.
include(${CMAKE_CURRENT_LIST_DIR}/wasm32.cmake)
string(APPEND CMAKE_CXX_FLAGS_INIT " -stdlib=libc++")
# Load time counts more than speed. Every engine that has SIMD has the other extensions as well.
set(CMAKE_CXX_FLAGS_RELEASE "-Oz -flto -fno-threadsafe-statics -fno-sized-deallocation -fno-math-errno -fcomplex-arithmetic=basic -fno-vectorize -fno-slp-vectorize -DNDEBUG" CACHE STRING "")
