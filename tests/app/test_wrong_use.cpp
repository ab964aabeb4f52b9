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

}  // namespace

TEST_CASE("Wrong use: an unknown flag is named before missing arguments") {
  const Shell shell;
  for (const std::string line :
       {"clatter render --frobnicate", "clatter measure --frobnicate 3",
        "clatter render vibrated --out a.mp4 --frobnicate", "clatter sweep plot --frobnicate"}) {
    check_refused(shell, line, {"clatter: there is no flag --frobnicate; `clatter help COMMAND`"});
  }
  check_refused(shell, "clatter render", {"scene is required"});
  check_refused(shell, "clatter render vibrated --out a.mp4 word",
                {"word: there is no such scene"});
  check_refused(shell, "clatter measure vibrated --out a.json word", {"not expected: word"});
}

TEST_CASE("Wrong use: messages about flags have no words of the parser and no control characters") {
  const Shell shell;
  const std::string measure = "clatter measure vibrated ";
  check_refused(shell, measure + "--out a.json --out b.json", {"--out is given 2 times; give it"});
  check_refused(shell, measure + "--out", {"--out: the value is missing; give FILE.json; "});
  check_refused(shell, measure + "--events e.csv --events-of 1,two",
                {"--events-of: the value '1,two' is wrong; "});
  check_refused(shell, "clatter render vibrated --out a.mp4 --backend $(printf '\\033[31m')",
                {"--backend: '\\u001b[31m' is unknown"});
  check_refused(shell, "clatter check vibrated \"$(printf 'two\nlines')\"", {"two\\u000alines"});
  check_refused(shell, measure + "--set particles.count=0 --events e.csv --events-of 0",
                {"there is no particle 0; the scene has no particles"});
}

