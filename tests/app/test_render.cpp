#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/support/shell.h"

namespace clatter {

using Files = std::vector<std::string>;

static const std::string kRender = "clatter render vibrated --size 160x120 --quiet ";

// Width, height and number of decoded pictures, from ffprobe.
static std::string probe(const Shell& shell, const std::string& file) {
  return shell
      .run(
          "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
          "stream=width,height,nb_read_frames -of csv=p=0 " +
          file)
      .out;
}

// The pixels of a picture, as a hash of the decoded data of ffmpeg.
static std::string pixels_of(const Shell& shell, const std::string& file) {
  return shell.run("ffmpeg -v error -i " + file + " -f md5 -").out;
}

TEST_CASE("Render: a film has the frames, the rate and the size asked for") {
  const Shell shell;
  const Outcome outcome = shell.run(kRender + "--from 1 --to 2 --speed 2 --fps 20 --out film.mp4");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.empty());
  CHECK(probe(shell, "film.mp4") == "160,120,10\n");
  CHECK(shell.files() == Files{"film.mp4"});
}

TEST_CASE("Render: the picture of the guide opens, and shows the gas of its command") {
  const Shell shell;
  const std::string file = std::string(CLATTER_DOCS) + "/vibrated.png";
  const Outcome opened = shell.run("clatter check " + file);
  CAPTURE(opened.err);
  CHECK(opened.code == 0);
  const auto run = nlohmann::json::parse(
      shell.run("clatter measure vibrated --quiet --set measure.burn_in=0 --until 20").out);
  const std::string hash = run.at("state_hash");
  CHECK(says(shell.run("cat " + file).out, std::string("State hash\0\0\0\0\0", 15) + hash));
}

TEST_CASE("Render: a quality sets size and rate, unless these are given") {
  const Shell shell;
  const std::string line = "clatter render vibrated --quiet --to 0.1 --speed 1 --out ";
  struct Asked {
    std::string flags;
    std::string found;  // 0.1 s of film
  };
  for (const Asked& asked : {Asked{"-ql", "854,480,2\n"},
                             {"", "1280,720,3\n"},
                             {"-qm", "1280,720,3\n"},
                             {"-qh", "1920,1080,6\n"},
                             {"-qh --size 160x120 --fps 50", "160,120,5\n"}}) {
    CAPTURE(asked.flags);
    CHECK(shell.run(line + "film.mp4 " + asked.flags).code == 0);
    CHECK(probe(shell, "film.mp4") == asked.found);
  }
  // A GIF has at most 50 frames per second.
  CHECK(shell.run(line + "film.gif -qh --size 160x120").code == 0);
  CHECK(probe(shell, "film.gif") == "160,120,5\n");
  CHECK(shell.run(line + "film.mp4 -qx").code == 2);
}

TEST_CASE("Render: pictures and films contain their scene, seed, state and program") {
  const Shell shell;
  const auto measured = nlohmann::json::parse(
      shell.run("clatter measure vibrated --seed 5 --set measure.burn_in=0 --until 2 --quiet").out);
  const std::string hash = measured.at("state_hash");
  // The last of these frames is at time 2.
  const std::string line = kRender + "--seed 5 --speed 1 --fps 4 --to 2.25 --out ";
  for (const std::string name : {"film.mp4", "film.webm", "film.mkv"}) {
    CAPTURE(name);
    REQUIRE(shell.run(line + name).code == 0);
    const std::string tags =
        shell.run("ffprobe -v error -show_entries format_tags -of json " + name).out;
    CAPTURE(tags);
    CHECK(says(tags, "\"Vibrated box\""));
    CHECK(says(tags, "Simulation time: 2\\nState hash: " + hash));
    CHECK(says(tags, "Software: clatter " CLATTER_VERSION "\\nSeed: 5\\nScene: schema = 1"));
  }
  REQUIRE(shell.run(line + "frames").code == 0);
  const std::string last = shell.read("frames/frame_000008.png");
  CHECK(says(last, std::string("State hash\0\0\0\0\0", 15) + hash));
  CHECK(says(last, std::string("Seed\0\0\0\0\0", 9) + "5"));
  CHECK(says(last, "drive_speed = 1"));
  CHECK_FALSE(says(shell.read("frames/frame_000007.png"), hash));
}

