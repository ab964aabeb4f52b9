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
  CHECK(says(outcome.out, "clatter - simulate driven granular gases of hard disks and spheres"));
}

TEST_CASE("Manual: the page has every command, its flags, and the exit codes") {
  const Shell shell;
  const std::string page = shell.run("clatter help --man").out;
  for (const char* part : {".SH DESCRIPTION\n.PP\nSimulate ", ".SH OPTIONS\n.TP\n\\fB\\-h\\fR",
                           ".SH COMMANDS\n.SS clatter view\n", ".SS clatter bench accuracy\n",
                           ".SS clatter help keys\n", "\\fB\\-q\\fR, \\fB\\-\\-quality\\fR",
                           "\\fB\\-\\-checkpoint\\-every\\fR \\fINUMBER\\fR",
                           ".SH EXIT STATUS\n.TP\n0\nSuccess.\n.TP\n1\nA run or a check failed.\n"
                           ".TP\n2\nWrong use, or a wrong scene.\n.TP\n3\nThe physics stopped.\n"
                           ".TP\n130\nInterrupted. "}) {
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