TEST_CASE("Wrong use: mistakes in a scene are refused at their line and column") {
  const Shell shell;
  struct Mistake {
    std::string scene;
    std::vector<std::string> parts;
  };
  for (const Mistake& mistake : {
           Mistake{scene("count = 10", "restituton = 0.9"),
                   {"s.toml:5:1: ", "restituton", "did you mean 'restitution'?"}},
           Mistake{scene("count = -3"), {"s.toml:4:1: ", "-3", "between 0 and"}},
           Mistake{scene("count = 10", "restitution = 1.5"),
                   {"s.toml:5:1: ", "1.5", "between 0 and 1"}},
           Mistake{scene("count = 10", "restitution = nan"), {"s.toml:5:1: ", "nan"}},
           // A triangular lattice on a square box: 23 rows of 20.
           Mistake{scene("count = 100000"), {"s.toml:4:1: ", "100000", "at most 4"}},
           Mistake{scene() + "[walls.left]\nkind = 'static'\n",
                   {"s.toml:6:1: ", "no wall opposite", "add [walls.right]"}},
           Mistake{scene("count = "), {"s.toml:4:"}},
           Mistake{"a = " + std::string(100'000, '[') + std::string(100'000, ']'), {"s.toml:1:"}},
           Mistake{"#" + std::string(10'000'000, ' '), {"s.toml: ", "larger than 1 MB"}},
       }) {
    shell.write("s.toml", mistake.scene);
    check_refused(shell, "clatter check s.toml", mistake.parts);
    check_refused(shell, "clatter measure s.toml --out r.json --csv tables", mistake.parts);
    check_refused(shell, "clatter render s.toml --out film.mp4", mistake.parts);
  }
}

TEST_CASE("Wrong use: mistakes in a start state are refused at their line and column") {
  const Shell shell;
  shell.write("s.toml", "[particles.start]\nlayout = 'file'\nfile = 'a.csv'\n");
  struct Mistake {
    std::string csv;
    std::vector<std::string> parts;
  };
  for (const Mistake& mistake :
       {Mistake{"x,y,vx,vy\n1,1,0,0\n1.5,1,0,0\n", {"a.csv:3:1: ", "lines 2 and 3", "move them"}},
        Mistake{"x,y,vx,vy\n1,1,0,zero\n", {"a.csv:2:7: ", "zero", "write, say"}},
        Mistake{"x,y,vx,vy,omega\n1,1,0,0,1\n", {"a.csv:1:11: ", "omega", "remove the column"}}}) {
    shell.write("a.csv", mistake.csv);
    check_refused(shell, "clatter check s.toml", mistake.parts);
    check_refused(shell, "clatter measure s.toml --out r.json", mistake.parts);
    check_refused(shell, "clatter render s.toml --out film.mp4", mistake.parts);
  }
}

TEST_CASE("Wrong use: scenes that do not exist are refused") {
  const Shell shell;
  check_refused(shell, "clatter check nowhere.toml", {"nowhere.toml: ", "clatter scenes"});
  check_refused(shell, "clatter check vibratd", {"did you mean the gallery scene 'vibrated'?"});
  check_refused(shell, "clatter check .", {".: ", "directory"});
  check_refused(shell, "clatter check ''", {"there is no such scene"});
}

TEST_CASE("Wrong use: wrong flags are refused") {
  const Shell shell;
  check_refused(shell, "clatter check vibrated --set particles.count", {"--set KEY=VALUE"});
  check_refused(shell, "clatter check vibrated --set =5", {"--set KEY=VALUE"});
  check_refused(shell, "clatter check vibrated --set particles.cuont=5",
                {"--set particles.cuont", "did you mean 'count'?"});
  check_refused(shell, "clatter check vibrated --colour", {"--colour"});
  check_refused(shell, "clatter check vibrated --seed -1", {"--seed"});
  check_refused(shell, "clatter measure vibrated --until 0", {"--until"});
  check_refused(shell, "clatter measure vibrated --until nan", {"--until"});
  check_refused(shell, "clatter measure vibrated --set measure.burn_in=500 --until 400",
                {"--until", "burn-in", "500"});
  check_refused(shell, "clatter measure vibrated --set measure.burn_in=5.999999999999999 --until 6",
                {"--until", "burn-in", "5.999999999999999"});
  check_refused(shell, "clatter measure vibrated --progress loud", {"--progress"});
  check_refused(shell, "clatter check", {"scene is required"});
}

TEST_CASE("Wrong use: runs that would fill the memory or never end are refused") {
  const Shell shell;
  check_refused(shell, "clatter measure vibrated --set measure.series_interval=1e-300",
                {"measure.series_interval", "samples", "choose at least"});
  check_refused(shell,
                "clatter measure vibrated --set measure.estimator=snapshot "
                "--set measure.interval=1e-300",
                {"measure.interval", "1e7 samples", "choose at least"});
  check_refused(shell, "clatter measure vibrated --set measure.duration=1e308", {"samples"});
  check_refused(shell,
                "clatter measure vibrated "
                "--set 'measure.observables=[\"velocity_autocorrelation\"]' "
                "--set measure.velocity_autocorrelation.interval=1e-9",
                {"measure.velocity_autocorrelation.interval: the longest lag has more than 1e7 "
                 "intervals; choose a lag of at most 0.01, or an interval of at least 1e-06"});
  check_refused(shell, "clatter render vibrated --out x.png --set view.window=1e-20",
                {"view.window", "choose at least"});
}

TEST_CASE("Wrong use: no run starts if its output cannot be written") {
  const Shell shell;
  shell.run("mkdir folder");
  for (const std::string out : {"missing/x", "folder", "folder/"}) {
    CAPTURE(out);
    check_refused(shell, "clatter measure vibrated --until 1e6 --out " + out, {"--out", "folder"});
    check_refused(shell, "clatter measure vibrated --until 1e6 --save-state " + out,
                  {"--save-state", "folder"});
  }
  check_refused(shell, "clatter measure vibrated --until 1e6 --hdf5 folder", {"--hdf5", "folder"});
  for (const std::string flag : {"--csv", "--vtk"}) {
    check_refused(shell, "clatter measure vibrated --until 1e6 " + flag + " missing/x",
                  {flag, "missing"});
    const Outcome outcome = shell.run("clatter measure vibrated --until 1e6 " + flag + " /proc/x");
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "cannot make the folder /proc/x"));
  }
  check_refused(shell, "clatter render vibrated --to 1e5 --out missing/x.mp4",
                {"--out", "missing"});
  check_refused(shell, "clatter render vibrated --to 1e5 --out x.avi", {"x.avi", ".mp4"});
  for (const std::string table :
       {"engine", "growth", "features", "fields", "render", "window", "timeline"}) {
    check_refused(shell, "clatter bench " + table + " --json missing/x", {"--json", "missing"});
  }
  check_refused(shell, "clatter bench growth --plot missing/x.png", {"--plot", "missing"});
}

