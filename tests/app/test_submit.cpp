#include <doctest/doctest.h>

#include <iterator>
#include <sstream>

#include "app/sweep/submit.h"
#include "tests/support/shell.h"

namespace clatter {

using testing::TemporaryFolder;

namespace {

// A sweep of nine runs without any result.
constexpr const char* kNineRuns = R"(scene = "vibrated"
seeds = [5, 6, 7]
[axes]
"particles.restitution" = [0.7, 0.8, 0.9]
)";

constexpr int kFailed = 1, kWrongUse = 2, kPhysicalStop = 3;

// Runs 2, 8 and 9 are open. Runs 3 and 5 failed for a reason that may be gone.
void end_most_runs(const SweepFolder& folder) {
  for (const int id : {1, 4}) testing::write_bytes(folder.result(id), "{}");
  folder.fail(3, {kFailed, "killed"});
  folder.fail(5, {kFailed, "no space left"});
  folder.fail(6, {kPhysicalStop, "inelastic collapse"});
  folder.fail(7, {kPhysicalStop, "particles overlapped"});
}

// The text between two others; empty if the first is absent.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  if (begin == std::string::npos) return "";
  return text.substr(begin + from.size(), text.find(to, begin + from.size()) - begin - from.size());
}

// The chunks in the batch script.
std::vector<std::string> chunks_in(const std::string& script) {
  std::istringstream words(between(script, "tasks=(\n", ")"));
  return {std::istream_iterator<std::string>(words), {}};
}

// The value of an option such as --mem.
std::string option_in(const std::string& script, const std::string& name) {
  return between(script, "#SBATCH --" + name + '=', "\n");
}

std::string script_of(const SweepFolder& folder, int chunk = 0, const TaskLimits& limits = {}) {
  return testing::bytes_of(write_batch_script(folder, chunk, limits));
}

}  // namespace

TEST_CASE("Submit: tasks contain each run without result once") {
  const TemporaryFolder temporary;
  const SweepFolder folder = SweepFolder::make(kNineRuns, "s.toml", temporary / "d");
  const std::string start =
      "parallel clatter sweep run ''\\''" + (temporary / "d").string() + "'\\''' ::: ";
  for (const auto& [chunk, tasks] :
       {std::pair{0, "1 2 3 4 5 6 7 8 9\n"}, std::pair{4, "1-4 5-8 9\n"}, std::pair{9, "1-9\n"},
        std::pair{100, "1-9\n"}}) {
    CHECK(parallel_line(folder, chunk) == start + tasks);
  }

  // A physical stop would occur again. Other failures are repeated.
  end_most_runs(folder);
  for (const auto& [chunk, tasks] : {std::pair{1, "2 3 5 8 9\n"}, std::pair{2, "2-3 5,8 9\n"},
                                     std::pair{3, "2-3,5 8-9\n"}, std::pair{7, "2-3,5,8-9\n"}}) {
    CHECK(parallel_line(folder, chunk) == start + tasks);
  }
  const std::string script = script_of(folder, 2);
  CHECK(chunks_in(script) == std::vector<std::string>{"2-3", "5,8", "9"});
  CHECK(option_in(script, "array") == "1-3");

  // A kill after the write of a result may leave the failure of an earlier attempt.
  for (const int id : {2, 3, 5, 8, 9}) testing::write_bytes(folder.result(id), "{}");
  CHECK(parallel_line(folder, 1) == "");
  CHECK(write_batch_script(folder, 0, {}).empty());
}

TEST_CASE("Submit: a large sweep has at most 1000 tasks on a cluster") {
  const TemporaryFolder temporary;
  const SweepFolder folder =
      SweepFolder::make("scene = \"vibrated\"\nreplicas = 2500\n", "s.toml", temporary / "d");
  const std::string script = script_of(folder);
  const std::vector<std::string> chunks = chunks_in(script);
  CHECK(chunks.size() == 834);  // of three runs each, the last of one
  CHECK(chunks.front() == "1-3");
  CHECK(chunks.back() == "2500");
  CHECK(option_in(script, "array") == "1-834");
}

