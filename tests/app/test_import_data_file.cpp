// Data files of LAMMPS.

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/shell.h"

namespace clatter {

using namespace testing;

namespace {

const std::string kHeader =
    "LAMMPS data file via write_data, version 29 Sep 2021, timestep = 100\n\n2 atoms\n1 atom "
    "types\n"
    "0 bonds\n\n-10 10 xlo xhi\n-5 5 ylo yhi\n-0.5 0.5 zlo zhi\n\n";
const std::string kVelocities = "\nVelocities\n\n2 -1 0 0\n1 1 0.5 0\n";
const std::string kDataWant = "x,y,vx,vy\n1,2,1,0.5\n15,7.5,-1,0\n";

std::string atoms(const std::string& style, const std::string& before, const std::string& behind) {
  return "Atoms" + style + "\n\n1 " + before + " -9 -3 0" + behind + "\n2 " + before + " 5 2.5 0" +
         behind + "   # a comment\n";
}

}  // namespace

TEST_CASE("Data files: each atom style gives the particles, sorted by their numbers") {
  const Shell shell;
  const auto check = [&](const std::string& file, const std::string& text,
                         const std::string& want = kDataWant) {
    shell.write(file, text);
    const Outcome converted = shell.run("clatter convert " + file + " out.csv");
    CAPTURE(text);
    CAPTURE(converted.err);
    CHECK(converted.code == 0);
    CHECK(shell.read("out.csv") == want);
  };
  for (const char* file : {"a.data", "a.lmp", "data.grains", "data.2d.txt"}) {
    check(file, kHeader + atoms(" # atomic", "1", "") + kVelocities);
  }
  check("a.data", kHeader + atoms("", "1", "") + kVelocities);  // five columns: atomic
  check("a.data", kHeader + atoms("  # charge", "1 0.5", "") + kVelocities);
  check("a.data", kHeader + atoms(" # molecular", "0 1", " 1 0 0") + kVelocities);
  check("a.data", kHeader + atoms(" # full", "0 1 -0.5", "") + kVelocities);
  check("a.data", kHeader + atoms(" # dipole", "1 0", " 1 0 0") + kVelocities);
  check("a.data", kHeader + "Masses\n\n1 2.5\n\n" + atoms(" # atomic", "1", "") + kVelocities);
  check("a.data", kHeader + "Atom Type Labels\n\n1 grain\n\nMasses\n\ngrain 2.5\n\n" +
                      atoms(" # atomic", "grain", "") + kVelocities +
                      "\nPair Coeffs # gran/hooke\n\n1 1.0 2.0\n");
  // Spheres of LAMMPS have angular velocities.
  check("a.data",
        kHeader + atoms(" # sphere", "1 1 1.909859317102744", "") +
            "\nVelocities\n\n2 -1 0 0 0 0 3\n1 1 0.5 0 0 0 -4\n",
        "x,y,vx,vy,omega\n1,2,1,0.5,-4\n15,7.5,-1,0,3\n");
  // Periodic images, and the defaults of a layer.
  std::string layer = kHeader;
  layer.erase(layer.find("-0.5 0.5"), 17);
  shell.write("a.data",
              layer + "0 0 0 xy xz yz\n\n" + atoms(" # atomic", "1", " 2 -1 0") + kVelocities);
  REQUIRE(shell.run("clatter convert a.data a.xyz").code == 0);
  CHECK(says(shell.read("a.xyz"), "Lattice=\"20 0 0 0 10 0 0 0 1\""));
  CHECK(says(shell.read("a.xyz"), "pbc=\"T T F\""));  // the default of LAMMPS
  CHECK(says(shell.read("a.xyz"), "\nX 1 2 0 1 0.5 0 2 -1 0 0.5\n"));
  // Compressed, and without velocities.
  shell.write("a.data", kHeader + atoms(" # atomic", "1", ""));
  REQUIRE(shell.run("gzip a.data && clatter convert a.data.gz out.csv --temperature 0").code == 0);
  CHECK(shell.read("out.csv") == "x,y,vx,vy\n1,2,0,0\n15,7.5,0,0\n");
}

TEST_CASE("Data files: what is not read is refused with the line") {
  const Shell shell;
  const auto refused = [&](const std::string& text, const std::string& part,
                           const std::string& flags = "") {
    CAPTURE(text);
    shell.write("a.data", text);
    check_refused(shell, "clatter convert a.data out.csv " + flags, {part});
  };
  const std::string good = kHeader + atoms(" # atomic", "1", "") + kVelocities;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string atomic = atoms(" # atomic", "1", "");
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"", "a.data: the file is empty"},
      {changed("2 atoms", "3 atoms"), "a.data:16: this line has 1 column instead of 5"},
      {changed("2 atoms", "1 atoms"), "a.data:14: unknown section \"2 1 5 2.5 0\""},
      {changed("xlo xhi", "xlo"), "a.data:7: unknown line \"-10 10 xlo\""},
      {changed("-10 10 xlo", "10 xlo"), "a.data:7: xlo xhi has 1 number"},
      {changed("2 atoms", "1 1 0 xy xz yz\n2 atoms"), "a.data:3: the box is tilted"},
      {changed("2 atoms", "1 0 0 avec\n2 atoms"), "a.data:3: unknown line \"1 0 0 avec\""},
      {changed("-0.5 0.5 zlo", "0.5 -25 zlo"), "a.data:9: the edge of the box along z is -25.5"},
      {kHeader + atoms("", "1 1", "") + kVelocities, "a.data:13: the atom style is missing"},
      {changed(" # atomic", " # ellipsoid"), "a.data:13: the atom style \"ellipsoid\""},
      {changed(" # atomic\n\n", " # atomic\n"), "a.data:12: this line is not blank"},
      {changed("1 1 -9", "1 2 -9"), "a.data:13: \"2\" is no atom type"},
      {changed("2 1 5", "1 1 5"), "there is no atom 2"},
      {changed("-9 -3 0", "-9 -3"), "a.data:13: this line has 4 columns"},
      {changed("-9 -3 0", "-9 -3 x"), "a.data:13: \"x\""},
      {changed("2 -1 0 0", "1 -1 0 0"), "a.data:19: the atom 1 has two velocities"},
      {changed("\n1 1 0.5 0", ""), "a.data:18: the file ends within a section"},
      {changed("Velocities", "Velocity"), "a.data:16: unknown section \"Velocity\""},
      {kHeader + atomic, "the section Velocities is missing"},
      {kHeader, "the section Atoms is missing"},
      {kHeader + atoms(" # sphere", "1 2 1", "") + "\nVelocities\n\n1 0 0 0 0 0 0\n2 0 0 0 0 0 0\n",
       "a.data:13: the diameter is 2 instead of 1"},
      {changed("1 atom types", "2 atom types") + "\nMasses\n\n1 1\n1 2\n", "occurs twice"},
      {changed("1 atom types", "1.5 atom types"), "a.data:4: \"1.5\""},
      {changed("1 atom types\n", ""), "a.data:12: the header does not say"},
      {changed("0 bonds", "1 bond bond types"), "a.data:5: unknown line"},
      {kHeader + atoms(" # atomic", "1", " 1e5 0 0") + kVelocities, "a.data:13: \"1e5\""}};
  for (const auto& [text, part] : rows) refused(text, part);
  refused(good, "a.data: the file has 1 frame", "--frame 1");
  refused(good, "--group: a.data is no H5MD file", "--group all");
}

