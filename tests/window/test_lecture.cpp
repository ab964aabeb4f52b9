// Lecture mode: its sliders, plots, tools and playlists.

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "app/plots/plots.h"
#include "app/view/lecture.h"
#include "app/view/lecture_tools.h"
#include "app/view/playlist.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"
#include "render/typography/gui_context.h"
#include "tests/support/temporary_folder.h"
#include "tests/window/gui_driver.h"
#include "tests/window/offscreen_window.h"

namespace clatter {

using nlohmann::json;
using namespace std::chrono_literals;

TEST_CASE("Lecture: the sliders of a scene are its restitution and drive") {
  using Names = std::vector<std::string>;
  CHECK(usual_sliders(load_scene("vibrated")) ==
        Names{"particles.restitution", "walls.left.drive_speed", "walls.right.drive_speed"});
  CHECK(usual_sliders(load_scene("shaker")) ==
        Names{"particles.restitution", "walls.bottom.frequency", "gravity.acceleration.y"});
  Scene scene = load_scene("cooling");
  scene.particles.restitution = 1.0;
  CHECK(usual_sliders(scene) == Names{"particles.restitution", "particles.count"});
  scene.walls[kTop] = Wall{.kind = WallKind::Thermal, .temperature = 2.0};
  scene.bulk_drive = BulkDrive{};
  CHECK(usual_sliders(scene) ==
        Names{"walls.top.temperature", "bulk_drive.kick_speed", "particles.restitution"});
}

TEST_CASE(
    "Lecture: each scene has the slider of its suggestion, and a plot a third as high as the "
    "window") {
  for (const auto& [scene, slider] : std::vector<std::pair<std::string, std::string>>{
           {"shaker", "walls.bottom.stroke"},
           {"spheres_leidenfrost", "walls.bottom.stroke"},
           {"brazil_nut", "walls.bottom.stroke"},
           {"rough_driven", "particles.friction"},
           {"spheres_rough", "particles.friction"},
           {"rough_cooling", "particles.tangential_restitution"},
           {"dense", "box.size.x"},
           {"couette", "walls.top.surface_velocity.x"},
           {"ratchet", "gravity.acceleration.x"},
           {"barometer", "walls.bottom.temperature"},
           {"conduction", "walls.right.temperature"},
           {"mixed_atmosphere", "gravity.acceleration.y"},
           {"bow_shock", "gravity.acceleration.x"},
           {"vibrated", "particles.restitution"}}) {
    CAPTURE(scene);
    Scene played = load_scene(scene);
    played.view.speed = 100.0;
    OffscreenWindow window(played, 1280.0f, 720.0f, 2.0);
    window.press('l');
    window.press_key(GLFW_KEY_SPACE);  // a profile begins when it is first shown
    CHECK(window.comes_to([&] { return !window.text("lecture/plot").empty(); }));
    window.draw();
    // In the column of the plot, not in a panel.
    CHECK(window.place(slider)[0] >= window.place("lecture.plot")[0]);
    CHECK(window.place("lecture.plot")[3] >= 240.0f);
  }
}

TEST_CASE("Lecture: letters are at least 2.5 % of the height of the window") {
  for (const auto& [width, height] : {std::pair(1280.0f, 720.0f), std::pair(1920.0f, 1080.0f)}) {
    OffscreenWindow window(load_scene("vibrated"), width, height);
    window.press('l');
    CAPTURE(height);
    CHECK(ImGui::GetIO().FontDefault->FontSize >= 0.025f * height);
  }
}

TEST_CASE("Lecture: a stopwatch starts, stops with its times, and returns to zero") {
  const Stopwatch::Clock::time_point start{};
  Stopwatch watch;
  CHECK(watch.at_zero());
  CHECK(watch.read(7.0, start).seconds == 0.0);
  watch.press(10.0, start);
  CHECK(watch.runs());
  CHECK(watch.read(13.5, start + 2500ms).simulated == 3.5);
  CHECK(watch.read(13.5, start + 2500ms).seconds == 2.5);
  // After a jump into the past.
  CHECK(watch.read(9.0, start + 3s).simulated == -1.0);
  watch.press(14.0, start + 4s);
  CHECK(!watch.runs());
  CHECK(watch.read(99.0, start + 60s).simulated == 4.0);
  CHECK(watch.read(99.0, start + 60s).seconds == 4.0);
  watch.press(99.0, start + 60s);
  CHECK(watch.at_zero());
  CHECK(watch.read(99.0, start + 60s).simulated == 0.0);
}

TEST_CASE("Lecture: ink is opaque at first, fades, and is removed") {
  FadingInk ink(8.0, 2.0);
  CHECK(ink.opacity(1.0, 1.0) == 1.0f);
  CHECK(ink.opacity(1.0, 7.0) == 1.0f);
  CHECK(ink.opacity(1.0, 8.0) == doctest::Approx(0.5));
  CHECK(ink.opacity(1.0, 9.5) == 0.0f);
  CHECK(!ink.visible());
  ink.draw_to(ImVec2(10, 10), 0.0);
  ink.draw_to(ImVec2(30, 10), 1.0);
  ink.update(8.5);
  CHECK(ink.visible());
  ink.update(9.0);
  CHECK(!ink.visible());
}

// A part of the line joins two places, unless the pen was lifted between them.
TEST_CASE("Lecture: a painted line fades, and a lifted pen begins another line") {
  const GuiContext context = make_gui_context();
  const CurrentContext current(context.get());
  ImGui::GetIO().DisplaySize = ImVec2(100.0f, 100.0f);
  ImGui::GetIO().Fonts->Build();
  struct Painted {
    int vertices;
    ImU32 opacity;  // the largest of a vertex, 0..255
  };
  const auto painted = [&](bool lifts, double now) {
    FadingInk ink(8.0, 2.0);
    ink.draw_to(ImVec2(10, 10), 0.0);
    if (lifts) ink.lift();
    ink.draw_to(ImVec2(30, 10), 0.1);
    ImGui::NewFrame();
    const ImDrawList& list = *ImGui::GetForegroundDrawList();
    ink.paint(*ImGui::GetForegroundDrawList(), IM_COL32_WHITE, 4.0f, now);
    Painted result{list.VtxBuffer.Size, 0};
    for (const ImDrawVert& vertex : list.VtxBuffer) {
      result.opacity = std::max(result.opacity, vertex.col >> IM_COL32_A_SHIFT);
    }
    ImGui::EndFrame();
    return result;
  };
  CHECK(painted(false, 0.2).vertices > painted(true, 0.2).vertices);
  CHECK(painted(false, 0.2).opacity == 255);
  // The younger place has half its opacity one second before its end.
  CHECK(painted(false, 7.1).opacity == 128);
}

TEST_CASE("Lecture: each name of a plot is that of its plot") {
  Frame frame;
  frame.scene = std::make_shared<const Scene>(load_scene("vibrated"));
  frame.snapshot.box = Vec2(20.0, 25.0);
  const auto title = [&](LecturePlot which) {
    const History history{};
    const auto plot = lecture_plot(which, {{&history, &frame, ""}}, 0, kDarkTheme);
    return plot ? plot->title : "";
  };
  CHECK(title(LecturePlot::None).empty());
  CHECK(title(LecturePlot::Temperature) == "Temperature");
  CHECK(title(LecturePlot::Energy) == "Energy per time");
  CHECK(title(LecturePlot::Velocities) == "Velocities");
  CHECK(title(LecturePlot::Profile).empty());  // before the first profile
}

TEST_CASE("Playlist: scenes of the gallery, of its folder, and with settings") {
  const testing::TemporaryFolder folder;
  folder.write("mine.toml", "title = \"Mine\"\nparticles.count = 3\n");
  const auto list = load_playlist(
      folder.write("list.toml",
                   "schema = 1\nscenes = [\"cradle\", \"mine.toml\",\n"
                   "  { scene = \"vibrated\", set = { \"particles.count\" = 7 }, seed = 5 }]\n"));
  REQUIRE(list.size() == 3);
  CHECK(list[0].scene.title == "Newton's cradle");
  CHECK(!list[0].seed);
  CHECK(list[1].scene.title == "Mine");
  CHECK(list[2].scene.title == "Vibrated box");
  CHECK(list[2].scene.particles.count == 7);
  CHECK(list[2].seed == 5u);
}

TEST_CASE("Playlist: each mistake is refused at its place") {
  const auto error = [](const std::string& text) -> std::string {
    try {
      read_playlist(text, "list.toml");
    } catch (const UserError& error) {
      return error.what();
    }
    return "none";
  };
  struct Case {
    const char* text;
    const char* message;
  };
  for (const auto& [text, message] :
       {Case{"scenes = [\"cradle\",\n  \"nosuch\"]", "list.toml:3:3: nosuch"},
        Case{"scenes = [3]", "list.toml:2:11: 3"}, Case{"scenes = []", "list.toml:2:10: 'scenes'"},
        Case{"", "'scenes' is missing"}, Case{"scene = [\"cradle\"]", "did you mean 'scenes'?"},
        Case{"scenes = [{ seed = 1 }]", "list.toml:2:11: a scene has no name"},
        Case{"scenes = [{ scene = \"cradle\", seeds = 1 }]", "list.toml:2:39: unknown key"},
        Case{"scenes = [{ scene = \"cradle\", seed = -1 }]", "list.toml:2:38: 'seed'"},
        Case{"scenes = [{ scene = \"vibrated\", set = { \"particles.count\" = -7 } }]",
             "list.toml:2:11: 'particles.count'"},
        Case{"scenes = [\"cradle\"", "list.toml:2"}}) {
    const std::string found = error("schema = 1\n" + std::string(text));
    CAPTURE(text);
    CAPTURE(found);
    CHECK(says(found, message));
  }
  CHECK(says(error("scenes = [\"cradle\"]"), "'schema' is missing"));
  CHECK(says(error("schema = 2\nscenes = [\"cradle\"]"), "list.toml:1:1: 'schema'"));
}

TEST_SUITE_BEGIN("display");

TEST_CASE("Window: lecture mode has the sliders of the scene, and one drives the gas") {
  const GuiDriver driver(
      "--set 'view.lecture.sliders=[\"walls.left.drive_speed\", \"particles.restitutio\"]'");
  const std::size_t told = driver.told();
  driver.key("l");
  const json message = driver.wait_for("message", told);
  CHECK(
      says(message["text"], "no control \"particles.restitutio\"; try \"particles.restitution\""));
  CHECK(driver.place("lecture.plot", told)[2] > 300.0);
  const std::vector<double> caption = driver.place("lecture.caption", told);
  CHECK(caption[2] > caption[3]);
  driver.drag("walls.left.drive_speed", 0.2, 0.8);
  const json set = driver.wait_for("set", told);
  CHECK(std::stod(set["keys"]["walls.left.drive_speed"].get<std::string>()) > 2.0);
}

TEST_CASE("Window: the targets of lecture mode are at least 44 points high, at every size") {
  const GuiDriver driver("", "800x500");
  const std::size_t told = driver.told();
  driver.key("l");
  for (const char* widget : {"gallery", "previous_scene", "next_scene", "play", "reset",
                             "lecture.timeline", "lecture.pen", "lecture.pointer",
                             "lecture.stopwatch", "lecture.settings", "lecture.close"}) {
    CAPTURE(widget);
    const std::vector<double> place = driver.place(widget, told);
    CHECK(place[2] >= 44.0);
    CHECK(place[3] >= 44.0);
    CHECK(place[0] + place[2] <= 800.0);
    CHECK(place[1] + place[3] <= 500.0);
  }
}

TEST_CASE("Window: the tools of lecture mode: timeline, stopwatch, pen, plot and settings") {
  const GuiDriver driver("");
  driver.key("l");
  std::size_t told = driver.told();
  driver.click("lecture.timeline");
  driver.place("timeline", told);

  told = driver.told();
  driver.key("w");
  const json start = driver.wait_for("stopwatch", told);
  CHECK(start["runs"]);
  told = driver.told();
  driver.click("lecture.stopwatch");
  const json stop = driver.wait_for("stopwatch", told);
  CHECK(!stop["runs"]);
  CHECK(stop["simulated"].get<double>() ==
        doctest::Approx(stop["time"].get<double>() - start["time"].get<double>()));
  // Each event has its real time.
  CHECK(std::fabs(stop["seconds"].get<double>() -
                  (stop["at"].get<double>() - start["at"].get<double>())) < 0.1);

  // The pen leaves a line, and no disk is picked.
  driver.key("d");
  told = driver.told();
  driver.pull("viewport", 60, 40);
  const std::vector<double> viewport = driver.place("viewport");
  const auto middle = [&](int axis) {
    return static_cast<int>(viewport[axis] + 0.5 * viewport[axis + 2]);
  };
  CHECK(driver.pixel(middle(0) + 30, middle(1) + 20) == std::vector<int>{0xd5, 0x5e, 0x00});
  CHECK(driver.events("pick").empty());
  told = driver.told();
  driver.key("e");
  driver.wait_for("picture", told + 4);
  CHECK(driver.pixel(middle(0) + 30, middle(1) + 20) != std::vector<int>{0xd5, 0x5e, 0x00});

  // Another plot and another slider, which the saved scene has.
  driver.click("lecture.settings");
  driver.click("lecture.slider.1");
  driver.click("lecture.slider.1.particles.count");
  driver.click("lecture.plot_of");
  driver.click("lecture.plot_of.velocities");
  told = driver.told();
  driver.key("ctrl+s");
  const Scene saved =
      parse_scene(driver.shell().read(driver.wait_for("saved", told)["file"]), "saved.toml");
  CHECK(saved.view.lecture.sliders == std::vector<std::string>{"particles.count",
                                                               "walls.left.drive_speed",
                                                               "walls.right.drive_speed"});
  CHECK(saved.view.lecture.plot == LecturePlot::Velocities);
}

TEST_CASE("Window: its size scales all texts at once, within the room of lecture mode") {
  const GuiDriver driver("", "1280x1840");
  const auto height = [&](const char* widget, std::size_t told) {
    return driver.place(widget, told)[3];
  };
  const double button = height("play", 0);
  std::size_t told = driver.told();
  driver.click("window.scale.number");
  driver.key("2 period 0");
  driver.key("Return");
  CHECK(height("play", told) == doctest::Approx(2.0 * button).epsilon(0.05));
}

TEST_CASE("Window: a playlist goes forth and back, and has two ends") {
  const testing::TemporaryFolder folder;
  const std::string list = folder.write(
      "list.toml", "schema = 1\nscenes = [\"cradle\", { scene = \"cooling\", seed = 4 }]\n");
  const GuiDriver driver("--playlist " + list);
  CHECK(driver.events("open")[0]["title"] == "Newton's cradle");
  std::size_t told = driver.told();
  driver.key("bracketleft");
  CHECK(says(driver.wait_for("message", told)["text"], "first scene of the playlist"));
  driver.key("l");
  told = driver.told();
  driver.click("next_scene");
  const json next = driver.wait_for("open", told);
  CHECK(next["title"] == "Haff's cooling");
  CHECK(next["seed"] == 4);
  told = driver.told();
  driver.key("bracketright");
  CHECK(says(driver.wait_for("message", told)["text"], "last scene of the playlist"));
  driver.click("previous_scene");
  CHECK(driver.wait_for("open", told)["title"] == "Newton's cradle");
}

TEST_CASE("Window: a scene and a playlist together are refused") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter view vibrated --playlist list.toml");
  CHECK(outcome.code == 2);
  CHECK(says(outcome.err, "--playlist"));
}

TEST_SUITE_END();

}  // namespace clatter