TEST_CASE("Wrong use: output that fails at the end gives exit code 1 and a message") {
  const Shell shell;
  for (const std::string flag : {"--out", "--hdf5", "--save-state"}) {
    const Outcome outcome = shell.run(
        "clatter measure vibrated --set measure.burn_in=0 "
        "--set measure.cells=[40,40] --until 5 --quiet " +
        flag + " /dev/full");
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "cannot write /dev/full: "));
    CHECK(says(outcome.err, "; continue with --resume vibrated-seed1.checkpoint\n"));
  }
}

TEST_CASE("Outputs: a current folder that was removed is named in plain words") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "mkdir gone; cd gone; rmdir ../gone; clatter measure vibrated --until 1 --out a.json");
  CHECK(outcome.code == 1);
  CHECK(says(outcome.err, "clatter: cannot use a.checkpoint: No such file or directory\n"));
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
  CHECK(says(outcome.err, "clatter: cannot start a thread: Resource temporarily unavailable; end"));
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
  const Outcome full = shell.run(line + "--out /dev/full");
  CHECK(full.code == 1);
  CHECK(full.out == shell.read("whole.json"));
  CHECK(
      says(full.err, "cannot write /dev/full: No space left on device; the result is on stdout\n"));
  const Outcome closed = shell.run(line + ">/dev/full");
  CHECK(closed.code == 1);
  CHECK(says(closed.err, "cannot write stdout: "));
  CHECK(says(closed.err, "; the result is in vibrated-seed7.json\n"));
  CHECK(shell.read("vibrated-seed7.json") == shell.read("whole.json"));
  // The second result does not replace the first.
  const Outcome again = shell.run(line + "--set measure.burn_in=2 >/dev/full");
  CHECK(again.code == 1);
  CHECK(says(again.err, "the result is lost, because vibrated-seed7.json exists"));
  CHECK(shell.read("vibrated-seed7.json") == shell.read("whole.json"));
}

TEST_CASE("Wrong use: outputs that would replace inputs are refused") {
  const Shell shell;
  shell.run("clatter check vibrated > s.toml");
  shell.run(
      "clatter measure vibrated --until 1 --quiet --checkpoint c --out r.json --save-state e.csv");
  const std::string start = "--set 'particles.start={layout=\"file\",file=\"e.csv\"}' ";
  const std::vector<std::pair<std::string, std::string>> lines = {
      {"measure s.toml --until 2 --out s.toml", "--out"},
      {"measure s.toml --until 2 --save-state ./s.toml", "--save-state"},
      {"render s.toml --to 1 --checkpoint s.toml --out x.mp4", "--checkpoint"},
      {"measure s.toml --until 2 " + start + "--out e.csv", "--out"},
      {"measure s.toml --until 2 --resume c --out c", "--out"},
      {"render s.toml --to 1 --out x.mp4 --checkpoint x.mp4.part", "--out"}};
  for (const auto& [line, flag] : lines) {
    check_refused(shell, "clatter " + line, {flag, "is the file that", "choose different names"});
  }
  check_refused(shell, "clatter measure s.toml --resume ''", {"--resume", "the name is empty"});
  check_refused(shell, "clatter measure s.toml --checkpoint ''", {"--checkpoint", "name a file"});
  for (const std::string flag : {"--out", "--csv", "--vtk", "--hdf5", "--save-state"}) {
    check_refused(shell, "clatter measure s.toml --until 2 " + flag + " ''",
                  {flag, "the name is empty; name a file or folder"});
  }
}

