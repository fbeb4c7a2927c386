# SPDX-License-Identifier: BSD-3-Clause
# Find the interpreter for which the package is built and tested: the first of those at hand that has its headers,
# cffi, numpy and pytest. Sets CAPSTAN_PYTHON_EXECUTABLE, empty if there is none, and CAPSTAN_PYTHON_INCLUDE.
find_package(Python3 COMPONENTS Interpreter)
set(ask "import os, sys, sysconfig, cffi, numpy, pytest
folder = sysconfig.get_paths()['include']
sys.exit(1) if sys.version_info < (3, 9) or not os.path.exists(os.path.join(folder, 'Python.h')) else print(folder)")
set(CAPSTAN_PYTHON_EXECUTABLE "")
foreach(candidate IN ITEMS ${Python3_EXECUTABLE} /usr/bin/python3)
  execute_process(COMMAND ${candidate} -c ${ask} RESULT_VARIABLE failed OUTPUT_VARIABLE folder ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed EQUAL 0)
    set(CAPSTAN_PYTHON_EXECUTABLE ${candidate})
    set(CAPSTAN_PYTHON_INCLUDE ${folder})
    break()
  endif()
endforeach()
