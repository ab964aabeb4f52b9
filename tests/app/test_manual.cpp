#include <doctest/doctest.h>

#include "tests/support/shell.h"

namespace clatter {

TEST_CASE("Manual: man formats the page without warnings") {
  const Shell shell;
  if (shell.run("command -v man").code != 0) {
    MESSAGE("[skipped] there is no man");
    return;
  }
  shell.run("clatter help --man > clatter.1");
  const Outcome outcome = shell.run("LC_ALL=C.UTF-8 man --warnings -l clatter.1 | cat");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(says(outcome.out, "clatter - "));
}

TEST_CASE("Manual: the page has the commands, their flags and the exit codes") {
  const std::string page = Shell().run("clatter help --man").out;
  for (const char* part :
       {".SS clatter view\n", ".SS clatter bench accuracy\n", ".SS clatter help keys\n",
        "\\fB\\-q\\fR, \\fB\\-\\-quality\\fR", ".SH EXIT STATUS\n.TP\n0\n"}) {
    CAPTURE(part);
    CHECK(says(page, part));
  }
}

TEST_CASE("Manual: lines of help do not become requests of roff") {
  const std::string page = Shell().run("clatter help --man").out;
  for (const char* request : {"\n.mp4", "\n'particles", "\n.gif"}) {
    CAPTURE(request);
    CHECK_FALSE(says(page, request));
  }
}

}  // namespace clatter
