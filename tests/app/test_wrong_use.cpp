// Every wrong use gives exit code 2, a message with the place, the problem and the fix, and no
// output.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "render/output/image.h"
#include "tests/support/shell.h"

namespace clatter {

namespace {

// A valid scene. A mistake replaces line 4 or 5.
std::string scene(const std::string& line_4 = "count = 10",
                  const std::string& line_5 = "restitution = 0.9") {
  return "[box]\nsize = [20, 20]\n[particles]\n" + line_4 + "\n" + line_5 + "\n";
}

struct WrongLine {
  std::string line;  // after `clatter`
  std::vector<std::string> words;
};

void check_all_refused(const Shell& shell, const std::vector<WrongLine>& lines) {
  for (const auto& [line, words] : lines) check_refused(shell, "clatter " + line, words);
}

const std::string kLong = "measure vibrated --until 1e6 ";
const std::string kPicture = "render vibrated --out x.png ";
const std::string kMovie = "render vibrated --out x.mp4 ";

}  // namespace

TEST_CASE("Wrong use: a message names the flag, the problem and the fix") {
  check_all_refused(
      Shell(),
      {
          // An unknown flag comes before missing arguments.
          {"render --frobnicate", {"there is no flag --frobnicate"}},
          {"sweep plot --frobnicate", {"there is no flag --frobnicate"}},
          {"mesure vibrated", {"mesure", "measure"}},
          {"bench nonsense", {"nonsense", "engine"}},
          {"render", {"scene is required"}},
          {"render vibrated", {"--out"}},
          {"render vibrated --out a.mp4 word", {"word: there is no such scene"}},
          {"measure vibrated --out a.json word", {"not expected: word"}},
          {"measure vibrated --out a.json --out b.json", {"--out is given 2 times"}},
          {"measure vibrated --out", {"--out: the value is missing; give FILE.json"}},
          {"measure vibrated --events e.csv --events-of 1,two", {"--events-of", "'1,two'"}},
          {"measure vibrated --set particles.count=0 --events e.csv --events-of 0",
           {"there is no particle 0"}},
          // No control characters reach the terminal.
          {"render vibrated --out a.mp4 --backend $(printf '\\033[31m')", {"'\\u001b[31m'"}},
          {"check vibrated \"$(printf 'two\nlines')\"", {"two\\u000alines"}},
          {"check nowhere.toml", {"nowhere.toml: ", "clatter scenes"}},
          {"check vibratd", {"did you mean the gallery scene 'vibrated'?"}},
          {"check .", {".: ", "directory"}},
          {"check ''", {"there is no such scene"}},
          {"check vibrated --set particles.count", {"--set KEY=VALUE"}},
          {"check vibrated --set =5", {"--set KEY=VALUE"}},
          {"check vibrated --set particles.cuont=5", {"--set particles.cuont", "'count'?"}},
          {"check vibrated --set particles.count=1e3", {"cannot be 1000.0"}},
          {"check vibrated --seed -1", {"--seed"}},
          {"measure vibrated --until 0", {"--until"}},
          {"measure vibrated --until nan", {"--until"}},
          {"measure vibrated --set measure.burn_in=500 --until 400", {"--until", "500"}},
          {"measure vibrated --set measure.burn_in=5.999999999999999 --until 6",
           {"--until", "5.999999999999999"}},
          {"measure vibrated --progress loud", {"--progress"}},
          {"measure vibrated --set measure.fields=[] --vtk maps", {"--vtk", "measure.fields="}},
          // Runs that would fill the memory or never end.
          {"measure vibrated --set measure.series_interval=1e-300", {"choose at least"}},
          {"measure vibrated --set measure.estimator=snapshot --set measure.interval=1e-300",
           {"measure.interval", "1e7 samples", "choose at least"}},
          {"measure vibrated --set measure.duration=1e308", {"samples"}},
          {kPicture + "--set view.window=1e-20", {"view.window", "choose at least"}},
          {kMovie + "--to 1e300", {"--to", "frames"}},
          {kPicture + "--size 16384x16384 --supersample 4", {"--size", "65536", "--supersample"}},
          {"view --size 319x240", {"from 320x240"}},
          {kMovie + "--fps 0", {"--fps"}},
          {kMovie + "--speed 0", {"--speed"}},
          {kMovie + "--from 9 --to 8", {"--to", "--from"}},
          {"render vibrated --out x.gif --fps 60", {"--fps", "at most --fps 50"}},
          {"render vibrated --out x.avi", {"x.avi", ".mp4"}},
          {"render vibrated --out .mp4", {".mp4: the name before the extension is missing"}},
      });
}

TEST_CASE("Wrong use: sizes that are no size are refused") {
  const Shell shell;
  for (const std::string size : {"nonsense", "1280", "1280x", "x720", "0x0", "-64x64", "64x64x64",
                                 "1e3x1e3", "99999x99999", "640x480px"}) {
    for (const std::string line : {"render vibrated --out x.png", "view vibrated"}) {
      check_refused(shell, "DISPLAY= clatter " + line + " --size=" + size,
                    {"--size", size, "1280x720"});
    }
  }
}

TEST_CASE("Wrong use: mistakes in a scene or a start state are refused at their line and column") {
  const Shell shell;
  const std::string start = "[particles.start]\nlayout = 'file'\nfile = 'a.csv'\n";
  shell.write("a.csv", "x,y,vx,vy\n1,1,0,0\n1.5,1,0,0\n");
  for (const auto& [text, words] : std::vector<WrongLine>{
           {scene("count = 10", "restituton = 0.9"), {"s.toml:5:1: ", "'restitution'?"}},
           // A triangular lattice on a square box: 23 rows of 20.
           {scene("count = 100000"), {"s.toml:4:1: ", "100000", "at most 4"}},
           {scene() + "[walls.left]\nkind = 'static'\n", {"s.toml:6:1: ", "[walls.right]"}},
           {scene("count = "), {"s.toml:4:"}},
           {"a = " + std::string(100'000, '[') + std::string(100'000, ']'), {"s.toml:1:"}},
           {"#" + std::string(10'000'000, ' '), {"s.toml: ", "larger than 1 MB"}},
           {start, {"a.csv:3:1: ", "lines 2 and 3"}},
       }) {
    shell.write("s.toml", text);
    for (const char* line : {"check s.toml", "measure s.toml --out r.json --csv tables",
                             "render s.toml --out film.mp4"}) {
      check_refused(shell, std::string("clatter ") + line, words);
    }
  }
}

TEST_CASE("Wrong use: no run starts if its output cannot be written") {
  const Shell shell;
  shell.run("mkdir folder; mkdir -p tab/maps.csv/x maps/series.pvd");
  std::vector<WrongLine> lines = {
      {kLong + "--hdf5 folder", {"--hdf5", "folder"}},
      {kLong + "--csv tab --out r.json", {"--csv", "tab/maps.csv is a folder"}},
      {kLong + "--vtk maps --out r.json", {"--vtk", "maps/series.pvd is a folder"}},
      {"render vibrated --to 1e5 --out missing/x.mp4", {"--out", "missing"}},
      {"bench growth --plot missing/x.png", {"--plot", "missing"}},
  };
  for (const std::string flag : {"--out", "--save-state"}) {
    for (const std::string out : {"missing/x", "folder", "folder/"}) {
      lines.push_back({kLong + flag + ' ' + out, {flag, "folder"}});
    }
  }
  for (const std::string table :
       {"engine", "growth", "features", "fields", "render", "window", "timeline"}) {
    lines.push_back({"bench " + table + " --json missing/x", {"--json", "missing"}});
  }
  for (const std::string flag : {"--csv", "--vtk"}) {
    lines.push_back({kLong + flag + " missing/x", {flag, "missing"}});
    const Outcome outcome = shell.run("clatter " + kLong + flag + " /proc/x");
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "cannot make the folder /proc/x"));
  }
  check_all_refused(shell, lines);
}

