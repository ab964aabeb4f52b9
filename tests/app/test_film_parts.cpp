// Films that are interrupted and resumed, and films made in parts, with the command line.

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "tests/app/film_scene.h"

namespace clatter {

namespace {

// 150 frames with motion blur and trails over a heatmap with automatic ranges. The stroke of one
// wall grows later, so that an automatic camera would show more. The camera follows a disk.
const std::string kFilm =
    "clatter render scene.toml --size 160x120 --fps 10 --quiet --speed 1 --shutter 0.7 --to 15 ";

void write_scene(const Shell& shell) {
  write_film_scene(shell,
                   ", plots = [\"temperature\", \"density_profile\"], arrows = \"velocity\", "
                   "camera = [{ time = 5.0 }, { time = 9.0, follow = 3, "
                   "width = 8.0 }]",
                   "[[change]]\ntime = 4.0\nset = { \"walls.left.stroke\" = 1.0 }\n");
}

// One line per frame of a film, or per picture of a folder, with a hash of its pixels.
std::string hashes(const Shell& shell, const std::string& input) {
  return shell
      .run("ffmpeg -v error " + input +
           " -pix_fmt rgb24 -f framemd5 - | grep -v '#' | sed 's/.*, //'")
      .out;
}

// Films until the encoder of the second piece has begun, then applies `act` to the run $pid.
Outcome film_into_second_piece(const Shell& shell, const std::string& act,
                               const std::string& flags = "") {
  return shell.run(
      kFilm + flags +
      "--out film.mp4 & pid=$!\n"
      "until [ -e film.mp4.part/000060.mp4 -a -n \"$(cat /proc/$pid/task/$pid/children)\" ] || "
      "! kill -0 $pid; do sleep 0.02; done\n" +
      act);
}

// An ffmpeg in the folder no-join that does not join pieces.
void write_failing_join(const Shell& shell) {
  shell.run("mkdir no-join");
  shell.write("no-join/ffmpeg",
              "#!/bin/sh\ncase \"$*\" in *'-f concat'*) echo 'no room' >&2; exit 1 ;; esac\n"
              "PATH=${PATH#*:} exec ffmpeg \"$@\"\n");
  shell.run("chmod +x no-join/ffmpeg");
}

void check_goes_on_to_whole(const Shell& shell) {
  CHECK(shell.run(kFilm + "--out film.mp4 --resume film.checkpoint && cmp film.mp4 whole").code ==
        0);
}

}  // namespace

TEST_CASE(
    "Film parts: the parts of a film, also when resumed from each other's checkpoints, are the "
    "film") {
  const Shell shell;
  write_scene(shell);
  REQUIRE(shell.run(kFilm + "--out whole.mkv").code == 0);
  const std::string whole = hashes(shell, "-i whole.mkv");
  CHECK(std::ranges::count(whole, '\n') == 150);

  // The first and the last part are separate runs. The second writes a checkpoint, from which the
  // third continues.
  for (const std::string part :
       {"--frames 0:37 --out frames", "--frames 37:80 --out frames --checkpoint c",
        "--frames 90:120 --out frames --resume c", "--frames 80:90 --out frames --resume c",
        "--frames 120: --out frames"}) {
    CAPTURE(part);
    const Outcome outcome = shell.run(kFilm + part);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
  }
  CHECK((hashes(shell, "-framerate 10 -i frames/frame_%06d.png") == whole));

  const Outcome film =
      shell.run(kFilm + "--frames 60:120 --out part.mp4 && " + kFilm + "--out whole.mp4");
  CHECK(film.code == 0);
  const std::string lossy = hashes(shell, "-i whole.mp4"), part = hashes(shell, "-i part.mp4");
  CHECK(part.size() * 150 == lossy.size() * 60);
  CHECK((says(lossy, part)));

  // Parts without loss may begin anywhere.
  REQUIRE(shell
              .run("mkdir parts && " + kFilm + "--frames 0:37 --out parts/000000.mkv && " + kFilm +
                   "--frames 37: --out parts/000037.mkv && " + kFilm +
                   "--join parts --out joined.mkv")
              .code == 0);
  CHECK((hashes(shell, "-i joined.mkv") == whole));
  CHECK(shell.run("mkfifo pipe.mkv").code == 0);
  check_refused(shell, kFilm + "--join parts --out pipe.mkv", {"pipe.mkv: this is not a regular"});
}

TEST_CASE("Film parts: a resumed film keeps the flags it began with, and refuses others") {
  const Shell shell;
  write_scene(shell);
  REQUIRE(shell.run(kFilm + "--out whole.mp4").code == 0);
  REQUIRE(shell.run(kFilm + "--frames 0:60 --out film --checkpoint c").code == 0);
  const std::string on = "clatter render scene.toml --quiet --resume c ";
  const std::vector<std::pair<std::string, std::vector<std::string>>> rows = {
      {"--fps 20", {"--fps", "10"}},
      {"--size 320x240", {"--size", "160x120"}},
      {"--speed 2", {"--speed"}},
      {"--shutter 0.2", {"--shutter", "0.7"}},
      {"--transparent", {"--transparent"}},
      {"--encoding small", {"--encoding", "balanced"}},
      {"--no-overlay", {"--no-overlay"}},
      {"--to 3", {"--to", "5.9"}},
      {"--set view.field=density", {"view.field"}},
      {"--frames 10:30", {"--frames", "60"}},
      {"--frames 150:160", {"--frames", "150"}},
      {"--frames 7", {"--frames", "FIRST:END"}}};
  for (const auto& [flags, parts] : rows) check_refused(shell, on + "--out film " + flags, parts);
  check_refused(shell, "clatter render scene.toml --to 0 --out still --frames 1:2",
                {"--frames", "the film has 1 frame;"});
  check_refused(shell, on + "--out other.mp4", {"other.mp4", "000000.mp4", "--frames 60:"});
  CHECK(shell.run(on + "--out film").code == 0);
  CHECK(shell.run("ls film | wc -l").out == "150\n");
  // A film that began with --no-overlay continues, although its scene has plots.
  REQUIRE(shell.run(kFilm + "--frames 0:60 --no-overlay --out alone --checkpoint d").code == 0);
  for (const std::string flag : {"", " --no-overlay --overwrite"}) {
    CHECK(
        shell.run("clatter render scene.toml --quiet --resume d --to 7 --out alone" + flag).code ==
        0);
  }
  // Another start time begins another film.
  CHECK(shell.run(on + "--from 7 --to 7.2 --out other.mp4").code == 0);
}

TEST_CASE(
    "Film parts: a film whose encoder is killed keeps its frames, says where, and can be resumed") {
  const Shell shell;
  write_scene(shell);
  REQUIRE(shell.run(kFilm + "--out film.mp4 && mv film.mp4 whole").code == 0);
  const Outcome killed =
      film_into_second_piece(shell, "kill -9 $(cat /proc/$pid/task/$pid/children); wait $pid");
  CAPTURE(killed.err);
  CHECK(killed.code == 1);
  CHECK(says(killed.err,
             "Killed; earlier pictures are in film.mp4.part; continue with --resume "
             "film.checkpoint"));
  CHECK(hashes(shell, "-i film.mp4.part/000000.mp4").size() == 60 * 33);
  check_refused(shell, kFilm + "--out film.mp4", {"film.mp4.part", "--resume", "--overwrite"});
  check_goes_on_to_whole(shell);
}

// The first run's encoder opens its file only after the second run has filmed the same frames.
TEST_CASE(
    "Film parts: an encoder that outlives a killed run does not touch the film made after it") {
  const Shell shell;
  write_scene(shell);
  shell.run("mkdir late");
  shell.write("late/ffmpeg",
              "#!/bin/sh\n[ -e go ] || touch begun\nuntil [ -e go ]; do sleep 0.02; done\n"
              "PATH=${PATH#*:} ffmpeg \"$@\"; touch ended\n");
  shell.run("chmod +x late/ffmpeg");
  shell.run("PATH=$PWD/late:$PATH " + kFilm +
            "--out film.mp4 & pid=$!\n"
            "while [ ! -e begun ] && kill -0 $pid; do sleep 0.02; done; kill -9 $pid; wait $pid");
  const Outcome film =
      film_into_second_piece(shell,
                             "kill -STOP $pid; touch go; until [ -e ended ]; do sleep 0.02; done\n"
                             "kill -CONT $pid; wait $pid",
                             "--overwrite ");
  CAPTURE(film.err);
  CHECK(film.code == 0);
  CHECK(hashes(shell, "-i film.mp4").size() == 150 * 33);
}

TEST_CASE("Film parts: hidden files of a join are locked until the encoder ends") {
  const Shell shell;
  write_film_scene(shell);
  const std::string film =
      "clatter render scene.toml --size 64x48 --fps 10 --quiet --speed 1 --to 0.4 ";
  shell.run("mkdir parts locked");
  for (const std::string part : {"0:2 --out parts/000000.mp4", "2: --out parts/000002.mp4"}) {
    REQUIRE(shell.run(film + "--frames " + part).code == 0);
  }
  // Another run would remove a hidden file without a lock.
  shell.write("locked/ffmpeg",
              "#!/bin/sh\ncase \"$*\" in *'-f concat'*) for file in .film.mp4.clatter-*; do\n"
              "flock -n $file true && echo no lock || echo locked; done >>locks ;; esac\n"
              "PATH=${PATH#*:} exec ffmpeg \"$@\"\n");
  shell.run("chmod +x locked/ffmpeg");
  const Outcome joined =
      shell.run("PATH=$PWD/locked:$PATH " + film + "--join parts --out film.mp4");
  CAPTURE(joined.err);
  CHECK(joined.code == 0);
  CHECK(shell.read("locks") == "locked\nlocked\n");  // the list and the film
}

TEST_CASE("Film parts: a lock that is released soon does not refuse a film") {
  const Shell shell;
  write_scene(shell);
  const std::string line = kFilm + "--out film.mp4";
  const auto film_beside_lock = [&](const std::string& seconds) {
    return shell.run("mkdir -p film.mp4.part; flock film.mp4.part sh -c 'touch held; sleep " +
                     seconds + "' & until [ -e held ]; do sleep 0.01; done; rm held; " + line +
                     "; code=$?; wait; exit $code");
  };
  const Outcome refused = film_beside_lock("4");
  CHECK(refused.code == 2);
  CHECK(says(refused.err, "another program is filming to this name"));
  const Outcome film = film_beside_lock("0.3");
  CAPTURE(film.err);
  CHECK(film.code == 0);
}

// The film has two complete pieces and a part of a third.
TEST_CASE("Film parts: a film that could not be joined is resumed to the same bytes") {
  const Shell shell;
  write_scene(shell);
  write_failing_join(shell);
  REQUIRE(shell.run(kFilm + "--out film.mp4 && mv film.mp4 whole").code == 0);
  const Outcome failed =
      shell.run("PATH=$PWD/no-join:$PATH " + kFilm + "--out film.mp4 --checkpoint film.checkpoint");
  CAPTURE(failed.err);
  CHECK(failed.code == 1);
  CHECK(says(failed.err, "no room; earlier pictures are in film.mp4.part; continue with --resume"));
  SUBCASE("as it was") {
    check_goes_on_to_whole(shell);
  }
  // The film restarts from its beginning, and its pieces are drawn again.
  for (const std::string damage :
       {"cp film.mp4.part/000000.mp4 film.mp4.part/000060.mp4",
        "truncate -s 1000 film.mp4.part/000000.mp4", ": >film.mp4.part/000000.mp4"}) {
    SUBCASE(damage.c_str()) {
      CAPTURE(damage);
      const Outcome outcome =
          shell.run(damage + " && " + kFilm +
                    "--out film.mp4 --resume film.checkpoint && cmp film.mp4 whole");
      CAPTURE(outcome.err);
      CHECK(outcome.code == 0);
      CHECK(says(outcome.err,
                 ".mp4 is not the piece that was drawn; the film restarts from its beginning\n"));
      CHECK(shell.files() == std::vector<std::string>{"film.checkpoint", "film.mp4", "no-join",
                                                      "scene.toml", "whole"});
    }
  }
  // Other laws from the beginning would be another film.
  SUBCASE("but not under other laws") {
    shell.run("truncate -s 1000 film.mp4.part/000000.mp4");
    check_refused(
        shell, kFilm + "--out film.mp4 --resume film.checkpoint --set particles.restitution=0.8",
        {"film.mp4.part/000000.mp4 is not the piece that was drawn; draw the film again"});
  }
}

TEST_CASE("Film parts: a film of one frame that could not be joined is resumed to the same bytes") {
  const Shell shell;
  write_scene(shell);
  write_failing_join(shell);
  const std::string film =
      "clatter render scene.toml --size 160x120 --fps 10 --quiet --speed 1 --from 3 --to 3.1 "
      "--out film.mp4 ";
  REQUIRE(shell.run(film + "&& mv film.mp4 whole").code == 0);
  const Outcome failed = shell.run("PATH=$PWD/no-join:$PATH " + film);
  CHECK(says(failed.err, "no room; earlier pictures are in film.mp4.part; continue with --resume"));
  const Outcome resumed = shell.run(film + "--resume film.checkpoint && cmp film.mp4 whole");
  CAPTURE(resumed.err);
  CHECK(resumed.code == 0);
}

// The pictures of the first film fit into the pipe to the encoder, those of the second do not.
TEST_CASE("Film parts: an interrupt ends a film whose encoder does not read its input") {
  const Shell shell;
  write_scene(shell);
  shell.run("mkdir deaf");
  shell.write("deaf/ffmpeg", "#!/bin/sh\nexec sleep 1000\n");
  shell.run("chmod +x deaf/ffmpeg");
  for (const std::string size : {"24x16", "640x480"}) {
    CAPTURE(size);
    const Outcome outcome = shell.run(
        "PATH=$PWD/deaf:$PATH timeout --preserve-status -k 20 -s INT 1 clatter render scene.toml "
        "--size " +
        size + " --fps 10 --speed 1 --to 1000 --quiet --out film.mp4");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "it does not read its input; continue with --resume film.checkpoint"));
    CHECK(shell.run("rm film.checkpoint* && ls").out == "deaf\nscene.toml\n");
  }
}

