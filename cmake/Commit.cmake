# Writes commit.cpp with the 12-digit commit of a checkout, or an empty text without a checkout.
# After a new commit, the build is configured again, and this one file is compiled.
set(commit "")
set(log "")
find_package(Git QUIET)
if(Git_FOUND AND EXISTS ${CMAKE_SOURCE_DIR}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --short=12 HEAD
                  WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE commit
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  # Each commit and each checkout adds a line to this file.
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --path-format=absolute --git-path logs/HEAD
                  WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE log
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(EXISTS "${log}")
  set_property(DIRECTORY ${CMAKE_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${log})
endif()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/commit.cpp CONTENT
"#include \"app/system/commit.h\"

const char* const clatter::kCommit = \"${commit}\";
")