TEST_CASE("Wrong use: output that fails at the end gives exit code 1 and a message") {
  const Shell shell;
  for (const std::string flag : {"--hdf5", "--save-state"}) {
    const Outcome outcome =
        shell.run("clatter measure vibrated --set measure.burn_in=0 --until 5 --quiet " + flag +
                  " /dev/full");
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "cannot write /dev/full: "));
    CHECK(says(outcome.err, "; continue with --resume vibrated-seed1.checkpoint\n"));
  }
}

TEST_CASE("Outputs: a current folder that was removed is named in plain words") {
  const Outcome outcome = Shell().run(
      "mkdir gone; cd gone; rmdir ../gone; clatter measure vibrated --until 1 --out a.json");
  CHECK(outcome.code == 1);
  CHECK(says(outcome.err, "cannot use a.checkpoint: No such file or directory\n"));
}

TEST_CASE("Outputs: a system without files or threads is named, and not a missing program") {
  const Shell shell;
  const std::string render = "clatter render vibrated --to 0.2 --size 64x48 --quiet ";
  bool failed = false;
  for (int files = 5; files < 15; ++files) {
    CAPTURE(files);
    const Outcome outcome = shell.run("ulimit -n " + std::to_string(files) + "; " + render +
                                      "--out film.gif --overwrite");
    CAPTURE(outcome.err);
    CHECK_FALSE(says(outcome.err, "films need ffmpeg"));
    failed |= says(outcome.err, "cannot make a pipe to ffmpeg: Too many open files");
  }
  CHECK(failed);
  if (is_sanitized()) return;
  // A thread needs more address space for its stack than there is.
  const Outcome outcome =
      shell.run("ulimit -s 9000000; ulimit -v 6000000; " + render + "--out folder");
  CHECK(outcome.code == 1);
  CHECK(says(outcome.err, "cannot start a thread: Resource temporarily unavailable"));
}