TEST_CASE("Film parts: a resumed folder with an empty or truncated picture is drawn again") {
  const Shell shell;
  write_scene(shell);
  const std::string line = "clatter render scene.toml --size 64x48 --fps 10 --quiet --out frames ";
  // The film that restarts has the seed of the checkpoint.
  REQUIRE(shell.run(line + "--to 8 --seed 5 && mv frames kept").code == 0);
  for (const std::string size : {"0", "100"}) {
    CAPTURE(size);
    REQUIRE(shell.run("rm -rf frames; " + line + "--to 7 --seed 5 --checkpoint c").code == 0);
    CHECK(shell.run("truncate -s " + size + " frames/frame_000003.png").code == 0);
    const Outcome outcome = shell.run(line + "--to 8 --resume c");
    CHECK(outcome.code == 0);
    CHECK(says(outcome.err,
               "the frame frames/frame_000003.png is damaged; the film restarts from its "
               "beginning"));
    CHECK(shell.run("diff -r frames kept").code == 0);
  }
}

TEST_SUITE_BEGIN("slow");

// Random times within the usual duration of the film, seed 6. Some precede the first frame.
TEST_CASE("Film parts: a film interrupted or killed at any time is resumed to the same bytes") {
  const Shell shell;
  write_scene(shell);
  for (const std::string out : {"film.mp4", "film.mkv", "film"}) {
    CAPTURE(out);
    const std::string line = kFilm + "--out " + out + " ";
    REQUIRE(shell.run(line + "&& mv " + out + " kept").code == 0);
    std::mt19937 random(6);
    for (int trial = 0; trial < 20; ++trial) {
      const double seconds = std::uniform_real_distribution(0.1, 4.0)(random);
      const bool killed = trial % 4 == 3;
      CAPTURE(trial);
      CAPTURE(seconds);
      const std::string run = line + " --checkpoint c --checkpoint-every 0.2";
      const std::string at = std::to_string(seconds);
      // After a kill the shell waits for the end of the program, which then holds no lock.
      const int code = shell
                           .run(killed ? run + " & sleep " + at + "; kill -KILL $!; wait $!"
                                       : "timeout --preserve-status -s INT " + at + " " + run)
                           .code;
      CHECK((code == 0 || code == 130 || code == 137));
      const std::string compare = "diff -r " + out + " kept";
      // A run killed at once has no checkpoint yet. A run killed late is complete.
      if (code != 0 && shell.run(compare).code != 0) {
        const bool kept = std::ranges::count(shell.files(), "c") > 0;
        const Outcome outcome = shell.run(line + (kept ? "--resume c" : "--overwrite"));
        CAPTURE(outcome.err);
        CHECK(outcome.code == 0);
      }
      CHECK(shell.run(compare).code == 0);
      shell.run("rm -rf " + out + " " + out + ".part c c.previous");
    }
    shell.run("rm -rf kept");
  }
}

TEST_SUITE_END();

}  // namespace clatter