TEST_CASE("Render: a picture holds the scene and seed to draw it again") {
  const Shell shell;
  shell.run(kRender + "--to 1 --seed 7 --set particles.count=50 --out a.png");
  REQUIRE(shell.run("clatter render a.png --size 160x120 --quiet --to 1 --out b.png").code == 0);
  CHECK(shell.read("a.png") == shell.read("b.png"));
  // The command line overrides the picture.
  CHECK(shell.run("clatter render a.png --size 160x120 --quiet --to 1 --seed 8 --out b.png").code ==
        0);
  CHECK(says(shell.read("b.png"), std::string("Seed\0\0\0\0\0", 9) + "8"));
  CHECK(pixels_of(shell, "a.png") != pixels_of(shell, "b.png"));
  CHECK(says(shell.run("clatter check a.png --set particles.count=51").out, "count = 51"));
  // A picture of another program.
  shell.run("ffmpeg -v error -f lavfi -i color -frames:v 1 other.png");
  const Outcome other = shell.run("clatter check other.png");
  CHECK(other.code == 2);
  CHECK(says(other.err, "other.png"));
}

TEST_CASE("Render: a picture of several samples a pixel has the size asked for, and other edges") {
  const Shell shell;
  shell.run(kRender + "--to 1 --out a.png && " + kRender + "--to 1 --supersample 3 --out b.png");
  CHECK(probe(shell, "b.png") == "160,120,1\n");
  CHECK(shell.read("a.png") != shell.read("b.png"));
  const Outcome outcome = shell.run(kRender + "--to 1 --supersample 5 --out c.png");
  CHECK(outcome.code == 2);
  CHECK(says(outcome.err, "--supersample"));
}

// The pixels of a picture at t = 2 without an overlay.
static std::string drawn(const Shell& shell, const std::string& flags) {
  const Outcome outcome = shell.run(kRender + "--no-overlay --to 2 --out a.png " + flags);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  return pixels_of(shell, "a.png");
}

TEST_CASE("Render: shutter, trails and camera change pictures, but not the run") {
  const Shell shell;
  const std::string plain = drawn(shell, "");
  CHECK(drawn(shell, "--shutter 0") == plain);
  CHECK(drawn(shell, "--shutter 1") != plain);
  CHECK(drawn(shell, "--set view.trails=1") != plain);
  CHECK(drawn(shell, "--set view.camera='[{ follow = 3, width = 8 }]'") != plain);
  CHECK(drawn(shell, "--set view.camera='[{ time = 5 }]'") == plain);
  CHECK(shell.run(kRender + "--shutter 1.5 --out b.png").code == 2);
}

TEST_CASE("Render: without an overlay the gas is alone, unless --set gives plots") {
  const Shell shell;
  const std::string plots = "--set 'view.plots=[\"temperature\"]'";
  CHECK(drawn(shell, plots) != drawn(shell, ""));
  // Plots of the scene itself.
  CHECK(shell
            .run("clatter render rough_cooling --size 160x120 --quiet --to 1 --no-overlay --out "
                 "b.png && "
                 "clatter render rough_cooling --size 160x120 --quiet --to 1 --no-overlay --set "
                 "view.plots=[] --out c.png")
            .code == 0);
  CHECK((pixels_of(shell, "b.png") == pixels_of(shell, "c.png")));
}

TEST_CASE("Render: a film begins with its title where a card is asked for") {
  const Shell shell;
  CHECK(shell.run(kRender + "--to 1 --speed 1 --fps 4 --set view.card=0.5 --out card").code == 0);
  CHECK(shell.run(kRender + "--to 1 --speed 1 --fps 4 --out plain").code == 0);
  const auto frame = [&](const std::string& film, int number) {
    return pixels_of(shell, film + "/frame_00000" + std::to_string(number) + ".png");
  };
  for (const int number : {0, 1}) CHECK(frame("card", number) != frame("plain", number));
  for (const int number : {2, 3}) CHECK(frame("card", number) == frame("plain", number));
}

TEST_CASE("Render: a picture may have no background, and an mp4 must have one") {
  const Shell shell;
  CHECK(shell.run(kRender + "--to 1 --transparent --out a.png").code == 0);
  // Parts are transparent, parts are opaque.
  const std::string alpha =
      "ffmpeg -v error -i a.png -vf alphaextract -f rawvideo - | od -An -v -tu1 -w1 | sort -nu | ";
  CHECK(says(shell.run(alpha + "head -1").out, " 0\n"));
  CHECK(says(shell.run(alpha + "tail -1").out, "255\n"));
  const Outcome film = shell.run(kRender + "--to 1 --transparent --out a.mp4");
  CHECK(film.code == 2);
  CHECK(says(film.err, "--transparent"));
}