TEST_CASE("Outputs: one that fails costs no other, and a checkpoint has the results") {
  const Shell shell;
  const std::string line =
      "clatter measure vibrated --set measure.burn_in=1 --set measure.cells=[7,5] --set "
      "'measure.fields=[\"density\", \"balance\"]' --until 30 --quiet ";
  REQUIRE(shell.run(line + "--out whole.json").code == 0);
  const Outcome failed =
      shell.run(line + "--out /dev/full --csv tab --vtk maps --hdf5 r.h5 --save-state e.csv");
  CHECK(failed.code == 1);
  CHECK(says(failed.err, "cannot write /dev/full: No space left on device; continue"));
  for (const char* file : {"tab/maps.csv", "maps/fields.vti", "r.h5", "e.csv"}) {
    CAPTURE(file);
    CHECK_FALSE(shell.read(file).empty());
  }
  REQUIRE(shell.run(line + "--out again.json --resume vibrated-seed1.checkpoint").code == 0);
  auto whole = nlohmann::json::parse(shell.read("whole.json"));
  auto again = nlohmann::json::parse(shell.read("again.json"));
  for (auto* result : {&whole, &again}) result->erase("performance");
  CHECK(again == whole);
}

// The reader ends at once, and so closes the pipe.
TEST_CASE("Outputs: a result whose reader has ended is in a checkpoint, or in a new file") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --set measure.burn_in=1 --until 30 ";
  REQUIRE(shell.run("(" + line + "; echo $? >code) | true").code == 0);
  CHECK(shell.read("code") == "1\n");
  CHECK(shell.run(line + "--out r.json --resume vibrated-seed1.checkpoint").code == 0);
  REQUIRE(shell.run("(" + line + "--replicas 2 2>told; echo $? >code) | true").code == 0);
  CHECK(shell.read("code") == "1\n");
  CHECK(says(shell.read("told"), "cannot write stdout: Broken pipe; the result is in"));
}

