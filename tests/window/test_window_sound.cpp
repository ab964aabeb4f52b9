// The sound of the window. The wave device of OpenAL writes it into a file.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/support/tables.h"
#include "tests/window/gui_driver.h"

namespace clatter {

using nlohmann::json;
using testing::table_in;

namespace {

// Programs that start in its life have the wave device alone.
class WaveDevice {
 public:
  // Without a file the device cannot be opened.
  explicit WaveDevice(const Shell& shell, const std::string& file = "",
                      const std::string& options = "") {
    shell.write("openal.conf",
                "[general]\nchannels = stereo\nsample-type = int16\ndither = false\n" + options +
                    "\n[wave]\nfile = " + file + "\n");
    ::setenv("ALSOFT_DRIVERS", "wave", 1);
    ::setenv("ALSOFT_CONF", shell.path("openal.conf").c_str(), 1);
  }
  WaveDevice(const WaveDevice&) = delete;
  WaveDevice& operator=(const WaveDevice&) = delete;
  ~WaveDevice() {
    ::unsetenv("ALSOFT_DRIVERS");
    ::unsetenv("ALSOFT_CONF");
  }
};

using StereoSample = std::array<std::int16_t, 2>;

// The samples in a WAV file with two channels of 16 bits.
std::vector<StereoSample> wave_samples(const std::string& bytes) {
  const std::size_t data = bytes.find("data");
  REQUIRE(data != std::string::npos);
  std::vector<StereoSample> samples((bytes.size() - data - 8) / sizeof(StereoSample));
  std::memcpy(samples.data(), bytes.data() + data + 8, samples.size() * sizeof(StereoSample));
  return samples;
}

// Samples per second in the header of a WAV file.
std::uint32_t wave_rate(const std::string& bytes) {
  constexpr std::size_t kPlace = 24;
  std::uint32_t rate = 0;
  REQUIRE(bytes.size() > kPlace + sizeof rate);
  std::memcpy(&rate, bytes.data() + kPlace, sizeof rate);
  return rate;
}

// The numbers of the samples at which a silence of 10 ms ends.
std::vector<long> onsets_in(const std::vector<StereoSample>& samples) {
  std::vector<long> onsets;
  long silent = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool silence = samples[i] == StereoSample{};
    if (!silence && silent >= 480) onsets.push_back(static_cast<long>(i));
    silent = silence ? silent + 1 : 0;
  }
  return onsets;
}

}  // namespace

TEST_SUITE_BEGIN("display");

TEST_CASE("Window sound: the clicks are those of the run, at its speed") {
  constexpr double kSpeed = 0.3;
  const Shell files;
  files.write(
      "few.toml",
      "title = \"Few\"\nbox.size = [20, 15]\nparticles = { count = 30, restitution = 0.9 }\n"
      "walls.left = { kind = \"driven\", drive_speed = 2.0 }\n"
      "walls.right = { kind = \"static\" }\nview.speed = 0.3\n");
  REQUIRE(
      files.run("clatter measure few.toml --quiet --until 3.6 --events e.csv --out r.json").code ==
      0);
  const WaveDevice device(files, files.path("sound.wav"));
  {
    const GuiDriver driver("--sound --until 3.6 " + files.path("few.toml").string(), "640x480");
    driver.wait_for("status", 0, [](const json& status) { return status["time"] == 3.6; });
    driver.key("ctrl+q");
    CHECK(driver.exit_code() == 0);
  }
  const std::string wave = files.read("sound.wav");
  CHECK(wave_rate(wave) == 48000);
  const std::vector<long> onsets = onsets_in(wave_samples(wave));
  const json times = table_in(files.read("e.csv")).columns["time"];
  const auto sample_of = [&](std::size_t event) {
    return std::lround(times[event].get<double>() / kSpeed * 48000.0);
  };
  // Pairs of events in succession that silence precedes. A machine that is busy may delay some
  // samples, but keeps the order.
  int pairs = 0, heard = 0;
  auto after = onsets.begin();
  for (std::size_t i = 1; i + 1 < times.size(); ++i) {
    const long interval = sample_of(i + 1) - sample_of(i);
    if (sample_of(i) - sample_of(i - 1) < 7200 || interval < 7200) continue;
    ++pairs;
    const auto is_it = [&](long first, long second) {
      return std::abs(second - first - interval) <= 1;
    };
    const auto found = std::adjacent_find(after, onsets.end(), is_it);
    if (found == onsets.end()) continue;
    ++heard;
    after = found + 1;
  }
  CAPTURE(pairs);
  CHECK(pairs >= 8);
  CHECK(heard >= (pairs + 1) / 2);
}

TEST_CASE("Window sound: a collision is heard on the side of its place") {
  const Shell files;
  // A disk falls again and again, near the left edge.
  files.write("start.csv", "x,y,vx,vy\n1,8,0,0\n");
  files.write("fall.toml",
              "box.size = [20, 15]\n"
              "particles = { count = 1, restitution = 1.0, start = { layout = \"file\", file = "
              "\"start.csv\" } }\n"
              "walls.bottom = { kind = \"static\" }\nwalls.top = { kind = \"static\" }\n"
              "gravity.acceleration = [0, -1]\nview.speed = 20.0\n");
  // The model of a head would change the sides.
  const WaveDevice device(files, files.path("sound.wav"), "hrtf = true");
  {
    const GuiDriver driver("--sound --until 40 " + files.path("fall.toml").string(), "640x480");
    driver.wait_for("status", 0, [](const json& status) { return status["time"] == 40.0; });
    driver.key("ctrl+q");
    CHECK(driver.exit_code() == 0);
  }
  const std::vector<StereoSample> samples = wave_samples(files.read("sound.wav"));
  const std::vector<long> onsets = onsets_in(samples);
  CHECK(onsets.size() >= 2);
  for (const long onset : onsets) {
    std::array<double, 2> loudest = {};
    for (long i = onset; i < onset + 200 && i < static_cast<long>(samples.size()); ++i) {
      for (const int side : {0, 1}) {
        loudest[side] = std::max(loudest[side], std::fabs(1.0 * samples[i][side]));
      }
    }
    const double left = loudest[0] * loudest[0], right = loudest[1] * loudest[1];
    CHECK(right / (left + right) == doctest::Approx(0.05).epsilon(0.01));
  }
}

TEST_CASE("Window sound: it is off at first, and a key switches it") {
  const Shell files;
  const WaveDevice device(files, files.path("sound.wav"));
  const GuiDriver driver("");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 1.0; });
  CHECK(driver.events("sound").empty());
  CHECK(files.files() == std::vector<std::string>{"openal.conf"});
  driver.key("s");
  CHECK(driver.wait_for("sound")["on"] == true);
  const std::size_t told = driver.told();
  const double then = driver.wait_for("status", told)["time"];
  driver.wait_for("status", told, [&](const json& now) { return now["time"] > then + 2.0; });
  driver.click("sound");
  CHECK(driver.wait_for("sound", told)["on"] == false);
  CHECK_FALSE(onsets_in(wave_samples(files.read("sound.wav"))).empty());
}

TEST_CASE("Window sound: without a device a message says so, and it stays off") {
  const Shell files;
  const WaveDevice device(files);
  const GuiDriver driver("--sound");
  CHECK(says(driver.wait_for("message")["text"].get<std::string>(), "no device for sound"));
  CHECK(driver.events("sound").empty());
}

TEST_SUITE_END();

}  // namespace clatter