TEST_CASE("Submit: the options of the script are those of the user") {
  const TemporaryFolder temporary;
  const SweepFolder folder = SweepFolder::make(kNineRuns, "s.toml", temporary / "d");
  for (const TaskLimits& limits :
       {TaskLimits{}, TaskLimits{.time = "1:30:00", .partition = "long"}}) {
    const std::string script = script_of(folder, 0, limits);
    CHECK(option_in(script, "time") == limits.time);
    CHECK(option_in(script, "partition") == limits.partition);
    CHECK(option_in(script, "output") == '"' + (temporary / "d/slurm/%a.log").string() + '"');
  }
}

TEST_CASE("Submit: the memory request grows with the number of particles") {
  const auto megabytes = [](const std::string& counts) {
    const TemporaryFolder temporary;
    const std::string text =
        "scene = \"vibrated\"\n[set]\n\"box.size\" = [2000.0, 2000.0]\n"
        "[axes]\n\"particles.count\" = " +
        counts + "\n";
    const SweepFolder folder = SweepFolder::make(text, "s.toml", temporary / "d");
    const std::string memory = option_in(script_of(folder), "mem");
    REQUIRE(memory.ends_with("M"));
    return std::stod(memory);
  };
  const double small = megabytes("[100]"), large = megabytes("[1000000]");
  CHECK(small >= 100.0);
  CHECK(small < 120.0);
  // A disk has at least a position, a velocity and an event: 48 bytes.
  CHECK(large > small + 48.0);
  // The largest run counts.
  CHECK(megabytes("[1000000, 100]") == large);
}

TEST_CASE("Submit: a shell reads the line for GNU parallel as one folder and the tasks") {
  // parallel passes its arguments to a second shell, here by eval.
  const std::string parallel =
      "parallel() { while [ \"$1\" != ::: ]; do c=\"$c $1\"; shift; done; shift; "
      "for t; do eval \"show $c $t\"; done; }; show() { printf '%s\\n' \"$@\"; }";
  for (const std::string folder : {"plain", "a b", "it's", " '\"$HOME\" \\`x` ; * '' "}) {
    CAPTURE(folder);
    const Shell shell;
    shell.write("s.toml", kNineRuns);
    SweepFolder::make(kNineRuns, "s.toml", shell.path(folder));
    shell.write("name", folder);
    const Outcome outcome =
        shell.run("clatter sweep submit \"$(cat name)\" --parallel --chunk 4 >line.sh && " +
                  parallel + " && . ./line.sh");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    std::string expected;
    for (const char* task : {"1-4", "5-8", "9"}) {
      expected += "clatter\nsweep\nrun\n" + folder + '\n' + task + '\n';
    }
    CHECK(outcome.out == expected);
  }
}

TEST_CASE("Submit: the batch script is valid, and runs the chunk of its task") {
  const Shell shell;
  shell.write("s.toml", R"(scene = "vibrated"
[set]
"measure.burn_in" = 1.0
"measure.duration" = 10.0
"measure.fields" = []
[axes]
"particles.count" = [10, 20, 30]
)");
  const std::string folder = "\"it's %a b\"";
  REQUIRE(shell.run("clatter sweep s.toml --prepare --out " + folder).code == 0);
  // --dry-run does not start sbatch.
  const Outcome dry = shell.run(
      "mkdir bin && printf '#!/bin/sh\\necho \"$@\" >submitted\\n' "
      ">bin/sbatch && chmod +x bin/sbatch && PATH=$PWD/bin:$PATH "
      "clatter sweep submit " +
      folder + " --slurm --chunk 2 --dry-run");
  CAPTURE(dry.err);
  CHECK(dry.code == 0);
  const std::string script = shell.path("it's %a b/slurm/job.sh");
  CHECK(dry.out == script + '\n');
  CHECK_FALSE(std::filesystem::exists(shell.path("submitted")));
  CHECK(says(testing::bytes_of(script), "/it's %%a b/slurm/%a.log\"\n"));
  const Outcome syntax = shell.run("bash -n " + folder + "/slurm/job.sh");
  CHECK_MESSAGE(syntax.code == 0, syntax.err);
  // Task 2 measures the third run.
  const Outcome task = shell.run("SLURM_ARRAY_TASK_ID=2 bash " + folder + "/slurm/job.sh");
  CAPTURE(task.err);
  CHECK(task.code == 0);
  CHECK(shell.run("ls " + folder + "/results").out == "3.json\n");
  // Without --dry-run, sbatch gets the script.
  const Outcome real = shell.run("PATH=$PWD/bin:$PATH clatter sweep submit " + folder + " --slurm");
  CAPTURE(real.err);
  CHECK(real.code == 0);
  CHECK(shell.read("submitted") == script + '\n');
  CHECK(chunks_in(testing::bytes_of(script)) == std::vector<std::string>{"1", "2"});
  // The exit code of a task is that of its runs.
  shell.run("echo broken > " + folder + "/scene.toml");
  CHECK(shell.run("SLURM_ARRAY_TASK_ID=1 bash " + folder + "/slurm/job.sh").code == 2);
}

