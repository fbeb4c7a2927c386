# SPDX-License-Identifier: BSD-3-Clause
# Do all places that name the version agree with VERSION (CMake's)?    Needs SOURCE, VERSION, COMMAND.

function(expect where found)
  if(NOT found STREQUAL VERSION)
    message(SEND_ERROR "${where} says '${found}', CMakeLists.txt says '${VERSION}'")
  endif()
endfunction()

# the macros of base.h
file(READ ${SOURCE}/include/capstan/base.h header)
foreach(part MAJOR MINOR PATCH)
  string(REGEX MATCH "CPS_VERSION_${part} ([0-9]+)" match "${header}")
  list(APPEND parts ${CMAKE_MATCH_1})
endforeach()
list(JOIN parts "." found)
expect(include/capstan/base.h "${found}")

# the command (and through it cps_version)
execute_process(COMMAND ${COMMAND} --version OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" found "${output}")
expect("capstan --version" "${found}")

# what is cited, and the newest numbered entry of the change log
file(STRINGS ${SOURCE}/CITATION.cff line REGEX "^version:")
string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" found "${line}")
expect(CITATION.cff "${found}")
file(STRINGS ${SOURCE}/CHANGELOG.md line REGEX "^## .*[0-9]+\\.[0-9]+\\.[0-9]+" LIMIT_COUNT 1)
string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" found "${line}")
expect(CHANGELOG.md "${found}")