TEST_CASE("Wrong use: outputs that the automatic checkpoint would replace are refused") {
  const Shell shell;
  for (const std::string flags :
       {"--out run.checkpoint", "--out ./run.json --save-state run.checkpoint",
        "--out run.json --hdf5 run.checkpoint.previous", "--save-state vibrated-seed1.checkpoint",
        "--seed 7 --csv vibrated-seed7.checkpoint"}) {
    check_refused(shell, "clatter measure vibrated --until 1e6 " + flags,
                  {"is the file that --checkpoint writes", "choose different names"});
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
    check_refused(shell, "clatter measure vibrated --until 1e6 --csv tables " + out,
                  {refused, "move it, or name a checkpoint"});
    check_refused(shell,
                  "clatter measure vibrated --until 1e6 --checkpoint " + named + ".checkpoint",
                  {refused, "give another name"});
    if (named == "run") {
      check_refused(shell, "clatter render vibrated --to 1e5 --out run.mp4", {refused, "move it"});
    }
    CHECK(shell.run("clatter measure vibrated --until 1 --quiet --checkpoint c " + out).code == 0);
    CHECK(shell.read(file) == "precious");
    shell.run("rm -f run.* vibrated*");
  }
  // The new checkpoint replaces the resumed one, or the one after it.
  const std::string line =
      "clatter measure vibrated --set measure.burn_in=0 --quiet --out c.json --checkpoint "
      "c.checkpoint ";
  REQUIRE(shell.run(line + "--until 1 --checkpoint-every 0.001").code == 0);
  REQUIRE(shell.run(line + "--until 2 --resume c.checkpoint").code == 0);
  CHECK(shell.run(line + "--until 3 --resume ./c.checkpoint.previous").code == 0);
  CHECK(shell
            .run("clatter measure vibrated --set measure.burn_in=0 --until 4 --quiet --out c.json "
                 "--resume c.checkpoint")
            .code == 0);
}

TEST_CASE("Wrong use: a write-protected result of an earlier run is not replaced") {
  const Shell shell;
  shell.run("mkdir tab maps frames");
  for (const std::string file : {"r.json", "r.h5", "e.csv", "film.mp4", "picture.png",
                                 "tab/maps.csv", "maps/fields.vti", "c"}) {
    shell.write(file, "precious");
    shell.run("chmod 444 " + file);
  }
  const std::string measure = "clatter measure vibrated --until 1e6 ";
  const std::string render = "clatter render vibrated --to 1e5 --out ";
  for (const auto& [line, file] :
       std::vector<std::pair<std::string, std::string>>{{measure + "--out r.json", "r.json"},
                                                        {measure + "--hdf5 r.h5", "r.h5"},
                                                        {measure + "--save-state e.csv", "e.csv"},
                                                        {measure + "--csv tab", "tab/maps.csv"},
                                                        {measure + "--vtk maps", "maps/fields.vti"},
                                                        {measure + "--checkpoint c", "c"},
                                                        {render + "film.mp4", "film.mp4"},
                                                        {render + "picture.png", "picture.png"}}) {
    CAPTURE(line);
    const Outcome outcome = shell.run(line);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "cannot write " + file + ": it is write-protected; make it writable"));
    CHECK(shell.read(file) == "precious");
  }
}

