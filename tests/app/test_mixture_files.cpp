// Trajectories, event logs and results of mixtures, read by the programs of their formats.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/app/readers.h"
#include "tests/app/trajectory_scenes.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;
using namespace testing;

namespace {

// Rough small and large particles. The large ones have unequal diameters.
constexpr const char* kSpecies = R"(
particles = { restitution = 0.9, friction = 0.4 }
measure = { burn_in = 1.0, duration = 6.0 }
walls.left = { kind = "thermal", temperature = 1.0 }
walls.right = { kind = "static" }
[[species]]
name = "small"
count = 12
diameter = 0.5
mass = 0.2
[[species]]
name = "large-1"
count = 4
diameter = 2.0
mass = 6.0
inertia = 0.3
polydispersity = { kind = "uniform", width = 0.2 }
)";

std::string mixture_scene(int dimension) {
  return std::string("title = \"M\"\nbox.size = ") + (dimension == 2 ? "[14, 9]" : "[14, 9, 8]") +
         kSpecies;
}

struct ParticleKind {
  std::string species;
  double diameter = 0.0, mass = 0.0;
  auto operator<=>(const ParticleKind&) const = default;
};

// What the particles are, by hand: diameters at the shares 1/8, 3/8, 5/8 and 7/8 between 1.6 and
// 2.4, and masses 6 (d/2)^D.
std::multiset<ParticleKind> expected_kinds(int dimension) {
  std::multiset<ParticleKind> kinds;
  for (int i = 0; i < 12; ++i) kinds.insert({"small", 0.5, 0.2});
  for (const double diameter : {1.7, 1.9, 2.1, 2.3}) {
    kinds.insert({"large-1", diameter, 6.0 * std::pow(diameter / 2.0, dimension)});
  }
  return kinds;
}

void check_kinds(const std::vector<ParticleKind>& found, int dimension) {
  const std::multiset<ParticleKind> expected = expected_kinds(dimension);
  const std::multiset<ParticleKind> sorted(found.begin(), found.end());
  REQUIRE(sorted.size() == expected.size());
  for (auto one = sorted.begin(), other = expected.begin(); one != sorted.end(); ++one, ++other) {
    CHECK(one->species == other->species);
    CHECK(one->diameter == doctest::Approx(other->diameter).epsilon(1e-14));
    CHECK(one->mass == doctest::Approx(other->mass).epsilon(1e-14));
  }
}

std::vector<ParticleKind> kinds_in(const std::vector<Row>& rows) {
  std::vector<ParticleKind> kinds;
  for (const Row& row : rows) {
    kinds.push_back({row.at("species"), std::stod(row.at("diameter")), std::stod(row.at("mass"))});
  }
  return kinds;
}

// The particles of a file in the order of its reader. `first` is the number of the first type, and
// `names` are those of the types of a file that has none.
std::vector<ParticleKind> kinds_in(const json& read, int first,
                                   const std::vector<std::string>& names = {}) {
  std::vector<ParticleKind> kinds;
  const json all = names.empty() ? read.at("names") : json(names);
  for (std::size_t i = 0; i < read.at("types").size(); ++i) {
    const auto type = read.at("types").at(i).get<std::size_t>() - static_cast<std::size_t>(first);
    kinds.push_back({all.at(type), read.at("diameters").at(i), read.at("masses").at(i)});
  }
  return kinds;
}

const std::vector<std::string> kNames = {"small", "large-1"};

}  // namespace

