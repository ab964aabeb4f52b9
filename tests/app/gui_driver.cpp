#include "tests/app/gui_driver.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <thread>

namespace clatter {

using nlohmann::json;
using namespace std::chrono_literals;

// A person pauses between press, move and release. The program needs a new picture in between.
static constexpr const char* kPause = " sleep 0.15 ";

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
  wait_for("widget", 0, [](const json& event) { return event["name"] == "viewport"; });
  std::this_thread::sleep_for(300ms);
}

Outcome GuiDriver::run(const std::string& line) const {
  return shell_.run(display_ + '\n' + line);
}

void GuiDriver::tool(const std::string& line) const {
  REQUIRE(run("xdotool " + line).code == 0);
}

void GuiDriver::key(const std::string& name) const {
  tool("key --delay 120 " + name + kPause);
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
  FAIL("no event '" << event << "' after the first " << after << ", but "
                    << shell_.read("log").substr(0, 2000) << shell_.read("err"));
  return {};
}

std::vector<double> GuiDriver::place(const std::string& widget) const {
  return wait_for("widget", 0, [&](const json& event) { return event["name"] == widget; })["place"];
}

static std::string at(const std::vector<double>& place, double share) {
  return std::to_string(std::lround(place[0] + share * place[2])) + ' ' +
         std::to_string(std::lround(place[1] + 0.5 * place[3]));
}

void GuiDriver::point_at(const std::string& widget, double share) const {
  tool("mousemove " + at(place(widget), share) + kPause);
}

void GuiDriver::click(const std::string& widget) const {
  tool("mousemove " + at(place(widget), 0.5) + kPause + "mousedown 1" + kPause + "mouseup 1" +
       kPause);
}

void GuiDriver::drag(const std::string& widget, double from, double to) const {
  const std::vector<double> where = place(widget);
  std::string line = "mousemove " + at(where, from) + kPause + "mousedown 1" + kPause;
  constexpr int kSteps = 6;
  for (int step = 1; step <= kSteps; ++step) {
    line += "mousemove " + at(where, from + (to - from) * step / kSteps) + kPause;
  }
  tool(line + "mouseup 1" + kPause);
}

void GuiDriver::pull(const std::string& widget, int right, int down) const {
  const std::string way = std::to_string(right) + ' ' + std::to_string(down);
  tool("mousemove " + at(place(widget), 0.5) + kPause + "mousedown 1" + kPause +
       "mousemove_relative -- " + way + kPause + "mouseup 1" + kPause);
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

double GuiDriver::brightness(const std::string& widget) const {
  const std::vector<double> where = place(widget);
  const auto pixels = [&](int i) { return std::to_string(std::lround(where[i])); };
  const Outcome outcome =
      run("ffmpeg -v error -y -f x11grab -draw_mouse 0 -video_size " + pixels(2) + 'x' + pixels(3) +
          " -i $DISPLAY+" + pixels(0) + ',' + pixels(1) +
          " -frames:v 1 -pix_fmt gray -f rawvideo grabbed </dev/null");
  REQUIRE(outcome.code == 0);
  double sum = 0.0;
  const std::string grabbed = shell_.read("grabbed");
  unsigned char darkest = 255;
  for (const char pixel : grabbed) {
    const auto bright = static_cast<unsigned char>(pixel);
    darkest = std::min(darkest, bright);
    sum += bright;
  }
  return sum / static_cast<double>(grabbed.size()) - darkest;
}

int GuiDriver::exit_code() const {
  const Outcome outcome =
      shell_.run("for i in $(seq 100); do [ -s code ] && cat code && exit; sleep 0.05; done");
  return outcome.out.empty() ? -1 : std::stoi(outcome.out);
}

}  // namespace clatter
