#include <doctest/doctest.h>

#include <filesystem>

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
  check_refused(shell, "clatter help keys --markdown page.md",
                {"page.md has no part for the keys of the scene"});
}

TEST_CASE("Help: a key is printed with its unit, default, values and conditions") {
  const Shell shell;
  const std::string stroke = shell.run("clatter help keys walls.right.stroke").out;
  CAPTURE(stroke);
  CHECK(says(stroke, "walls.SIDE.stroke\n"));
  CHECK(says(stroke, "  unit     a\n"));
  CHECK(says(stroke, "  default  required\n"));
  CHECK(says(stroke, "  values   a number between 0 and 1e+06\n"));
  CHECK(says(stroke, "Required with kind = \"sawtooth\" or kind = \"sinusoidal\", not"));
  const std::string inertia = shell.run("clatter help keys particles.inertia").out;
  CAPTURE(inertia);
  CHECK(says(inertia, "  default  0.5, for spheres 0.4\n"));
  CHECK(says(inertia, "no\n  meaning where nothing spins."));
}

TEST_CASE("Help: a table has all of its keys, and no name has all keys of a scene") {
  const Shell shell;
  const std::string all = shell.run("clatter help keys").out;
  for (const char* key : {"schema", "box.size", "particles.count", "particles.volume_fraction",
                          "particles.start.file", "walls.SIDE.phase", "gravity.acceleration",
                          "bulk_drive.kick_spin", "collapse.contact_time", "measure.width",
                          "view.card", "view.camera.follow", "change.until"}) {
    CAPTURE(key);
    CHECK(says("\n" + all, std::string("\n") + key + "\n  "));
  }
  const std::string camera = shell.run("clatter help keys view.camera").out;
  CHECK(says(camera, "view.camera.width\n"));
  CHECK_FALSE(says(camera, "view.card\n"));
}

TEST_CASE("Help: entries of keys are separate, and name the keys that change in a run") {
  const Shell shell;
  const std::string all = shell.run("clatter help keys").out;
  CHECK(all.starts_with("schema\n"));
  CHECK(says(all, "\n\ntitle\n"));
  CHECK(says(shell.run("clatter help keys particles.restitution").out,
             "\n  changes  in a run, by [[change]] and in the window\n"));
}

TEST_CASE("Help: a page has the usage, the summaries of its commands and the related flags") {
  const Shell shell;
  const std::string program = shell.run("clatter --help").out;
  CHECK(program.starts_with("Simulate driven granular gases of hard disks and spheres."));
  CHECK(says(program, "\nUsage: clatter [OPTIONS] COMMAND\n"));
  CHECK(says(program, "\n  scenes                    List the scenes of the gallery.\n"));
  CHECK(says(shell.run("clatter help bench").out, "\nTables:\n  engine "));
  CHECK(says(shell.run("clatter help help").out, "\nTopics:\n  keys "));
  const std::string measure = shell.run("clatter help measure").out;
  CHECK(says(measure, " Print errors only on stderr.\n"));
  CHECK(says(measure, " Default: 600. Needs --checkpoint.\n"));
  CHECK(says(measure, " Excludes --accuracy, --checkpoint, --csv, --events, --hdf5,\n"));
}

TEST_CASE("Help: a misspelt key or command is refused with a suggestion") {
  const Shell shell;
  check_refused(shell, "clatter help keys particles.restitutoin",
                {"there is no key", "did you mean 'particles.restitution'?"});
  check_refused(shell, "clatter help particles.cuont",
                {"there is no key 'particles.cuont'; did you mean 'particles.count'?"});
  CHECK(shell.run("clatter help particles.count").out ==
        shell.run("clatter help keys particles.count").out);
  check_refused(shell, "clatter help rendr", {"no command 'rendr'", "did you mean 'render'?"});
  check_refused(shell, "clatter help bench engin", {"no table 'engin'", "'engine'?"});
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
