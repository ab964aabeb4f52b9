#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/engine/scene/refusal.h"

using namespace clatter;
using namespace clatter::testing;

// Every mistake in the text of a scene gives an error with its place and a fix.

TEST_CASE("Scene file: mistakes are reported with their place and a fix") {
  struct Case {
    std::string text, place, word;
  };
  const std::string measure = kParticles + "[measure]\n", view = kParticles + "[view]\n";
  const std::string top = kParticles + "[walls.top]\nkind = ";
  const std::string snapshot = measure + "estimator = \"snapshot\"\n";
  const std::string start = kParticles + "[particles.start]\n";
  const std::string sheared = "[box]\nsize = [10, 9]\n[particles]\ncount = 9\n[shear]\nrate = 1\n";
  const std::string divided =
      "[box]\nsize = [10, 4]\n[walls.left]\nkind = \"static\"\n[walls.right]\nkind = "
      "\"static\"\n[particles]\ncount = 9\n";
  const std::string captions = kParticles + "[[view.captions]]\n";
  const std::string sawtooth = "kind = \"sawtooth\"\n", fixed = "kind = \"static\"\n";
  const std::vector<Case> cases = {
      // syntax
      {"title = \"a\"\nbox = = 3\n", "2:7", ""},
      {"title = \"\xff\"\n" + kParticles, "1:9", "utf-8"},
      // unknown keys
      {kParticles + "restitutoin = 1\n", "3:1", "did you mean 'restitution'?"},
      {kParticles + "\n[walls.lefft]\nkind = \"static\"\n", "4:1", "did you mean 'left'?"},
      {"[disks]\ncount = 1\n", "1:1", "'particles'"},
      {kParticles + "[veiw]\n", "3:1", "did you mean 'view'?"},
      {kParticles + "temperature = 1\n", "3:1", "'particles.start.temperature'"},
      {kParticles + "mass = 0.3\n", "3:1", "count, area_fraction, restitution, friction"},
      {kParticles + "[bulk_drive]\nkick_sped = 1\n", "4:1", "'kick_speed'"},
      {"[particles.start]\nlayout = 'file'\nfile = \"no\\u0000such.csv\"\n", "3:1",
       "no\\u0000such"},
      {"\"a.b\\u001b\" = 1\n" + kParticles, "1:1", "unknown key 'a.b\\u001b'"},
      {"\"particles.count\" = 1\n" + kParticles, "1:1", "unknown key 'particles.count'; "},
      // wrong types
      {"title = 3\n" + kParticles, "1:1", "text"},
      {"[particles]\n  count = 10.5\n", "2:3", "whole number between 0 and 2147483647"},
      {"box = 3\n" + kParticles, "1:1", "table"},
      {kParticles + "restitution = \"high\"\n", "3:1", "number between 0 and 1"},
      {view + "overlay = 1\n", "4:1", "true or false"},
      {measure + "fields = \"density\"\n", "4:1", "list of names"},
      {measure + "cells = [2.0, 3]\n", "4:1", "whole numbers"},
      // camera and captions
      {view + "camera = [{ time = 1 }, { time = 1 }]\n", "4:1", "in order"},
      {view + "camera = [{ follow = 10 }]\n", "4:1", "from 0 to 9"},
      {"particles.count = 1\nview.camera = [{ follow = 1 }]\n", "2:6", "number 0"},
      {"particles.count = 0\nview.camera = [{ follow = 0 }]\n", "2:6", "no particles"},
      {"particles.count = 0\nchange = [{ time = 1, nudge = { particle = 3, add = [1, 0] } }]\n",
       "2:33", "no particles"},
      {view + "camera = [{ follow = 3000000000 }]\n", "4:13", "'view.camera.follow'"},
      {view + "camera = [{ widht = 3 }]\n", "4:13", "'width'"},
      {view + "camera = [{ width = 1e-300 }]\n", "4:13", "between 0.001 and 1e+09"},
      {kParticles + "[[view.camera]]\nfollow = 1\ncentre = [1, 2]\n", "5:1", "beside follow"},
      {view + "captions = [{ text = 'v^2' },\n  { text = 'T_{x' }]\n", "5:3", "'{' has no '}'"},
      {captions + "from = 1\n", "3:1", "'view.captions.text' is missing"},
      {captions + "text = 'a'\nfrom = 3\nto = 3\n", "6:1", "greater than 3"},
      // values out of range
      {"schema = 2\n" + kParticles, "1:1", "give 1"},
      {kParticles + "restitution = 1.5\n", "3:1", "between 0 and 1"},
      {view + "speed = inf\n", "4:1", "between 1e-30 and 1e+30"},
      {start + "temperature = -1\n", "4:1", "between 0 and"},
      {"[particles]\ncount = -1\n", "2:1", "whole number"},
      {"[box]\nsize = [1, 5]\n" + kParticles, "2:1", "greater than 1 and at most 1e+06"},
      {"[box]\nsize = [20]\n" + kParticles, "2:1", "has 1 number"},
      {"[box]\nsize = [2, 3, 4, 5]\n" + kParticles, "2:1", "has 4 numbers"},
      {"[box]\nsize = [20, 20, 1]\n" + kParticles, "2:1", "along x, y and z"},
      {measure + "cells = [0, 3]\n", "4:1", "two whole numbers between 1 and 2000"},
      {measure + "cells = [10, 4294967297]\n", "4:1", "[10, 4294967297]"},
      {"[box]\nsize = [20, 20, 20]\n[measure]\ncells = [3, 3]\n" + kParticles, "4:1",
       "three whole numbers"},
      {"[box]\nsize = [20, 20, 20]\n[particles]\narea_fraction = 0.1\n", "4:1", "volume_fraction"},
      {view + "range = [3, 3]\n", "4:1", "low < high"},
      {view + "range = [0, 5e-324]\n", "4:1", "[0, 5e-324]"},
      {view + "range = \"automatic\"\n", "4:1", "'view.range'"},
      {view + "field_range = [-1e308, 1e308]\n", "4:1", "'view.field_range'"},
      {view + "estimator = \"snapshot\"\ninterval = 1e-300\n", "5:1", "between 2e-05 and 20"},
      {view + "background = \"#12345\"\n", "4:1", "\"#rrggbb\""},
      {kSpheres + "[view]\ntiling = true\n", "6:1", "no meaning for spheres"},
      {view + "palette = \"virdis\"\n", "4:1", "did you mean \"viridis\"?"},
      {measure + "fields = [\"density\", \"pressure\"]\n", "4:1", "\"density\", \"velocity\""},
      // estimators
      {measure + "interval = 1.0\n", "4:1", "exact estimator"},
      {snapshot, "3:1", "'measure.interval' is missing"},
      {snapshot + "interval = 0\n", "5:1", "'measure.interval' cannot be 0"},
      {measure + "width = 1.0\n", "4:1", "box kernel"},
      {measure + "kernel = \"gaussian\"\nwidth = 2.0\n", "4:1", "exact estimator"},
      {snapshot + "interval = 1\nkernel = \"gaussian\"\n", "3:1", "'measure.width' is missing"},
      {snapshot + "interval = 1\nkernel = \"gaussian\"\nwidth = 0.25\n", "7:1", "cells of 1"},
      {kSpheres + "[measure]\nestimator = \"snapshot\"\ninterval = 1\nkernel = \"gaussian\"\n"
                  "width = 0.9\ncells = [20, 20, 10]\n",
       "9:1", "cells of 2"},
      {measure + "profile_axis = \"z\"\n", "4:1", "two dimensions"},
      // walls
      {kParticles + "[walls.left]\n" + fixed, "3:1", "add [walls.right]"},
      {kParticles + "[walls.top]\nrestitution = 1\n", "3:1", "'walls.top.kind' is missing"},
      {top + "\"driven\"\n", "3:1", "'walls.top.drive_speed' is missing"},
      {top + "\"thermal\"\n", "3:1", "'walls.top.temperature' is missing"},
      {top + "\"sawtooth\"\nfrequency = 1\n", "3:1", "'walls.top.stroke' is missing"},
      {top + "\"sinusoidal\"\nstroke = 1\n", "3:1", "'walls.top.frequency' is missing"},
      {top + "\"static\"\ndrive_speed = 1\n", "5:1", "no meaning for this kind of wall"},
      {top + "\"driven\"\ndrive_speed = 1\nfrequency = 1\n", "6:1", "no meaning for this kind"},
      {top + "\"thermal\"\ntemperature = 1\nrestitution = 1\n", "6:1", "no meaning for this kind"},
      {top + "\"static\"\nrestitution = 10.1\n", "5:1", "between 0 and 10"},
      {top + "\"sawtoth\"\n", "4:1", "did you mean \"sawtooth\"?"},
      {top + "\"sawtooth\"\nstroke = -1\nfrequency = 1\n", "5:1", "between 0 and"},
      {kParticles + "[walls.left]\n" + fixed + "[walls.right]\n" + sawtooth +
           "stroke = 10\nfrequency = 1e15\n",
       "8:1", "speed of 1e+16"},
      {kParticles +
           "[walls.left]\nkind = \"sinusoidal\"\nstroke = 1\nfrequency = 4e14\n"
           "[walls.right]\n" +
           fixed,
       "6:1", "speed of 1256637061435917.2"},
      {kParticles +
           "[walls.left]\nkind = \"sinusoidal\"\nstroke = 18\nfrequency = 1\n"
           "[walls.right]\n" +
           sawtooth + "stroke = 10\nfrequency = 1\n",
       "9:1", "1 diameters are left"},
      {kParticles + "[walls.front]\n" + fixed, "3:1", "left, right, bottom, top"},
      {kSpheres + "[walls.back]\n" + fixed, "5:1", "add [walls.front]"},
      {kSpheres + "[walls.back]\n" + fixed + "[walls.front]\n" + sawtooth +
           "stroke = 10\nfrequency = 1e15\n",
       "10:1", "speed of 1e+16"},
      {kSpheres + "[walls.back]\n" + sawtooth + "stroke = 19.5\nfrequency = 1\n[walls.front]\n" +
           fixed,
       "7:1", "0.5 diameters are left"},
      // rough particles, and spins without rough partners
      {kParticles + "friction = -1\n", "3:1", "at least 0, or inf"},
      {kParticles + "tangential_restitution = -1.1\n", "3:1", "between -1 and 1"},
      {kParticles + "friction = 1\ninertia = 0\n", "4:1", "'particles.inertia' cannot be 0"},
      {kParticles + "inertia = 0.5\n", "3:1", "nothing spins"},
      {start + "spin_temperature = 1\n", "4:1", "nothing spins"},
      {kParticles + "[bulk_drive]\ninterval = 1\nkick_speed = 1\nkick_spin = 1\n", "6:1",
       "nothing spins"},
      {view + "colour_by = \"spin\"\n", "4:1", "nothing spins"},
      {view + "colour_by = \"species\"\n", "4:1", "the particles have no species"},
      {view + "plots = [\"mixing\"]\n", "4:1", "\"mixing\" is for mixtures"},
      {view + "plots = [\"velocity_autocorrelation\"]\n", "4:1", "a plot of an observable"},
      {view + "field = \"spin_temperature\"\n", "4:1", "nothing spins"},
      {measure + "fields = [\"density\", \"spin\"]\n", "4:1", "nothing spins"},
      // forces
      {kParticles + "[gravity]\n", "3:1", "'gravity.acceleration' is missing"},
      {kParticles + "[gravity]\nacceleration = -1\n", "4:1", "two numbers between"},
      {kParticles + "[bulk_drive]\nkick_speed = 1\n", "3:1", "'bulk_drive.interval' is missing"},
      {kParticles + "[bulk_drive]\ninterval = 1\n", "3:1", "'bulk_drive.kick_speed' is missing"},
      {kParticles + "[bulk_drive]\ninterval = 0\nkick_speed = 1\n", "4:1", "greater than 0"},
      {kParticles + "[collapse]\ncontact_time = 0\n", "4:1", "greater than 0"},
      // start
      {start + "file = \"a.csv\"\n", "4:1", "without layout = \"file\""},
      {start + "layout = \"file\"\n", "3:1", "'particles.start.file' is missing"},
      {start + "layout = \"file\"\nfile = \"a.csv\"\ntemperature = 1\n", "6:1", "beside layout"},
      {kParticles + "friction = 1\n[particles.start]\nlayout = \"file\"\nfile = \"a.csv\"\n"
                    "spin_temperature = 1\n",
       "7:1", "beside layout"},
      {start + "layout = \"file\"\nfile = \"nowhere/a.csv\"\n", "5:1", "'nowhere/a.csv'"},
      // the number of particles
      {"title = \"a\"\n[particles]\n", "2:1", "the number of particles is missing"},
      {kParticles + "area_fraction = 0.3\n", "3:1", "'particles.area_fraction'"},
      {"[box]\nsize = [2.5, 3.5]\n[particles]\ncount = 9\n", "4:1", "give at most 8"},
      {"[box]\nsize = [2.5, 3.5]\n[particles]\ncount = 8\n[walls.left]\n" + sawtooth +
           "stroke = 1\nfrequency = 1\n[walls.right]\n" + fixed,
       "4:1", "give at most 4"},
      {"[particles]\narea_fraction = 0.95\n", "2:1", "605 particles have no place"},
      {"[particles]\ncount = 2000000000\n", "2:1", "2000000000 particles have no place"},
      // sheared boxes
      {sheared + "[walls.left]\n" + fixed + "[walls.right]\n" + fixed, "7:1", "no walls across"},
      {sheared + "[[obstacle]]\nkind = \"ball\"\ncentre = [3, 3]\nradius = 1\n", "7:3",
       "no bodies at rest"},
      {sheared + "[gravity]\nacceleration = [0, -1]\n", "7:1", "no gravity"},
      {sheared + "[measure]\nfields = [\"balance\"]\n", "8:1", "do not include the shear"},
      {sheared + "[view]\nfield = \"balance_mass\"\n", "8:1", "do not include the shear"},
      {sheared + "[measure]\nkernel = \"gaussian\"\nwidth = 1\nestimator = \"snapshot\"\n"
                 "interval = 1\n",
       "8:1", "across the sheared border"},
      {sheared + "[measure]\nobservables = [\"structure_factor\"]\n", "8:1", "wave vectors"},
      {sheared + "[measure]\nobservables = [\"plane_current\"]\n", "8:1", "a plane across x"},
      {sheared + "[[change]]\ntime = 1\nreverse = true\n", "9:1", "cannot be reversed"},
      {"box.size = [9, 9, 9]\nparticles.count = 9\nshear.rate = 1\n[walls.back]\nkind = "
       "\"thermal\"\ntemperature = 1\n[walls.front]\n" +
           fixed,
       "4:1", "would hold up the flow"},
      {sheared + "[[change]]\ntime = 1\nset = { \"walls.left\" = { kind = \"static\" } }\n", "7:1",
       "no wall opposite"},
      {kParticles + "[shear]\n", "3:1", "'shear.rate' is missing"},
      {"[box]\nsize = [9, 1.9]\n[particles]\ncount = 3\n[shear]\nrate = 1\n", "2:1",
       "too small to be sheared"},
      {"[box]\nsize = [1.19, 9]\n[particles]\ncount = 3\n[shear]\nrate = 1\n", "2:1",
       "too small to be sheared"},
      {kParticles + "[[change]]\ntime = 1\nset = { \"shear.rate\" = 1 }\n", "3:1",
       "while the gas moves"},
      // the sides of a divider: 2.4 x 4 has room for two columns of four
      {divided + "count_left = 2\n", "9:1", "in a box that nothing divides"},
      {divided + "count_left = 10\n[piston]\nposition = 5\nmass = 1\n", "9:1", "at most 9"},
      {divided + "count_left = 9\n[piston]\nposition = 2.4\nmass = 1\n", "11:1",
       "9 particles cannot start below the piston"},
      {divided + "count_left = 0\n[piston]\nposition = 8.1\nthickness = 1\nmass = 1\n", "11:1",
       "9 particles cannot start above the piston"},
      {divided + "count_left = 5\n[[partition]]\nposition = 0.9\n", "11:1",
       "5 particles cannot start below the partition"},
      {divided + "count_left = 0\n[piston]\nposition = 10\nmass = 1\n", "11:1",
       "not between the walls"},
  };
  for (const Case& mistake : cases) {
    CAPTURE(mistake.text);
    const std::string what = refusal(mistake.text);
    CAPTURE(what);
    CHECK(what.starts_with("s.toml:" + mistake.place + ": "));
    CHECK(says(what, mistake.word));
  }
  CHECK(refusal("").starts_with("s.toml: the number of particles is missing"));
  CHECK(refusal(view + "camera = [{ follow = 18446744073709551616 }]\n").starts_with("s.toml:4:"));
}

