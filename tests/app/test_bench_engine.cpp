// The tables of the engine, of cores and of growth.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

#include "app/bench/cores.h"
#include "app/bench/engine.h"
#include "tests/app/printed_columns.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

TEST_CASE("Bench: the engine's table is the default, and one cell of it ends in its numbers") {
  // The memory of so few disks is within the noise of the program. A sanitizer adds memory.
  const std::regex cell(std::string(R"((?:^|\n) +100 +0\.300 +[.\d]+ +[.\d]+ +)") +
                        (is_sanitized() ? "[-\\d]+" : "-") + "\n$");
  const Shell shell;
  for (const std::string name : {"", " engine"}) {
    CAPTURE(name);
    const Outcome outcome =
        shell.run("clatter bench" + name + " --count 100 --area-fraction 0.3 --json cell.json");
    CHECK(outcome.code == 0);
    CHECK(std::regex_search(outcome.out, cell));
    const json row = json::parse(shell.read("cell.json"))[0];
    CHECK(row["count"] == 100);
    CHECK(row["area_fraction"] == 0.3);
    CHECK((is_sanitized() || row["bytes_per_disk"].is_null()));
    check_columns(outcome.out, json::array({row}), "N phi Mcoll/s setup s bytes/disk",
                  {{"count", " %.0f"},
                   {"area_fraction", " %.3f"},
                   {"million_collisions_per_cpu_second", " %.3f"},
                   {"setup_seconds", " %.3f"},
                   {"bytes_per_disk", " %.0f"}});
  }
}

TEST_CASE("Bench: the rows of the engine's table, by fraction and then by number") {
  using Cells = std::vector<EngineCell>;
  CHECK(engine_cells({}) == Cells{{1000, 0.1},
                                  {10000, 0.1},
                                  {100000, 0.1},
                                  {1000000, 0.1},
                                  {1000, 0.3},
                                  {10000, 0.3},
                                  {100000, 0.3},
                                  {1000000, 0.3},
                                  {1000, 0.5},
                                  {10000, 0.5},
                                  {100000, 0.5},
                                  {1000000, 0.5},
                                  {1000, 0.7},
                                  {10000, 0.7},
                                  {100000, 0.7},
                                  {1000000, 0.7}});
  CHECK(engine_cells({.dimension = 3, .volume_fraction = {}}) == Cells{{1372, 0.1},
                                                                       {10976, 0.1},
                                                                       {87808, 0.1},
                                                                       {1000000, 0.1},
                                                                       {1372, 0.3},
                                                                       {10976, 0.3},
                                                                       {87808, 0.3},
                                                                       {1000000, 0.3},
                                                                       {1372, 0.49},
                                                                       {10976, 0.49},
                                                                       {87808, 0.49},
                                                                       {1000000, 0.49}});
  CHECK(engine_cells({.count = 50, .area_fraction = 0.2, .volume_fraction = {}}) ==
        Cells{{50, 0.2}});
  CHECK(engine_cells({.count = 50, .volume_fraction = 0.3}) == Cells{{50, 0.3}});
}