TEST_CASE("Mixture files: ASE, gsd, MDAnalysis, h5py and VTK read what the particles are") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const Shell shell;
    shell.write("s.toml", mixture_scene(dimension));
    for (const std::string format : {"csv", "xyz", "lammpstrj", "gsd", "h5md", "vtp"}) {
      const Outcome run = shell.run(kRun + "--every 3 --trajectory t." + format);
      CAPTURE(run.err);
      REQUIRE(run.code == 0);
    }
    std::vector<Row> rows = rows_in(shell.read("t.csv"));
    REQUIRE(rows.size() == 3 * 16);
    rows.erase(rows.begin(), rows.begin() + 2 * 16);  // the last frame
    const std::vector<ParticleKind> want = kinds_in(rows);
    check_kinds(want, dimension);
    json positions;
    for (const Row& row : rows) positions.push_back(json(position_of(row)));
    const std::vector<std::array<std::string, 2>> files = {
        {"t.xyz", "1"}, {"t.lammpstrj", "1"}, {"t.gsd", "0"}, {"t.h5md", "0"}};
    for (const auto& [file, first] : files) {
      CAPTURE(file);
      const json read = read_by(shell, "read_mixture.py", file);
      const bool dump = file == "t.lammpstrj";
      CHECK(kinds_in(read, std::stoi(first), dump ? kNames : std::vector<std::string>()) == want);
      CHECK(read.at("positions") == positions);
      if (!dump) CHECK(read.at("names") == json(kNames));
    }
    // MDAnalysis has types of both, and sizes and masses of GSD.
    const json dump = read_by(shell, "read_mixture.py", "t.lammpstrj").at("mdanalysis");
    const json gsd = read_by(shell, "read_mixture.py", "t.gsd");
    for (std::size_t i = 0; i < want.size(); ++i) {
      CHECK(dump.at("types").at(i) == (want[i].species == "small" ? "1" : "2"));
      CHECK(gsd.at("mdanalysis").at("types").at(i) == want[i].species);
      CHECK(gsd.at("mdanalysis").at("diameters").at(i) == static_cast<float>(want[i].diameter));
      CHECK(gsd.at("mdanalysis").at("masses").at(i) == static_cast<float>(want[i].mass));
      // I = q m d^2/4, with the q of the species or 1/2 of disks and 2/5 of spheres.
      const double q = want[i].species == "small" ? (dimension == 2 ? 0.5 : 0.4) : 0.3;
      const double moment = q * want[i].mass * want[i].diameter * want[i].diameter / 4.0;
      CHECK(gsd.at("single").at("moments").at(i).get<double>() ==
            doctest::Approx(moment).epsilon(1e-7));
    }
  }
}

TEST_CASE("Mixture files: VTK reads a series of particles, with diameters as the scalars") {
  const Shell shell;
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    shell.write("s.toml", mixture_scene(dimension));
    REQUIRE(shell.run(kRun + "--every 3 --trajectory t.csv").code == 0);
    REQUIRE(shell.run(kRun + "--every 3 --trajectory t.vtp").code == 0);
    const std::vector<Row> rows = rows_in(shell.read("t.csv"));
    const json frames = read_by(shell, "read_mixture.py", "t.vtp.series");
    REQUIRE(frames.size() == 3);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const json& frame = frames.at(k / 16);
      const std::size_t i = k % 16;
      const Row& row = rows[k];
      CHECK(frame.at("listed") == std::stod(row.at("time")));
      CHECK(frame.at("time") == std::stod(row.at("time")));
      // The layer of disks is as deep as the largest can be.
      CHECK(frame.at("box") == json{14.0, 9.0, dimension == 2 ? 2.4 : 8.0});
      CHECK(frame.at("scalars") == "diameter");
      CHECK(frame.at("vectors") == "velocity");
      CHECK(frame.at("names") == json(kNames));
      CHECK(frame.at("vertices") == 16);
      CHECK(frame.at("positions").at(i) == json(position_of(row)));
      const json& arrays = frame.at("arrays");
      CHECK(arrays.at("diameter").at(i) == std::stod(row.at("diameter")));
      CHECK(arrays.at("mass").at(i) == std::stod(row.at("mass")));
      CHECK(arrays.at("velocity").at(i) == json(velocity_of(row)));
      CHECK(arrays.at("spin").at(i) == json(spin_of(row)));
      CHECK(arrays.at("image").at(i) == json(image_of(row)));
      CHECK(arrays.at("species").at(i) == (row.at("species") == "small" ? 0 : 1));
    }
  }
  // Particles that are alike, without spins.
  shell.write("s.toml", kSmoothDisks);
  REQUIRE(shell.run(kRun + "--every 5 --trajectory t.vtp").code == 0);
  const json last = read_by(shell, "read_mixture.py", "t.vtp.series").back();
  CHECK(last.at("listed") == 20.0);
  CHECK(last.at("diameters") == json(std::vector<double>(6, 1.0)));
  CHECK(last.at("masses") == json(std::vector<double>(6, 1.0)));
  CHECK(!last.at("arrays").contains("species"));
  CHECK(!last.at("arrays").contains("spin"));
}

