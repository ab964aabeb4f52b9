// The sound of films, with the command line.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/app/film_scene.h"
#include "tests/support/tables.h"

namespace clatter {

using testing::table_in;

namespace {

using StereoSample = std::array<std::int16_t, 2>;

// The samples of a WAV file with a header of 44 bytes.
std::vector<StereoSample> samples_in(const std::string& bytes) {
  REQUIRE(bytes.size() > 44);
  CHECK(bytes.substr(0, 4) == "RIFF");
  std::vector<StereoSample> samples((bytes.size() - 44) / sizeof(StereoSample));
  std::memcpy(samples.data(), bytes.data() + 44, samples.size() * sizeof(StereoSample));
  return samples;
}

// A collision of an event log as a film has it.
struct ExpectedClick {
  long sample;
  double place;  // 0: left, 1: right
  double energy;
};

constexpr double kFewFrom = 1.0, kFewSpeed = 0.2, kFewLength = 20.0;  // film and box of few.toml

void write_few(const Shell& shell) {
  shell.write(
      "few.toml",
      "title = \"Few\"\nbox.size = [20, 15]\nparticles = { count = 10, restitution = 0.9 }\n"
      "walls.left = { kind = \"sinusoidal\", stroke = 0.2, frequency = 1.0 }\n"
      "walls.right = { kind = \"static\" }\n"
      "[[change]]\ntime = 6.0\nset = { \"particles.restitution\" = 0.7 }\n");
}

// The sound of a film of few.toml up to t = 30, at 7 frames a second.
std::vector<StereoSample> sound_of_few(const Shell& shell, const std::string& flags) {
  const Outcome film = shell.run(
      "clatter render few.toml --seed 3 --quiet --fps 7 --from 1 --to 30 "
      "--speed 0.2 --sound --out d " +
      flags);
  CAPTURE(film.err);
  REQUIRE(film.code == 0);
  return samples_in(shell.read("d/sound.wav"));
}

// The collisions of few.toml with a setting, from its event log. The gas is in the part of the
// picture from `left`, of a width in units of the whole one.
std::vector<ExpectedClick> expected_clicks(const Shell& shell, const std::string& setting,
                                           double left, double width) {
  REQUIRE(shell
              .run("rm -f e.csv r.json && clatter measure few.toml --seed 3 --quiet --until 30 "
                   "--events e.csv --out r.json --set " +
                   setting)
              .code == 0);
  const nlohmann::json log = table_in(shell.read("e.csv")).columns;
  std::vector<ExpectedClick> clicks;
  for (std::size_t i = 0; i < log["time"].size(); ++i) {
    const double time = log["time"][i];
    const bool wall = log["partner_position_x"][i].is_null();
    const double x = log["position_x"][i];
    const double contact = wall ? x : 0.5 * (x + log["partner_position_x"][i].get<double>());
    const double impulse =
        std::hypot(log["impulse_x"][i].get<double>(), log["impulse_y"][i].get<double>());
    if (time < kFewFrom) continue;
    clicks.push_back({static_cast<long>(std::floor((time - kFewFrom) / kFewSpeed * 48000)),
                      left + width * contact / kFewLength, impulse * impulse / (wall ? 8.0 : 4.0)});
  }
  return clicks;
}

// Checks the clicks that no other click precedes within a third of a second.
void check_heard(const std::vector<StereoSample>& samples, std::vector<ExpectedClick> clicks) {
  std::ranges::sort(clicks, {}, &ExpectedClick::sample);
  long last = -48000;
  int heard = 0;
  std::vector<double> loudness;
  for (const ExpectedClick& click : clicks) {
    const bool apart = click.sample - last > 16000;
    last = click.sample;
    if (!apart || click.sample + 10 > static_cast<long>(samples.size())) continue;
    CAPTURE(click.sample);
    // Silence before the onset.
    const auto begin = samples.begin() + std::max(0L, click.sample - 4800);
    const auto onset = std::find_if(
        begin, samples.end(), [](const StereoSample& sample) { return sample != StereoSample{}; });
    CHECK(std::abs(onset - samples.begin() - click.sample) <= 1);
    const double left = (*onset)[0], right = (*onset)[1];
    CHECK(right * right / (left * left + right * right) ==
          doctest::Approx(click.place).epsilon(0.03));
    loudness.push_back((left * left + right * right) / click.energy);
    ++heard;
  }
  CHECK(heard >= 10);
  CHECK(*std::ranges::max_element(loudness) / *std::ranges::min_element(loudness) < 1.02);
}

// 150 frames, in three pieces. The laws change at t = 4.
const std::string kSoundFilm =
    "clatter render scene.toml --size 64x48 --fps 10 --quiet --speed 1 --sound ";

void write_sound_scene(const Shell& shell) {
  write_film_scene(shell, "", "[[change]]\ntime = 4.0\nset = { \"walls.left.stroke\" = 1.0 }\n");
}

}  // namespace

TEST_CASE("Film sound: a click is heard at the sample, on the side and as loud as its collision") {
  const Shell shell;
  write_few(shell);
  const std::vector<StereoSample> samples = sound_of_few(shell, "--size 64x48");
  CHECK(samples.size() == 145 * 48000);
  check_heard(samples, expected_clicks(shell, "particles.restitution=0.9", 0.0, 1.0));
}

TEST_CASE("Film sound: gases beside each other and plots are heard from the sides of their cells") {
  const Shell shell;
  write_few(shell);
  const std::vector<StereoSample> samples = sound_of_few(
      shell, "--compare particles.count=7 --size 240x90 --set 'view.plots=[\"energy\"]'");
  std::vector<ExpectedClick> clicks = expected_clicks(shell, "particles.count=10", 0.0, 0.5);
  for (const ExpectedClick& click : expected_clicks(shell, "particles.count=7", 0.5, 0.5)) {
    clicks.push_back(click);
  }
  check_heard(samples, clicks);
}

TEST_CASE(
    "Film sound: each format has an audio stream as long as the film, and pictures as before") {
  const Shell shell;
  write_sound_scene(shell);
  const auto pictures = [&](const std::string& name) {
    return shell.run("ffmpeg -v error -i " + name + " -map 0:v -f framemd5 - | grep -v '#'").out;
  };
  for (const std::string name : {"v.mp4", "v.webm", "v.mkv"}) {
    CAPTURE(name);
    const Outcome film = shell.run(kSoundFilm + "--to 15 --out " + name);
    CAPTURE(film.err);
    REQUIRE(film.code == 0);
    CHECK(shell
              .run("ffprobe -v error -select_streams a -show_entries stream=sample_rate,channels "
                   "-of csv=p=0 " +
                   name)
              .out == "48000,2\n");
    const std::string decoded = shell.run("ffmpeg -v error -i " + name + " -f s16le - | wc -c").out;
    CHECK(std::abs(std::stod(decoded) / (4 * 48000) - 15.0) < 0.05);
    CHECK(
        shell.run(kSoundFilm.substr(0, kSoundFilm.find("--sound")) + "--to 15 --out silent-" + name)
            .code == 0);
    CHECK(shell.run("ffprobe -v error -show_entries stream=codec_type -of csv=p=0 silent-" + name)
              .out == "video\n");
    const std::string with = pictures(name);
    CHECK(std::ranges::count(with, '\n') == 150);
    CHECK((with == pictures("silent-" + name)));
  }
  // FLAC is lossless.
  REQUIRE(shell.run(kSoundFilm + "--to 15 --out d").code == 0);
  CHECK(shell
            .run("ffmpeg -v error -i v.mkv -f s16le mkv.raw && tail -c +45 d/sound.wav | "
                 "cmp - mkv.raw")
            .code == 0);
}

TEST_CASE("Film sound: a film with sound that was killed is resumed to the same bytes") {
  const Shell shell;
  write_sound_scene(shell);
  for (const std::string out : {"film.mp4", "film"}) {
    CAPTURE(out);
    const std::string line = kSoundFilm + "--to 15 --out " + out + " ";
    REQUIRE(shell.run(line + "&& mv " + out + " kept").code == 0);
    for (const std::string number : {"20", "70", "130"}) {
      CAPTURE(number);
      // The run is killed as soon as this file exists, later than its first checkpoint.
      const std::string seen =
          out == "film" ? "film/frame_000" + std::string(3 - number.size(), '0') + number + ".png"
                        : "film.mp4.part/000060.mp4";
      shell.run(line + "--checkpoint c --checkpoint-every 0.01 & pid=$!\nuntil [ -e " + seen +
                " -a -e c ] || ! kill -0 $pid; do :; done; kill -9 $pid; wait $pid");
      // The kill may come while the checkpoint is replaced.
      REQUIRE(shell.run("[ -e c ] || mv c.previous c").code == 0);
      const Outcome outcome = shell.run(line + "--resume c");
      CAPTURE(outcome.err);
      CHECK(outcome.code == 0);
      CHECK(outcome.err.empty());  // not drawn again from the beginning
      // Unfinished pictures of a killed run stay, with names that begin with a dot.
      CHECK(shell.run("diff -r -x '.*' " + out + " kept").code == 0);
      shell.run("rm -rf " + out + " " + out + ".part c c.previous");
    }
    shell.run("rm -rf kept");
  }
}

TEST_CASE("Film sound: a film that is continued for longer has the sound of one long film") {
  const Shell shell;
  write_sound_scene(shell);
  REQUIRE(shell.run(kSoundFilm + "--to 15 --out long").code == 0);
  REQUIRE(shell.run(kSoundFilm + "--to 7 --out film --checkpoint c").code == 0);
  CHECK(samples_in(shell.read("film/sound.wav")).size() == 7 * 48000);
  const Outcome outcome =
      shell.run("clatter render scene.toml --quiet --resume c --to 15 --out film");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());  // not drawn again from the beginning
  CHECK(shell.run("cmp film/sound.wav long/sound.wav").code == 0);
}

