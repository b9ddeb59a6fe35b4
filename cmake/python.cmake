# The package for Python, if there is an interpreter with NumPy, its headers and pybind11.
function(has_numpy result candidate)
  execute_process(COMMAND ${candidate} -c "import numpy, sys; assert sys.version_info >= (3, 9)"
                  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(failed)
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

find_program(SWEEPFACE_PYTHON NAMES python3 python VALIDATOR has_numpy DOC "The interpreter of the package for Python")
# What was found for another interpreter is looked for again.
if(NOT SWEEPFACE_PYTHON STREQUAL SWEEPFACE_PYTHON_BEFORE)
  unset(_Python_INCLUDE_DIR CACHE)
  unset(PYTHON_MODULE_EXTENSION CACHE)
endif()
set(SWEEPFACE_PYTHON_BEFORE ${SWEEPFACE_PYTHON} CACHE INTERNAL "")

if(NOT SWEEPFACE_PYTHON)
  set(lacking "no Python 3.9 or later with NumPy")
else()
  set(Python_EXECUTABLE ${SWEEPFACE_PYTHON})
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
  if(NOT Python_FOUND)
    set(lacking "no headers of ${SWEEPFACE_PYTHON}")
  else()
    # A pybind11 that pip installed says where it is.
    execute_process(COMMAND ${SWEEPFACE_PYTHON} -m pybind11 --cmakedir OUTPUT_VARIABLE hint ERROR_QUIET
                    OUTPUT_STRIP_TRAILING_WHITESPACE)
    find_package(pybind11 2.10 QUIET HINTS ${hint})
    if(NOT pybind11_FOUND)
      set(lacking "no pybind11 2.10 or later")
    endif()
  endif()
endif()
if(lacking)
  message(STATUS "The package for Python is not built: ${lacking}.")
else()
  add_subdirectory(python)
endif()
