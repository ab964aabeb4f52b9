// The lists, boxes and buttons of the window's panels: each sets its own key.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/scene/scene_file.h"
#include "render/colour_range.h"
#include "tests/support/messages.h"
#include "tests/window/panel_actions.h"

namespace clatter {

using nlohmann::json;
using testing::says;

TEST_CASE("Panels: buttons turn the view of spheres, and boxes choose its slices") {
  PanelDriver driver(uneven_spheres(), all_panels);
  struct Direction {
    const char* button;
    double azimuth, elevation;
  };
  // From a corner all axes make the same angle with the line of sight, of cosine 1/sqrt(3).
  for (const auto& [button, azimuth, elevation] :
       {Direction{"view.from.x", 90.0, 0.0}, Direction{"view.from.y", 0.0, 90.0},
        Direction{"view.from.z", 0.0, 0.0},
        Direction{"view.from.iso", 45.0, std::asin(1.0 / std::sqrt(3.0)) * 180.0 / M_PI}}) {
    tick(driver, button);
    CHECK(settings(driver).at("/view/azimuth") == doctest::Approx(azimuth));
    CHECK(settings(driver).at("/view/elevation") == doctest::Approx(elevation));
  }
  tick(driver, "view.slices.y");
  CHECK(settings(driver).at("/view/slices/2/position") == 11.5);
  tick(driver, "view.slices.x");
  CHECK(settings(driver).at("/view/slices/0/axis") == "z");
  CHECK_FALSE(settings(driver).contains("/view/slices/2/axis"));
  choose(driver, "view.slab.axis", "none");
  CHECK_FALSE(settings(driver).contains("/view/slab/axis"));
  choose(driver, "view.slab.axis", "x");
  CHECK(settings(driver).at("/view/slab/to") == 9.5);
  choose(driver, "walls.back", "periodic");
  CHECK_FALSE(settings(driver).contains("/walls/front/kind"));
  CHECK(settings(driver).at("/walls/bottom/kind") == "thermal");
  choose(driver, "view.colour_by", "depth");
  CHECK(settings(driver).at("/view/colour_by") == "depth");
}

TEST_CASE("Panels: the dimension is chosen in a list, and undo starts the former scene") {
  PanelDriver driver(uneven_spheres(), all_panels);
  const auto starts = [&](std::uint64_t run) {
    driver.wait_for([run](const Frame& frame) { return frame.run == run; });
    return settings(driver);
  };
  starts(1);
  choose(driver, "dimension", "2: disks");
  const json disks = starts(2);
  CHECK(driver.session().frame().snapshot.positions.rows() == 2);
  CHECK(says(driver.session().message(), "walls.back, walls.front"));
  CHECK(disks.at("/particles/count") == 14);
  CHECK_FALSE(disks.contains("/box/size/2"));
  driver.session().undo();
  const json again = starts(3);
  CHECK(again.at("/box/size/2") == 21.0);
  CHECK(again.at("/walls/back/kind") == "thermal");
  CHECK(again.at("/view/slab/to") == 17.5);
  driver.session().redo();
  CHECK_FALSE(starts(4).contains("/box/size/2"));
  choose(driver, "dimension", "3: spheres");
  const json cube = starts(5);
  CHECK(cube.at("/box/size/2") == cube.at("/box/size/1"));
}

TEST_CASE("Panels: every word of a list sets its own key to itself") {
  struct List {
    const char* key;
    std::vector<const char*> words;
  };
  for (const auto& [key, words] :
       {List{"view.colour_by", {"none", "speed", "velocity x", "spin"}},
        List{"view.palette", {"viridis", "inferno"}},
        List{"view.field", {"density", "velocity y", "temperature x"}},
        List{"view.field_palette", {"grey", "cividis"}}, List{"view.field_style", {"cells"}},
        List{"view.arrows", {"velocity"}}, List{"view.theme", {"dark", "projector"}},
        List{"walls.left", {"static", "thermal", "sawtooth", "sinusoidal"}},
        List{"walls.right", {"driven", "thermal"}}, List{"walls.bottom", {"sawtooth"}},
        List{"walls.top", {"static"}}}) {
    for (const std::string word : words) {
      CAPTURE(key);
      CAPTURE(word);
      PanelDriver driver(uneven_disks(), all_panels);
      const json before = settings(driver);
      choose(driver, key, word);
      const json after = settings(driver);
      std::string place = '/' + std::string(key), value = word;
      std::ranges::replace(place, '.', '/');
      std::ranges::replace(value, ' ', '_');
      const bool wall = place.starts_with("/walls");
      CHECK(after.at(wall ? place + "/kind" : place) == value);
      for (const std::string& changed : changes(before, after)) {
        CHECK(changed.starts_with(place));
      }
    }
  }
}

TEST_CASE("Panels: the first item of a list removes the feature") {
  PanelDriver driver(uneven_disks(), all_panels);
  const json before = settings(driver);
  choose(driver, "view.arrows", "none");
  CHECK(changes(before, settings(driver)) == Places{"/view/arrows"});
  choose(driver, "view.field", "none");
  CHECK_FALSE(settings(driver).contains("/view/field"));
  // The opposite side becomes periodic too.
  choose(driver, "walls.bottom", "periodic");
  CHECK_FALSE(settings(driver).contains("/walls/bottom/kind"));
  CHECK_FALSE(settings(driver).contains("/walls/top/kind"));
  CHECK(settings(driver).at("/walls/left/kind") == "driven");
  CHECK(settings(driver).at("/walls/right/kind") == "static");
}

TEST_CASE("Panels: \"none\" is also a name in scenes, as in the lists") {
  const Scene scene =
      parse_scene("[particles]\ncount = 5\n[view]\nfield = 'density'\narrows = 'velocity'\n", "",
                  {{"view.field", "\"none\""}, {"view.arrows", "\"none\""}});
  CHECK_FALSE(scene.view.field);
  CHECK_FALSE(scene.view.arrows);
}

TEST_CASE("Panels: ranges are automatic, locked or given from the one number to the other") {
  struct Range {
    const char* key;
    const char* place;
  };
  for (const auto& [key, place] :
       {Range{"view.range", "/view/range"}, Range{"view.field_range", "/view/field_range"}}) {
    CAPTURE(key);
    PanelDriver driver(uneven_disks(), all_panels);
    const json before = settings(driver);
    choose(driver, key, "locked");
    CHECK(settings(driver).at(place) == "locked");
    choose(driver, key, "auto");
    for (const std::string& changed : changes(before, settings(driver))) {
      CHECK(changed.starts_with(place));
    }
    choose(driver, key, "given");
    CHECK(changes(before, settings(driver)).empty());
  }
}

TEST_CASE("Panels: a range that becomes given has round ends around the values") {
  Scene scene = uneven_disks();
  scene.view.range = scene.view.field_range = {};
  for (const bool signs : {false, true}) {
    CAPTURE(signs);
    scene.view.field = signs ? Field(Quantity::Velocity, 0) : Field(Quantity::Density);
    scene.view.colour_by = signs ? ColourBy::VelocityY : ColourBy::Speed;
    PanelDriver driver(scene, all_panels);
    driver.session().play_until(1.0);
    driver.wait_for([](const Frame& frame) { return frame.snapshot.time == 1.0; });
    choose(driver, "view.field_range", "given");
    choose(driver, "view.range", "given");
    const View& view = driver.session().view();
    const std::optional<FieldMap> map = driver.session().frame().snapshot.field;
    REQUIRE(map);
    double most = 0.0;
    for (const double value : map->values) {
      if (std::isfinite(value)) most = std::max(most, std::fabs(value));
    }
    CHECK(view.field_range.ends[0] == (signs ? -view.field_range.ends[1] : 0.0));
    CHECK(view.field_range.ends[1] >= most);
    CHECK(view.field_range.ends[1] <= 2.5 * most);
    const double speed =
        std::sqrt(driver.session().frame().snapshot.velocities.colwise().squaredNorm().mean());
    CHECK(view.range.ends[0] == (signs ? -view.range.ends[1] : 0.0));
    CHECK(view.range.ends[1] >= 1.9 * speed);
    CHECK(view.range.ends[1] <= 2.6 * 2.0 * speed);
    for (const double end : {view.field_range.ends[1], view.range.ends[1]}) {
      CHECK(round_up(end) == end);
    }
  }
}

TEST_CASE("Panels: every box to tick switches its own key") {
  const auto changed_by = [](const char* key) {
    PanelDriver driver(uneven_disks(), all_panels);
    const json before = settings(driver);
    tick(driver, key);
    return changes(before, settings(driver));
  };
  CHECK(changed_by("view.grid") == Places{"/view/grid"});
  CHECK(changed_by("view.overlay") == Places{"/view/overlay"});
  CHECK(changed_by("contact_time") == Places{"/collapse/contact_time"});
}

TEST_CASE("Panels: a box of disks with a periodic axis can be repeated beyond its edges") {
  const auto offers = [](const Scene& scene) {
    PanelDriver driver(scene, all_panels);
    return says(text_of(driver), "Repeat beyond edges");
  };
  Scene scene = uneven_disks();
  CHECK_FALSE(offers(scene));
  scene.walls[kLeft].reset();
  scene.walls[kRight].reset();
  CHECK(offers(scene));
  PanelDriver driver(scene, all_panels);
  const json before = settings(driver);
  tick(driver, "view.tiling");
  CHECK(changes(before, settings(driver)) == Places{"/view/tiling"});
  scene = uneven_disks();
  scene.walls[kBottom].reset();
  scene.walls[kTop].reset();
  CHECK(offers(scene));
  scene = uneven_spheres();
  scene.walls.fill({});
  CHECK_FALSE(offers(scene));
}

TEST_CASE("Panels: spins go with their keys, and come back with the numbers that they had") {
  Scene scene = uneven_disks();
  scene.particles.inertia = 0.45;
  scene.particles.start.spin_temperature = 0.7;
  scene.bulk_drive->kick_spin = 0.9;
  PanelDriver driver(scene, all_panels);
  const json before = settings(driver);
  tick(driver, "rough");
  CHECK(driver.session().message().empty());
  CHECK(changes(before, settings(driver)) ==
        Places{"/particles/friction", "/particles/tangential_restitution", "/bulk_drive/kick_spin",
               "/particles/inertia", "/particles/start/spin_temperature"});
  tick(driver, "rough");
  CHECK(changes(before, settings(driver)) ==
        Places{"/particles/friction", "/particles/tangential_restitution"});
}

TEST_CASE("Panels: colours and fields of spins go with the spins, and come back with undo") {
  Scene scene = uneven_disks();
  scene.view.colour_by = ColourBy::Spin;
  scene.view.field = Field(Quantity::Spin);
  scene.measure.fields = {Field(Quantity::Spin)};
  PanelDriver driver(scene, all_panels);
  tick(driver, "rough");
  const auto smooth = [](const Frame& frame) { return !frame.scene->spins(); };
  driver.wait_for([&](const Frame& frame) { return frame.run == 1 && smooth(frame); });
  CHECK(driver.session().message().empty());
  CHECK(driver.session().view().colour_by == ColourBy::Speed);
  CHECK_FALSE(driver.session().view().field);
  // The scene that would be saved is complete.
  const auto recorded_scene = [](const Session& of) {
    return parse_scene(scene_to_toml(of.recorded(of.frame())), "");
  };
  CHECK(recorded_scene(driver.session()).changes.size() == 1);
  driver.session().undo();
  driver.wait_for([&](const Frame& frame) { return !smooth(frame); });
  CHECK(driver.session().message().empty());
  CHECK(driver.session().view().colour_by == ColourBy::Spin);
  CHECK(driver.session().view().field == Field(Quantity::Spin));
  CHECK(recorded_scene(driver.session()).changes.size() == 2);
}

TEST_CASE("Panels: undo after another scene was opened returns to the changed scene") {
  PanelDriver driver(uneven_disks(), all_panels);
  const auto opened = [](std::uint64_t run) {
    return [run](const Frame& frame) { return frame.run == run; };
  };
  driver.wait_for(opened(1));
  tick(driver, "rough");
  const json changed = settings(driver);
  driver.session().open(Scene{}, 7, false);
  CHECK(says(driver.session().message(), "Ctrl+Z returns to"));
  driver.wait_for(opened(2));
  CHECK(driver.session().frame().seed == 7);
  driver.session().undo();
  driver.wait_for(opened(3));
  CHECK(changes(changed, settings(driver)).empty());
  CHECK(driver.session().frame().seed == 1);
  driver.session().redo();
  driver.wait_for(opened(4));
  CHECK(driver.session().frame().seed == 7);
}

TEST_CASE("Panels: a drag changes a halted gas once, at a time with few digits") {
  PanelDriver driver(uneven_disks(), all_panels);
  driver.session().set_speed(2.0);
  driver.session().play_until(M_PI);
  driver.wait_for([](const Frame& frame) { return frame.snapshot.time == M_PI; });
  const auto [x, y, width, height] = driver.place("particles.restitution");
  driver.drag(x + 0.8f * width, y + 0.5f * height, x + 0.3f * width);
  driver.wait_for([](const Frame& frame) { return !frame.scene->changes.empty(); });
  const std::vector<Change> changes = driver.session().frame().scene->changes;
  CHECK(changes.size() == 1);
  // A frame has 2/60 = 0.033 time units, so the times are multiples of 0.001.
  CHECK(changes[0].time == 3.142);
  // A change at the same time again.
  driver.drag(x + 0.3f * width, y + 0.5f * height, x + 0.4f * width);
  driver.wait_for([](const Frame& frame) { return frame.scene->changes.size() > 1; });
  CHECK(driver.session().frame().scene->changes[1].time == 3.142);
}

TEST_CASE("Panels: a feature starts with its usual numbers when switched on") {
  Scene scene = uneven_disks();
  scene.particles.roughness = {};
  scene.contact_time.reset();
  scene.bulk_drive.reset();
  scene.view.estimator = Estimator::Exact;
  PanelDriver driver(scene, all_panels);
  tick(driver, "rough");
  tick(driver, "contact_time");
  tick(driver, "bulk_drive");
  const json after = settings(driver);
  CHECK(after.at("/particles/friction") == 0.5);
  CHECK(after.at("/particles/tangential_restitution") == 0.5);
  CHECK(after.at("/collapse/contact_time") == 1e-5);
  CHECK(after.at("/bulk_drive/interval") == 0.05);
  CHECK(after.at("/bulk_drive/kick_speed") == 0.1);
  choose(driver, "walls.bottom", "sawtooth");
  CHECK(settings(driver).at("/walls/bottom/stroke") == 0.2);
  CHECK(settings(driver).at("/walls/bottom/frequency") == 2.0);
  choose(driver, "walls.right", "driven");
  CHECK(settings(driver).at("/walls/right/drive_speed") == 1.0);
  CHECK(settings(driver).at("/walls/right/restitution") == 0.73);
  choose(driver, "view.estimator", "snapshot  x1.1");
  CHECK(settings(driver).at("/view/estimator") == "snapshot");
}

}  // namespace clatter
