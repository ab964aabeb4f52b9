// Event logs.

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/results/event_log.h"
#include "engine/error.h"
#include "engine/physics/random.h"
#include "engine/system/growing_file.h"
#include "tests/support/shell.h"
#include "tests/support/tables.h"

namespace clatter {

using nlohmann::json;
using testing::Table;
using testing::table_in;

namespace {

const std::string kEventRun =
    "clatter measure s.toml --quiet --set measure.burn_in=0 --set measure.duration=30 ";

// A gas without any symmetry.
std::string scene(int dimension) {
  const bool disks = dimension == 2;
  return "schema = 1\ntitle = \"log\"\n[box]\nsize = " +
         std::string(disks ? "[11.0, 9.0]" : "[5.0, 6.0, 4.0]") + R"(
[particles]
count = 12
restitution = 0.8
friction = 0.4
[walls.left]
kind = "thermal"
temperature = 0.5
[walls.right]
kind = "driven"
restitution = 0.9
drive_speed = 1.5
[gravity]
acceleration = )" +
         (disks ? "[0.1, -0.2]" : "[0.1, -0.2, 0.3]") + "\n";
}

std::vector<double> column(const Table& table, const std::string& name) {
  std::vector<double> numbers;
  for (const json& value : table.columns.at(name)) {
    numbers.push_back(value.is_null() ? std::nan("") : value.get<double>());
  }
  return numbers;
}

}  // namespace

// The log has all collisions that the result counts, and its velocities give the result's energies
// and pressures.
TEST_CASE("Event log: it has all collisions, and they add up to the result") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const Shell shell;
    shell.write("s.toml", scene(dimension));
    const Outcome outcome = shell.run(kEventRun + "--events e.csv --out r.json");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const json result = json::parse(shell.read("r.json"));
    const Table log = table_in(shell.read("e.csv"));
    const std::vector<double> kind = column(log, "kind"), time = column(log, "time");
    const std::vector<double> particle = column(log, "particle"), partner = column(log, "partner");
    const auto pairs = std::ranges::count(kind, 0.0);
    CHECK(pairs == result.at("events").at("disk_disk"));
    CHECK(static_cast<long>(kind.size()) - pairs == result.at("events").at("disk_wall"));
    CHECK(std::ranges::is_sorted(time));
    CHECK(time.back() <= 30.0);
    CHECK(time.front() >= 0.0);

    const std::vector<std::string> axes = dimension == 2 ? std::vector<std::string>{"x", "y"}
                                                         : std::vector<std::string>{"x", "y", "z"};
    const std::vector<std::string> spins =
        dimension == 2 ? std::vector<std::string>{""} : std::vector<std::string>{"_x", "_y", "_z"};
    const double inertia = (dimension == 2 ? 0.5 : 0.4) / 4.0;
    std::vector<double> gain(kind.size(), 0.0), distance(kind.size(), 0.0);
    const auto add = [&](const std::string& who, double weight, const std::string& quantity,
                         const std::string& axis) {
      const std::vector<double> before = column(log, who + quantity + "_before" + axis);
      const std::vector<double> after = column(log, who + quantity + "_after" + axis);
      for (std::size_t k = 0; k < kind.size(); ++k) {
        if (who.empty() || kind[k] == 0.0) {
          gain[k] += 0.5 * weight * (after[k] * after[k] - before[k] * before[k]);
        } else {
          REQUIRE(std::isnan(before[k]));
          REQUIRE(std::isnan(after[k]));
        }
      }
    };
    const std::vector<double> sides =
        dimension == 2 ? std::vector<double>{11.0, 9.0} : std::vector<double>{5.0, 6.0, 4.0};
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      const std::string name = "_" + axes[axis];
      add("", 1.0, "velocity", name);
      add("partner_", 1.0, "velocity", name);
      const std::vector<double> r = column(log, "position" + name);
      const std::vector<double> s = column(log, "partner_position" + name);
      const std::vector<double> before = column(log, "velocity_before" + name);
      const std::vector<double> after = column(log, "velocity_after" + name);
      const std::vector<double> impulse = column(log, "impulse" + name);
      for (std::size_t k = 0; k < kind.size(); ++k) {
        CHECK(after[k] - before[k] == doctest::Approx(impulse[k]).epsilon(1e-9));
        REQUIRE(r[k] >= 0.0);
        REQUIRE(r[k] <= sides[axis]);
        double apart = std::fabs(r[k] - s[k]);
        if (axis > 0) apart = std::min(apart, sides[axis] - apart);
        distance[k] += apart * apart;
      }
    }
    for (const std::string& axis : spins) {
      add("", inertia, "spin", axis);
      add("partner_", inertia, "spin", axis);
    }
    double lost = 0.0, from_walls = 0.0;
    std::vector<double> impulse_of_wall(2, 0.0);
    const std::vector<double> impulse = column(log, "impulse_x"), x = column(log, "position_x");
    for (std::size_t k = 0; k < kind.size(); ++k) {
      if (kind[k] == 0.0) {
        lost -= gain[k];
        CHECK(particle[k] < partner[k]);
        CHECK(std::sqrt(distance[k]) == doctest::Approx(1.0).epsilon(1e-9));
      } else {
        from_walls += gain[k];
        CHECK(partner[k] == -1.0);
        REQUIRE((kind[k] == 1.0 || kind[k] == 2.0));
        CHECK(x[k] == doctest::Approx(kind[k] == 1.0 ? 0.5 : sides[0] - 0.5).epsilon(1e-9));
        impulse_of_wall[kind[k] == 1.0 ? 0 : 1] += std::fabs(impulse[k]);
      }
    }
    double area = 1.0;
    for (std::size_t axis = 1; axis < sides.size(); ++axis) area *= sides[axis];
    const auto mean = [&](const char* group, const char* name) {
      return result.at(group).at(name).at("mean").get<double>();
    };
    CHECK(lost / 30.0 == doctest::Approx(mean("energy", "dissipated")).epsilon(1e-9));
    CHECK(from_walls / 30.0 == doctest::Approx(mean("energy", "walls_in")).epsilon(1e-9));
    CHECK(impulse_of_wall[0] / 30.0 / area == doctest::Approx(mean("pressure", "left")));
    CHECK(impulse_of_wall[1] / 30.0 / area == doctest::Approx(mean("pressure", "right")));
    CHECK(log.units.at("impulse_x") == "m a/t");
    CHECK(log.units.at("partner_velocity_after_y") == "a/t");
    CHECK(log.units.at("partner_position_x") == "a");
    CHECK(log.units.at(dimension == 2 ? "spin_before" : "spin_before_z") == "1/t");
  }
}

