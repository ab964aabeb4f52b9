#include "app/view/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/view/desktop.h"
#include "app/view/gui.h"
#include "engine/error.h"
#include "render/context/glfw_context.h"

namespace clatter {

namespace {

using RealClock = std::chrono::steady_clock;

// Detects a lost OpenGL context. Needs OpenGL 4.5 or ARB_robustness; otherwise it detects nothing.
class ContextGuard {
 public:
  ContextGuard() {
    for (const char* name : {"glGetGraphicsResetStatus", "glGetGraphicsResetStatusARB"}) {
      if (!status_) status_ = reinterpret_cast<GLenum (*)()>(glfwGetProcAddress(name));
    }
  }
  /// Throws RunError if the context is lost.
  void check() const {
    if (status_ && status_() != GL_NO_ERROR) throw RunError("the window's OpenGL context is lost");
  }

 private:
  GLenum (*status_)() = nullptr;
};

double refresh_rate() {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  return mode && mode->refreshRate > 0 ? mode->refreshRate : 60.0;
}

// Dear ImGui, connected to the keyboard and mouse of a window.
class DearImGui {
 public:
  explicit DearImGui(GLFWwindow* window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    ImGui_ImplGlfw_InitForOpenGL(window, true);
  }
  DearImGui(const DearImGui&) = delete;
  DearImGui& operator=(const DearImGui&) = delete;
  ~DearImGui() {
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
};

// Makes a window that is larger than the screen as large as the screen.
void fit_to_screen(GLFWwindow* window) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (!monitor) return;
  std::array<int, 4> screen{}, frame{};
  std::array<int, 2> size{};
  glfwGetMonitorWorkarea(monitor, &screen[0], &screen[1], &screen[2], &screen[3]);
  glfwGetWindowFrameSize(window, &frame[0], &frame[1], &frame[2], &frame[3]);
  glfwGetWindowSize(window, &size[0], &size[1]);
  const int width = std::min(size[0], screen[2] - frame[0] - frame[2]);
  const int height = std::min(size[1], screen[3] - frame[1] - frame[3]);
  if (width < size[0] || height < size[1]) glfwSetWindowSize(window, width, height);
}

// Sleeps until an event, such as a new frame of the engine. While the panels settle it sleeps for
// at most one refresh period. Without vertical synchronisation the sleep still limits the picture
// rate. Returns whether there was an event.
bool wait_for_events(bool settles, RealClock::time_point began, double rate) {
  const std::chrono::duration<double> shortest(0.7 / rate), period(1.0 / rate);
  std::this_thread::sleep_until(began + std::chrono::duration_cast<RealClock::duration>(shortest));
  if (!settles) {
    glfwWaitEvents();
    return true;
  }
  const auto waits_since = RealClock::now();
  glfwWaitEventsTimeout(period.count());
  return RealClock::now() - waits_since < period;
}

}  // namespace

static void show(const WindowOptions& options) {
  const GlfwContext context("clatter", options.size);
  const ContextGuard guard;
  GLFWwindow* window = context.window();
  fit_to_screen(window);
  glfwSwapInterval(1);
  ScriptLog log(options.script_log);
  WindowInput input;
  Desktop desktop(window, input);
  const DearImGui imgui(window);
  const double rate = refresh_rate();
  Worker worker(rate, [] { glfwPostEmptyEvent(); });
  {
    Gui gui(desktop, context.gl(), input, worker, log);
    gui.set_playlist(options.playlist);
    if (options.sound) gui.listen(true);
    gui.open(options.scene, options.seed, options.until, options.others);
    // Panels need several pictures after an event to settle.
    constexpr int kSettle = 4;
    for (int left = kSettle;;) {
      if (glfwWindowShouldClose(window)) {
        if (gui.may_close()) break;
        glfwSetWindowShouldClose(window, GLFW_FALSE);
      }
      const auto began = RealClock::now();
      ImGui_ImplGlfw_NewFrame();
      if (const auto press = input.take_mouse_press()) {
        ImGui::GetIO().MousePos = ImVec2((*press)[0], (*press)[1]);
      }
      gui.draw();
      glfwSwapBuffers(window);
      guard.check();
      const bool event = wait_for_events(left > 0 || gui.changes(), began, rate);
      left = event ? kSettle : std::max(0, left - 1);
    }
    // Hide the window first: ~Gui interrupts a film and waits for its end.
    glfwHideWindow(window);
    log.event("quit", nlohmann::json::object());
  }
  // A long step of the engine, for example placing a million disks, is abandoned.
  constexpr std::chrono::milliseconds kPatience{150};
  if (!worker.stop_within(kPatience)) std::_Exit(EXIT_SUCCESS);
}

void show_window(const WindowOptions& options) {
  try {
    show(options);
  } catch (const RunError& error) {
    throw RunError(std::string(error.what()) +
                   "; use `clatter render SCENE --out film.mp4`, which needs no window");
  }
}

}  // namespace clatter
