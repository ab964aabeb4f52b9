// Films that an array job draws. A task runs here as its batch script, without Slurm.

#include <doctest/doctest.h>

#include <sstream>

#include "tests/app/film_scene.h"

namespace clatter {

namespace {

// 210 frames with automatic colours, averages and trails, at an uneven frame rate.
const std::string kJob =
    "clatter render scene.toml --size 160x120 --speed 0.7 --from 2 --to 23 --shutter 0.5 "
    "--seed 5 --set particles.restitution=0.85 --backend egl --fps ";

// The word `name` for a shell.
std::string word(const std::string& name) {
  return '"' + name + '"';
}

// A line that runs a task of the job for `out`.
std::string task(const std::string& out, int number) {
  return "env SLURM_ARRAY_TASK_ID=" + std::to_string(number) + " bash " +
         word(out + ".slurm/job.sh");
}

Outcome submit(const Shell& shell, const std::string& out, const std::string& flags) {
  return shell.run(kJob + "7 --dry-run --out " + word(out) + ' ' + flags);
}

std::string script_of(const Shell& shell, const std::string& out) {
  return shell.read(out + ".slurm/job.sh");
}

bool has_line(const std::string& text, const std::string& line) {
  return text.find('\n' + line + '\n') != text.npos;
}

// Waits until a file is there, or the process $pid has ended.
std::string await(const std::string& file) {
  return "until [ -e " + file + " ] || ! kill -0 $pid 2>/dev/null; do sleep 0.02; done\n";
}

}  // namespace

TEST_CASE("Film job: tasks in any order make the film of one run, to the byte") {
  const Shell shell;
  write_film_scene(shell);
  for (const std::string out : {"film.mp4", "it's a %n.gif", "frames"}) {
    CAPTURE(out);
    const std::string encoding = out == "film.mp4" ? " --encoding small" : "";
    REQUIRE(shell
                .run(kJob + "7 --quiet --out " + word(out) + encoding + " && mv " + word(out) +
                     " whole")
                .code == 0);
    REQUIRE(submit(shell, out, "--slurm 2" + encoding).out ==
            shell.path(out + ".slurm/job.sh").string() + '\n');
    // The tasks do not need the scene of the user.
    shell.run("mv scene.toml away");
    const bool is_film = out != "frames";
    for (const int number : {2, 1}) {
      CHECK_FALSE((is_film && std::filesystem::exists(shell.path(out))));
      const Outcome outcome = shell.run(task(out, number));
      CAPTURE(outcome.err);
      CHECK(outcome.code == 0);
    }
    CHECK(shell.run("mv away scene.toml; diff -r " + word(out) + " whole && rm -r whole").code ==
          0);
    // A task that runs again draws nothing.
    shell.run("touch start");
    CHECK(shell.run(task(out, 1)).code == 0);
    CHECK(shell.run("find . -newer start -name '0000*.gif' -o -newer start -name '*.png'").out ==
          "");
  }
}

TEST_CASE("Film job: interrupted and killed tasks continue, and the film is the same") {
  const Shell shell;
  write_film_scene(shell);
  REQUIRE(shell.run(kJob + "7 --quiet --out film.mp4 && mv film.mp4 whole").code == 0);
  REQUIRE(submit(shell, "film.mp4", "--slurm 1").code == 0);
  // Runs the task until a piece of the film has begun.
  const auto until_piece = [](const std::string& piece) {
    return "setsid " + task("film.mp4", 1) + " & pid=$!\n" +
           await("film.mp4.slurm/000000.mp4.part/" + piece);
  };
  const Outcome interrupted = shell.run(until_piece("000060.mp4") + "kill -TERM $pid; wait $pid");
  CAPTURE(interrupted.err);
  CHECK(interrupted.code == 130);
  CHECK(std::filesystem::exists(shell.path("film.mp4.slurm/000000.checkpoint")));
  // The killed programs end, and with them the lock of the film.
  CHECK(shell
            .run(until_piece("000120.mp4") +
                 "kill -9 -$pid; wait $pid; code=$?\n"
                 "while kill -0 -$pid 2>/dev/null; do sleep 0.02; done; exit $code")
            .code == 128 + 9);
  CHECK_FALSE(std::filesystem::exists(shell.path("film.mp4")));
  // A second submission may have other limits.
  CHECK(submit(shell, "film.mp4", "--slurm 1 --time 1:00:00").code == 0);
  const Outcome last = shell.run(task("film.mp4", 1) + " && cmp film.mp4 whole");
  CAPTURE(last.err);
  CHECK(last.code == 0);
}

TEST_CASE("Film job: the script has the resources, and as many tasks as the film has pieces") {
  const Shell shell;
  write_film_scene(shell);
  const auto script = [&](const std::string& flags) {
    const Outcome outcome = submit(shell, "film.mp4", flags + " --overwrite");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    return script_of(shell, "film.mp4");
  };
  const std::string two = script("--slurm 2 --time 1:30:00 --partition long");
  CHECK(has_line(two, "tasks=(\n  000000:120\n  000120:210\n)"));
  CHECK(has_line(two, "#SBATCH --array=1-2"));
  CHECK(has_line(two, "#SBATCH --time=1:30:00"));
  CHECK(has_line(two, "#SBATCH --partition=long"));
  CHECK(has_line(script("--slurm 9"),
                 "tasks=(\n  000000:60\n  000060:120\n  000120:180\n  000180:210\n)"));

  const auto megabytes = [&](const std::string& flags) {
    std::istringstream lines(script(flags));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("#SBATCH --mem=")) return std::stod(line.substr(14));
    }
    return 0.0;
  };
  CHECK(has_line(script("--slurm 2 --threads 5"), "#SBATCH --cpus-per-task=2"));
  REQUIRE(submit(shell, "frames", "--slurm 2 --threads 5").code == 0);
  CHECK(has_line(script_of(shell, "frames"), "#SBATCH --cpus-per-task=5"));
  const double small = megabytes("--slurm 1");
  CHECK(small >= 200.0);
  // A large picture needs at least 4 bytes per pixel and sample, and a disk 48 bytes.
  CHECK(megabytes("--slurm 1 --supersample 4") > small + 4e-6 * 160 * 120 * 16);
  CHECK(megabytes("--slurm 1 --set particles.count=200000 --set box.size=[2000,2000]") >
        small + 9.6);
}

