#include "tests/window/gui_driver.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <thread>

namespace clatter {

using nlohmann::json;
using namespace std::chrono_literals;

// Panels settle, and react to the mouse, within this number of pictures.
static constexpr std::size_t kSettle = 3;
// Longest wait for these pictures: a window without changes draws none, and shaken walls never
// stand still.
static constexpr auto kPatience = 2s;

static void wait_until(const std::function<bool()>& is_so) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!is_so() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(10ms);
}

static std::size_t pictures(const std::string& log, std::size_t from) {
  std::size_t count = 0;
  for (; (from = log.find(R"("event":"picture")", from)) != std::string::npos; ++from) ++count;
  return count;
}

GuiDriver::GuiDriver(const std::string& arguments, const std::string& size,
                     const std::string& screen) {
  const Outcome outcome =
      shell_.run("Xvfb -displayfd 3 -screen 0 " + (screen.empty() ? size : screen) +
                 "x24 3>display >/dev/null 2>&1 & echo $! >xvfb\n"
                 "until [ -s display ]; do sleep 0.05; done");
  REQUIRE(outcome.code == 0);
  display_ = "export DISPLAY=:" + shell_.read("display");
  shell_.run(display_ + "\n(clatter view --size " + size + " --script-log log " + arguments +
             " >out 2>err; echo $? >code) >/dev/null 2>&1 &");
  wait_for("status");
  tool("search --sync --name clatter windowmove 0 0 windowfocus --sync");
  place("viewport");
}

Outcome GuiDriver::run(const std::string& line) const {
  return shell_.run(display_ + '\n' + line);
}

void GuiDriver::tool(const std::string& line) const {
  REQUIRE(run("xdotool " + line).code == 0);
}

void GuiDriver::act(const std::string& line) const {
  tool(line);
  const std::size_t before = pictures(shell_.read("log"), 0);
  wait_until([&] { return pictures(shell_.read("log"), 0) >= before + kSettle; });
}

void GuiDriver::key(const std::string& names) const {
  std::istringstream keys(names);
  for (std::string key; keys >> key;) act("key " + key);
}

std::vector<json> GuiDriver::events(const std::string& name) const {
  std::istringstream log(shell_.read("log"));
  std::vector<json> events;
  for (std::string line; std::getline(log, line) && !log.eof();) {
    json event = json::parse(line);
    if (name.empty() || event["event"] == name) events.push_back(std::move(event));
  }
  return events;
}

json GuiDriver::wait_for(const std::string& event, std::size_t after,
                         const std::function<bool(const json&)>& is_it) const {
  const auto end = std::chrono::steady_clock::now() + 20s;
  do {
    const std::vector<json> all = events();
    for (std::size_t i = all.size(); i > after; --i) {
      if (all[i - 1]["event"] == event && is_it(all[i - 1])) return all[i - 1];
    }
    std::this_thread::sleep_for(50ms);
  } while (std::chrono::steady_clock::now() < end);
  const std::string last = shell_.run("grep -v '\"status\"' log | tail -n 20").out;
  FAIL("no event '" << event << "' after the first " << after << "; the last ones are\n"
                    << last << shell_.read("err"));
  return {};
}

std::vector<double> GuiDriver::place(const std::string& widget, std::size_t after) const {
  const auto is_it = [&](const json& event) { return event["name"] == widget; };
  wait_for("widget", after, is_it);
  const std::string line = R"("event":"widget","name":")" + widget + '"';
  wait_until([&] {
    const std::string log = shell_.read("log");
    return pictures(log, log.rfind(line)) >= kSettle;
  });
  return wait_for("widget", after, is_it)["place"];
}

// A place in a widget, at a share of its width.
static std::string at(const std::vector<double>& place, double share) {
  return std::to_string(std::lround(place[0] + share * place[2])) + ' ' +
         std::to_string(std::lround(place[1] + 0.5 * place[3]));
}

// Moves the mouse to a place, also if it is there already: two moves are at least one event.
static std::string move_to(const std::string& place) {
  return "mousemove " + place + " mousemove_relative 1 0 mousemove " + place;
}

void GuiDriver::point_at(const std::string& widget, double share) const {
  act(move_to(at(place(widget), share)));
}

void GuiDriver::click(const std::string& widget) const {
  point_at(widget);
  act("mousedown 1");
  act("mouseup 1");
}

void GuiDriver::drag(const std::string& widget, double from, double to) const {
  const std::vector<double> where = place(widget);
  act(move_to(at(where, from)));
  act("mousedown 1");
  constexpr int kSteps = 6;
  for (int step = 1; step <= kSteps; ++step) {
    act(move_to(at(where, from + (to - from) * step / kSteps)));
  }
  act("mouseup 1");
}

void GuiDriver::pull(const std::string& widget, int right, int down) const {
  point_at(widget);
  act("mousedown 1");
  act("mousemove_relative -- " + std::to_string(right) + ' ' + std::to_string(down));
  act("mouseup 1");
}

std::vector<int> GuiDriver::pixel(int x, int y) const {
  const std::string place = std::to_string(x) + ',' + std::to_string(y);
  const Outcome outcome =
      run("ffmpeg -v error -f x11grab -video_size 2x2 -i $DISPLAY+" + place +
          " -frames:v 1 -pix_fmt rgb24 -f rawvideo - </dev/null | od -An -tu1 -N3");
  std::istringstream numbers(outcome.out);
  std::vector<int> colour(3);
  for (int& channel : colour) numbers >> channel;
  return colour;
}

bool GuiDriver::corner_becomes(const std::vector<int>& colour) const {
  for (int look = 0; look < 50; ++look) {
    const std::vector<double> viewport = place("viewport");
    if (pixel(static_cast<int>(viewport[0]) + 3, static_cast<int>(viewport[1]) + 3) == colour)
      return true;
  }
  return false;
}

int GuiDriver::exit_code() const {
  const Outcome outcome =
      shell_.run("for i in $(seq 100); do [ -s code ] && cat code && exit; sleep 0.05; done");
  return outcome.out.empty() ? -1 : std::stoi(outcome.out);
}

json hash_of_run(const GuiDriver& driver, const std::string& scene, const json& status) {
  char line[256];
  std::snprintf(line, sizeof line,
                "clatter measure %s --quiet --set measure.burn_in=0 --until %.17g", scene.c_str(),
                status["time"].get<double>());
  const Outcome outcome = driver.shell().run(line);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(outcome.out)["state_hash"];
}

void check_saved_scene(const GuiDriver& driver) {
  const std::size_t told = driver.told();
  driver.key("ctrl+s");
  const std::string scene = driver.wait_for("saved", told)["file"];
  const json now = driver.wait_for("status", 0, halted);
  CHECK(hash_of_run(driver, scene, now) == now["hash"]);
}

}  // namespace clatter
