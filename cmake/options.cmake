# Compiler options that every target of the project shares; they are not exported to users.
add_library(sweepface_options INTERFACE)
target_compile_options(sweepface_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wshadow
  -fno-fast-math     # even if an enclosing project's flags ask for it: NaNs are refused
  -ffp-contract=off  # the same bytes with every compiler
  -fno-math-errno)   # a square root is one instruction
if(SWEEPFACE_WARNINGS_AS_ERRORS)
  target_compile_options(sweepface_options INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports these inside its own standard library.
  target_compile_options(sweepface_options INTERFACE -Wno-maybe-uninitialized -Wno-restrict
    -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread -Wno-dangling-pointer)
  # When GCC 12 vectorises two doubles it optimises away rounding to float and back.
  target_compile_options(sweepface_options INTERFACE -fno-tree-slp-vectorize)
  # To GCC every file of a unity build looks like a header.
  target_compile_options(sweepface_options INTERFACE
    $<$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>:-Wno-subobject-linkage>)
endif()
if(SWEEPFACE_SANITIZE)
  # The runtime has no RTTI, which the check of virtual pointers needs.
  add_compile_options(-fsanitize=${SWEEPFACE_SANITIZE} -fno-sanitize=vptr -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${SWEEPFACE_SANITIZE})
endif()
