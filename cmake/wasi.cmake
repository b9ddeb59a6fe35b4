# Builds the tool for wasm32-wasi with the libraries that scripts/wasi-root puts into build/wasi-root: among them a standard
# library that, unlike Debian's, has exceptions and files.
include(${CMAKE_CURRENT_LIST_DIR}/wasm32.cmake)
set(root ${CMAKE_CURRENT_LIST_DIR}/../build/wasi-root)
foreach(language C CXX)
  string(APPEND CMAKE_${language}_FLAGS_INIT
    " -fwasm-exceptions -isystem \"${CMAKE_CURRENT_LIST_DIR}/wasi\" -include \"${CMAKE_CURRENT_LIST_DIR}/wasi/lacking.h\"")
endforeach()
string(APPEND CMAKE_CXX_FLAGS_INIT " -nostdinc++ -isystem \"${root}/include/c++/v1\"")
# Recursion needs more than the 64 KiB that a stack has otherwise.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib++ -L\"${root}/lib\" -lc++ -lc++abi -lunwind -lrealpath -lc-printscan-long-double \
-Wl,--strip-all,--stack-first,-z,stack-size=8388608")
set(CMAKE_FIND_ROOT_PATH ${root})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