TEST_CASE("Bench: a cell of the engine's table for spheres, with its memory") {
  const Shell shell;
  const Outcome outcome =
      shell.run("clatter bench engine --count 100000 --volume-fraction 0.2 --json cell.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.starts_with("elastic spheres, periodic box"));
  const json rows = json::parse(shell.read("cell.json"));
  REQUIRE(rows.size() == 1);
  check_columns(outcome.out, rows, "N phi Mcoll/s setup s bytes/sph.",
                {{"count", " %.0f"},
                 {"volume_fraction", " %.3f"},
                 {"million_collisions_per_cpu_second", " %.3f"},
                 {"setup_seconds", " %.3f"},
                 {"bytes_per_sphere", " %.0f"}});
  CHECK(rows[0]["count"] == 100'000);
  CHECK(rows[0]["volume_fraction"] == 0.2);
  CHECK(rows[0]["setup_seconds"] > 1e-3);
  if (!is_sanitized()) {
    CHECK(rows[0]["bytes_per_sphere"] > 200.0);
    CHECK(rows[0]["bytes_per_sphere"] < 500.0);
  }
}

TEST_CASE("Bench: a cell of the table of cores has the gas as a whole and in tiles") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter bench cores --count 100000 --area-fraction 0.25 --threads 3 --json cores.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.starts_with("elastic disks, periodic box"));
  const json rows = json::parse(shell.read("cores.json"));
  std::vector<int> threads;
  for (const json& row : rows) {
    threads.push_back(row["threads"]);
    CHECK(row["count"] == 100'000);
    CHECK(row["area_fraction"] == 0.25);
    const double rate = row["million_collisions_per_second"],
                 whole = rows[0]["million_collisions_per_second"];
    CHECK(rate > 0.0);
    CHECK(row["of_whole"].get<double>() == doctest::Approx(rate / whole).epsilon(1e-6));
    const bool tiles = row["threads"] > 0;
    if (!tiles) CHECK(row["busy"] == 1.0);
    CHECK((row["redundant"] > 0.0) == tiles);
    CHECK(row["redone"] < 0.5);
    // Halos are copied in each window, and windows are rarely run again.
    if (tiles) CHECK(row["redundant"] > row["redone"]);
    CHECK(row["busy"] <= 1.1);
  }
  CHECK(threads == std::vector<int>{0, 1, 2, 3});
  // One thread and three threads have the same tiles, so the same work. Only the times differ.
  for (const char* share : {"redundant", "redone"}) CHECK(rows[1][share] == rows[3][share]);
  CHECK(rows[1]["busy"] != rows[3]["busy"]);
  CHECK(std::regex_search(outcome.out, std::regex("\n +100000 +0\\.250 +whole ")));
  check_columns(outcome.out, rows, "N phi threads Mcoll/s of whole busy redundant redone",
                {{"million_collisions_per_second", " %.3f"},
                 {"of_whole", " %.2f"},
                 {"busy", " %.2f"},
                 {"redundant", " %.2f"},
                 {"redone", " %.3f"}});
  check_refused(shell, "clatter bench cores --count 2 --area-fraction 0.9",
                {"--area-fraction",
                 "no square box holds this number of disks at this fraction; choose a "
                 "smaller fraction, or another --count"});
}

TEST_CASE("Bench: the table of cores has large gases, up to the number asked for") {
  using Cells = std::vector<EngineCell>;
  const auto cells = [](int dimension, int count) {
    return cores_cells({.dimension = dimension, .count = count});
  };
  const Cells disks = {{100'000, 0.1}, {100'000, 0.3}, {100'000, 0.5}, {100'000, 0.7}};
  CHECK(cells(2, 100'000) == disks);
  CHECK(cells(3, 999'999) ==
        Cells{{100'000, 0.1}, {100'000, 0.3}, {100'000, 0.45}, {100'000, 0.7}});
  const Cells all = cells(2, 0);
  REQUIRE(all.size() == 12);
  for (std::size_t k = 0; k < all.size(); ++k) {
    CHECK(all[k].first == (k < 4 ? 1e5 : k < 8 ? 1e6 : 1e7));
    CHECK(all[k].second == disks[k % 4].second);
  }
}

TEST_CASE("Bench: the plot of cores has the rates of each gas over the threads") {
  const Plot plot = cores_plot(2, {{.count = 100, .fraction = 0.3, .rate = 2.346},
                                   {.count = 100, .fraction = 0.3, .threads = 1, .rate = 1.5},
                                   {.count = 7000, .fraction = 0.7, .rate = 2.0}});
  CHECK(plot.title == "Collision rate on several threads");
  CHECK(plot.caption ==
        "Elastic disks in a periodic box; the smallest number of threads: the gas as a whole");
  CHECK(plot.x_name == "threads");
  CHECK(plot.y_name == "million collisions per second");
  CHECK(says(cores_plot(3, {}).caption, "Elastic spheres in"));
  REQUIRE(plot.panels.size() == 2);
  CHECK(plot.panels[0].title == "N = 100, phi = 0.3");
  CHECK(plot.panels[1].title == "N = 7000, phi = 0.7");
  REQUIRE(plot.panels[0].points.size() == 2);
  CHECK(plot.panels[1].points.size() == 1);
  const PlotPoint &whole = plot.panels[0].points[0], &tiles = plot.panels[0].points[1];
  CHECK(whole.x == 0.5);
  CHECK(whole.y == 2.346);
  CHECK(whole.label == "2.35");
  CHECK(tiles.x == 1.0);
  CHECK(tiles.y == 1.5);
}

TEST_CASE("Bench: the plot of growth has the rates of each fraction over the number") {
  const Plot plot = growth_plot({{.count = 100, .fraction = 0.1, .rate = 2.346},
                                 {.count = 1000, .fraction = 0.1, .rate = 2.0},
                                 {.count = 100, .fraction = 0.7, .rate = 1.5}});
  CHECK(plot.title == "Collision rate of the engine");
  CHECK(plot.caption == "Elastic disks in a periodic box, one core, by area fraction phi");
  CHECK(plot.x_name == "number of disks");
  CHECK(plot.y_name == "million collisions per CPU second");
  REQUIRE(plot.panels.size() == 2);
  CHECK(plot.panels[0].title == "phi = 0.1");
  CHECK(plot.panels[1].title == "phi = 0.7");
  REQUIRE(plot.panels[0].points.size() == 2);
  CHECK(plot.panels[1].points.size() == 1);
  const PlotPoint& first = plot.panels[0].points[0];
  CHECK(first.x == 100.0);
  CHECK(first.y == 2.346);
  CHECK(first.label == "2.35");
}

TEST_CASE("Bench: a fraction that no box holds is refused under the flag that gave it") {
  const Shell shell;
  for (const std::string flag : {"--area-fraction 0.9", "--volume-fraction 0.74"}) {
    CAPTURE(flag);
    const Outcome outcome = shell.run("clatter bench engine --count 10 " + flag);
    CHECK(outcome.code == 2);
    CHECK(says(outcome.err, flag.substr(0, flag.find(' ')) +
                                ": no square or cubic box holds this number of particles"));
    CHECK(says(outcome.err, "choose a smaller fraction, or another --count"));
  }
}

TEST_CASE("Bench: the cells of the table of growth, by fraction and then by number") {
  std::vector<EngineCell> cells;
  for (const double phi : {0.01, 0.1, 0.3, 0.5, 0.7, 0.88}) {
    for (int count = 100; count <= 100'000; count *= 10) {
      // The boxes of 100 and of 1000 disks at 0.88 hold 90 and 986 disks in whole hexagonal rows.
      if (phi < 0.8 || count > 1000) cells.emplace_back(count, phi);
    }
    if (phi == 0.5) cells.insert(cells.end(), {{1'000'000, phi}, {4'000'000, phi}});
  }
  CHECK(growth_cells(0) == cells);
  std::erase_if(cells, [](const EngineCell& cell) { return cell.first > 1000; });
  CHECK(growth_cells(1000) == cells);
}

TEST_CASE("Bench: the table of growth has the numbers and fractions of its limit" *
          doctest::test_suite("slow")) {
  const Shell shell;
  const Outcome outcome =
      shell.run("clatter bench growth --count 100 --json t.json --plot growth.png", 600);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json rows = json::parse(shell.read("t.json"));
  std::vector<double> fractions;
  for (const json& row : rows) {
    if (!row.contains("gas")) {
      CHECK(row["count"] == 100);
      fractions.push_back(row["area_fraction"]);
    }
  }
  CHECK(fractions == std::vector{0.01, 0.1, 0.3, 0.5, 0.7});
  REQUIRE(rows.size() == fractions.size() + 2);
  const std::string table = outcome.out.substr(outcome.out.find("gas "));
  const json gases = json::array({rows[5], rows[6]});
  check_columns(table, gases, "gas N phi Mcoll/s of homog.",
                {{"count", " %.0f"},
                 {"area_fraction", " %.3f"},
                 {"million_collisions_per_cpu_second", " %.3f"},
                 {"of_homogeneous", " %.2f"}});
  for (const json& row : gases) {
    CHECK(row["count"] == 20'000);
    CHECK(row["area_fraction"].get<double>() == doctest::Approx(0.1).epsilon(1e-12));
  }
  CHECK(gases[0]["gas"] == "cooled into clusters");
  CHECK(gases[1]["gas"] == "collapsed under gravity");
  CHECK(shell.read("growth.png").starts_with("\x89PNG"));
}

TEST_CASE("Bench: one gas with clusters cools, the other falls on a floor") {
  const std::vector<Inhomogeneous> gases = inhomogeneous_gases(5000);
  REQUIRE(gases.size() == 2);
  for (const Inhomogeneous& gas : gases) {
    const Scene& scene = gas.scene;
    const bool falls = gas.name == std::string("collapsed under gravity");
    CAPTURE(gas.name);
    CHECK(scene.particles.count == 5000);
    const double area = scene.box[0] * scene.box[1];
    CHECK(5000 * 0.25 * std::numbers::pi / area == doctest::Approx(0.1).epsilon(1e-12));
    CHECK(scene.gravity.has_value() == falls);
    if (falls) CHECK((*scene.gravity)[1] == -0.2);
    CHECK(scene.particles.restitution == (falls ? 0.9 : 0.6));
    CHECK(scene.contact_time == 1e-6);
    CHECK(scene.walls[kBottom].has_value() == falls);
    CHECK(scene.walls[kTop].has_value() == falls);
    if (falls) CHECK(scene.walls[kBottom]->restitution == 0.9);
    if (falls) CHECK(scene.walls[kTop]->restitution == 1.0);
  }
}

}  // namespace clatter