TEST_CASE("Wrong use: names that the file system refuses are reported before a run") {
  const Shell shell;
  shell.run("ln -s loop loop; ln -s loop.mp4 loop.mp4");
  const std::string longest(251, 'a');
  const std::string measure = "clatter measure vibrated --until 1e6 ";
  for (const auto& [line, reason] : std::vector<std::pair<std::string, std::string>>{
           {measure + "--out loop", "cannot write loop: Too many levels of symbolic links"},
           {measure + "--checkpoint loop", "cannot write loop: Too many levels"},
           {measure + "--save-state " + longest + ".json", ".json: File name too long"},
           {"clatter render vibrated --out loop.mp4", "cannot write loop.mp4: Too many levels"},
           {measure + "--out " + longest + ".txt", ".checkpoint is too long; name a checkpoint"},
           {"clatter render vibrated --out " + longest + ".mp4", ".checkpoint is too long"},
           {"clatter render vibrated --checkpoint c --out " + longest + ".mp4", "name too long"},
           {"clatter render vibrated --out /sys/frames", "cannot write to /sys/frames: "}}) {
    CAPTURE(line);
    const Outcome outcome = shell.run(line);
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
    check_refused(shell, "clatter check " + name, {name + ": "});
    check_refused(shell, measure + "--resume " + name, {name + ": "});
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
}

TEST_CASE(
    "Measure: a run that ends within the burn-in of the scene has a shorter one, and says so") {
  const Shell shell;
  const Outcome outcome =
      shell.run("clatter measure vibrated --set measure.duration=1500 --until 20 --progress none");
  CHECK(outcome.code == 0);
  CHECK(says(outcome.err,
             "note: the run ends within measure.burn_in = 500; averages begin at t = 5 instead\n"));
  const auto time = nlohmann::json::parse(outcome.out).at("time");
  CHECK(time.at("burn_in") == 5.0);
  CHECK(time.at("measured") == doctest::Approx(15.0).epsilon(0.02));
}

TEST_CASE("Wrong use: a picture without a scene is refused as a picture") {
  const Shell shell;
  REQUIRE(shell.run("ffmpeg -v error -f lavfi -i color=red:16x16 -frames:v 1 red.png").code == 0);
  check_refused(shell, "clatter check red.png",
                {"red.png: this picture contains no scene", "a picture made by clatter"});
  const auto check_scene_of = [&](std::size_t size, const std::vector<std::string>& parts) {
    std::string text(size, ' ');
    text.front() = '#';
    const std::vector<PngText> texts = {{"Scene", text}};
    write_png(shell.path("large.png"), Image{{1, 1}, {0, 0, 0, 255}}, texts);
    check_refused(shell, "clatter check large.png", parts);
  };
  check_scene_of(1'000'001, {"large.png: the scene in this picture is larger than 1 MB"});
  check_scene_of(1'000'000, {"large.png: the number of particles is missing"});
  check_refused(shell, "clatter check vibrated --set particles.count=1e3", {"cannot be 1000.0"});
  shell.write("text.png", "These words are no scene.\n");
  check_refused(
      shell, "clatter check text.png",
      {"text.png: this is not a PNG picture; give a picture made by clatter, or a scene"});
}

TEST_CASE("Wrong use: outputs that would replace each other are refused") {
  const Shell shell;
  shell.run("mkdir folder && ln -s folder link");
  const std::vector<std::string> flags = {"--out",  "--csv",        "--vtk",
                                          "--hdf5", "--save-state", "--checkpoint"};
  for (std::size_t k = 0; k < flags.size(); ++k) {
    for (std::size_t other = 0; other < k; ++other) {
      check_refused(shell,
                    "clatter measure vibrated --until 1e6 " + flags[k] + " link/x " + flags[other] +
                        " ./folder/../folder/x",
                    {flags[k], flags[other], "/x is the file that", "choose different names"});
    }
  }
  check_refused(shell, "clatter measure vibrated --until 1e6 --csv x/ --vtk x", {"--vtk", "--csv"});
  check_refused(shell, "clatter measure vibrated --until 1e6 --checkpoint c --out c.previous",
                {"--checkpoint", "c.previous", "--out"});
  for (const std::string file :
       {"--csv d --out d/temperature_series.csv", "--csv d --hdf5 d/profile.csv",
        "--csv d --save-state d/maps.csv", "--vtk d --out d/fields.vti",
        "--vtk d --checkpoint d/series.pvd", "--vtk d --out d/series_63.vti"}) {
    const std::string name = file.substr(file.rfind("d/"));
    check_refused(shell, "clatter measure vibrated --until 1e6 " + file,
                  {file.substr(0, 5), name + " is the file that", "choose different names"});
  }
  check_refused(shell, "clatter render vibrated --to 1e5 --out x.mp4 --checkpoint x.mp4",
                {"--checkpoint", "--out"});
  REQUIRE(shell.run("mkdir tables").code == 0);
  CHECK(shell
            .run("clatter measure vibrated --set measure.burn_in=0 --until 1 --quiet "
                 "--csv tables --out tables/r.json --save-state tables/series_00.vti")
            .code == 0);
  CHECK(shell
            .run("clatter measure vibrated --set measure.burn_in=0 --until 1 --quiet "
                 "--out /dev/null --save-state /dev/null")
            .code == 0);
}

TEST_CASE("Wrong use: a folder in the place of a table is refused") {
  const Shell shell;
  shell.run("mkdir -p tab/maps.csv/x maps/series.pvd");
  check_refused(shell, "clatter measure vibrated --until 1e6 --csv tab --out r.json",
                {"--csv", "tab/maps.csv is a folder; remove it"});
  check_refused(shell, "clatter measure vibrated --until 1e6 --vtk maps --out r.json",
                {"--vtk", "maps/series.pvd is a folder"});
}

TEST_CASE("Wrong use: the fix comes after the problem") {
  const Shell shell;
  shell.write("change.toml",
              "particles.count = 10\n[[change]]\ntime = 1\n"
              "set = { \"particles.restitution\" = 0.5 }\n");
  check_refused(shell, "clatter measure change.toml --until 2 --replicas 2",
                {"--replicas: the laws of this scene change; measure each seed separately, or"});
  check_refused(shell, "clatter render vibrated --to 1 --fps 60 --out a.gif",
                {"--fps: a GIF has at most 50 frames per second; give at most --fps 50, or"});
  check_refused(shell, "clatter render vibrated --to 1 --transparent --out a.mp4",
                {"--transparent: a film .mp4 cannot be transparent; write a film .mov, .webm or"});
  check_refused(shell, "clatter check vibrated --set particles.count",
                {"--set particles.count: no value is set; write --set KEY=VALUE, for example"});
}

TEST_CASE("Wrong use: replicas beyond the last seed are refused") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --until 1 --replicas 2 --seed ";
  check_refused(shell, line + "18446744073709551615", {"--seed", "exceed 18446744073709551615"});
  const Outcome last = shell.run(line + "18446744073709551614");
  CHECK(last.code == 0);
  CHECK(nlohmann::json::parse(last.out).at("seeds").back() == 18446744073709551615u);
}

