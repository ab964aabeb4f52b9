#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "app/sweep/refinement.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;
using testing::refusal_of;
using testing::TemporaryFolder;

namespace {

// A refined sweep of some axes.
std::string refined(int budget, const std::string& axes, const std::string& head = "") {
  return "scene = \"vibrated\"\nrefine = true\nbudget = " + std::to_string(budget) + "\n" + head +
         "[axes]\n" + axes;
}

const std::string kLinear = "\"particles.restitution\" = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]\n";

using Texts = std::set<std::string>;

double setting(const SweepPoint& point, const std::string& key) {
  for (const Override& one : point) {
    if (one.key == key) return std::stod(one.value);
  }
  FAIL("no setting " << key);
  return 0.0;
}

struct Mean {
  double mean = 0.0;
  double error = 0.0;
};

void write_result(const SweepFolder& folder, const SweepRun& run, const Mean& mean) {
  const json result = {{"program", "clatter"},
                       {"seed", run.seed},
                       {"state_hash", "0"},
                       {"time", {{"measured", 1.0}}},
                       {"temperature", {{"mean", mean.mean}, {"standard_error", mean.error}}}};
  testing::write_bytes(folder.result(run.id), result.dump());
}

// The folder of a sweep without measurements. Its results are written by the test.
class MadeSweep {
 public:
  explicit MadeSweep(const std::string& text)
      : folder_(SweepFolder::make(text, "s.toml", temporary_ / "d")) {}

  // Writes the result of each run without one, with the temperature of its settings.
  void measure(const std::function<Mean(const SweepPoint&)>& temperature) const {
    for (const SweepRun& run : folder_.runs()) {
      if (std::filesystem::exists(folder_.result(run.id))) continue;
      write_result(folder_, run, temperature(run.settings));
    }
  }

  // The texts of the next points.
  std::vector<std::string> next() const {
    std::vector<std::string> texts;
    for (const SweepPoint& point : refined_points(folder_, folder_.sweep())) {
      texts.push_back(settings_text(point));
    }
    return texts;
  }

  // The texts of the first two of the next four points.
  Texts next_two() const {
    const std::vector<std::string> texts = next();
    REQUIRE(texts.size() == 4);
    return {texts.begin(), texts.begin() + 2};
  }

  // Measures and refines until the end of the refinement. Returns all points.
  std::vector<SweepPoint> finish(const std::function<Mean(const SweepPoint&)>& temperature) const {
    const Sweep sweep = folder_.sweep();
    for (int round = 0; round < 100; ++round) {
      measure(temperature);
      const auto points = refined_points(folder_, sweep);
      if (points.empty()) break;
      folder_.add(points, sweep.seeds);
    }
    std::vector<SweepPoint> all;
    for (const SweepRun& run : folder_.runs()) all.push_back(run.settings);
    return all;
  }

  const SweepFolder& folder() const { return folder_; }

 private:
  TemporaryFolder temporary_;
  SweepFolder folder_;
};

}  // namespace

TEST_CASE("Refinement: new points are where the curve bends") {
  const MadeSweep sweep(refined(50, kLinear));
  // A kink at 0.4: the curvature is not zero only in the two intervals beside it.
  sweep.measure([](const SweepPoint& point) {
    return Mean{std::fabs(setting(point, "particles.restitution") - 0.4), 1e-6};
  });
  CHECK(sweep.next_two() == Texts{"particles.restitution=0.35", "particles.restitution=0.45"});
  // The choice depends on the results only.
  CHECK(sweep.next() == sweep.next());
  // A bend of the same second derivative counts more in a wider interval.
  const MadeSweep uneven(refined(50, "\"particles.restitution\" = [0.1, 0.2, 0.3, 0.5, 0.7]\n"));
  uneven.measure([](const SweepPoint& point) {
    const double x = setting(point, "particles.restitution");
    return Mean{x * x, 0.0};
  });
  CHECK(uneven.next_two() == Texts{"particles.restitution=0.4", "particles.restitution=0.6"});
}

TEST_CASE("Refinement: new points of a straight line are where its errors are largest") {
  const MadeSweep sweep(refined(50, kLinear));
  sweep.measure([](const SweepPoint& point) {
    const double x = setting(point, "particles.restitution");
    return Mean{3.0 * x, x > 0.15 && x < 0.25 ? 0.2 : 0.01};
  });
  CHECK(sweep.next_two() == Texts{"particles.restitution=0.15", "particles.restitution=0.25"});
}

