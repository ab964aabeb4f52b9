// Films of several gases beside each other, with the command line.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "app/film/compared_scenes.h"
#include "engine/scene/scene_file.h"
#include "render/output/image.h"
#include "tests/app/film_scene.h"

namespace clatter {

namespace {

// The pixels of a part of a picture, as a hash. `part` is WIDTH:HEIGHT:LEFT:TOP.
std::string pixels_of(const Shell& shell, const std::string& file, const std::string& part) {
  return shell.run("ffmpeg -v error -i " + file + " -vf format=rgba,crop=" + part + " -f md5 -")
      .out;
}

std::string state_hash(const Shell& shell, const std::string& setting) {
  const Outcome run = shell.run(
      "clatter measure vibrated --quiet --set measure.burn_in=0 --until 5 --set " + setting);
  return nlohmann::json::parse(run.out).at("state_hash");
}

// About 150 frames of three gases whose averages, trails and plots reach beyond the parts of the
// film.
const std::string kComparison =
    "clatter render scene.toml --compare particles.restitution=1 --compare walls.left.stroke=0.4 "
    "--size 240x90 --fps 10 --quiet --speed 1 --to 9 ";

Scene with(const std::vector<Override>& settings) {
  return load_scene("vibrated", settings);
}

}  // namespace

TEST_CASE("Compare films: each cell shows the gas alone, with its hash") {
  const Shell shell;
  const std::string line = "clatter render vibrated --quiet --no-overlay --to 5 ";
  const std::string ranges = "--set 'view.range=[0,3]' --set 'view.field_range=[0,0.8]' ";
  const Outcome both =
      shell.run(line + ranges +
                "--compare particles.restitution=1 --compare particles.count=90 "
                "--compare particles.restitution=0.6 --size 321x241 --out all.png");
  CAPTURE(both.err);
  REQUIRE(both.code == 0);
  struct Cell {
    std::string setting, size, part, name;
  };
  for (const Cell& cell : {Cell{"particles.restitution=0.9", "160x120", "160:120:0:0", ""},
                           Cell{"particles.restitution=1", "161x120", "161:120:160:0", " B"},
                           Cell{"particles.count=90", "160x121", "160:121:0:120", " C"},
                           Cell{"particles.restitution=0.6", "161x121", "161:121:160:120", " D"}}) {
    CAPTURE(cell.name);
    const Outcome alone = shell.run(line + ranges + "--set " + cell.setting + " --size " +
                                    cell.size + " --out alone.png");
    CAPTURE(alone.err);
    REQUIRE(alone.code == 0);
    const std::string whole(cell.part, 0, cell.part.find(':', cell.part.find(':') + 1));
    CHECK(pixels_of(shell, "all.png", cell.part) == pixels_of(shell, "alone.png", whole + ":0:0"));
    CHECK(png_text(shell.path("all.png"), "State hash" + cell.name) ==
          state_hash(shell, cell.setting));
  }
  const auto text = png_text(shell.path("all.png"), "Scene B");
  REQUIRE(text);
  CHECK(says(*text, "restitution = 1.0"));
}

TEST_CASE("Compare films: disks and spheres are beside each other in a film") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter render vibrated spheres_vibrated --size 200x100 --quiet --fps 10 --speed 1 --to 1 "
      "--out film.mp4");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(shell.files() == std::vector<std::string>{"film.mp4"});
}

TEST_CASE("Compare films: parts from checkpoints, and a resumed film, are the film") {
  const Shell shell;
  write_film_scene(shell,
                   ", plots = [\"temperature\", \"velocities\", \"density_profile\"], "
                   "pace = [{ time = 2.0, factor = 1.0 }, { time = 3.0, factor = 0.5 }]");
  REQUIRE(
      shell.run(kComparison + "--out whole && " + kComparison + "--sound --out whole.mkv").code ==
      0);
  for (const std::string part : {"--frames 0:37 --checkpoint c", "--frames 37: --resume c"}) {
    CAPTURE(part);
    const Outcome outcome = shell.run(kComparison + "--out parts " + part);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
  }
  CHECK(shell.run("diff -r whole parts && rm c*").code == 0);

  const Outcome cut = cut_off(shell, kComparison + "--sound --out film.mkv", "TERM");
  CAPTURE(cut.err);
  CHECK(cut.code == 130);
  const Outcome resumed = shell.run(kComparison + "--out film.mkv --resume c");
  CAPTURE(resumed.err);
  CHECK(resumed.code == 0);
  CHECK(shell.run("cmp film.mkv whole.mkv").code == 0);
}

TEST_CASE("Compare films: a checkpoint refuses other gases") {
  const Shell shell;
  const std::string line =
      "clatter render vibrated --size 100x50 --quiet --fps 10 --speed 1 "
      "--to 2 --out frames ";
  REQUIRE(shell.run(line + "--compare particles.restitution=1 --frames 0:9 --checkpoint c").code ==
          0);
  check_refused(shell, line + "--resume c", {"gases", "is 2, not 1"});
  check_refused(shell, line + "--compare particles.restitution=0.8 --resume c",
                {"compares other scenes or seeds"});
}

TEST_CASE("Compare films: the stop of a gas beside the run ends the film and names the gas") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter render equilibrium --set particles.count=300 --set 'box.size=[25,25]' "
      "--compare particles.restitution=0.1 --size 150x50 --quiet --fps 10 --to 1000 --speed 20 "
      "--out film.mp4");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 3);
  CHECK(says(outcome.err, "B: time does not advance"));
  CHECK(says(outcome.err, "inelastic collapse"));
}

TEST_CASE("Compare films: what a film of several gases cannot have is refused") {
  const Shell shell;
  const std::string one = "--compare particles.restitution=1 ";
  const std::string more = "--compare particles.count=9 --compare particles.count=8 ";
  for (const auto& [flags, word] :
       {std::pair<std::string, std::string>{one + more + more, "at most 4 gases"},
        {one + "--slurm 4", "--slurm"},
        {one + "--join .", "--join"},
        {one + more + "--size 40x30", "16x16"},
        {"--compare restitution", "--compare restitution: "},
        {"--compare particles.restitution=7", "--compare particles.restitution: "},
        {"--set particles.count=-1 --compare walls=1", "--set particles.count: "}}) {
    check_refused(shell, "clatter render vibrated " + flags + " --out f.mp4", {word});
  }
  REQUIRE(shell.run("clatter render vibrated --quiet --size 40x40 --to 0 --out b.png").code == 0);
  check_refused(shell, "clatter render cradle b.png --out b.png", {"b.png"});
}

TEST_CASE("Compare films: headings name what differs") {
  using Titles = std::vector<std::string>;
  const Scene inelastic = with({}), elastic = with({{"particles.restitution", "1"}});
  const Scene other = with({{"title", "\"Other\""}});
  const Scene changed =
      with({{"change", "[{time = 3.0, set = {\"particles.restitution\" = 1.0}}]"}});
  CHECK(cell_titles({{elastic, 1}, {elastic, 2}}) == Titles{"A: seed 1", "B: seed 2"});
  CHECK(cell_titles({{elastic, 1}, {elastic, 1}}) == Titles{"A", "B"});
  CHECK(cell_titles({{inelastic, 1}, {elastic, 1}, {other, 1}}) ==
        Titles{"A: " + inelastic.title + ", restitution 0.9",
               "B: " + inelastic.title + ", restitution 1", "C: Other"});
  CHECK(cell_titles({{inelastic, 1}, {changed, 1}}) ==
        Titles{"A: without changes", "B: with changes"});
}

}  // namespace clatter
