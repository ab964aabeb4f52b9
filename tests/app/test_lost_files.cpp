// Outputs that cannot be written, or that are removed during a run.

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "tests/support/shell.h"

namespace clatter {

namespace {

// Runs a line in the background, removes a file once it is there, and waits.
Outcome removed_while(const Shell& shell, const std::string& line, const std::string& file) {
  return shell.run(line + " & pid=$!\nwhile [ ! -e " + file +
                   " ] && kill -0 $pid; do sleep 0.01; done\nrm -r " + file + "; wait $pid");
}

}  // namespace

TEST_CASE("Lost files: a full disk or no file as standard output is an error of every command") {
  const Shell shell;
  for (const std::string line :
       {"bench engine --count 100 --area-fraction 0.1",
        "bench engine --count 100 --volume-fraction 0.1",
        "bench cores --count 100000 --area-fraction 0.1 --threads 1", "scenes", "help keys",
        "help sweep", "check vibrated", "completions fish", "--version", "--help",
        "measure vibrated --until 10 --quiet"}) {
    CAPTURE(line);
    const Outcome outcome = shell.run("clatter " + line + " >/dev/full");
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "No space left on device"));
  }
  CHECK(shell.run("clatter check vibrated >&-").code == 1);
}

TEST_CASE("Lost files: a picture that is removed during the film is an error that names it") {
  const Shell shell;
  const std::string film =
      "clatter render vibrated --size 64x64 --to 20 --quiet --out frames --sound";
  // Sound that lacks its beginning cannot continue.
  for (const auto& [file, advice] :
       {std::pair<std::string, std::string>{"frames/frame_000003.png",
                                            "continue with --resume frames.checkpoint"},
        {"frames/sound.wav", ""}}) {
    CAPTURE(file);
    shell.run("rm -rf frames");
    const Outcome outcome = removed_while(shell, film, file);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, file));
    CHECK(says(outcome.err, advice));
  }
}

TEST_CASE("Lost files: a growing file that is removed during the run is an error") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --quiet --until 600 --out r.json ";
  for (const std::string file : {"t.extxyz", "t.gsd", "t.h5md.records", "e.csv", "e.h5.records"}) {
    CAPTURE(file);
    const std::string name = file.substr(0, file.find(".records"));
    const std::string flags =
        file.starts_with('e') ? "--events " + name : "--every 1 --trajectory " + name;
    const Outcome outcome = removed_while(shell, line + flags, file);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "cannot write " + file));
    shell.run("rm -f t.* e.*");
  }
}

// Nobody has a lock on these files.
TEST_CASE(
    "Lost files: a run removes the hidden files of killed runs from the folders it writes to") {
  const Shell shell;
  shell.run("mkdir frames tables");
  for (const std::string folder : {"", "frames/", "tables/"}) {
    shell.write(folder + ".r.json.clatter-99-0", "half a result");
  }
  REQUIRE(shell
              .run("clatter measure vibrated --quiet --until 10 --out r.json --csv tables && "
                   "clatter render vibrated --size 64x64 --to 1 --quiet --out frames")
              .code == 0);
  CHECK(shell.run("find . -name '.*clatter*'").out.empty());
}

}  // namespace clatter
