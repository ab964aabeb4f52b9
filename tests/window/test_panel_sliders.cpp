// The sliders of the window's panels: each sets the value of its own key.

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"
#include "tests/window/panel_actions.h"

namespace clatter {

using nlohmann::json;
using testing::says;

namespace {

struct SliderMeaning {
  const char* key;
  const char* place;  // position in the scene
  double low, high;
  const char* line;  // with its value when the scene is opened
  bool logarithmic = false;
};

const std::vector<SliderMeaning> kSliders = {
    {"particles.restitution", "/particles/restitution", 0.0, 1.0, "Restitution α 0.810"},
    {"particles.friction", "/particles/friction", 0.0, 2.0, "Friction μ 0.420"},
    {"particles.tangential_restitution", "/particles/tangential_restitution", -1.0, 1.0,
     "Tangential β₀ 0.530"},
    {"box.size.x", "/box/size/0", 4.0, 100.0, "Width Lx 19.0 a"},
    {"box.size.y", "/box/size/1", 4.0, 100.0, "Height Ly 23.0 a"},
    {"walls.left.drive_speed", "/walls/left/drive_speed", 0.0, 5.0, "Drive speed v_dr 1.500 a/t"},
    {"walls.left.restitution", "/walls/left/restitution", 0.0, 1.1, "Restitution α_w 0.940"},
    {"walls.right.restitution", "/walls/right/restitution", 0.0, 1.1, "Restitution α_w 0.730"},
    {"walls.bottom.temperature", "/walls/bottom/temperature", 0.0, 10.0,
     "Temperature T_w 2.500 m a²/t²"},
    {"walls.top.stroke", "/walls/top/stroke", 0.0, 4.0, "Stroke 0.310 a"},
    {"walls.top.frequency", "/walls/top/frequency", 0.0, 10.0, "Frequency f 1.120 1/t"},
    {"walls.top.restitution", "/walls/top/restitution", 0.0, 1.1, "Restitution α_w 0.860"},
    {"gravity.acceleration.x", "/gravity/acceleration/0", -2.0, 2.0,
     "Gravity along x g_x 0.150 a/t²"},
    {"gravity.acceleration.y", "/gravity/acceleration/1", -2.0, 2.0,
     "Gravity along y g_y -0.470 a/t²"},
    {"bulk_drive.kick_speed", "/bulk_drive/kick_speed", 0.0, 1.0, "Kicks s 0.220 a/t"},
    {"view.opacity", "/view/opacity", 0.0, 1.0, "Opacity 0.65"},
    {"view.trails", "/view/trails", 0.0, 5.0, "Trails 0.25 t"},
    {"view.tracer.time", "/view/tracer/time", 0.1, 1000.0, "Path of the tracer 3.5 t", true},
    {"collapse.contact_time", "/collapse/contact_time", 1e-9, 0.1, "Duration t_c 2.0e-04 t", true},
    {"view.interval", "/view/interval", 0.01, 4.0, "Snapshots every 0.300 t", true},
    {"view.window", "/view/window", 0.1, 100.0, "Averaged over 4.00 t", true}};

// Those that only spheres have.
const std::vector<SliderMeaning> kSphereSliders = {
    {"box.size.z", "/box/size/2", 4.0, 100.0, "Depth Lz 21.0 a"},
    {"walls.back.temperature", "/walls/back/temperature", 0.0, 10.0,
     "Temperature T_w 1.750 m a²/t²"},
    {"walls.front.drive_speed", "/walls/front/drive_speed", 0.0, 5.0, "Drive speed v_dr 0.650 a/t"},
    {"walls.front.restitution", "/walls/front/restitution", 0.0, 1.1, "Restitution α_w 0.950"},
    {"gravity.acceleration.z", "/gravity/acceleration/2", -2.0, 2.0,
     "Gravity along z g_z 0.290 a/t²"},
    {"view.view_angle", "/view/view_angle", 0.0, 90.0, "Angle of view 35 °"},
    {"view.slab.from", "/view/slab/from", 0.0, 17.4, "From 2.5 a"},
    {"view.slab.to", "/view/slab/to", 2.6, 23.0, "To 17.5 a"},
    {"view.volume", "/view/volume", 0.0, 5.0, "Volume 0.75 1/a"},
    {"view.slices.x.position", "/view/slices/0/position", 0.0, 19.0, "Position 4.5 a"},
    {"view.slices.z.position", "/view/slices/1/position", 0.0, 21.0, "Position 6.5 a"}};

// Those of the species that is chosen in the panel, the first, and of its pairs.
const std::vector<SliderMeaning> kSpeciesSliders = {
    {"species.fine.count", "/species/0/count", 1.0, 10000.0, "Disks N 40", true},
    {"species.fine.diameter", "/species/0/diameter", 0.1, 10.0, "Diameter d 0.60 a", true},
    {"species.fine.mass", "/species/0/mass", 0.01, 1000.0, "Mass m 3 m", true},
    {"pair.fine.coarse.restitution", "/pair/0/restitution", 0.0, 1.0, "α with coarse 0.710"}};

Scene sieve() {
  return parse_scene(R"(box.size = [200, 200]
      [particles]
      restitution = 0.9
      [[species]]
      name = "fine"
      count = 40
      diameter = 0.6
      mass = 3.0
      [[species]]
      name = "coarse"
      count = 10
      diameter = 1.5
      [[pair]]
      species = ["coarse", "fine"]
      restitution = 0.71)",
                     "sieve.toml");
}

// The number in a line, as a word.
std::string number_in(const std::string& line) {
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    char* end = nullptr;
    std::strtod(word.c_str(), &end);
    if (!*end) return word;
  }
  return "none";
}