TEST_CASE("Outputs: replicas whose result cannot be written go to stdout, or to a new file") {
  const Shell shell;
  const std::string line =
      "clatter measure vibrated --set measure.burn_in=1 --until 5 --quiet --replicas 2 --seed 7 ";
  REQUIRE(shell.run(line + "--out whole.json").code == 0);
  const std::string whole = shell.read("whole.json");
  const auto fails = [&](const std::string& output, const std::string& where) {
    const Outcome outcome = shell.run(line + output);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, where));
    return outcome.out;
  };
  CHECK(fails("--out /dev/full", "the result is on stdout\n") == whole);
  fails(">/dev/full", "; the result is in vibrated-seed7.json\n");
  CHECK(shell.read("vibrated-seed7.json") == whole);
  // The second result does not replace the first.
  fails("--set measure.burn_in=2 >/dev/full", "is lost, because vibrated-seed7.json exists");
  CHECK(shell.read("vibrated-seed7.json") == whole);
}

TEST_CASE(
    "Wrong use: outputs that would replace inputs, or the automatic checkpoint, are refused") {
  const Shell shell;
  shell.run("clatter check vibrated > s.toml");
  shell.run(
      "clatter measure vibrated --until 1 --quiet --checkpoint c --out r.json --save-state e.csv");
  const std::string start = "--set 'particles.start={layout=\"file\",file=\"e.csv\"}' ";
  for (const auto& [line, flag] : std::vector<std::pair<std::string, std::string>>{
           {"measure s.toml --until 2 --out s.toml", "--out"},
           {"measure s.toml --until 2 --save-state ./s.toml", "--save-state"},
           {"render s.toml --to 1 --checkpoint s.toml --out x.mp4", "--checkpoint"},
           {"measure s.toml --until 2 " + start + "--out e.csv", "--out"},
           {"measure s.toml --until 2 --resume c --out c", "--out"},
           {"render s.toml --to 1 --out x.mp4 --checkpoint x.mp4.part", "--out"},
           {kLong + "--out run.checkpoint", "--checkpoint"},
           {kLong + "--out ./run.json --save-state run.checkpoint", "--checkpoint"},
           {kLong + "--out run.json --hdf5 run.checkpoint.previous", "--checkpoint"},
           {kLong + "--save-state vibrated-seed1.checkpoint", "--checkpoint"},
           {kLong + "--seed 7 --csv vibrated-seed7.checkpoint", "--checkpoint"},
       }) {
    check_refused(shell, "clatter " + line, {flag, "is the file that", "choose different names"});
  }
  check_refused(shell, "clatter measure s.toml --resume ''", {"--resume", "the name is empty"});
  for (const std::string flag :
       {"--out", "--csv", "--vtk", "--hdf5", "--save-state", "--checkpoint"}) {
    check_refused(shell, "clatter measure s.toml --until 2 " + flag + " ''", {flag, "name a file"});
  }
  CHECK(shell
            .run("clatter measure vibrated --until 1 --seed 7 --save-state "
                 "vibrated-seed1.checkpoint")
            .code == 0);
}

TEST_CASE("Wrong use: a checkpoint does not replace another file") {
  const Shell shell;
  for (const std::string file :
       {"run.checkpoint", "run.checkpoint.previous", "vibrated-seed1.checkpoint.previous"}) {
    shell.write(file, "precious");
    const std::string named = file.substr(0, file.find('.'));
    const std::string refused = file + " exists and is not a checkpoint";
    const std::string out = named == "run" ? "--out run.json" : "";
    check_all_refused(shell,
                      {{kLong + "--csv tables " + out, {refused, "move it, or name a checkpoint"}},
                       {kLong + "--checkpoint " + named + ".checkpoint", {refused}}});
    if (named == "run") check_refused(shell, "clatter render vibrated --out run.mp4", {refused});
    CHECK(shell.run("clatter measure vibrated --until 1 --quiet --checkpoint c " + out).code == 0);
    CHECK(shell.read(file) == "precious");
    shell.run("rm -f run.* vibrated*");
  }
  // The new checkpoint replaces the resumed one, or the one after it.
  const std::string line = "clatter measure vibrated --set measure.burn_in=0 --quiet --out c.json ";
  const std::string named = line + "--checkpoint c.checkpoint ";
  CHECK(shell.run(named + "--until 1 --checkpoint-every 0.001").code == 0);
  CHECK(shell.run(named + "--until 2 --resume c.checkpoint").code == 0);
  CHECK(shell.run(named + "--until 3 --resume ./c.checkpoint.previous").code == 0);
  CHECK(shell.run(line + "--until 4 --resume c.checkpoint").code == 0);
}