TEST_CASE("Film job: the parts of another film are kept unless they may be replaced") {
  const Shell shell;
  write_film_scene(shell);
  REQUIRE(submit(shell, "film.mp4", "--slurm 2").code == 0);
  REQUIRE(shell.run(task("film.mp4", 1)).code == 0);
  const std::string part = "film.mp4.slurm/000000.mp4";
  for (const std::string other :
       {"--slurm 3", "--slurm 2 --supersample 2", "--slurm 2 --no-overlay",
        "--slurm 2 --set walls.left.stroke=0.1"}) {
    CAPTURE(other);
    const Outcome refused = submit(shell, "film.mp4", other);
    CHECK(refused.code == 2);
    CHECK(says(refused.err, "has the job of another film; replace it with --overwrite"));
    CHECK(std::filesystem::exists(shell.path(part)));
  }
  // Files of others stay.
  shell.run("cd film.mp4.slurm && touch 7 20261123 20261123_notes 000000.txt");
  for (const bool same_film : {false, true}) {
    CAPTURE(same_film);
    shell.run("touch film.mp4.slurm/000120.mp4");
    CHECK(submit(shell, "film.mp4", "--slurm 3 --overwrite").code == 0);
    CHECK(shell.run("ls film.mp4.slurm | xargs").out ==
          "000000.txt 20261123 20261123_notes 7 job.sh scene.toml\n");
  }

  shell.run("mkdir frames && touch frames/frame_000000.png");
  const Outcome folder = submit(shell, "frames", "--slurm 2");
  CHECK(folder.code == 2);
  CHECK(says(folder.err, "frames: has the pictures of another film"));
}