TEST_CASE("Data files: atom types are numbers") {
  const Shell shell;
  std::string two =
      kHeader + "Masses\n\n1 2.5\n2 2.5\n\n" + atoms(" # atomic", "01", "") + kVelocities;
  two.replace(two.find("1 atom types"), 12, "2 atom types");
  shell.write("a.data", two);
  CHECK(shell.run("clatter convert a.data out.csv").code == 0);
  // The mass of type 01 is that of type 1.
  two.replace(two.find("1 2.5"), 5, "1 3.5");
  two.replace(two.find("2 01 5"), 6, "2 2 5");
  shell.write("a.data", two);
  REQUIRE(shell.run("clatter convert a.data out.csv").code == 0);
  CHECK(shell.read("out.csv") ==
        "x,y,vx,vy,diameter,mass,species\n1,2,1,0.5,1,3.5,type1\n15,7.5,-1,0,1,2.5,type2\n");
  // Labels are names.
  two.replace(two.find("Masses"), 6, "Atom Type Labels\n\n1 sand\n2 grit\n\nMasses");
  shell.write("a.data", two);
  REQUIRE(shell.run("clatter convert a.data out.csv").code == 0);
  CHECK(says(shell.read("out.csv"), ",1,3.5,sand\n15,7.5,-1,0,1,2.5,grit\n"));
}

TEST_CASE("Data files: the header counts the rows of sections that are skipped") {
  const Shell shell;
  const std::string sections =
      "\nBonds\n\n1 1 1 2\n2 C-C 2 1\n\nBond Coeffs # harmonic\n\n1 harmonic 80 1.2\n"
      "\nBodies\n\n1 1 3 6\n4 1 2\n0.5 0 0\n0 0 0\n";
  std::string header = kHeader;
  header.replace(header.find("0 bonds"), 7, "2 bonds\n1 bond types\n1 bodies");
  const std::string good = header + atoms(" # atomic", "1", "") + sections + kVelocities;
  shell.write("a.data", good);
  const Outcome converted = shell.run("clatter convert a.data out.csv");
  CAPTURE(converted.err);
  CHECK(converted.code == 0);
  CHECK(shell.read("out.csv") == kDataWant);
  const auto refused = [&](const std::string& from, const std::string& to,
                           const std::vector<std::string>& parts) {
    std::string text = good;
    text.replace(text.rfind(from), from.size(), to);
    CAPTURE(text);
    shell.write("a.data", text);
    check_refused(shell, "clatter convert a.data out.csv --temperature 1", parts);
  };
  refused("Velocities", "velocities", {"unknown section \"velocities\""});
  refused("Bond Coeffs # harmonic\n\n", "", {"unknown section \"1 harmonic 80 1.2\""});
  refused("1 harmonic 80 1.2\n", "", {"this line is no row of the section Bond Coeffs"});
  refused("2 C-C 2 1\n", "", {"this line is no row of the section Bonds"});
  refused("2 C-C 2 1\n", "2 C-C 2 x\n", {"\"x\" is no number"});
  refused("4 1 2\n", "4 1 2 3\n", {"a body has too many values"});
}

}  // namespace clatter
