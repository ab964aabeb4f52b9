// Files of VTK PolyData: those of other programs, and lists of files.

#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/app/trajectory_scenes.h"
#include "tests/support/shell.h"

namespace clatter {

using namespace testing;

namespace {

std::string polydata(const std::string& data, const std::string& attributes = "") {
  return "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"" + attributes +
         "><PolyData>" + data + "</PolyData></VTKFile>\n";
}

std::string ascii_array(const std::string& name, int components, const std::string& numbers,
                        const std::string& type = "Float64") {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"ascii\">" + numbers + "</DataArray>";
}

std::string piece_of(int count, const std::string& positions, const std::string& arrays) {
  return "<Piece NumberOfPoints=\"" + std::to_string(count) + "\"><PointData>" + arrays +
         "</PointData><Points>" + ascii_array("Points", 3, positions) + "</Points></Piece>";
}

const std::string kOneDisk = piece_of(1, "1 2 0", ascii_array("velocity", 3, "3 4 0"));

// The start state of a file, which is written first.
std::string state_of_vtp(const Shell& shell, const std::string& text,
                         const std::string& flags = "") {
  shell.write("a.vtp", text);
  const Outcome converted = shell.run("clatter convert a.vtp state.csv" + flags);
  CAPTURE(converted.err);
  CHECK(converted.code == 0);
  return shell.read("state.csv");
}

void check_bad_vtp(const Shell& shell, const std::string& text,
                   const std::vector<std::string>& parts) {
  shell.write("bad.vtp", text);
  check_refused(shell, "clatter convert bad.vtp out.csv", parts);
}

}  // namespace

TEST_CASE("Import: VTK PolyData, each encoding of VTK's writer gives the particles to the bit") {
  const Shell shell;
  const Outcome written = shell.run(CLATTER_READERS "write_vtk.py");
  if (written.code == 3) {
    MESSAGE("[skipped] VTK is not installed");
    return;
  }
  REQUIRE(written.code == 0);
  std::istringstream names(written.out);
  int files = 0;
  for (std::string name; names >> name; ++files) {
    CAPTURE(name);
    const Outcome converted = shell.run("clatter convert " + name + " a.csv");
    CAPTURE(converted.err);
    CHECK(converted.code == 0);
    CHECK(shell.read("a.csv") ==
          "x,y,vx,vy,diameter,mass,species\n"
          "0.3333333333333333,1,0.1,2,1,1,light\n"
          "4.1,2,-0.3333333333333333,0,1,1,light\n"
          "6,1e-09,0,1e-300,2,8,heavy\n");
  }
  CHECK(files == 32);
}

TEST_CASE("Import: VTK PolyData written by hand, with the time and the box of clatter") {
  const Shell shell;
  const std::string fields = "<FieldData>" + ascii_array("TimeValue", 1, "2.5") +
                             ascii_array("box", 3, "8 6 1") +
                             ascii_array("periodic", 3, "1 0 0", "UInt8") + "</FieldData>";
  const std::string disks = piece_of(
      2, "1 2 0\n 9.5\t4 0",
      ascii_array("V", 3, "0.5 +2.5e-1 0 -.5 0 0") + ascii_array("Diameters", 1, "1 1") +
          ascii_array("omega", 3, "0 0 7 0 0 8") + ascii_array("force", 3, "nan 0 0 0 0 0"));
  shell.write("a.vtp", polydata(fields + disks));
  REQUIRE(shell.run("clatter convert a.vtp a.xyz").code == 0);
  const std::string xyz = shell.read("a.xyz");
  CHECK(says(xyz, "pbc=\"T F F\""));
  CHECK(says(xyz, "Lattice=\"8 0 0 0 6 0 0 0 1\""));
  CHECK(says(xyz, " Time=2.5 "));
  CHECK(says(xyz, "\nX 1 2 0 0.5 0.25 0 0 0 7 0 0 0 0.5\n"));
  CHECK(says(xyz, "\nX 1.5 4 0 -0.5 0 0 0 0 8 1 0 0 0.5\n"));  // beyond the periodic side
  check_refused(shell, "clatter convert a.vtp --frame 1 out.csv", {"a.vtp: the file has 1 frame"});
  // Without a box this comes from a scene.
  shell.write("s.toml", "box.size = [8, 6]\nparticles.count = 1\n");
  shell.write("b.vtp", polydata(kOneDisk));
  check_refused(shell, "clatter convert b.vtp new.xyz", {"b.vtp: the file has no box", "--scene"});
  REQUIRE(shell.run("clatter convert b.vtp b.xyz --scene s.toml").code == 0);
  CHECK(says(shell.read("b.xyz"), "\nX 1 2 0 3 4 0 0 0 0 0.5\n"));
}

TEST_CASE("Import: VTK PolyData has pieces, and particles in the order of their identifiers") {
  const Shell shell;
  const auto piece = [](int count, const std::string& x, const std::string& ids) {
    return piece_of(count, x, ascii_array("id", 1, ids, "Int64"));
  };
  const std::string state = state_of_vtp(
      shell, polydata(piece(2, "1 2 0 3 4 0", "7 5") + piece(0, "", "") + piece(1, "5 6 0", "6")),
      " --temperature 0");
  CHECK(state == "x,y,vx,vy\n3,4,0,0\n5,6,0,0\n1,2,0,0\n");
  check_bad_vtp(shell, polydata(piece(2, "1 2 0 3 4 0", "7 7") + kOneDisk),
                {"bad.vtp:1: this piece lacks the array velocity"});
  check_bad_vtp(
      shell,
      polydata(piece_of(2, "1 2 0 3 4 0",
                        ascii_array("id", 1, "7 7") + ascii_array("v", 3, "0 0 0 0 0 0"))),
      {"bad.vtp: the id 7 occurs twice"});
}

TEST_CASE("Import: VTK PolyData, the XML may have comments, references and CDATA") {
  const Shell shell;
  const std::string head = "\xef\xbb\xbf<?xml version='1.0'?>\n<!-- a > b -->\n";
  std::string disk = kOneDisk;
  disk.replace(disk.rfind(" format=\"ascii\""), 15, "");  // the default
  disk.replace(disk.find("3 4 0"), 5, "&#51;<!-- < --> &#x34;<![CDATA[ 0]]>");
  CHECK(state_of_vtp(shell, head + polydata(disk)) == "x,y,vx,vy\n1,2,3,4\n");
  // Numbers of single precision are rounded.
  const auto in_layer = [](const std::string& type) {
    return polydata(piece_of(2, "1 2 0 3 4 1e-8", ascii_array("v", 3, "0 0 0 0 0 0", type)));
  };
  CHECK(state_of_vtp(shell, in_layer("Float32")) == "x,y,vx,vy\n1,2,0,0\n3,4,0,0\n");
  CHECK(state_of_vtp(shell, in_layer("Float64")).starts_with("x,y,z,"));
}

TEST_CASE("Import: VTK PolyData that is no gas is refused with the line") {
  const Shell shell;
  const auto bad = [&](const std::string& text, const std::vector<std::string>& parts) {
    check_bad_vtp(shell, text, parts);
  };
  const auto with_arrays = [](const std::string& arrays) {
    return polydata(piece_of(1, "1 2 0", arrays));
  };
  const std::string v = ascii_array("v", 3, "0 0 0");
  bad("", {"bad.vtp:1: the file is cut off within its XML; give a complete file"});
  bad("x,y,vx,vy\n1,2,3,4\n<", {"bad.vtp:3: there is text before the first element"});
  bad("<VTKFile>", {"bad.vtp:1: the file is cut off"});
  bad("<VTKFile></PolyData>", {"the end tag \"PolyData\" has no start tag"});
  bad("<VTKFile>\n<a b='1' b='2'/></VTKFile>", {"bad.vtp:2: the attribute \"b\" occurs twice"});
  bad("<VTKFile a=1/>", {"the value of \"a\" has no quotes"});
  bad("<VTKFile a='&b;'/>", {"&b; is no character"});
  bad("<!DOCTYPE a [<!ENTITY b 'c'>]><VTKFile/>", {"the file declares a type of documents"});
  std::string nested;
  for (int k = 0; k < 100'000; ++k) nested += "<a>";
  bad(nested, {"more than 100 elements are in each other"});
  bad("<VTKFile type='ImageData'/>", {"no file of VTK of the type PolyData"});
  bad("<VTKFile type='PolyData'/>", {"the element PolyData is missing"});
  bad(polydata(kOneDisk, " compressor=\"vtkLZ4DataCompressor\""),
      {"compressed by \"vtkLZ4DataCompressor\"", "with the compressor zlib"});
  bad(with_arrays(""), {"the velocities are missing", "the array velocity"});
  bad(with_arrays(ascii_array("v", 2, "0 0")), {"\"v\" has 2 components instead of 3"});
  bad(with_arrays(ascii_array("v", 3, "0 0")), {"\"v\" has 2 numbers instead of 3"});
  bad(with_arrays(ascii_array("v", 3, "0 0 x")), {"the array \"v\" has \"x\"; give numbers"});
  for (const std::string velocity : {"0 nan 0", "0 0 nan", "0 0 inf"}) {
    bad(with_arrays(ascii_array("v", 3, velocity)), {"particle 0: the velocity is not finite"});
  }
  bad(with_arrays(v + ascii_array("vel", 3, "0 0 0")), {"\"v\" and \"vel\" have one meaning"});
  bad(with_arrays(v + ascii_array("type", 1, "1.5")), {"a species is 1.5"});
  bad(with_arrays(v + ascii_array("radius", 1, "1") + ascii_array("diameter", 1, "1")),
      {"the radius 1 does not fit the diameter 1"});
  bad(with_arrays(v + ascii_array("mass", 1, "1", "Complex")),
      {"\"mass\" has the type \"Complex\""});
  bad(polydata("<Piece NumberOfPoints=\"-1\"/>"), {"NumberOfPoints is \"-1\""});
  bad(polydata("<Piece NumberOfPoints=\"4000000000\"/>"), {"too many particles"});
  bad(polydata("<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"/>"), {"lines or surfaces"});
  bad(polydata("<Piece NumberOfPoints=\"3\"/>"), {"the positions are missing"});
  // Sizes that the data do not have, without an allocation of so many bytes.
  for (const std::string data : {"/////w==", "AQAAAA==", "AAAAAA==", "GAAAAAAA", "!"}) {
    for (const char* compressor : {"", " compressor=\"vtkZLibDataCompressor\""}) {
      CAPTURE(data);
      std::string array = ascii_array("v", 3, data);
      array.replace(array.find("ascii"), 5, "binary");
      bad(polydata(piece_of(1, "1 2 0", array), compressor),
          {"bad.vtp:1: the array \"v\" is damaged or cut off"});
    }
  }
  std::string lost = ascii_array("v", 3, "");
  lost.replace(lost.find("ascii\""), 6, "appended\" offset=\"99\"");
  bad(polydata(piece_of(1, "1 2 0", lost)), {"the array \"v\" is damaged or cut off"});
}

TEST_CASE("Import: lists of files of VTK, those of a run and those of ParaView") {
  const Shell shell;
  shell.write("s.toml", kDisks);
  REQUIRE(shell.run("mkdir here").code == 0);
  REQUIRE(shell.run(kRun + "--until 2 --every 1 --trajectory here/t.vtp").code == 0);
  check_refused(shell, "clatter convert here/t.vtp out.csv",
                {"here/t.vtp: there is no such file; give the list here/t.vtp.series"});
  check_refused(shell, "clatter convert here/t.vtp.series --frame 3 out.csv",
                {"here/t.vtp.series: the file has 3 frames; give --frame from 0 to 2"});
  REQUIRE(shell.run("clatter convert here/t_000001.vtp one.xyz").code == 0);
  const auto list = [&](const std::string& text) { shell.write("here/l.pvd", text); };
  const auto entry = [](const std::string& time, const std::string& file) {
    return "<DataSet timestep=\"" + time + "\" part=\"0\" file=\"" + file + "\"/>";
  };
  const std::string begin = "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>";
  const std::string end = "</Collection></VTKFile>";
  list(begin + entry("7", "t_000001.vtp") + entry("8", "t_000000.vtp") + end);
  REQUIRE(shell.run("clatter convert here/l.pvd --frame 0 listed.xyz").code == 0);
  CHECK(shell.read("listed.xyz") == shell.read("one.xyz"));  // its own time comes first
  // The time of a file without one is that of the list.
  shell.write("here/b.vtp",
              polydata("<FieldData>" + ascii_array("box", 3, "8 6 1") + "</FieldData>" + kOneDisk));
  list(begin + entry("7", "b.vtp") + end);
  REQUIRE(shell.run("clatter convert here/l.pvd b.xyz").code == 0);
  CHECK(says(shell.read("b.xyz"), " Time=7 "));
  CHECK(says(shell.read("b.xyz"), "pbc=\"T T F\""));  // as in extended XYZ
  const auto bad = [&](const std::string& text, const std::string& part) {
    list(text);
    check_refused(shell, "clatter convert here/l.pvd out.csv", {"here/l.pvd", part});
  };
  bad(begin + end, "the file has no frame");
  bad(begin + entry("7", "c.vtp") + end, "the list names here/c.vtp, which is no file");
  bad(begin + entry("7", "c.vtu") + end, "the list names \"c.vtu\"; give a list of files .vtp");
  bad(begin + entry("x", "b.vtp") + end, "the entry has no file and time");
  bad(begin + entry("7", "b.vtp") + entry("7", "t_000000.vtp") + end,
      "several files of the time 7");
  for (const std::string text :
       {"", "[1]", "{\"files\": 1}", "{\"files\": [{\"name\": \"b.vtp\"}]}"}) {
    shell.write("l.vtp.series", text);
    check_refused(shell, "clatter convert l.vtp.series out.csv",
                  {"l.vtp.series: ", "give a list of files as ParaView writes it"});
  }
}

}  // namespace clatter
