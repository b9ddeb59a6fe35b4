# Builds for 64-bit Windows with Debian's clang 19, the libraries of MinGW-w64 and those that scripts/windows-root puts
# into build/windows-root; programs run under Wine. GCC does not align AVX values on the stack there.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_AR llvm-ar-19)
set(CMAKE_RANLIB llvm-ranlib-19)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/../scripts/wine)
set(CMAKE_FIND_ROOT_PATH ${CMAKE_CURRENT_LIST_DIR}/../build/windows-root /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
foreach(language C CXX)
  set(CMAKE_${language}_COMPILER_TARGET x86_64-w64-windows-gnu)
  # Both clang and MinGW-w64 define this function, and the latter's headers include one that the former deprecates. The
  # standard library was built by GCC, which emulates thread-local storage.
  set(CMAKE_${language}_FLAGS_INIT
    "-D__INTRINSIC_DEFINED___cpuidex -D_CLANG_DISABLE_CRT_DEPRECATION_WARNINGS -femulated-tls")
endforeach()
# Nothing but Windows itself is needed to run what is built. C++23 makes a function inline that the standard library also
# defines (GCC bug 110572).
foreach(kind EXE SHARED)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT "-fuse-ld=lld -static -lpthread -s -Wl,--allow-multiple-definition")
endforeach()
set(ZLIB_USE_STATIC_LIBS ON)