// The largest number of a task is below MaxArraySize.
TEST_CASE("Submit: an array job that the cluster would refuse is refused before") {
  const Shell shell;
  shell.write("s.toml", kNineRuns);
  REQUIRE(shell.run("clatter sweep s.toml --out d --prepare").code == 0);
  REQUIRE(shell
              .run("mkdir bin && touch bin/sbatch && chmod +x bin/sbatch && cp bin/sbatch "
                   "bin/scontrol && printf '#!/bin/sh\\n"
                   "echo \"ControlMachine          = node\"\\n"
                   "echo \"MaxArraySize            = 5\"\\n' >bin/scontrol")
              .code == 0);
  const std::string line = "PATH=$PWD/bin:$PATH clatter ";
  check_refused(shell, line + "sweep submit d --slurm --chunk 2",
                {"--chunk: the array job would have 5 tasks, and this cluster allows 4",
                 "give at least --chunk 3"});
  for (const std::string chunk : {"", " --chunk 3"}) {
    REQUIRE(shell.run(line + "sweep submit d --slurm" + chunk).code == 0);
    CHECK(chunks_in(shell.read("d/slurm/job.sh")) == std::vector<std::string>{"1-3", "4-6", "7-9"});
  }
  const std::string film = line + "render vibrated --fps 30 --speed 1 --to 20 --out f.mp4 --slurm ";
  check_refused(
      shell, film + "6",
      {"--slurm: the array job would have 6 tasks, and this cluster allows 4", "give at most 4"});
  CHECK(shell.run(film + "4").code == 0);
}

TEST_CASE("Submit: wrong flags are refused") {
  const Shell shell;
  shell.write("s.toml", kNineRuns);
  REQUIRE(shell.run("clatter sweep s.toml --out d --prepare").code == 0);
  for (const std::string folder : {"'a{}b'", "'a\"b'"}) {
    REQUIRE(shell.run("clatter sweep s.toml --prepare --out " + folder).code == 0);
  }
  for (const auto& [flags, words] : std::vector<std::pair<std::string, std::string>>{
           {"d", "add --slurm or --parallel"},
           {"d --slurm --parallel", "--slurm excludes --parallel"},
           {"d --parallel --time 1:00", "--time requires --slurm"},
           {"d --parallel --partition x", "--partition requires --slurm"},
           {"d --parallel --dry-run", "--dry-run requires --slurm"},
           {"d --slurm --chunk 0", "--chunk: '0' is wrong"},
           {"none --parallel", "none: this is not the folder of a sweep"},
           {"'a\"b' --slurm --dry-run", "a batch script cannot name this folder"},
           {"'a{}b' --parallel", "a{}b: GNU parallel replaces braces"}}) {
    check_refused(shell, "clatter sweep submit " + flags, {words});
  }
  // sbatch is not installed.
  const Outcome none = shell.run("c=$(command -v clatter); PATH=/none $c sweep submit d --slurm");
  CHECK(none.code == 1);
  CHECK(says(none.err, "cannot start sbatch: No such file or directory; the script is "));
}

}  // namespace clatter
