#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/shell.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;
using nlohmann::json;

// Extreme sizes, lengths, times and numbers either run, or are an error with a reason.

namespace {

json measured(const Shell& shell, const std::string& scene_and_flags, int seconds = 60) {
  const Outcome outcome = shell.run("clatter measure " + scene_and_flags, seconds);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(outcome.out);
}

}  // namespace

// At area fraction .68: two collisions of each particle.
TEST_CASE("Sizes: 10^7 particles" * doctest::test_suite("slow") *
          doctest::description("10^7 collisions in less than 4 GB; T constant to 1e-12, overlap "
                               "below 1e-9")) {
  const Shell shell;
  const json result = measured(
      shell,
      "equilibrium --quiet --set particles.count=10000000 --set box.size=[3400,3400] "
      "--set particles.start.layout='\"lattice\"' --set measure.fields=[] --set measure.burn_in=0 "
      "--until 0.2",
      600);
  const int collisions = result.at("events").at("disk_disk");
  const double off = result.at("temperature").at("mean").get<double>() - 1.0;
  const double gigabytes = 1e-9 * result.at("performance").at("peak_memory_bytes").get<double>();
  const double overlap = result.at("checks").at("deepest_overlap");
  MESSAGE(brief(collisions), " collisions, ", brief(gigabytes), " GB, T off by ", brief(off),
          ", deepest overlap ", brief(overlap));
  CHECK(collisions > 10'000'000);
  CHECK(gigabytes < 4.0);
  CHECK(std::fabs(off) < 1e-12);
  CHECK(overlap < 1e-9);
}

TEST_CASE("Sizes: 2 * 10^9 particles" *
          doctest::description("an error with the memory required, before it is allocated, or an "
                               "error that the box is too small")) {
  const Shell shell;
  const std::string measure =
      "clatter measure equilibrium --quiet --set particles.count=2000000000 ";
  check_refused(
      shell, measure + "--set box.size=[100000,100000]",
      {"2000000000 particles take about 480 GB, and this process may use ", "choose at most "});
  check_refused(shell, measure + "--set box.size=[1000,1000]",
                {"have no place on a lattice", "at most"});
  MESSAGE("refused");
}

TEST_CASE("Sizes: boxes of 10^6 x 2 and 2 x 10^6" *
          doctest::description("runs and pictures succeed; overlap below 1e-9, including 1e-10 "
                               "from the rounding of positions")) {
  const Shell shell;
  for (const std::string size : {"[1e6,2]", "[2,1e6]"}) {
    CAPTURE(size);
    const std::string scene = "equilibrium --quiet --set box.size=" + size;
    const json result =
        measured(shell, scene +
                            " --set particles.count=100000 --set measure.burn_in=0 --until 1 "
                            "--set measure.cells=[20,20]");
    const double overlap = result.at("checks").at("deepest_overlap");
    MESSAGE(result.at("events").at("disk_disk").get<int>(), " collisions, deepest overlap ",
            brief(overlap));
    CHECK(overlap < 1e-9);
    CHECK(shell
              .run("clatter render " + scene +
                   " --set particles.count=1000 --to 1 --out a.png --overwrite")
              .code == 0);
  }
}

TEST_CASE("Sizes: pictures of 1 x 1, 16 x 16, 16384 x 64 and 64 x 16384 pixels" *
          doctest::description("drawn, or an error with the valid range of sizes")) {
  const Shell shell;
  for (const std::string size : {"1x1", "0x0", "-5x7", "16385x64", "99999999999x64"}) {
    check_refused(shell, "clatter render vibrated --to 1 --out a.png --size=" + size,
                  {"from 16x16 to 16384x16384"});
  }
  for (const std::string size : {"16x16", "16384x64", "64x16384"}) {
    CAPTURE(size);
    const Outcome outcome =
        shell.run("clatter render vibrated --quiet --to 1 --overwrite --out a.png --size=" + size);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
  }
  MESSAGE("1 x 1 refused, the others drawn");
}

TEST_CASE("Sizes: windows of 1 x 1 and 16384 x 64 pixels" *
          doctest::description("an error with the valid range of sizes, before a window opens")) {
  const Shell shell;
  check_refused(shell, "clatter view vibrated --size 1x1",
                {"is not a valid size", "from 320x240 to 16384x16384"});
  check_refused(shell, "clatter view vibrated --size 16384x64",
                {"is not a valid size", "from 320x240 to 16384x16384"});
  MESSAGE("refused");
}
