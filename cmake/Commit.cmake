# Writes commit.cpp, which has the commit of a checkout in 12 digits, or an empty text elsewhere. A
# new commit configures the build again and compiles that one file.
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