// The film has more than one piece. The alpha of VP9 is a film of its own beside the colours, which
// only the decoder of libvpx reads.
TEST_CASE("Render: a transparent film has the alpha and the colours of the pictures") {
  const Shell shell;
  const std::string line =
      kRender + "--speed 1 --fps 50 --to 1.3 --transparent --no-overlay --out ";
  REQUIRE(shell.run(line + "frames").code == 0);
  // The similarity of the channels of a film with those of the folder, from 0 to 1. Colours count
  // as far as they are visible.
  const auto similarity = [&](const std::string& film, const std::string& channels) {
    const std::string seen =
        channels == "alpha" ? "alphaextract" : "premultiply=inplace=1,format=gbrp";
    const std::string lavfi =
        "[0]format=gbrap," + seen + "[a];[1]format=gbrap," + seen + "[b];[a][b]ssim";
    const std::string words =
        shell
            .run("ffmpeg " + film + " -framerate 50 -i frames/frame_%06d.png -lavfi '" + lavfi +
                 "' -f null - 2>&1 | sed -n 's/.*SSIM.*All:\\([0-9.]*\\).*/\\1/p'")
            .out;
    return words.empty() ? 0.0 : std::stod(words);
  };
  for (const std::string name : {"film.mov", "film.webm", "film.mkv"}) {
    CAPTURE(name);
    const Outcome outcome = shell.run(line + name);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(probe(shell, name) == "160,120,65\n");
    const std::string input = (name == "film.webm" ? "-c:v libvpx-vp9 -i " : "-i ") + name;
    CHECK(similarity(input, "alpha") > 0.97);
    CHECK(similarity(input, "colours") > 0.95);
  }
}

TEST_CASE("Render: a picture from a time is the picture at that time") {
  const Shell shell;
  shell.run(kRender + "--from 3 --out from.png && " + kRender + "--to 3 --out to.png");
  REQUIRE_FALSE(shell.read("to.png").empty());
  CHECK(shell.read("from.png") == shell.read("to.png"));
}

// Most of the picture is beside the arrows and stays unchanged.
TEST_CASE("Render: arrows need no heatmap, and take none along") {
  const Shell shell;
  shell.write("s.toml", "box.size = [9, 9]\nparticles.count = 4\nview.colour_by = 'none'\n");
  const std::string line = "clatter render s.toml --to 1 --no-overlay --size 90x90 --out ";
  REQUIRE(shell.run(line + "a.png && " + line + "b.png --set view.arrows=velocity").code == 0);
  const std::string levels =
      shell
          .run(
              "ffmpeg -i a.png -i b.png -lavfi blend=all_mode=difference,signalstats,"
              "metadata=print:file=- -f null - | grep -E 'YAVG|YMAX'")
          .out;
  const auto value = [&](const std::string& key) {
    return std::stod(levels.substr(levels.find(key + "=") + key.size() + 1));
  };
  CHECK(value("YMAX") > 100.0);
  CHECK(value("YAVG") < 30.0);
}

TEST_CASE("Render: a folder gets a picture for each frame, and keeps older ones") {
  const Shell shell;
  const std::string line = kRender + "--to 1 --speed 1 --fps 4 --out frames/";
  CHECK(shell.run(line).code == 0);
  const std::string listed =
      "frame_000000.png\nframe_000001.png\nframe_000002.png\nframe_000003.png\n";
  CHECK(shell.run("ls frames").out == listed);

  const std::string before = shell.run("ls -l --full-time frames").out;
  const Outcome refused = shell.run(line);
  CHECK(refused.code == 2);
  CHECK(says(refused.err, "--overwrite"));
  CHECK(shell.run("ls -l --full-time frames").out == before);

  CHECK(shell.run(line + " --overwrite --seed 2").code == 0);
  CHECK(shell.run("ls frames").out == listed);
  CHECK(shell.run("ls -l --full-time frames").out != before);
}

