// The files of films, read by their specifications (read_film.py) instead of the encoder.

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

#include "tests/app/readers.h"

namespace clatter {

using nlohmann::json;

namespace {

// 150 frames: three pieces. The third picture of a second has no decimal time.
const std::string kFilmOf5Seconds =
    "clatter render vibrated --size 160x120 --fps 30 --speed 1 --to 5 --quiet ";

// Picture k is at k/30 s, up to the ticks of the format.
void check_times(const json& film, long pictures, double tick) {
  CHECK(film.at("pictures") == pictures);
  CHECK(std::fabs(film.at("end").get<double>() - static_cast<double>(pictures) / 30.0) <= tick);
  for (std::size_t k = 0; k < film.at("times").size(); ++k) {
    const double off = film.at("times")[k].get<double>() - static_cast<double>(k) / 30.0;
    CHECK(std::fabs(off) <= tick);
  }
}

}  // namespace

TEST_CASE("Film files: every format has all pictures at their times, in one stream") {
  const Shell shell;
  struct Format {
    const char* extension;
    double tick;  // s
  };
  for (const Format& format : {Format{"gif", 0.0051}, Format{"mp4", 1e-4}, Format{"mov", 1e-4},
                               Format{"webm", 1.1e-3}, Format{"mkv", 1.1e-3}}) {
    CAPTURE(format.extension);
    const std::string file = std::string("film.") + format.extension;
    REQUIRE(shell.run(kFilmOf5Seconds + "--out " + file).code == 0);
    check_times(read_by(shell, "read_film.py", file), 150, format.tick);
  }
}

// The similarity is that of ffmpeg, over all pictures.
TEST_CASE("Film files: encodings trade bytes, and all resemble the pictures") {
  const Shell shell;
  const std::string render = "clatter render vibrated --size 480x360 --to 5 --speed 2 --quiet ";
  REQUIRE(shell.run(render + "--out whole.mkv").code == 0);
  for (const std::string format : {"mp4", "webm"}) {
    CAPTURE(format);
    std::uintmax_t less = 0;
    for (const std::string encoding : {"small", "balanced", "fast"}) {
      CAPTURE(encoding);
      const std::string file = encoding + "." + format;
      REQUIRE(shell.run(render + "--encoding " + encoding + " --out " + file).code == 0);
      check_times(read_by(shell, "read_film.py", file), 75, 1.1e-3);
      const std::uintmax_t bytes = std::filesystem::file_size(shell.path(file));
      CHECK(bytes > less);
      less = bytes;
      const std::string report =
          shell
              .run("ffmpeg -i " + file +
                   " -i whole.mkv -lavfi '[0:v]setpts=N/30/TB[a];[1:v]scale=out_color_matrix=bt709"
                   ":out_range=tv,format=yuv420p,setpts=N/30/TB[b];[a][b]ssim' -f null - 2>&1")
              .out;
      const auto all = report.find("All:");
      REQUIRE(all != report.npos);
      CHECK(std::stod(report.substr(all + 4)) > 0.985);
    }
  }
  REQUIRE(shell.run(render + "--out default.mp4").code == 0);
  CHECK(shell.run("cmp default.mp4 balanced.mp4").code == 0);
  for (const char* out : {"film.mkv", "film.gif", "folder", "picture.png"}) {
    check_refused(shell, render + "--encoding fast --out " + out, {"--encoding", ".mp4 or .webm"});
  }
  check_refused(shell, render + "--encoding quick --out a.mp4", {"--encoding", "quick"});
}

TEST_CASE("Film files: each picture of a transparent WebM has an opacity") {
  const Shell shell;
  REQUIRE(shell.run(kFilmOf5Seconds + "--transparent --out film.webm").code == 0);
  const json film = read_by(shell, "read_film.py", "film.webm");
  check_times(film, 150, 1.1e-3);
  CHECK(film.at("opacities") == 150);
}

// A namespace of processes with the /proc of the outside, as in some containers.
TEST_CASE("Film files: a film is made where this process has another number in /proc") {
  const Shell shell;
  if (shell.run("unshare -pf true").code != 0) {
    MESSAGE("[skipped] this needs the right to make a namespace");
    return;
  }
  const Outcome outcome =
      shell.run("unshare -pf clatter render vibrated --size 160x120 --to 1 --out film.mp4 --quiet");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(read_by(shell, "read_film.py", "film.mp4").at("pictures") == 15);
}

}  // namespace clatter