TEST_CASE("Wrong use: a write-protected result of an earlier run is not replaced") {
  const Shell shell;
  shell.run("mkdir tab maps");
  for (const auto& [line, file] : std::vector<std::pair<std::string, std::string>>{
           {kLong + "--out r.json", "r.json"},
           {kLong + "--hdf5 r.h5", "r.h5"},
           {kLong + "--save-state e.csv", "e.csv"},
           {kLong + "--csv tab", "tab/maps.csv"},
           {kLong + "--vtk maps", "maps/fields.vti"},
           {kLong + "--checkpoint c", "c"},
           {"render vibrated --to 1e5 --out film.mp4", "film.mp4"},
           {"render vibrated --to 1e5 --out picture.png", "picture.png"}}) {
    CAPTURE(line);
    shell.write(file, "precious");
    const Outcome outcome = shell.run("chmod 444 " + file + "; clatter " + line);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "cannot write " + file + ": it is write-protected"));
    CHECK(shell.read(file) == "precious");
  }
}

TEST_CASE("Wrong use: names that the file system refuses are reported before a run") {
  const Shell shell;
  shell.run("ln -s loop loop; ln -s loop.mp4 loop.mp4");
  const std::string longest(251, 'a');
  for (const auto& [line, reason] : std::vector<std::pair<std::string, std::string>>{
           {kLong + "--out loop", "cannot write loop: Too many levels of symbolic links"},
           {kLong + "--checkpoint loop", "cannot write loop: Too many levels"},
           {kLong + "--save-state " + longest + ".json", ".json: File name too long"},
           {"render vibrated --out loop.mp4", "cannot write loop.mp4: Too many levels"},
           {kLong + "--out " + longest + ".txt", ".checkpoint is too long; name a checkpoint"},
           {"render vibrated --out " + longest + ".mp4", ".checkpoint is too long"},
           {"render vibrated --checkpoint c --out " + longest + ".mp4", "name too long"},
           {"render vibrated --out /sys/frames", "cannot write to /sys/frames: "}}) {
    CAPTURE(line);
    const Outcome outcome = shell.run("clatter " + line);
    CAPTURE(outcome.err);
    CHECK((outcome.code == 1 || outcome.code == 2));
    CHECK(says(outcome.err, reason));
    CHECK_FALSE(says(outcome.err, "filesystem"));
    CHECK_FALSE(says(outcome.err, "No such file"));
  }
  // A measurement can have a name of any length, if its checkpoint has another one.
  CHECK(shell
            .run("clatter measure vibrated --until 1 --quiet --checkpoint c --out " + longest +
                 ".txt")
            .code == 0);
  for (const std::string& name : {std::string("loop"), longest + ".toml"}) {
    check_all_refused(
        shell, {{"check " + name, {name + ": "}}, {kLong + "--resume " + name, {name + ": "}}});
  }
}

// A device keeps its type. An open file is kept too, because others may write to it.
TEST_CASE("Outputs: devices, links and open files are written into") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --until 1 --quiet --out ";
  CHECK(shell.run(line + "/dev/null && test -c /dev/null").code == 0);
  CHECK(shell.run("echo before > all; " + line + "/dev/stdout >> all; echo after >> all").code ==
        0);
  const std::string all = shell.read("all");
  CHECK(all.starts_with("before\n{"));
  CHECK(all.ends_with("}\nafter\n"));
  CHECK(shell.run(line + "/dev/fd/5 5> five && " + line + "/proc/self/fd/6 6> six").code == 0);
  CHECK(shell.read("five").starts_with("{"));
  CHECK(shell.read("six").starts_with("{"));
  CHECK(shell.run("touch real; ln -s real link; " + line + "link && test -L link").code == 0);
  CHECK(shell.read("real").starts_with("{"));
  // Two outputs may go to one device.
  CHECK(shell.run(line + "/dev/null --save-state /dev/null").code == 0);
}

