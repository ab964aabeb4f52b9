// The sound of the window. The wave device of OpenAL writes it into a file.

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "tests/app/gui_driver.h"
#include "tests/app/tables.h"

namespace clatter {

using nlohmann::json;
using testing::table_in;

namespace {

// Programs that start in its life have the wave device alone.
class WaveDevice {
 public:
  // Without a file the device cannot be opened.
  explicit WaveDevice(const Shell& shell, const std::string& file = "") {
    shell.write("openal.conf",
                "[general]\nchannels = stereo\nsample-type = int16\nfrequency = 48000\n"
                "dither = false\n[wave]\nfile = " +
                    file + "\n");
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

// The samples in a WAV file with two channels of 16 bits at which a silence of 10 ms ends.
std::vector<long> wave_onsets(const std::string& bytes) {
  const std::size_t data = bytes.find("data");
  REQUIRE(data != std::string::npos);
  std::vector<std::uint32_t> samples((bytes.size() - data - 8) / 4);
  std::memcpy(samples.data(), bytes.data() + data + 8, 4 * samples.size());
  std::vector<long> onsets;
  long silent = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i] != 0 && silent >= 480) onsets.push_back(static_cast<long>(i));
    silent = samples[i] == 0 ? silent + 1 : 0;
  }
  return onsets;
}

}  // namespace

TEST_SUITE_BEGIN("window");

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
  const std::vector<long> onsets = wave_onsets(files.read("sound.wav"));
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
  CHECK_FALSE(wave_onsets(files.read("sound.wav")).empty());
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
