#include <fmt/printf.h>

#include "app/bench/tables.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "app/view/desktop.h"
#include "app/view/gui.h"
#include "engine/dynamics/simulation.h"
#include "engine/live/watched_run.h"
#include "engine/scene/scene_file.h"
#include "engine/system/usage.h"
#include "engine/system/write_file.h"
#include "render/context/glfw_context.h"

namespace clatter {

namespace {

// A function of this type without any effect.
template <class R, class... Arguments>
auto idle(R (*)(Arguments...)) -> R (*)(Arguments...) {
  return [](Arguments...) -> R {
    if constexpr (!std::is_void_v<R>) return R{};
  };
}

// An OpenGL that accepts all calls and draws nothing. It answers the queries of the program's
// start.
Gl idle_gl() {
  Gl gl;
#define CLATTER_IDLE(name) gl.name = idle(gl.name);
  CLATTER_GL_FUNCTIONS(CLATTER_IDLE)
#undef CLATTER_IDLE
  const auto name_all = [](GLsizei count, GLuint* names) { std::fill_n(names, count, 1u); };
  gl.GenBuffers = gl.GenFramebuffers = gl.GenTextures = gl.GenVertexArrays = name_all;
  gl.CreateProgram = [] { return GLuint{1}; };
  gl.CreateShader = [](GLenum) { return GLuint{1}; };
  gl.GetShaderiv = gl.GetProgramiv = [](GLuint, GLenum, GLint* value) { *value = GL_TRUE; };
  gl.CheckFramebufferStatus = [](GLenum) { return GLenum{GL_FRAMEBUFFER_COMPLETE}; };
  gl.GetIntegerv = [](GLenum, GLint* value) { *value = 16384; };
  return gl;
}

// The times of pictures with a new frame of the engine, in seconds, sorted.
std::vector<double> picture_times(const Scene& scene, Size size) {
  constexpr int kWarmUp = 30, kPictures = 300;
  const GlfwContext context;
  const Gl gl = idle_gl();
  ScriptLog log("");
  WindowInput input;
  Desktop desktop(context.window(), input);
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.DisplaySize = ImVec2(static_cast<float>(size.width), static_cast<float>(size.height));
  std::atomic<int> published = 0;
  std::vector<double> times;
  {
    Worker worker(60.0, [&] {
      ++published;
      glfwPostEmptyEvent();
    });
    Gui gui(desktop, gl, input, worker, log);
    gui.open(scene, 1);
    for (int picture = 0, seen = 0; picture < kWarmUp + kPictures; ++picture) {
      while (published == seen) glfwWaitEventsTimeout(0.1);
      seen = published;
      const double began = thread_cpu_seconds();
      gui.draw();
      if (picture >= kWarmUp) times.push_back(thread_cpu_seconds() - began);
    }
  }
  ImGui::DestroyContext();
  std::ranges::sort(times);
  return times;
}

struct LawTimes {
  double change;  // of the restitution, seconds
  double build;   // of a simulation with the same particles
};

// The least times of several. The run is that of the window, with its field and its record.
LawTimes law_times(const Scene& scene) {
  constexpr int kRepetitions = 8;
  constexpr double kMoving = 0.1;  // a run that has begun
  const auto run = watched_run(scene, 1);
  run->run_until(kMoving, kNoLimit, kNoLimit, {});
  LawTimes least{kNever, kNever};
  for (int k = 1; k <= kRepetitions; ++k) {
    const double began = thread_cpu_seconds();
    run->change({{"particles.restitution", fmt::format("{}", 0.9 - 0.01 * k)}}, 0.0);
    least.change = std::min(least.change, thread_cpu_seconds() - began);
  }
  const Model<2> model = model_of<2>(run->laws(), 1);
  for (int k = 1; k <= kRepetitions; ++k) {
    auto state = std::get<State<2>>(run->state());
    const double began = thread_cpu_seconds();
    const Simulation<2> built(model, std::move(state));
    least.build = std::min(least.build, thread_cpu_seconds() - began);
  }
  return least;
}

}  // namespace

Scene window_scene(int count) {
  Scene scene = load_scene("vibrated");
  scene.box *= std::sqrt(static_cast<double>(count) / scene.particles.count);
  scene.particles.count = count;
  scene.view.field = Quantity::Temperature;
  return scene;
}

int bench_window(const std::string& json, int count) {
  if (count == 0) count = 10'000;
  const Size size{1280, 720};
  const std::vector<double> times = picture_times(window_scene(count), size);
  const double median = 1e3 * times[times.size() / 2];
  const double most = 1e3 * times[times.size() * 99 / 100];
  const LawTimes laws = law_times(window_scene(count));
  const double change = 1e3 * laws.change, build = 1e3 * laws.build;
  std::fprintf(
      stderr,
      "window of %dx%d, temperature field, OpenGL without effect; a changed restitution, and "
      "a simulation built again; CPU time\n",
      size.width, size.height);
  print(fmt::sprintf("%10s %12s %12s %12s %12s\n%10d %12.2f %12.2f %12.2f %12.2f\n", "N",
                     "median ms", "99 % ms", "change ms", "build ms", count, median, most, change,
                     build));
  const nlohmann::ordered_json row = {{"count", count},
                                      {"median_milliseconds", median},
                                      {"percentile_99_milliseconds", most},
                                      {"change_milliseconds", change},
                                      {"build_milliseconds", build}};
  if (!json.empty()) write_file(json, row.dump(1) + "\n");
  return kOk;
}

}  // namespace clatter