TEST_CASE("Event log: HDF5 has the numbers of the CSV, and the run is the same") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const Shell shell;
    shell.write("s.toml", scene(dimension));
    REQUIRE(shell.run(kEventRun + "--out plain.json").code == 0);
    REQUIRE(shell.run(kEventRun + "--events e.csv --out csv.json").code == 0);
    REQUIRE(shell.run(kEventRun + "--events e.h5 --out h5.json").code == 0);
    CHECK(shell.run("ls e.*").out == "e.csv\ne.h5\n");
    json plain = json::parse(shell.read("plain.json")), log = json::parse(shell.read("h5.json"));
    for (json* each : {&plain, &log}) each->erase("performance");
    CHECK(plain == log);
    const Outcome read = shell.run("head -2 e.csv | tail -1 > header && " CLATTER_READERS
                                   "read_events.py e.h5 \"$(cat header)\" > h5.csv && "
                                   "tail -n +3 e.csv > numbers.csv && wc -l < h5.csv");
    CAPTURE(read.err);
    REQUIRE(read.code == 0);
    CHECK(std::stol(read.out) > 100);
    // Both have the shortest texts of the same doubles; Python adds ".0".
    CHECK(shell.run("sed 's/\\.0\\b//g' h5.csv | cmp - numbers.csv").code == 0);
  }
}

TEST_CASE("Event log: particles, a region and a share") {
  const Shell shell;
  shell.write("s.toml", scene(2));
  REQUIRE(shell.run(kEventRun + "--events all.csv --out r.json").code == 0);
  const auto lines = [&](const std::string& flags) {
    const Outcome outcome = shell.run(kEventRun + flags + " --events e.csv --out r.json");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    return shell.run("tail -n +3 e.csv").out;
  };
  const std::string awk = "tail -n +3 all.csv | awk -F, ";
  CHECK(lines("--events-of 3,7") ==
        shell.run(awk + "'$3 == 3 || $3 == 7 || $4 == 3 || $4 == 7'").out);
  CHECK(lines("--events-in 2,5.5,1,8") ==
        shell
            .run(awk + "'($5 >= 2 && $5 <= 5.5 && $6 >= 1 && $6 <= 8) || "
                       "($7 >= 2 && $7 <= 5.5 && $8 >= 1 && $8 <= 8)'")
            .out);
  CHECK(lines("--events-share 0.25") == shell.run(awk + "'NR % 4 == 0'").out);
  CHECK(lines("--events-share 0.5 --events-of 3") ==
        shell.run(awk + "'($3 == 3 || $4 == 3) && ++n % 2 == 0'").out);
}

