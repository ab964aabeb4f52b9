// The dialog for films of the run in the window.

#include <doctest/doctest.h>

#include <map>
#include <set>

#include "app/view/film_dialog.h"
#include "render/output/movie_format.h"
#include "tests/support/messages.h"
#include "tests/window/gui_driver.h"
#include "tests/window/panel_actions.h"

namespace clatter {

using nlohmann::json;
using testing::says;

namespace {

using Words = std::vector<std::string>;

// The dialog in a panel, and the action that ended it.
struct ShownDialog {
  FilmDialog dialog;
  FilmDialog::Action action = FilmDialog::Action::None;
  PanelDriver driver{uneven_disks(), [this](Session&, Controls& controls) {
                       const auto now = dialog.draw(controls);
                       if (now != FilmDialog::Action::None) action = now;
                     }};

  void open(const FilmedRun& run, const std::string& file) {
    dialog.open(run, file);
    // Its place follows from its height, which the first pictures determine.
    for (int picture = 0; picture < 3; ++picture) driver.lines();
  }
};

}  // namespace

TEST_CASE("Film dialog: its formats are those of films, with their sound and transparency") {
  const std::map<std::string, std::string> names = {
      {".gif", "GIF"}, {".mkv", "MKV"}, {".mov", "MOV"}, {".mp4", "MP4"}, {".webm", "WebM"}};
  std::set<std::string> extensions;
  for (const FilmFormat& offered : film_formats()) {
    CAPTURE(offered.extension);
    const MovieFormat* format = find_movie_format(offered.extension);
    REQUIRE(format);
    CHECK(std::string(offered.use).starts_with(names.at(offered.extension)));
    CHECK(offered.sound == !format->sound.empty());
    CHECK(offered.alpha == !format->clear_pixels.empty());
    extensions.insert(offered.extension);
  }
  CHECK(extensions.size() == names.size());
}

TEST_CASE("Film dialog: the command has all settings, and none that the format lacks") {
  FilmSettings film{.from = 0.0, .to = 12.5, .speed = 2.0, .file = "a.mp4"};
  CHECK(film_command(film, {"s.toml"}, 3) == Words{"clatter", "render", "s.toml", "--seed", "3",
                                                   "--to", "12.5", "--speed", "2", "--out",
                                                   "a.mp4"});
  film = {.from = 1.5,
          .to = 7.0,
          .speed = 0.1,
          .quality = 'h',
          .file = "b.webm",
          .overlay = false,
          .sound = true,
          .motion_blur = true,
          .transparent = true};
  CHECK(film_command(film, {"s.toml"}, 1) == Words{"clatter", "render",
                                                   "s.toml",  "--seed",
                                                   "1",       "--from",
                                                   "1.5",     "--to",
                                                   "7",       "--speed",
                                                   "0.1",     "-qh",
                                                   "--set",   "view.overlay=false",
                                                   "--sound", "--shutter",
                                                   "0.5",     "--transparent",
                                                   "--out",   "b.webm"});
  film.overlay = true;
  film.plots = true;
  const Words plotted = film_command(film, {"s.toml"}, 1);
  const auto set = std::ranges::find(plotted, "--set");
  REQUIRE(set < plotted.end() - 1);
  CHECK(*(set + 1) == R"(view.plots=["temperature", "energy", "density_profile"])");
  film.own_plots = true;
  CHECK(std::ranges::count(film_command(film, {"s.toml"}, 1), "--set") == 0);
  film.plots = false;
  CHECK(std::ranges::count(film_command(film, {"s.toml"}, 1), "view.plots=[]") == 1);
  film.own_plots = false;
  const Words several = film_command(film, {"s.toml", "t.toml"}, 1);
  CHECK(several[3] == "t.toml");
  CHECK(std::ranges::count(several, "--sound") == 1);
  film.file = "b.gif";
  const Words silent = film_command(film, {"s.toml"}, 1);
  CHECK(std::ranges::count(silent, "--sound") == 0);
  CHECK(std::ranges::count(silent, "--transparent") == 0);
  film.file = "b.mp4";
  const Words opaque = film_command(film, {"s.toml"}, 1);
  CHECK(std::ranges::count(opaque, "--sound") == 1);
  CHECK(std::ranges::count(opaque, "--transparent") == 0);
}

TEST_CASE("Film dialog: its buttons choose the whole run or its last 20 seconds") {
  ShownDialog shown;
  shown.open({100.0, 2.0, true}, "no-such-film.mp4");
  const FilmSettings& film = shown.dialog.film();
  CHECK(film.from == 0.0);
  CHECK(film.to == 100.0);
  CHECK(film.speed == 2.0);
  tick(shown.driver, "film.last");
  CHECK(film.from == 60.0);
  CHECK(film.to == 100.0);
  tick(shown.driver, "film.whole");
  CHECK(film.from == 0.0);
  // The run is shorter than 20 seconds.
  shown.open({15.0, 2.0, true}, "no-such-film.mp4");
  tick(shown.driver, "film.last");
  CHECK(film.from == 0.0);
  CHECK(film.to == 15.0);
}

TEST_CASE("Film dialog: the length follows the pace of the scene") {
  ShownDialog shown;
  // The film has half the speed up to t = 100.
  shown.open({100.0, 2.0, true, false, {{0.0, 0.5}, {100.0, 0.5}}}, "no-such-film.mp4");
  CHECK(says(text_of(shown.driver), "Length in s { 100 }"));
}

TEST_CASE("Film dialog: lists and boxes set quality, format and content") {
  ShownDialog shown;
  shown.open({100.0, 2.0, true}, "folder/no-such-film.mp4");
  const FilmSettings& film = shown.dialog.film();
  choose(shown.driver, "film.quality", "854 x 480, 15 per second");
  CHECK(film.quality == 'l');
  choose(shown.driver, "film.quality", "1920 x 1080, 60 per second");
  CHECK(film.quality == 'h');
  CHECK_FALSE(says(text_of(shown.driver), "Transparent"));
  tick(shown.driver, "film.sound");
  CHECK(film.sound);
  choose(shown.driver, "film.format", "WebM, for web pages");
  CHECK(film.file == "folder/no-such-film.webm");
  tick(shown.driver, "film.transparent");
  CHECK(film.transparent);
  tick(shown.driver, "film.overlay");
  CHECK_FALSE(film.overlay);
  tick(shown.driver, "film.blur");
  CHECK(film.motion_blur);
  CHECK_FALSE(film.plots);
  tick(shown.driver, "film.plots");
  CHECK(film.plots);
  choose(shown.driver, "film.format", "GIF, for pages without a player");
  CHECK(film.file == "folder/no-such-film.gif");
  CHECK_FALSE(says(text_of(shown.driver), "Sound"));
  tick(shown.driver, "film.make");
  CHECK(shown.action == FilmDialog::Action::Film);
  CHECK_FALSE(shown.dialog.is_open());
  // The next film has the same form, at the present speed. A view without texts has none to hide.
  shown.open({50.0, 3.0, false}, "other.mp4");
  CHECK(film.file == "other.gif");
  CHECK(film.quality == 'h');
  CHECK(film.speed == 3.0);
  CHECK_FALSE(says(text_of(shown.driver), "figures"));
  tick(shown.driver, "film.command");
  CHECK(shown.action == FilmDialog::Action::CopyCommand);
  shown.open({50.0, 3.0, true, true}, "other.mp4");
  CHECK(film.plots);
  CHECK(film.own_plots);
  tick(shown.driver, "film.cancel");
  CHECK(shown.action == FilmDialog::Action::Cancel);
}

TEST_CASE("Film dialog: each widget has its value and is explained") {
  ShownDialog shown;
  shown.open({100.0, 2.0, true}, "no-such-film.webm");
  const std::string text = text_of(shown.driver);
  CHECK(says(text, "From { 0 } To { 100 } Speed { 2 } Length in s { 50 }"));
  CHECK(says(text, "Pictures { 1280 x 720, 30 per second } Format { WebM, for web pages }"));
  check_explained(shown.driver, {"film.whole", "film.last", "film.from", "film.to", "film.speed",
                                 "film.length", "film.quality", "film.format", "film.file",
                                 "film.overlay", "film.plots", "film.blur", "film.sound",
                                 "film.transparent", "film.make", "film.command", "film.cancel"});
  shown.open({100.0, 2.0, true, true}, "no-such-film.webm");
  check_help(shown.driver, {{"film.plots", "The plots of the scene"}});
}

TEST_CASE("Film dialog: a mistake is named, and makes no film") {
  ShownDialog shown;
  const auto refused = [&](const char* reason) {
    CHECK(says(text_of(shown.driver), reason));
    tick(shown.driver, "film.make");
    tick(shown.driver, "film.command");
    CHECK(shown.action == FilmDialog::Action::None);
    CHECK(shown.dialog.is_open());
  };
  shown.open({10.0, 2.0, true}, "no-such-film.avi");
  refused("must end in one of .mp4, .webm, .gif, .mov, .mkv");
  shown.open({0.0, 2.0, true}, "no-such-film.mp4");
  refused("must end after its start");
  shown.open({10.0, 0.0, true}, "no-such-film.mp4");
  refused("greater than 0");
  const testing::TemporaryFolder folder;
  const std::string file = folder / "a.mp4";
  testing::write_bytes(file, "a film");
  shown.open({10.0, 2.0, true}, file);
  CHECK(says(text_of(shown.driver), "will be replaced"));
}

TEST_SUITE_BEGIN("display");

TEST_CASE("Window: typed times and a typed name make the film") {
  const GuiDriver driver("--until 3", "1280x1840");
  driver.wait_for("status", 0, halted);
  driver.click("film");
  std::size_t told = driver.told();
  const auto type = [&](const char* field, const char* keys) {
    driver.click(field);
    driver.key(keys);
  };
  type("film.from", "1");
  type("film.to", "2 period 5");
  type("film.length", "3");
  type("film.file", "f i l m period g i f");
  // Keys of the window wait.
  driver.key("Tab");
  driver.click("film.command");
  CHECK(driver.wait_for("command", told)["line"] ==
        "clatter render clatter-1.toml --seed 1 --from 1 --to 2.5 --speed 0.5 --out film.gif");
  driver.click("film");
  driver.key("g");
  driver.key("Escape");
  told = driver.told();
  driver.key("g");
  CHECK(driver.wait_for("gallery", told)["open"] == true);
}

TEST_SUITE_END();

}  // namespace clatter