TEST_CASE("Wrong use: maps of no fields are refused") {
  const Shell shell;
  check_refused(shell, "clatter measure vibrated --set measure.fields=[] --vtk maps",
                {"--vtk", "no fields", "measure.fields="});
}

TEST_CASE("Wrong use: impossible pictures and films are refused") {
  const Shell shell;
  for (const std::string size : {"nonsense", "1280", "1280x", "x720", "0x0", "-64x64", "64x64x64",
                                 "1e3x1e3", "99999x99999", "640x480px"}) {
    for (const std::string line : {"render vibrated --out x.png", "view vibrated"}) {
      check_refused(shell, "DISPLAY= clatter " + line + " --size=" + size,
                    {"--size", size, "1280x720"});
    }
  }
  check_refused(shell, "DISPLAY= clatter view --size 319x240", {"from 320x240"});
  check_refused(shell, "clatter render vibrated --out x.mp4 --fps 0", {"--fps"});
  check_refused(shell, "clatter render vibrated --out x.mp4 --speed 0", {"--speed"});
  check_refused(shell, "clatter render vibrated --out x.mp4 --from 9 --to 8", {"--to", "--from"});
  check_refused(shell, "clatter render vibrated --out x.mp4 --to 1e300", {"--to", "frames"});
  check_refused(shell, "clatter render vibrated --out x.gif --fps 60", {"--fps", "at most 50"});
  check_refused(shell, "clatter render vibrated --out f --size 16384x16384 --supersample 4",
                {"--size", "65536 samples along a side", "--supersample"});
  check_refused(shell, "clatter render vibrated", {"--out"});
  check_refused(shell, "clatter render vibrated --out x.avi",
                {"x.avi: the format .avi is not supported; use .mp4"});
  check_refused(shell, "clatter render vibrated --out .mp4",
                {".mp4: the name before the extension is missing; give a name such as film.mp4"});
  const Outcome outcome =
      shell.run("DISPLAY= clatter render vibrated --backend glfw --out x.png --to 0.1");
  CHECK(outcome.code == 1);
  CHECK(says(outcome.err, "glfw: no display"));
  CHECK(says(outcome.err, "; use egl or osmesa, which need no display\n"));
  CHECK_FALSE(says(outcome.err, "Wayland session"));
  const Outcome wayland =
      shell.run("DISPLAY= XDG_RUNTIME_DIR=/none WAYLAND_DISPLAY=wayland-0 clatter view vibrated");
  CHECK(wayland.code == 1);
  CHECK(says(wayland.err, "glfw: no display"));
  CHECK(says(wayland.err, "this is a Wayland session: install Xwayland, or "));
}

TEST_CASE("Wrong use: unknown commands are refused") {
  const Shell shell;
  check_refused(shell, "clatter mesure vibrated", {"mesure", "measure"});
  check_refused(shell, "clatter bench nonsense", {"nonsense", "engine"});
}

}  // namespace clatter