TEST_CASE("Event log: an interrupted and resumed run has the same log") {
  for (const std::string file : {"e.csv", "e.h5"}) {
    CAPTURE(file);
    const Shell shell;
    shell.write("s.toml", scene(2));
    const std::string line = kEventRun + "--set measure.duration=40000 --events-share 0.1 ";
    REQUIRE(shell.run(line + "--events whole_" + file + " --out r.json").code == 0);
    REQUIRE(cut_off(shell, line + "--events " + file + " --out r.json", "TERM").code == 130);
    CHECK(shell.run("test -e e.h5").code != 0);
    // Events after the checkpoint are written again.
    shell.run(
        "test -e e.csv && echo 1,2,3 >> e.csv; test -e e.h5.records && echo 123 >> e.h5.records");
    const Outcome resumed = shell.run(line + "--resume c --events " + file + " --out r.json");
    CAPTURE(resumed.err);
    REQUIRE(resumed.code == 0);
    CHECK(shell.run("cmp " + file + " whole_" + file).code == 0);
    check_refused(shell, line + "--resume c --events-of 1 --events " + file + " --out r.json",
                  {"--events", "has other events"});
  }
}

TEST_CASE("Event log: a complete run can be continued with its log") {
  for (const std::string file : {"e.csv", "e.h5"}) {
    CAPTURE(file);
    const Shell shell;
    shell.write("s.toml", scene(2));
    REQUIRE(shell.run(kEventRun + "--events whole_" + file + " --out r.json").code == 0);
    REQUIRE(shell.run(kEventRun + "--until 10 --checkpoint c --out r.json --events " + file).code ==
            0);
    CHECK(std::filesystem::exists(shell.path(file)));
    const Outcome resumed =
        shell.run(kEventRun + "--until 30 --resume c --out r.json --events " + file);
    CAPTURE(resumed.err);
    CHECK(resumed.code == 0);
    CHECK(shell.run("cmp " + file + " whole_" + file).code == 0);
    CHECK_FALSE(std::filesystem::exists(shell.path("e.h5.records")));
    const Outcome without = shell.run(
        "clatter measure s.toml --set measure.burn_in=0 --set measure.duration=30 --resume c "
        "--until 11 --out r.json");
    CAPTURE(without.err);
    CHECK(says(without.err, "note: the event log of c does not continue without --events"));
  }
}

// A gas that collapses at t = 69.
static const std::string kCollapse =
    "schema = 1\ntitle = \"collapse\"\n[box]\nsize = [10.0, 10.0]\n[particles]\n"
    "count = 40\nrestitution = 0.05\n";

TEST_CASE("Event log: a run that stops by itself has its last events") {
  const Shell shell;
  shell.write("s.toml", kCollapse);
  const Outcome outcome =
      shell.run("clatter measure s.toml --until 1e4 --out r.json --events e.h5");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 3);
  REQUIRE(std::filesystem::exists(shell.path("e.h5")));
  CHECK(std::filesystem::exists(shell.path("e.h5.records")));
  const Outcome read =
      shell.run(CLATTER_READERS
                "read_events.py e.h5 time,kind,particle,partner,"
                "position_x,position_y,partner_position_x,partner_position_y,"
                "velocity_before_x,velocity_before_y,velocity_after_x,velocity_after_y,"
                "partner_velocity_before_x,partner_velocity_before_y,"
                "partner_velocity_after_x,partner_velocity_after_y,impulse_x,impulse_y "
                "| wc -l");
  CAPTURE(read.err);
  CHECK(std::stoi(read.out) > 100);
}

namespace {

// Limits the size of files, as a full disk does.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::uint64_t bytes) : ignored_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, ignored_);
  }

 private:
  rlimit before_{};
  void (*ignored_)(int);
};

}  // namespace