TEST_CASE("Refinement: the middle on a logarithmic axis is the geometric mean") {
  const MadeSweep sweep(refined(
      5, "\"walls.left.drive_speed\" = { from = 0.01, to = 1.0, count = 3, scale = \"log\" }\n"));
  // Linear in the logarithm, with the larger errors at the upper end.
  sweep.measure([](const SweepPoint& point) {
    const double x = setting(point, "walls.left.drive_speed");
    return Mean{std::log(x), x};
  });
  const auto points = refined_points(sweep.folder(), sweep.folder().sweep());
  REQUIRE(points.size() == 2);
  CHECK(setting(points[0], "walls.left.drive_speed") == doctest::Approx(std::sqrt(0.1)));
  CHECK(setting(points[1], "walls.left.drive_speed") == doctest::Approx(std::sqrt(0.001)));
}

TEST_CASE("Refinement: whole numbers stay whole, and no point occurs twice") {
  const auto measured = [](const SweepPoint& point) {
    return Mean{1.0 / setting(point, "particles.count"), 1e-3};
  };
  for (const char* axis : {"[10, 13, 20]", "{ from = 10, to = 20, count = 3, scale = \"log\" }"}) {
    CAPTURE(axis);
    const MadeSweep sweep(
        refined(50, std::string("\"particles.count\" = ") + axis + '\n', "replicas = 2\n"));
    std::vector<std::string> counts;
    for (const SweepPoint& point : sweep.finish(measured)) counts.push_back(point.front().value);
    std::ranges::sort(counts);
    // At the end, all whole numbers between the ends are measured, each with two seeds.
    std::vector<std::string> all;
    for (int count = 10; count <= 20; ++count) all.insert(all.end(), 2, std::to_string(count));
    CHECK(counts == all);
  }
}

TEST_CASE("Refinement: the middle of -1 and 0 is not a second 0") {
  const MadeSweep sweep(R"(scene = "rough_driven"
refine = true
budget = 9
[set]
"view.colour_by" = "speed"
[axes]
"particles.tangential_restitution" = [-1, 0, 1]
)");
  const auto points = sweep.finish([](const SweepPoint& point) {
    return Mean{std::fabs(setting(point, "particles.tangential_restitution")), 0.1};
  });
  CHECK(points.size() == 3);
}

TEST_CASE("Refinement: the sweep ends at its budget of points, of all curves together") {
  const auto runs_of = [](int budget) {
    const std::string axes =
        "\"particles.restitution\" = [0.5, 0.6, 0.7]\n\"particles.count\" = [20, 30]\n";
    return MadeSweep(refined(budget, axes, "replicas = 3\n"))
        .finish([](const SweepPoint& point) {
          return Mean{std::exp(setting(point, "particles.restitution")), 0.01};
        })
        .size();
  };
  CHECK(runs_of(6) == 3 * 6);
  CHECK(runs_of(2) == 3 * 6);
  CHECK(runs_of(8) == 3 * 8);
  CHECK(runs_of(15) == 3 * 15);
}

TEST_CASE("Refinement: other axes have separate curves") {
  const MadeSweep sweep(refined(50,
                                "\"particles.restitution\" = [0.1, 0.2, 0.3, 0.4, 0.5]\n"
                                "\"particles.count\" = [20, 30]\n"));
  // Two straight lines of different height are no kinks. One of them has a kink at 0.4.
  sweep.measure([](const SweepPoint& point) {
    const double x = setting(point, "particles.restitution");
    return setting(point, "particles.count") == 20.0 ? Mean{5.0 + x, 1e-6}
                                                     : Mean{std::fabs(x - 0.4), 1e-6};
  });
  CHECK(sweep.next_two() == Texts{"particles.restitution=0.35 particles.count=30",
                                  "particles.restitution=0.45 particles.count=30"});
}