TEST_CASE("Film sound: a resumed film whose sound was changed is drawn again") {
  const Shell shell;
  write_sound_scene(shell);
  REQUIRE(shell.run(kSoundFilm + "--to 7 --out film --checkpoint c && cp -r film kept").code == 0);
  shell.run("printf 'xx' | dd of=film/sound.wav bs=1 seek=100000 conv=notrunc 2> /dev/null");
  REQUIRE(shell.run("cmp film/sound.wav kept/sound.wav").code == 1);
  const Outcome outcome = shell.run("clatter render scene.toml --resume c --to 7 --out film");
  CHECK(outcome.code == 0);
  CHECK(says(outcome.err, "is not the sound of the film"));
  CHECK(shell.run("cmp film/sound.wav kept/sound.wav").code == 0);
}

TEST_CASE("Film sound: sound that a film cannot have is refused") {
  const Shell shell;
  write_sound_scene(shell);
  const std::string line = "clatter render scene.toml --size 64x48 --sound ";
  check_refused(shell, line + "--out a.gif", {"--sound", "a GIF has no sound"});
  check_refused(shell, line + "--out a.png", {"--sound", "one picture has no sound"});
  for (const std::string part : {"--frames 0:5", "--slurm 2", "--join ."}) {
    check_refused(shell, line + "--out a.mp4 " + part, {"--sound", "made in parts", "--frames"});
  }
  check_refused(shell, line + "--fps 1 --to 30000 --speed 1 --out a.mp4", {"--sound", "6 hours"});
  REQUIRE(shell
              .run("clatter render scene.toml --quiet --size 64x48 --fps 10 --to 0.5 --speed 1 "
                   "--out d --checkpoint c")
              .code == 0);
  check_refused(shell, "clatter render scene.toml --resume c --to 1 --out d --sound",
                {"--sound", "the film of the checkpoint has no sound"});
  // The sound of another film is not replaced unless asked.
  REQUIRE(shell.run("mkdir e && echo > e/sound.wav").code == 0);
  check_refused(shell, line + "--quiet --fps 10 --to 0.5 --speed 1 --out e",
                {"sound.wav", "--overwrite"});
  CHECK(shell.run(line + "--quiet --fps 10 --to 0.5 --speed 1 --out e --overwrite").code == 0);
}

}  // namespace clatter