TEST_CASE("Scene file: huge boxes overflow nothing and huge counts allocate nothing") {
  const std::string box = "box.size = [1e6, 1e6]\n";
  CHECK(parse_scene(box + "particles.count = 2000000000\n", "s.toml").particles.count ==
        2'000'000'000);
  CHECK(says(refusal("box.size = [1e300, 1e300]\nparticles.area_fraction = 0.3\n"),
             "give two numbers greater than 1 and at most 1e+06"));
}

TEST_CASE("Scene file: hostile nesting is refused without a crash") {
  std::string arrays = "x = ", tables = "x = ", dotted, header,
              hidden = "x = {b = \"\"\"a\"\"\"\", ";
  for (int i = 0; i < 100'000; ++i) {
    arrays += '[';
    tables += "{a = ";
    dotted += "a.";
    header += "a . ";
  }
  CHECK(says(refusal(arrays), "s.toml:1:"));
  CHECK(says(refusal(tables), "s.toml:1:"));
  CHECK(says(refusal("\n" + dotted + "a = 1"), "s.toml:2: a key has more than 16 dots"));
  CHECK(says(refusal("\n\n[" + header + "a]"), "s.toml:3: a key has more than 16 dots"));
  CHECK(says(refusal(hidden + dotted + "a = 1}"), "s.toml:1: a key has more than 16 dots"));
  const std::string dots = ". . . . . . . . . . . . . . . . . . . .";
  CHECK(refusal("title = \"\\\"" + dots + "\" # " + dots + "\ncaption = '''\n" + dots + "'''\n" +
                kParticles) == "");
}
