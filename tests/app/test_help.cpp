#include <doctest/doctest.h>

#include <filesystem>
#include <utility>

#include "tests/support/shell.h"

namespace clatter {

TEST_CASE("Help: docs/scene.md has the current keys; the target scene_docs writes them") {
  const Shell shell;
  std::filesystem::copy_file(CLATTER_DOCS "/scene.md", shell.path("scene.md"));
  const std::string before = shell.read("scene.md");
  const Outcome outcome = shell.run("clatter help keys --markdown scene.md");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(shell.read("scene.md") == before);
}

TEST_CASE("Help: a page without the table of a key is refused") {
  const Shell shell;
  shell.write("page.md", "# Keys\n");
  check_refused(shell, "clatter help keys --markdown page.md", {"page.md has no part"});
}

TEST_CASE("Help: a key has its unit, values and conditions, and a table has all of its keys") {
  const Shell shell;
  const std::string stroke = shell.run("clatter help keys walls.right.stroke").out;
  CAPTURE(stroke);
  for (const char* part : {"walls.SIDE.stroke\n", "  unit     a\n", "between 0 and 1e+06\n",
                           "kind = \"sawtooth\" or kind = \"sinusoidal\""}) {
    CHECK(says(stroke, part));
  }
  CHECK(says(shell.run("clatter help keys particles.inertia").out, "0.5, for spheres 0.4\n"));
  CHECK(says(shell.run("clatter help keys particles.restitution").out, "[[change]]"));
  const std::string all = "\n" + shell.run("clatter help keys").out;
  for (const std::string key : {"schema", "walls.SIDE.phase", "view.card", "change.until"}) {
    CAPTURE(key);
    CHECK(says(all, "\n" + key + "\n  "));
  }
  const std::string camera = shell.run("clatter help keys view.camera").out;
  CHECK(says(camera, "view.camera.width\n"));
  CHECK_FALSE(says(camera, "view.card\n"));
}

TEST_CASE("Help: a misspelt key or command is refused with a suggestion") {
  const Shell shell;
  for (const auto& [topic, suggestion] :
       {std::pair<std::string, std::string>{"keys particles.restitutoin",
                                            "'particles.restitution'"},
        {"particles.cuont", "'particles.count'"},
        {"rendr", "'render'"},
        {"bench engin", "'engine'"}}) {
    check_refused(shell, "clatter help " + topic, {suggestion});
  }
  CHECK(shell.run("clatter help particles.count").out ==
        shell.run("clatter help keys particles.count").out);
}

TEST_CASE("Help: help of a command is the same as its --help") {
  const Shell shell;
  for (const std::string command : {"", "render", "bench", "bench accuracy", "help"}) {
    CAPTURE(command);
    const Outcome help = shell.run("clatter help " + command);
    CHECK(help.code == 0);
    CHECK(help.out == shell.run("clatter " + command + " --help").out);
  }
}

}  // namespace clatter