TEST_CASE("Film job: parts drawn by hand are joined, and missing frames are named") {
  const Shell shell;
  write_film_scene(shell);
  for (const std::string range : {"000000.mkv --frames 0:60", "000120.mkv --frames 120:"}) {
    REQUIRE(shell.run("mkdir -p parts && " + kJob + "7 --quiet --out parts/" + range).code == 0);
  }
  const std::string join = kJob + "7 --join parts ";
  check_refused(shell, join + "--out film.mkv",
                {"lack frame 60; draw 000060.mkv with --frames 60:120"});
  REQUIRE(shell.run(kJob + "7 --quiet --out parts/000060.mkv --frames 60:120").code == 0);
  check_refused(shell, kJob + "14 --join parts --out film.mkv",
                {"the parts lack frame 210; draw 000210.mkv with --frames 210:420"});
  check_refused(shell, kJob + "3 --join parts --out film.mkv", {"the parts have more frames"});
  shell.run("cp parts/000060.mkv parts/000300.mkv");
  check_refused(shell, join + "--out film.mkv", {"parts: the parts have more frames"});
  shell.run("mv parts/000300.mkv parts/60.mkv");
  check_refused(shell, join + "--out film.mkv",
                {"parts: 000060.mkv and 60.mkv begin at the same frame; remove one of them"});
  shell.run("rm parts/60.mkv");
  check_refused(shell, join + "--out film.mp4", {"lack frame 0; draw 000000.mp4"});
  check_refused(shell, join + "--out parts/000000.mkv", {"is in the folder of the parts"});
  check_refused(shell, join + "--out film.png", {"only films are joined"});
  check_refused(shell, kJob + "7 --join none --out film.mkv", {"none: "});
  const Outcome joined = shell.run(join + "--quiet --out film.mkv && " + kJob +
                                   "7 --quiet --out whole.mkv && cmp film.mkv whole.mkv");
  CAPTURE(joined.err);
  CHECK(joined.code == 0);
}

TEST_CASE("Film job: parts with another size or frame rate are refused by name") {
  const Shell shell;
  write_film_scene(shell);
  const auto draw = [&](const std::string& extension, int first, const std::string& flags) {
    const std::string frames = std::to_string(first) + ':' + std::to_string(first + 60);
    const Outcome drawn = shell.run(
        "mkdir -p parts && clatter render scene.toml --to 12 --speed 1 --seed 5 --quiet --backend "
        "egl --overwrite --frames " +
        frames + " --out parts/" + std::to_string(first) + extension + ' ' + flags);
    CAPTURE(drawn.err);
    REQUIRE(drawn.code == 0);
  };
  for (const std::string extension : {".mp4", ".webm", ".mkv", ".gif"}) {
    CAPTURE(extension);
    const std::string join =
        "clatter render scene.toml --to 12 --speed 1 --fps 10 --join parts --out film" + extension;
    draw(extension, 0, "--size 64x48 --fps 10");
    draw(extension, 60, "--size 64x50 --fps 10");
    check_refused(shell, join,
                  {"parts/60" + extension + ": its size is 64x50, and the size of 0" + extension +
                   " is 64x48; draw all parts with one --size"});
    draw(extension, 60, "--size 64x48 --fps 11");
    check_refused(shell, join,
                  {"parts/60" + extension + ": its frame rate is not 10; give the --fps of the"});
    draw(extension, 60, "--size 64x48 --fps 10");
    const Outcome joined = shell.run(join);
    CAPTURE(joined.err);
    CHECK(joined.code == 0);
  }
}

TEST_CASE("Film job: a join writes no files beside the parts, and follows a link to another disk") {
  const Shell shell;
  write_film_scene(shell);
  REQUIRE(shell.run(kJob + "7 --quiet --out whole.mkv").code == 0);
  shell.run(
      "mkdir parts && cp whole.mkv parts/000000.mkv && cd parts && echo mine >pieces.txt && "
      "echo mine >joined.mkv && touch -d @0 .");
  // /dev/shm is another file system on most machines.
  const Outcome joined = shell.run(
      "disk=$(mktemp -d -p /dev/shm || mktemp -d)\nln -s $disk/film.mkv link.mkv\n" + kJob +
      "7 --quiet --join parts --out link.mkv; code=$?\n"
      "cmp whole.mkv $disk/film.mkv && ls -A $disk\nrm -r $disk\nexit $code");
  CAPTURE(joined.err);
  CHECK(joined.code == 0);
  CHECK(joined.out == "film.mkv\n");
  CHECK(shell.run("cd parts; ls -A | xargs; stat -c %Y .; cat joined.mkv pieces.txt").out ==
        "000000.mkv joined.mkv pieces.txt\n0\nmine\nmine\n");
}

