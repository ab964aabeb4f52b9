#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/engine/scene/refusal.h"

using namespace clatter;
using namespace clatter::testing;

// Every mistake in the text of a scene gives an error with its place and a fix.

TEST_CASE("Scene file: mistakes are reported with their place and a fix") {
  struct Case {
    std::string text;
    std::string message;
  };
  const std::vector<Case> cases = {
      // syntax
      {"title = \"a\"\nbox = = 3\n", "s.toml:2:7: "},
      {"title = \"\xff\"\n" + kParticles, "s.toml:1:9: Encountered invalid utf-8 sequence"},
      // unknown keys
      {kParticles + "restitutoin = 1\n",
       "s.toml:3:1: unknown key 'restitutoin'; did you mean 'restitution'?"},
      {kParticles + "\n[walls.lefft]\nkind = \"static\"\n",
       "s.toml:4:1: unknown key 'lefft'; did you mean 'left'?"},
      {"[disks]\ncount = 1\n",
       "s.toml:1:1: unknown key 'disks'; it is called 'particles' now: write particles in place of "
       "disks"},
      {kParticles + "[veiw]\n", "s.toml:3:1: unknown key 'veiw'; did you mean 'view'?"},
      {kParticles + "temperature = 1\n",
       "s.toml:3:1: unknown key 'temperature'; did you mean 'particles.start.temperature'?"},
      {kParticles + "mass = 0.3\n",
       "s.toml:3:1: unknown key 'mass'; the keys here are count, area_fraction, restitution, "
       "friction, tangential_restitution, inertia, start"},
      {kParticles + "[gravty]\n", "s.toml:3:1: unknown key 'gravty'; did you mean 'gravity'?"},
      {kParticles + "[bulk_drive]\nkick_sped = 1\n",
       "s.toml:4:1: unknown key 'kick_sped'; did you mean 'kick_speed'?"},
      {"[particles.start]\nlayout = 'file'\nfile = \"no\\u0000such.csv\"\n",
       "s.toml:3:1: there is no file 'no\\u0000such.csv'; name a CSV file"},
      {"\"a.b\\u001b\" = 1\n" + kParticles,
       "s.toml:1:1: unknown key 'a.b\\u001b'; the keys here are"},
      {"\"particles.count\" = 1\n" + kParticles, "s.toml:1:1: unknown key 'particles.count'; "},
      // wrong types
      {"title = 3\n" + kParticles, "s.toml:1:1: 'title' cannot be 3; give a text between quotes"},
      {"[particles]\n  count = 10.5\n",
       "s.toml:2:3: 'particles.count' cannot be 10.5; give a whole number between 0 and "
       "2147483647"},
      {"box = 3\n" + kParticles, "s.toml:1:1: 'box' cannot be 3; give a table"},
      {"particles = [1]\n", "s.toml:1:1: 'particles' cannot be [1]; give a table"},
      {kParticles + "restitution = \"high\"\n",
       "s.toml:3:1: 'particles.restitution' cannot be \"high\"; give a number between 0 and 1"},
      {kParticles + "[view]\ncamera = [{ time = 1 }, { time = 1 }]\n",
       "s.toml:4:1: the camera's time 1 comes after 1; give each time once, in order"},
      {kParticles + "[view]\ncamera = [{ follow = 10 }]\n",
       "s.toml:4:1: there is no particle 10 to follow; particles are numbered from 0 to 9"},
      {"particles.count = 1\nview.camera = [{ follow = 1 }]\n",
       "s.toml:2:6: there is no particle 1 to follow; the only particle is number 0"},
      {"particles.count = 0\nview.camera = [{ follow = 0 }]\n",
       "s.toml:2:6: there is no particle 0 to follow; the scene has no particles"},
      {"particles.count = 0\nchange = [{ time = 1, nudge = { particle = 3, add = [1, 0] } }]\n",
       "s.toml:2:33: there is no particle 3; the scene has no particles"},
      {kParticles + "[view]\ncamera = [{ follow = 3000000000 }]\n",
       "s.toml:4:13: 'view.camera.follow' cannot be 3000000000; give a whole number between 0 and "
       "2147483647"},
      {kParticles + "[view]\ncamera = [{ follow = 18446744073709551616 }]\n", "s.toml:4:"},
      {kParticles + "[measure]\ncells = [10, 4294967297]\n",
       "s.toml:4:1: 'measure.cells' cannot be [10, 4294967297]; give two whole numbers between 1 "
       "and 2000, along x and y"},
      {kParticles + "[[view.camera]]\nfollow = 1\ncentre = [1, 2]\n",
       "s.toml:5:1: 'view.camera.centre' has no meaning beside follow; remove one of the two"},
      {kParticles + "[view]\ncamera = [{ widht = 3 }]\n",
       "s.toml:4:13: unknown key 'widht'; did you mean 'width'?"},
      {kParticles + "[view]\ncaptions = [{ text = 'v^2' },\n  { text = 'T_{x' }]\n",
       "s.toml:5:3: in the text of a caption a '{' has no '}'; write T_x, v^2 or T_{refined}, and "
       "a backslash before a plain _ or ^"},
      {kParticles + "[[view.captions]]\nfrom = 1\n", "s.toml:3:1: 'view.captions.text' is missing"},
      {kParticles + "[[view.captions]]\ntext = 'a'\nfrom = 3\nto = 3\n",
       "s.toml:6:1: 'view.captions.to' cannot be 3; give a number greater than 3"},
      {kParticles + "[view]\noverlay = 1\n",
       "s.toml:4:1: 'view.overlay' cannot be 1; give true or false"},
      {kParticles + "[measure]\nfields = \"density\"\n",
       "s.toml:4:1: 'measure.fields' cannot be \"density\"; give a list of names"},
      // values out of range
      {"schema = 2\n" + kParticles, "s.toml:1:1: 'schema' cannot be 2; give 1"},
      {kParticles + "restitution = 1.5\n",
       "s.toml:3:1: 'particles.restitution' cannot be 1.5; give a number between 0 and 1"},
      {kParticles + "restitution = nan\n",
       "s.toml:3:1: 'particles.restitution' cannot be nan; give"},
      {kParticles + "[view]\nspeed = inf\n",
       "s.toml:4:1: 'view.speed' cannot be inf; give a number between 1e-30 and 1e+30"},
      {kParticles + "[particles.start]\ntemperature = -1\n",
       "s.toml:4:1: 'particles.start.temperature' cannot be -1; give a number between 0 and"},
      {"[particles]\ncount = -1\n",
       "s.toml:2:1: 'particles.count' cannot be -1; give a whole number"},
      {"[box]\nsize = [1, 5]\n" + kParticles,
       "s.toml:2:1: 'box.size' cannot be [1, 5]; give two numbers greater than 1 and at most "
       "1e+06"},
      {"[box]\nsize = [20]\n" + kParticles,
       "s.toml:2:1: 'box.size' has 1 number; give two numbers for disks, or three for spheres"},
      {"[box]\nsize = [2, 3, 4, 5]\n" + kParticles, "s.toml:2:1: 'box.size' has 4 numbers; give"},
      {"[box]\nsize = [20, 20, 1]\n" + kParticles,
       "s.toml:2:1: 'box.size' cannot be [20, 20, 1]; give three numbers greater than 1 and at "
       "most "
       "1e+06, along x, y and z"},
      {"[box]\nsize = [20, 20, 20]\n[measure]\ncells = [3, 3]\n" + kParticles,
       "s.toml:4:1: 'measure.cells' cannot be [3, 3]; give three whole numbers between 1 and 2000, "
       "along x, y and z"},
      {"[box]\nsize = [20, 20, 20]\n[particles]\narea_fraction = 0.1\n",
       "s.toml:4:1: unknown key 'area_fraction'; a box of three sides has a 'volume_fraction'"},
      {kParticles + "[measure]\ncells = [0, 3]\n",
       "s.toml:4:1: 'measure.cells' cannot be [0, 3]; give two whole numbers between 1 and "
       "2000"},
      {kParticles + "[measure]\ncells = [2.0, 3]\n", "s.toml:4:1: 'measure.cells' cannot be"},
      {kParticles + "[view]\nrange = [3, 3]\n",
       "s.toml:4:1: 'view.range' cannot be [3, 3]; give \"auto\", \"locked\" or two numbers "
       "[low, high] with low < high"},
      {kParticles + "[view]\nrange = [0, 5e-324]\n",
       "s.toml:4:1: 'view.range' cannot be [0, 5e-324]; give \"auto\", \"locked\" "
       "or "
       "two numbers [low, high] with low < high, neither beyond 1e+300 nor closer than 1e-300"},
      {kParticles + "[view]\nfield_range = [-1e308, 1e308]\n", "s.toml:4:1: 'view.field_range'"},
      {kParticles + "[view]\ncamera = [{ width = 1e-300 }]\n",
       "s.toml:4:13: 'view.camera.width' cannot be 1e-300; give a number between 0.001 and 1e+09"},
      {kParticles + "[view]\nestimator = \"snapshot\"\ninterval = 1e-300\n",
       "s.toml:5:1: 'view.interval' cannot be 1e-300; give a number between 2e-05 and 20"},
      {kParticles + "[view]\nbackground = \"#12345\"\n",
       "s.toml:4:1: 'view.background' cannot be \"#12345\"; give a colour as \"#rrggbb\", for "
       "instance \"#ffffff\""},
      {kParticles + "[view]\nbackground = \"#12345x\"\n",
       "s.toml:4:1: 'view.background' cannot be"},
      {kParticles + "[view]\nrange = \"automatic\"\n", "s.toml:4:1: 'view.range' cannot be"},
      {kParticles + "[view]\nopacity = 1.5\n",
       "s.toml:4:1: 'view.opacity' cannot be 1.5; give a number between 0 and 1"},
      {"[box]\nsize = [9, 9, 9]\n" + kParticles + "[view]\ntiling = true\n",
       "s.toml:6:1: 'view.tiling' has no meaning for spheres, whose copies would hide the box; "
       "remove it, or give box.size two numbers"},
      {kParticles + "[view]\npalette = \"virdis\"\n",
       "s.toml:4:1: 'view.palette' cannot be \"virdis\"; give one of \"viridis\", \"inferno\", "
       "\"cividis\"; did you mean \"viridis\"?"},
      {kParticles + "[measure]\nfields = [\"density\", \"pressure\"]\n",
       "s.toml:4:1: 'measure.fields' cannot be \"pressure\"; give one of \"density\", "
       "\"velocity\""},
      {kParticles + "[measure]\nfields = [\"density\", \"spin\"]\n",
       "s.toml:4:1: a field of spins has no meaning where nothing spins; choose another, or make"},
      {kParticles + "[view]\nfield = \"spin_temperature\"\n",
       "s.toml:4:1: a field of spins has no meaning where nothing spins"},
      {kParticles + "[measure]\ninterval = 1.0\n",
       "s.toml:4:1: 'measure.interval' has no meaning for the exact estimator, which counts "
       "flights "
       "as a whole; remove it, or set estimator = \"snapshot\""},
      {kParticles + "[measure]\nestimator = \"snapshot\"\n",
       "s.toml:3:1: 'measure.interval' is missing"},
      {kParticles + "[measure]\nestimator = \"snapshot\"\ninterval = 0\n",
       "s.toml:5:1: 'measure.interval' cannot be 0"},
      {kParticles + "[measure]\nwidth = 1.0\n",
       "s.toml:4:1: 'measure.width' has no meaning for the box kernel"},
      {kParticles + "[measure]\nkernel = \"gaussian\"\nwidth = 2.0\n",
       "s.toml:4:1: the Gaussian kernel has no meaning for the exact estimator; set "
       "measure.estimator = \"snapshot\""},
      {kParticles + "[measure]\nestimator = \"snapshot\"\ninterval = 1\nkernel = \"gaussian\"\n",
       "s.toml:3:1: 'measure.width' is missing"},
      {kParticles + "[measure]\nestimator = \"snapshot\"\ninterval = 1\nkernel = \"gaussian\"\n"
                    "width = 0.25\n",
       "s.toml:7:1: the Gaussian falls between the centres of cells of 1"},
      {kParticles + "[measure]\nprofile_axis = \"z\"\n",
       "s.toml:4:1: 'measure.profile_axis' cannot be \"z\" of a box of two dimensions; "
       "choose \"x\" or \"y\", or give box.size a third number"},
      // walls
      {kParticles + "[walls.left]\nkind = \"static\"\n",
       "s.toml:3:1: [walls.left] has no wall opposite; add [walls.right], or remove this one"},
      {kParticles + "[walls.top]\nrestitution = 1\n",
       "s.toml:3:1: 'walls.top.kind' is missing; give it a value"},
      {kParticles + "[walls.top]\nkind = \"driven\"\n",
       "s.toml:3:1: 'walls.top.drive_speed' is missing"},
      {kParticles + "[walls.top]\nkind = \"thermal\"\n",
       "s.toml:3:1: 'walls.top.temperature' is missing"},
      {kParticles + "[walls.top]\nkind = \"static\"\ndrive_speed = 1\n",
       "s.toml:5:1: 'walls.top.drive_speed' has no meaning for this kind of wall"},
      {kParticles + "[walls.top]\nkind = \"thermal\"\ntemperature = 1\nrestitution = 1\n",
       "s.toml:6:1: 'walls.top.restitution' has no meaning for this kind of wall"},
      {kParticles + "[walls.top]\nkind = \"static\"\nrestitution = 10.1\n",
       "s.toml:5:1: 'walls.top.restitution' cannot be 10.1; give a number between 0 and 10"},
      {kParticles + "[walls.top]\nkind = \"sawtoth\"\n",
       "s.toml:4:1: 'walls.top.kind' cannot be \"sawtoth\"; give one of \"static\", \"driven\", "
       "\"thermal\", \"sawtooth\", \"sinusoidal\"; did you mean \"sawtooth\"?"},
      {kParticles + "[walls.top]\nkind = \"sawtooth\"\nfrequency = 1\n",
       "s.toml:3:1: 'walls.top.stroke' is missing"},
      {kParticles + "[walls.top]\nkind = \"sinusoidal\"\nstroke = 1\n",
       "s.toml:3:1: 'walls.top.frequency' is missing"},
      {kParticles + "[walls.top]\nkind = \"sawtooth\"\nstroke = -1\nfrequency = 1\n",
       "s.toml:5:1: 'walls.top.stroke' cannot be -1; give a number between 0 and"},
      {kParticles + "[walls.top]\nkind = \"static\"\nstroke = 1\n",
       "s.toml:5:1: 'walls.top.stroke' has no meaning for this kind of wall"},
      {kParticles + "[walls.top]\nkind = \"driven\"\ndrive_speed = 1\nfrequency = 1\n",
       "s.toml:6:1: 'walls.top.frequency' has no meaning for this kind of wall"},
      {kParticles + "[walls.top]\nkind = \"static\"\nphase = 1\n",
       "s.toml:5:1: 'walls.top.phase' has no meaning for this kind of wall"},
      {kParticles + "[walls.top]\nkind = \"thermal\"\ntemperature = 1\nfriction = 1\n",
       "s.toml:6:1: 'walls.top.friction' has no meaning for this kind of wall"},
      {kParticles +
           "[walls.top]\nkind = \"thermal\"\ntemperature = 1\ntangential_restitution = 1\n",
       "s.toml:6:1: 'walls.top.tangential_restitution' has no meaning for this kind of wall"},
      {kParticles +
           "[walls.top]\nkind = \"sawtooth\"\nstroke = 0.1\nfrequency = 1\ndrive_speed = 1\n",
       "s.toml:7:1: 'walls.top.drive_speed' has no meaning for this kind of wall"},
      {kParticles + "[walls.left]\nkind = \"static\"\n[walls.right]\nkind = \"sawtooth\"\n"
                    "stroke = 10\nfrequency = 1e15\n",
       "s.toml:8:1: the wall would move at a speed of 1e+16; lower its stroke or its frequency"},
      {kParticles + "[walls.left]\nkind = \"sinusoidal\"\nstroke = 1\nfrequency = 4e14\n"
                    "[walls.right]\nkind = \"static\"\n",
       "s.toml:6:1: the wall would move at a speed of 1256637061435917.2; lower its"},
      {kParticles + "[walls.left]\nkind = \"sinusoidal\"\nstroke = 18\nfrequency = 1\n"
                    "[walls.right]\nkind = \"sawtooth\"\nstroke = 10\nfrequency = 1\n",
       "s.toml:9:1: where the walls move farthest in, 1 diameters are left between them; choose a "
       "smaller stroke or a larger box"},
      {kParticles + "[walls.left]\nkind = \"sawtooth\"\nstroke = 19.5\nfrequency = 1\n"
                    "[walls.right]\nkind = \"static\"\n",
       "s.toml:5:1: where the walls move farthest in, 0.5 diameters are left between them"},
      // walls along z
      {kParticles + "[walls.front]\nkind = \"static\"\n",
       "s.toml:3:1: unknown key 'front'; the keys here are left, right, bottom, top"},
      {kSpheres + "[walls.back]\nkind = \"static\"\n",
       "s.toml:5:1: [walls.back] has no wall opposite; add [walls.front], or remove this one"},
      {kSpheres + "[walls.back]\nkind = \"static\"\n[walls.front]\nkind = \"sawtooth\"\n"
                  "stroke = 10\nfrequency = 1e15\n",
       "s.toml:10:1: the wall would move at a speed of 1e+16; lower its stroke or its frequency"},
      {kSpheres + "[walls.back]\nkind = \"sawtooth\"\nstroke = 19.5\nfrequency = 1\n"
                  "[walls.front]\nkind = \"static\"\n",
       "s.toml:7:1: where the walls move farthest in, 0.5 diameters are left between them"},
      {kSpheres + "[measure]\nestimator = \"snapshot\"\ninterval = 1\nkernel = \"gaussian\"\n"
                  "width = 0.9\ncells = [20, 20, 10]\n",
       "s.toml:9:1: the Gaussian falls between the centres of cells of 2"},
      // rough particles
      {kParticles + "friction = -1\n",
       "s.toml:3:1: 'particles.friction' cannot be -1; give a number of at least 0, or inf"},
      {kParticles + "friction = nan\n", "s.toml:3:1: 'particles.friction' cannot be nan; give"},
      {kParticles + "tangential_restitution = -1.1\n",
       "s.toml:3:1: 'particles.tangential_restitution' cannot be -1.1; give a number between -1 "
       "and 1"},
      {kParticles + "tangential_restitution = inf\n",
       "s.toml:3:1: 'particles.tangential_restitution' cannot be inf; give a number between -1 and "
       "1"},
      {kParticles + "friction = 1\ninertia = 0\n",
       "s.toml:4:1: 'particles.inertia' cannot be 0; give"},
      {kParticles + "friction = 1\ninertia = 1.1\n",
       "s.toml:4:1: 'particles.inertia' cannot be 1.1; give"},
      // spins without rough partners
      {kParticles + "inertia = 0.5\n",
       "s.toml:3:1: 'particles.inertia' has no meaning where nothing spins; remove it, or make the "
       "particles or a wall rough: give friction above 0, or tangential_restitution above -1"},
      {kParticles + "friction = 0\ninertia = 0.5\n",
       "s.toml:4:1: 'particles.inertia' has no meaning where nothing spins"},
      {kParticles + "[particles.start]\nspin_temperature = 1\n",
       "s.toml:4:1: 'particles.start.spin_temperature' has no meaning where nothing spins; remove "
       "it"},
      {kParticles + "[bulk_drive]\ninterval = 1\nkick_speed = 1\nkick_spin = 1\n",
       "s.toml:6:1: 'bulk_drive.kick_spin' has no meaning where nothing spins; remove it"},
      {kParticles + "[view]\ncolour_by = \"spin\"\n",
       "s.toml:4:1: the colour \"spin\" has no meaning where nothing spins; choose another"},
      // forces
      {kParticles + "[gravity]\n", "s.toml:3:1: 'gravity.acceleration' is missing"},
      {kParticles + "[gravity]\nacceleration = -1\n",
       "s.toml:4:1: 'gravity.acceleration' cannot be -1; give two numbers between"},
      {kParticles + "[gravity]\nacceleration = [0, -inf]\n",
       "s.toml:4:1: 'gravity.acceleration' cannot be [0, -inf]; give two numbers between"},
      {kParticles + "[bulk_drive]\nkick_speed = 1\n",
       "s.toml:3:1: 'bulk_drive.interval' is missing"},
      {kParticles + "[bulk_drive]\ninterval = 1\n",
       "s.toml:3:1: 'bulk_drive.kick_speed' is missing"},
      {kParticles + "[bulk_drive]\ninterval = 0\nkick_speed = 1\n",
       "s.toml:4:1: 'bulk_drive.interval' cannot be 0; give a number greater than 0"},
      {kParticles + "[bulk_drive]\ninterval = 1\nkick_speed = -1\n",
       "s.toml:5:1: 'bulk_drive.kick_speed' cannot be -1; give"},
      {kParticles + "[collapse]\ncontact_time = 0\n",
       "s.toml:4:1: 'collapse.contact_time' cannot be 0; give a number greater than 0"},
      // start
      {kParticles + "[particles.start]\nfile = \"a.csv\"\n",
       "s.toml:4:1: 'particles.start.file' has no meaning without layout = \"file\"; remove it, or "
       "set"},
      {kParticles + "[particles.start]\nlayout = \"file\"\n",
       "s.toml:3:1: 'particles.start.file' is missing"},
      {kParticles + "[particles.start]\nlayout = \"file\"\nfile = \"a.csv\"\ntemperature = 1\n",
       "s.toml:6:1: 'particles.start.temperature' has no meaning beside layout = \"file\""},
      {kParticles + "friction = 1\n[particles.start]\nlayout = \"file\"\nfile = \"a.csv\"\n"
                    "spin_temperature = 1\n",
       "s.toml:7:1: 'particles.start.spin_temperature' has no meaning beside layout = \"file\""},
      {kParticles + "[particles.start]\nlayout = \"file\"\nfile = \"nowhere/a.csv\"\n",
       "s.toml:5:1: there is no file 'nowhere/a.csv'; name a CSV file, relative to"},
      // the number of particles
      {"", "s.toml: the number of particles is missing; give exactly one of"},
      {"title = \"a\"\n[particles]\n", "s.toml:2:1: the number of particles is missing"},
      {kParticles + "area_fraction = 0.3\n",
       "s.toml:3:1: both 'particles.count' and 'particles.area_fraction' are given; give exactly "
       "one of"},
      {"[box]\nsize = [2.5, 3.5]\n[particles]\ncount = 9\n",
       "s.toml:4:1: 9 particles have no place on a lattice in the box; give at most 8"},
      {"[box]\nsize = [2.5, 3.5]\n[particles]\ncount = 8\n[walls.left]\nkind = \"sawtooth\"\n"
       "stroke = 1\nfrequency = 1\n[walls.right]\nkind = \"static\"\n",
       "s.toml:4:1: 8 particles have no place on a lattice in the box where its walls move "
       "farthest in; give at most 4"},
      {"[particles]\narea_fraction = 0.95\n",
       "s.toml:2:1: 605 particles have no place on a lattice in the box; give at most "},
      {"[particles]\ncount = 2000000000\n",
       "s.toml:2:1: 2000000000 particles have no place on a lattice in the box; give at most "},
  };
  for (const Case& mistake : cases) {
    CAPTURE(mistake.text);
    CAPTURE(mistake.message);
    const std::string what = refusal(mistake.text);
    CAPTURE(what);
    CHECK(what.starts_with(mistake.message));
  }
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