TEST_CASE("Render: without ffmpeg a film fails, names the package and leaves no file") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "program=$(command -v clatter); PATH=/nowhere\n"
      "\"$program\" render vibrated --to 1 --out film.mp4");
  CHECK(outcome.code == 1);
  CHECK(says(outcome.err, "apt install ffmpeg"));
  CHECK(shell.files().empty());
}

TEST_CASE("Render: on a full disk it fails with an error and keeps the usable frames") {
  const Shell shell;
  // A private namespace, so that the mount ends with the command. The disk has room for one
  // picture; two threads could fill it with the halves of two.
  const std::string small_disk =
      "mkdir -p small; exec unshare --mount sh -c 'mount -t tmpfs -o size=96k none small || exit "
      "77; ";
  if (shell.run(small_disk + "'").code != 0) {
    MESSAGE("skipped: only root may mount a small disk");
    return;
  }
  for (const std::string name : {"film.mp4", "picture.png", "frames"}) {
    CAPTURE(name);
    const Outcome outcome = shell.run(
        small_disk +
        "clatter render vibrated --to 20 --size 1280x720 --threads 1 --quiet --out small/" + name +
        "; code=$?; find small -type f; exit $code'");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "space"));
    CHECK(says(outcome.err, "small/" + name));
    CHECK_FALSE(says(outcome.out, "picture.png"));
    for (const std::string kept : {"film.mp4.part", "frames"}) {
      if (!kept.starts_with(name)) continue;
      CHECK(says(outcome.out, "small/" + kept));
      CHECK(says(outcome.err, "earlier pictures are in small/" + kept));
    }
  }
}

TEST_CASE("Render: an mp4 plays as far as it got when run and encoder are killed at once") {
  const Shell shell;
  shell.run(kRender +
            "--to 1e5 --out film.mp4 & pid=$!\n"
            "while [ ! -e film.mp4.part/000120.mp4 ] && kill -0 $pid; do sleep 0.1; done\n"
            "kill -9 $pid $(cat /proc/$pid/task/$pid/children)");
  CHECK(shell.files() == Files{"film.mp4.part"});
  CHECK(probe(shell, "film.mp4.part/000000.mp4") == "160,120,60\n");
  CHECK(probe(shell, "film.mp4.part/000060.mp4") == "160,120,60\n");
}

TEST_CASE("Render: a film is the same without standard streams") {
  const Shell shell;
  const std::string line = kRender + "--to 2 --out ";
  REQUIRE(shell.run(line + "film.mp4").code == 0);
  const std::string film = shell.read("film.mp4");
  for (const std::string closed : {"0<&-", "2>&-", "1>&- 2>&-", "0<&- 1>&- 2>&-"}) {
    CAPTURE(closed);
    CHECK(shell.run(line + "closed.mp4 --overwrite " + closed).code == 0);
    CHECK(shell.read("closed.mp4") == film);
  }
}

TEST_CASE("Render: a film beyond the largest file that the system allows is an error") {
  const Shell shell;
  const Outcome outcome = shell.run("ulimit -f 40; " + kRender + "--to 40 --out film.mp4");
  CHECK(outcome.code == 1);
  CHECK(says(outcome.err, "film.mp4"));
  CHECK_FALSE(std::filesystem::exists(shell.path("film.mp4")));
}

TEST_CASE("Render: a film of spheres in two parts has the pictures of one") {
  const Shell shell;
  shell.write("s.toml", R"(
      box.size = [6.0, 5.0, 4.0]
      particles = { count = 40, restitution = 0.9 }
      walls.left = { kind = "driven", drive_speed = 1.0 }
      walls.right = { kind = "static" }
      [view]
      field = "density"
      arrows = "velocity"
      trails = 0.3
      window = 0.5
      camera = [{ time = 0.0 }, { time = 2.0, azimuth = 200.0, elevation = -30.0 }])");
  const std::string film =
      "clatter render s.toml --quiet --size 64x48 --fps 5 --speed 1 --no-overlay ";
  REQUIRE(shell.run(film + "--to 2 --out whole").code == 0);
  REQUIRE(shell.run(film + "--to 1 --checkpoint c --out parts").code == 0);
  REQUIRE(shell.run(film + "--to 2 --resume c --out parts").code == 0);
  CHECK(shell.run("ls whole").out == shell.run("ls parts").out);
  CHECK(shell.run("diff -r whole parts").code == 0);
  CHECK(shell.run("cmp whole/frame_000000.png whole/frame_000008.png").code == 1);
}

}  // namespace clatter