TEST_CASE("Film job: the tasks have the start state of the submission") {
  const Shell shell;
  const std::string film = "clatter render --to 1 --fps 10 --size 64x48 --backend egl --quiet ";
  const std::string submit = " --slurm 1 --dry-run --out ";
  const auto same_pictures = [](const std::string& one, const std::string& two) {
    return "for f in " + one + ' ' + two +
           "; do ffmpeg -v error -y -i $f -f framemd5 $f.sums; done && cmp " + one + ".sums " +
           two + ".sums";
  };
  // The gallery has its own cradle.csv.
  shell.write("cradle.csv", "nonsense\n");
  const Outcome cradle =
      shell.run(film + "cradle --out a.mkv && " + film + "cradle" + submit + "b.mkv && " +
                task("b.mkv", 1) + " && " + same_pictures("a.mkv", "b.mkv"));
  CAPTURE(cradle.err);
  CHECK(cradle.code == 0);

  shell.write("two.csv", "x,y,vx,vy\n3,3,1,0\n6,3,0,1\n");
  shell.write("two.toml",
              "title = \"Two\"\nbox.size = [20, 15]\n"
              "particles.start = { layout = \"file\", file = \"two.csv\" }\n");
  const std::string job = film + "two.toml" + submit + "d.mkv";
  REQUIRE(shell.run(film + "two.toml --out c.mkv && " + job).code == 0);
  shell.write("two.csv", "x,y,vx,vy\n9,9,1,0\n6,3,0,1\n");
  const Outcome other = shell.run(job);
  CHECK(other.code == 2);
  CHECK(says(other.err, "has the job of another film"));
  const Outcome two = shell.run(task("d.mkv", 1) + " && " + same_pictures("c.mkv", "d.mkv"));
  CAPTURE(two.err);
  CHECK(two.code == 0);
}

TEST_CASE("Film job: wrong flags are refused") {
  const Shell shell;
  write_film_scene(shell);
  check_refused(shell, kJob + "7 --slurm 2 --out film.png", {"one picture"});
  check_refused(shell, kJob + "7 --slurm 2 --out film.mp4 --frames 0:60", {"--slurm"});
  check_refused(shell, kJob + "7 --slurm 0 --out film.mp4", {"--slurm"});
  check_refused(shell, kJob + "7 --time 1:00 --out film.mp4", {"--time"});
  check_refused(shell, kJob + "7 --slurm 2 --out none/film.mp4", {"there is no folder none"});
  shell.run(
      "mkdir film.mp4 && touch film.webm && chmod a-w film.webm && touch frames film.checkpoint");
  check_refused(shell, kJob + "7 --slurm 2 --out film.mp4", {"film.mp4 is a folder"});
  const Outcome locked = shell.run(kJob + "7 --slurm 2 --out film.webm");
  CHECK(locked.code == 1);
  CHECK(says(locked.err, "cannot write film.webm: it is write-protected"));
  CHECK(shell.run(kJob + "7 --slurm 2 --out frames").code == 1);
  CHECK_FALSE(std::filesystem::exists(shell.path("frames.slurm")));
  // Checkpoints of other runs do not matter: the tasks have their own.
  CHECK(shell.run("rm -r film.mp4; " + kJob + "7 --slurm 2 --dry-run --out film.mp4").code == 0);
  shell.run("rm -r film.mp4.slurm");
  const Outcome none = shell.run(
      "c=$(command -v clatter); PATH=/none $c render scene.toml --slurm 2 --out film.mp4");
  CHECK(none.code == 1);
  CHECK(says(none.err, "cannot start sbatch: No such file or directory; the script is "));
}

}  // namespace clatter