TEST_CASE("Refinement: the first axis of the file is refined, in any order of the manifest") {
  const std::string restitutions = "\"particles.restitution\" = [0.1, 0.2, 0.3]\n";
  const TemporaryFolder temporary;
  SweepFolder::make(refined(7, restitutions + "\"particles.count\" = [20, 30]\n"), "s.toml",
                    temporary / "d");
  // A longer file with the other order continues the same sweep.
  const SweepFolder folder =
      SweepFolder::make(refined(10, "\"particles.count\" = [20, 30, 40]\n" + restitutions),
                        "s.toml", temporary / "d");
  REQUIRE(folder.runs().size() == 9);
  for (const SweepRun& run : folder.runs()) {
    // Linear in both, with the largest errors between 30 and 40 at restitution 0.3.
    const double count = setting(run.settings, "particles.count");
    const double restitution = setting(run.settings, "particles.restitution");
    const bool uncertain = count > 25.0 && restitution > 0.25;
    write_result(folder, run, {count, uncertain ? 1.0 : 0.1});
  }
  const auto points = refined_points(folder, folder.sweep());
  REQUIRE(points.size() == 1);
  CHECK(points[0].size() == 2);
  CHECK(setting(points[0], "particles.count") == 35.0);
  CHECK(setting(points[0], "particles.restitution") == 0.3);
}

TEST_CASE("Refinement: a point without the mean of the goal is omitted and listed") {
  const MadeSweep sweep(refined(9, "\"particles.restitution\" = [0.1, 0.2, 0.3, 0.4]\n"));
  sweep.measure([](const SweepPoint&) { return Mean{1.0, 0.1}; });
  // As a result of a cooled gas, without a temperature.
  const auto file = sweep.folder().result(2);
  json result = json::parse(testing::bytes_of(file));
  result.erase("temperature");
  testing::write_bytes(file, result.dump());
  // The middle of 0.1 and 0.3 is the omitted point.
  CHECK(sweep.next() == std::vector<std::string>{"particles.restitution=0.35"});
  const auto omitted = points_without_goal(sweep.folder(), sweep.folder().sweep());
  REQUIRE(omitted.size() == 1);
  CHECK(settings_text(omitted[0]) == "particles.restitution=0.2");
}

TEST_CASE("Refinement: results without the mean of the goal are refused") {
  const MadeSweep sweep(refined(9, "\"particles.restitution\" = [0.5, 0.6, 0.7]\n",
                                "accuracy = \"5%\"\naccuracy_of = \"pressure.left\"\n"));
  sweep.measure([](const SweepPoint&) { return Mean{1.0, 0.1}; });
  CHECK(says(refusal_of([&] { sweep.next(); }), "no mean 'pressure.left'"));
}

TEST_CASE("Refinement: the points do not depend on the number of threads or on interrupts") {
  const Shell shell;
  shell.write("s.toml", R"(scene = "vibrated"
refine = true
budget = 12
replicas = 2
[set]
"measure.burn_in" = 5.0
"measure.duration" = 2000.0
"measure.fields" = []
[axes]
"particles.restitution" = [0.6, 0.8, 0.95]
"particles.count" = [20, 30]
)");
  const Outcome one = shell.run("clatter sweep s.toml --out one --threads 1 --quiet");
  CAPTURE(one.err);
  REQUIRE(one.code == 0);
  const std::string manifest = shell.read("one/manifest.jsonl");
  CHECK(std::ranges::count(manifest, '\n') == 24);
  REQUIRE(shell.run("clatter sweep s.toml --out two --threads 2 --quiet").code == 0);
  CHECK(shell.read("two/manifest.jsonl") == manifest);
  // Interrupts at different times, then to the end.
  for (const char* seconds : {"0.2", "0.5"}) {
    shell.run(std::string("timeout -s INT ") + seconds +
              " clatter sweep s.toml --out cut --threads 2 --quiet");
  }
  const Outcome end = shell.run("clatter sweep s.toml --out cut --threads 2 --quiet");
  CAPTURE(end.err);
  CHECK(end.code == 0);
  CHECK(shell.read("cut/manifest.jsonl") == manifest);
  const Outcome tables = shell.run(
      "for f in one two cut; do clatter sweep collect $f; done; cmp one/table.csv two/table.csv "
      "&& cmp one/table.csv cut/table.csv");
  CHECK(tables.code == 0);
  // A finished sweep adds nothing.
  CHECK(shell.run("clatter sweep s.toml --out one --quiet").code == 0);
  CHECK(shell.read("one/manifest.jsonl") == manifest);
}

}  // namespace clatter
