# Builds the tool for WebAssembly (wasm32-wasi) with Debian's clang 19, wasi-libc and the libraries that scripts/wasi-root
# puts into build/wasi-root: among them a standard library that, unlike Debian's, has exceptions and files.
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
set(CMAKE_SYSTEM_NAME WASI)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_AR llvm-ar-19)
set(CMAKE_RANLIB llvm-ranlib-19)
set(root ${CMAKE_CURRENT_LIST_DIR}/../build/wasi-root)
foreach(language C CXX)
  set(CMAKE_${language}_COMPILER_TARGET wasm32-wasi)
  set(CMAKE_${language}_FLAGS_INIT "-msimd128 -mbulk-memory -mnontrapping-fptoint -msign-ext -fwasm-exceptions \
-isystem ${CMAKE_CURRENT_LIST_DIR}/wasi -include ${CMAKE_CURRENT_LIST_DIR}/wasi/lacking.h")
endforeach()
string(APPEND CMAKE_CXX_FLAGS_INIT " -nostdinc++ -isystem ${root}/include/c++/v1")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib++ -L${root}/lib -lc++ -lc++abi -lunwind -lrealpath \
-lc-printscan-long-double -Wl,--strip-all,--stack-first,-z,stack-size=8388608")
set(CMAKE_FIND_ROOT_PATH ${root})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
