// The tables of the engine, of cores and of growth.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/printed_columns.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

// The columns of disks.
static void check_columns_of_disks(const std::string& printed, const json& rows) {
  check_columns(printed, rows, "N phi Mcoll/s setup s bytes/disk",
                {{"count", " %.0f"},
                 {"area_fraction", " %.3f"},
                 {"million_collisions_per_cpu_second", " %.3f"},
                 {"setup_seconds", " %.3f"},
                 {"bytes_per_disk", " %.0f"}});
}

TEST_CASE("Bench: the engine's table is the default, and a cell of it has its numbers") {
  const Shell shell;
  for (const std::string name : {"", " engine"}) {
    CAPTURE(name);
    const Outcome outcome =
        shell.run("clatter bench" + name + " --count 100 --area-fraction 0.3 --json cell.json");
    CHECK(outcome.code == 0);
    const json rows = json::parse(shell.read("cell.json"));
    REQUIRE(rows.size() == 1);
    check_columns_of_disks(outcome.out, rows);
    CHECK(rows[0]["count"] == 100);
    CHECK(rows[0]["area_fraction"] == 0.3);
    // The memory of so few disks is within the noise of the program. A sanitizer adds memory.
    CHECK((is_sanitized() || rows[0]["bytes_per_disk"].is_null()));
  }
}

TEST_CASE("Bench: a cell of the engine's table for spheres, with its memory") {
  const Shell shell;
  const Outcome outcome =
      shell.run("clatter bench engine --count 100000 --volume-fraction 0.2 --json cell.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
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

TEST_CASE("Bench: a mixture has one cell of the engine's table") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter bench engine --species 300:1:1,100:1.5:2 --area-fraction 0.4 --json cell.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json rows = json::parse(shell.read("cell.json"));
  REQUIRE(rows.size() == 1);
  CHECK(rows[0]["count"] == 400);
  CHECK(rows[0]["area_fraction"] == 0.4);
  CHECK(rows[0]["million_collisions_per_cpu_second"] > 0.01);
  for (const std::string wrong :
       {"300:1", "0:1:1", "1.5:1:1", "3:1:-1", "3:1:1:1", "3;1;1", "3:1:1,", ""}) {
    CAPTURE(wrong);
    const Outcome refused = shell.run("clatter bench engine --species '" + wrong + "'");
    CHECK(refused.code == 2);
    CHECK(refused.out.empty());
  }
  CHECK(shell.run("clatter bench engine --species 100:1:1 --area-fraction 0.9").code == 2);
  CHECK(shell.run("clatter bench engine --area-fraction 0.3").code == 2);
}

TEST_CASE("Bench: the set-up alone has no rate") {
  const Shell shell;
  const Outcome outcome =
      shell.run("clatter bench engine --species 20000:1:1,20:6:36 --start-only --json cell.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json rows = json::parse(shell.read("cell.json"));
  CHECK(rows[0]["million_collisions_per_cpu_second"].is_null());
  CHECK(rows[0]["setup_seconds"] > 1e-3);
  CHECK(rows[0]["count"] == 20'020);
  check_columns_of_disks(outcome.out, rows);
}

TEST_CASE("Bench: a cell of the table of cores has the gas as a whole and in tiles") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter bench cores --count 100000 --area-fraction 0.25 --threads 3 --json cores.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
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
  check_columns(outcome.out, rows, "N phi threads Mcoll/s of whole busy redundant redone",
                {{"million_collisions_per_second", " %.3f"},
                 {"of_whole", " %.2f"},
                 {"busy", " %.2f"},
                 {"redundant", " %.2f"},
                 {"redone", " %.3f"}});
  check_refused(shell, "clatter bench cores --count 2 --area-fraction 0.9", {"--area-fraction"});
}

TEST_CASE("Bench: a fraction that no box holds is refused under the flag that gave it") {
  const Shell shell;
  for (const std::string flag : {"--area-fraction 0.9", "--volume-fraction 0.74"}) {
    CAPTURE(flag);
    const Outcome outcome = shell.run("clatter bench engine --count 10 " + flag);
    CHECK(outcome.code == 2);
    CHECK(says(outcome.err, flag.substr(0, flag.find(' ')) + ": "));
  }
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

}  // namespace clatter