TEST_CASE("Event log: a full disk leaves complete records, and no damaged log") {
  const Shell shell;
  const std::string thousand(1000, 'x');
  {
    GrowingFile file(shell.path("e.csv"), 0);
    file.append("first\n");
    {
      const FileSizeLimit full(500);
      CHECK_THROWS_WITH_AS(file.append(thousand), doctest::Contains("File too large"), RunError);
    }
    CHECK(shell.read("e.csv") == "first\n");
    file.append("second\n");
    CHECK_THROWS_WITH_AS(GrowingFile(shell.path("e.csv"), 0),
                         doctest::Contains("another run writes this file"), UserError);
    file.close();
  }
  CHECK(shell.read("e.csv") == "first\nsecond\n");

  const std::vector<EventQuantity> quantities = event_quantities(2, false);
  std::string records;
  Random random(1, Stream::Placement, 0, 0);
  for (std::size_t k = 0; k < 20000 * record_size(quantities); ++k) {
    const double number = random.uniform();
    records.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  shell.write("e.h5.records", records);
  const auto write = [&] {
    write_event_file(shell.path("e.h5"), shell.path("e.h5.records"), quantities);
  };
  for (const std::uint64_t bytes : {1000u, 100'000u, 1'000'000u, 2'000'000u}) {
    CAPTURE(bytes);
    const FileSizeLimit full(bytes);
    CHECK_THROWS_AS(write(), RunError);
    CHECK(shell.files() == std::vector<std::string>{"e.csv", "e.h5.records"});
  }
  write();
  CHECK(std::filesystem::file_size(shell.path("e.h5")) > 2'000'000);
}

TEST_CASE("Event log: if the HDF5 file cannot be written, the run can be resumed") {
  const Shell shell;
  shell.write("s.toml", scene(2));
  const std::string line = kEventRun + "--events e.h5 --out r.json";
  const Outcome full = shell.run("ulimit -f 800; " + line);
  CAPTURE(full.err);
  CHECK(full.code == 1);
  CHECK(says(full.err,
             "cannot write e.h5: File too large; continue with --resume r.checkpoint --events"));
  REQUIRE(shell.run(line + " --resume r.checkpoint && mv e.h5 resumed.h5").code == 0);
  CHECK(shell.run(line + " && cmp e.h5 resumed.h5").code == 0);
}

TEST_CASE("Event log: it is complete although the trajectory of a stopped run is not") {
  const Shell shell;
  shell.write("s.toml", kCollapse);
  // A private namespace, so that the mount ends with the command. The disk has room for the
  // records, and none for the complete file.
  const std::string small_disk =
      "mkdir -p small; exec unshare --mount sh -c 'mount -t tmpfs -o size=40k none small || exit "
      "77; ";
  if (shell.run(small_disk + "'").code != 0) {
    MESSAGE("[skipped] only root may mount a small disk");
    return;
  }
  const Outcome full = shell.run(small_disk +
                                 "clatter measure s.toml --until 1e4 --out r.json --events e.h5 "
                                 "--trajectory small/t.h5md --every 10'");
  CAPTURE(full.err);
  CHECK(full.code == 3);
  CHECK(says(full.err, "cannot write small/t.h5md: No space left on device"));
  CHECK(std::filesystem::exists(shell.path("e.h5")));
}

TEST_CASE("Event log: wrong use is refused") {
  const Shell shell;
  shell.write("s.toml", scene(2));
  check_refused(shell, kEventRun + "--events e.txt", {"e.txt has no extension of an event log"});
  check_refused(shell, kEventRun + "--events e.csv --events-of 12", {"there is no particle 12"});
  check_refused(shell, kEventRun + "--events e.csv --events-in 1,2,3",
                {"3 numbers are given", "give 4"});
  check_refused(shell, kEventRun + "--events e.csv --events-in 5,0,2,8",
                {"no place of the box is between 5 and 0 along x"});
  check_refused(shell, kEventRun + "--events e.csv --events-in 0,5,9,12",
                {"no place of the box is between 9 and 12 along y"});
  check_refused(shell, kEventRun + "--events e.csv --events-share 2", {"--events-share"});
  check_refused(shell, kEventRun + "--events e.h5 --out e.h5.records", {"e.h5.records"});
  REQUIRE(shell.run(kEventRun + "--until 5 --checkpoint c --out r.json").code == 0);
  shell.write("e.h5.records", "records of another run");
  check_refused(shell, kEventRun + "--resume c --out r.json --events e.h5",
                {"e.h5.records exists, and the checkpoint has no event log"});
  check_refused(shell, kEventRun + "--events-of 1", {"--events"});
  check_refused(shell, kEventRun + "--events e.csv --trajectory e.csv --every 1", {"--events"});
}

}  // namespace clatter