TEST_CASE("VTP: a resumed series has the frames of a whole one, and earlier frames disappear") {
  const Shell shell;
  shell.write("s.toml", mixture_scene(2));
  const std::string flags = kRun + "--every 0.5 --trajectory ";
  REQUIRE(shell.run("mkdir whole part && " + flags + "whole/t.vtp").code == 0);
  REQUIRE(shell.run(flags + "part/t.vtp --checkpoint c --until 2.2").code == 0);
  CHECK(read_by(shell, "read_mixture.py", "part/t.vtp.series").size() == 5);
  shell.run("printf 'lost' >>part/t.vtp.series");
  REQUIRE(shell.run(flags + "part/t.vtp --resume c").code == 0);
  CHECK(shell.run("diff -r whole part").code == 0);
  CHECK(read_by(shell, "read_mixture.py", "part/t.vtp.series").size() == 15);
  shell.write("part/t_notes.vtp", "of the user");
  REQUIRE(shell.run(kRun + "--every 3 --trajectory part/t.vtp").code == 0);
  CHECK(shell.run("ls part").out ==
        "t.vtp.series\nt_000000.vtp\nt_000001.vtp\nt_000002.vtp\nt_notes.vtp\n");
  check_refused(shell, kRun + "--every 3 --trajectory v.vtp --save-state v.vtp.series",
                {"v.vtp.series"});
}

TEST_CASE("Mixture files: an event log has once what the particles are") {
  const Shell shell;
  shell.write("s.toml", mixture_scene(2));
  const Outcome run =
      shell.run(kRun + "--events e.h5 --save-state end.csv && " + kRun + "--events e.csv");
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  const std::vector<ParticleKind> want = kinds_in(rows_in(shell.read("end.csv")));
  check_kinds(want, 2);
  const json read = read_by(shell, "read_mixture.py", "e.h5");
  CHECK(kinds_in(read, 0) == want);
  CHECK(read.at("units") == json{"a", "m"});
  const std::string table = shell.read("e.particles.csv");
  CHECK(table.starts_with("# units, "));
  CHECK(kinds_in(rows_in(table.substr(table.find('\n') + 1))) == want);
  // Momentum is conserved with these masses.
  const std::string events = shell.read("e.csv");
  int pairs = 0;
  for (const Row& row : rows_in(events.substr(events.find('\n') + 1))) {
    if (row.at("kind") != "0") continue;
    ++pairs;
    const double first = want[std::stoul(row.at("particle"))].mass;
    const double second = want[std::stoul(row.at("partner"))].mass;
    const auto gain = [&](const std::string& name) {
      return std::stod(row.at(name + "velocity_after_x")) -
             std::stod(row.at(name + "velocity_before_x"));
    };
    CHECK(first * gain("") == doctest::Approx(std::stod(row.at("impulse_x"))).epsilon(1e-9));
    CHECK(second * gain("partner_") ==
          doctest::Approx(-std::stod(row.at("impulse_x"))).epsilon(1e-9));
  }
  CHECK(pairs > 20);
  check_refused(shell, kRun + "--events f.csv --save-state f.particles.csv", {"f.particles.csv"});
  shell.write("s.toml", kSmoothDisks);
  REQUIRE(shell.run(kRun + "--events one.csv --until 5 && test ! -e one.particles.csv").code == 0);
}

TEST_CASE("Mixture files: lists of species in HDF5 results are groups with their names") {
  const Shell shell;
  shell.write("s.toml", mixture_scene(2) +
                            "[[pair]]\nspecies = [\"small\", \"large-1\"]\nrestitution = 0.8\n");
  REQUIRE(shell.run(kRun + "--hdf5 r.h5").code == 0);
  const json file = read_by(shell, "read_hdf5.py", "r.h5");
  const json& species = file.at("scene").at("species");
  CHECK(species.at("small").at("diameter") == 0.5);
  CHECK(species.at("large-1").at("polydispersity").at("width") == 0.2);
  CHECK(file.at("scene").at("pair").at("small,large-1").at("restitution") == 0.8);
}

}  // namespace clatter