TEST_CASE("Wrong use: a picture without a scene is refused as a picture") {
  const Shell shell;
  REQUIRE(shell.run("ffmpeg -v error -f lavfi -i color=red:16x16 -frames:v 1 red.png").code == 0);
  check_refused(shell, "clatter check red.png", {"red.png: this picture contains no scene"});
  const auto check_scene_of = [&](std::size_t size, const std::string& problem) {
    std::string text(size, ' ');
    text.front() = '#';
    const std::vector<PngText> texts = {{"Scene", text}};
    write_png(shell.path("large.png"), Image{{1, 1}, {0, 0, 0, 255}}, texts);
    check_refused(shell, "clatter check large.png", {"large.png: ", problem});
  };
  check_scene_of(1'000'001, "larger than 1 MB");
  check_scene_of(1'000'000, "the number of particles is missing");
  shell.write("text.png", "These words are no scene.\n");
  check_refused(shell, "clatter check text.png", {"text.png: this is not a PNG picture"});
}

TEST_CASE("Wrong use: outputs that would replace each other are refused") {
  const Shell shell;
  shell.run("mkdir folder tables && ln -s folder link");
  const std::vector<std::string> flags = {"--out",  "--csv",        "--vtk",
                                          "--hdf5", "--save-state", "--checkpoint"};
  for (std::size_t k = 0; k < flags.size(); ++k) {
    for (std::size_t other = 0; other < k; ++other) {
      check_refused(
          shell,
          "clatter " + kLong + flags[k] + " link/x " + flags[other] + " ./folder/../folder/x",
          {flags[k], flags[other], "/x is the file that", "choose different names"});
    }
  }
  check_all_refused(
      shell, {{kLong + "--csv x/ --vtk x", {"--vtk", "--csv"}},
              {kLong + "--checkpoint c --out c.previous", {"--checkpoint", "c.previous", "--out"}},
              {kMovie + "--checkpoint x.mp4", {"--checkpoint", "--out"}}});
  for (const std::string file :
       {"--csv d --out d/temperature_series.csv", "--csv d --hdf5 d/profile.csv",
        "--csv d --save-state d/maps.csv", "--vtk d --out d/fields.vti",
        "--vtk d --checkpoint d/series.pvd", "--vtk d --out d/series_63.vti"}) {
    const std::string name = file.substr(file.rfind("d/"));
    check_refused(shell, "clatter " + kLong + file,
                  {file.substr(0, 5), name + " is the file that", "choose different names"});
  }
  CHECK(shell
            .run("clatter measure vibrated --set measure.burn_in=0 --until 1 --quiet "
                 "--csv tables --out tables/r.json --save-state tables/series_00.vti")
            .code == 0);
}

TEST_CASE("Wrong use: replicas beyond the last seed, or with other laws, are refused") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --until 1 --replicas 2 ";
  check_refused(shell, line + "--set 'change=[{time=1, set={\"particles.restitution\"=0.5}}]'",
                {"--replicas: the laws of this scene change; measure each seed separately, or"});
  check_refused(shell, line + "--seed 18446744073709551615", {"--seed", "18446744073709551615"});
  const Outcome last = shell.run(line + "--seed 18446744073709551614");
  CHECK(last.code == 0);
  CHECK(nlohmann::json::parse(last.out).at("seeds").back() == 18446744073709551615u);
}

TEST_CASE("Wrong use: without a display the message has the fix") {
  const Shell shell;
  const Outcome x11 =
      shell.run("DISPLAY= clatter render vibrated --backend glfw --out x.png --to 0.1");
  CHECK(x11.code == 1);
  CHECK(says(x11.err, "glfw: no display"));
  CHECK(says(x11.err, "use egl or osmesa"));
  CHECK_FALSE(says(x11.err, "Wayland session"));
  const Outcome wayland =
      shell.run("DISPLAY= XDG_RUNTIME_DIR=/none WAYLAND_DISPLAY=wayland-0 clatter view vibrated");
  CHECK(wayland.code == 1);
  CHECK(says(wayland.err, "install Xwayland"));
}

}  // namespace clatter