void check_sliders(const Scene& scene, const std::vector<SliderMeaning>& sliders) {
  for (const SliderMeaning& slider : sliders) {
    CAPTURE(slider.place);
    PanelDriver driver(scene, all_panels);
    CHECK(says(text_of(driver), slider.line));
    const json before = settings(driver);
    auto [x, y, width, height] = driver.place(slider.key);
    const float middle = y + 0.5f * height;
    driver.drag(x + 0.5f * width, middle, x + 0.75f * width);
    const json after = settings(driver);
    CHECK(changes(before, after) == Places{slider.place});
    const double value = after.at(slider.place);
    if (slider.logarithmic) {
      const double decades = std::log10(slider.high / slider.low);
      CHECK(std::log10(value / slider.low) == doctest::Approx(0.75 * decades).epsilon(0.05));
    } else {
      CHECK(std::fabs(value - slider.low - 0.75 * (slider.high - slider.low)) <
            0.02 * (slider.high - slider.low));
    }
    // While the mouse is over it, its tooltip has the value from the opening of the scene.
    const std::string told = text_of(driver);
    const std::string line = slider.line;
    const std::string usual = line.substr(line.find(number_in(line)));
    CHECK(says(told, "Here: " + usual));
    CHECK_FALSE(says(told, slider.line));

    // The round reset arrow above its right end.
    driver.click(x + width - 7.0f, y - 10.0f);
    CHECK(changes(before, settings(driver)).empty());
  }
}

}  // namespace

TEST_CASE("Panels: every slider sets the value of its own key, within its range, and back") {
  check_sliders(uneven_disks(), kSliders);
}

TEST_CASE("Panels: each slider of spheres changes its key, and disks lack these sliders") {
  check_sliders(uneven_spheres(), kSliders);
  check_sliders(uneven_spheres(), kSphereSliders);
  PanelDriver disks(uneven_disks(), all_panels);
  const std::string text = text_of(disks);
  for (const char* word : {"Depth", "Back", "Front", "along z", "View from", "Angle of view",
                           "Slab", "Slice", "pheres colo", "olume"}) {
    CAPTURE(word);
    CHECK_FALSE(says(text, word));
  }
}

TEST_CASE("Panels: each slider of a species sets the key of this species or of its pair") {
  check_sliders(sieve(), kSpeciesSliders);
  PanelDriver driver(sieve(), gas_panel);
  CHECK_FALSE(says(text_of(driver), "Disks N 10"));
  choose(driver, "species", "coarse");
  driver.point_at(0.0f, 0.0f);
  const std::string text = text_of(driver);
  CHECK(says(text, "Disks N 10"));
  CHECK(says(text, "α with fine 0.710"));
  CHECK(says(text, "α with coarse 0.900"));
}

TEST_CASE("Panels: a click or a double click on a slider changes nothing") {
  PanelDriver driver(uneven_disks(), all_panels);
  const json before = settings(driver);
  for (const char* key : {"particles.count", "particles.restitution", "box.size.x"}) {
    CAPTURE(key);
    const auto [x, y, width, height] = driver.place(key);
    driver.click(x + 0.2f * width, y + 0.5f * height);
    CHECK(changes(before, settings(driver)).empty());
  }
}

TEST_CASE("Panels: all widgets of the script log have names of their own") {
  PanelDriver driver(uneven_spheres(), all_panels);
  text_of(driver);
  const std::size_t told = driver.widgets_told();
  text_of(driver);
  // An unchanged picture is not logged again, unless two widgets share a name.
  CHECK(driver.widgets_told() == told);
}

TEST_CASE("Panels: a number of disks is set once its slider is let go") {
  PanelDriver driver(uneven_disks(), all_panels);
  const json before = settings(driver);
  const auto [x, y, width, height] = driver.place("particles.count");
  driver.drag(x + 0.5f * width, y + 0.5f * height, x + 0.75f * width);
  CHECK(changes(before, settings(driver)) == Places{"/particles/count"});
  // Logarithmic, up to the largest number that fits.
  const int count = settings(driver).at("/particles/count");
  CHECK(count > 80);
  CHECK(count < 110);
  CHECK(says(text_of(driver), "Disks N " + std::to_string(count)));
}

}  // namespace clatter
