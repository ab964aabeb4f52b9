// The functions that page.js calls. One page has one window. Lengths are pixels of the device.

#include <emscripten.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <chrono>
#include <cmath>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/view/gui.h"
#include "app/view/gui_keys.h"
#include "app/view/link.h"
#include "app/web/page_host.h"
#include "engine/error.h"
#include "render/context/web_context.h"
#include "render/typography/gui_context.h"

namespace clatter {

namespace {

// Events of the pointer that no picture has shown yet. A change of the buttons has a picture of its
// own, so that a press has its place, and a drag between two pictures is a drag.
class PointerQueue {
 public:
  struct State {
    ImVec2 place;
    int buttons;         // one bit a button
    float wheel;         // steps
    bool jumps = false;  // without a motion to this place
  };

  void add(const State& state) { states_.push_back(state); }
  bool empty() const { return states_.empty(); }
  // The buttons of the last event.
  int buttons() const { return states_.empty() ? buttons_ : states_.back().buttons; }

  // Gives Dear ImGui the events of the next picture.
  void advance(ImGuiIO& io) {
    for (bool moved = false; !states_.empty(); moved = true) {
      const State& next = states_.front();
      const bool changed = next.buttons != buttons_;
      if (changed && moved) return;
      io.MousePos = next.place;
      if (next.jumps) io.MousePosPrev = next.place;
      io.MouseWheel += next.wheel;
      for (int k = 0; k < 3; ++k) io.MouseDown[k] = (next.buttons >> k & 1) != 0;
      buttons_ = next.buttons;
      states_.pop_front();
      if (changed) return;
    }
  }

 private:
  std::deque<State> states_;
  int buttons_ = 0;  // of the last picture
};

class Page {
 public:
  explicit Page(bool logs) : log_(logs ? "/dev/stdout" : "") {
    ImGuiIO& io = ImGui::GetIO();
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    prepare_keys();
    io.ClipboardUserData = &host_;
    io.SetClipboardTextFn = [](void* host, const char* text) {
      static_cast<PageHost*>(host)->copy(text);
    };
  }

  void open(const char* fragment, std::optional<double> until) {
    try {
      open(read_link(fragment), until);
    } catch (const std::exception& error) {
      if (!opened_) open(read_link(""), until);
      gui_.report(error.what());
    }
  }

  // Shows the gas alone, with the controls of these names, separated by commas.
  void embed(std::string_view names) {
    std::vector<std::string> controls;
    for (std::size_t at = 0; at < names.size();) {
      const std::size_t end = std::min(names.find(',', at), names.size());
      controls.emplace_back(names.substr(at, end - at));
      at = end + 1;
    }
    gui_.embed(std::move(controls));
  }

  bool unsaved() const { return gui_.unsaved(); }

  bool shows_gas(float x, float y) const { return gui_.shows_gas(x, y); }

  void resize(float width, float height) {
    ImGui::GetIO().DisplaySize = ImVec2(width, height);
    settle();
  }

  void point(float x, float y, int buttons, float wheel) {
    pointer_.add({ImVec2(x, y), buttons, wheel});
    settle();
  }

  // Moves the pointer without a motion between.
  void place(float x, float y) { pointer_.add({ImVec2(x, y), pointer_.buttons(), 0.0f, true}); }

  // Moves the content of the panel at a place, pixels downwards.
  void scroll(float x, float y, float pixels) {
    constexpr float kStep = 5.0f;  // of the wheel in Dear ImGui, in text sizes
    point(x, y, 0, pixels / (kStep * ImGui::GetFontSize()));
  }

  // The last finger has left. The pointer leaves too, once the release has been seen.
  void lift() {
    lifted_ = true;
    settle();
  }

  void use_key(const KeyPress& press, bool down, bool repeated) {
    pass_modifiers(press.shift, press.ctrl);
    pass_key(press.key, down);
    if (down && (!repeated || repeats(press))) input_.press(press);
    settle();
  }

  void type(const char* text) {
    ImGui::GetIO().AddInputCharactersUTF8(text);
    for (; *text; ++text) input_.type(static_cast<unsigned char>(*text));
    settle();
  }

  void drop(const char* path) {
    input_.drop(path);
    settle();
  }

  // Shows a message.
  void report(const char* message) {
    gui_.report(message);
    settle();
  }

  // Draws a picture. Returns whether the next one may differ without input.
  bool draw() {
    constexpr std::chrono::milliseconds kBudget{12};
    engine_.work(kBudget);
    ImGuiIO& io = ImGui::GetIO();
    const auto now = Clock::now();
    const double since = std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    io.DeltaTime = static_cast<float>(std::clamp(since, 1e-4, 0.1));
    pointer_.advance(io);
    // Browsers clear the canvas before its first draw call, but not before a copy into it.
    const Gl& gl = context_.gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    gui_.draw();
    if (!pointer_.empty()) settle();
    if (lifted_ && pointer_.empty() && !io.MouseDown[0] && !io.MouseDown[1]) {
      io.MousePos = ImVec2(-FLT_MAX, -FLT_MAX);
      lifted_ = false;
      settle();
    }
    if (left_ > 0) --left_;
    return engine_.busy() || gui_.changes() || left_ > 0;
  }

 private:
  using Clock = std::chrono::steady_clock;

  // Panels need several pictures after an event to settle.
  void settle() { left_ = 4; }

  void open(const LinkedScene& linked, std::optional<double> until) {
    gui_.open(linked.scene, linked.seed, until);
    opened_ = true;
    settle();
  }

  PageHost host_;
  WebContext context_{"#canvas"};
  ScriptLog log_;
  WindowInput input_;
  GuiContext imgui_ = make_gui_context();
  CurrentContext current_{imgui_.get()};
  SlicedWorker engine_;
  Gui gui_{host_, context_.gl(), input_, engine_, log_};
  PointerQueue pointer_;
  bool opened_ = false;
  bool lifted_ = false;
  int left_ = 0;
  Clock::time_point last_ = Clock::now();
};

std::unique_ptr<Page> page;

std::optional<double> limit(double until) {
  return std::isnan(until) ? std::nullopt : std::optional(until);
}

}  // namespace

}  // namespace clatter

using clatter::page;

extern "C" {

// Shows the scene of a link up to a simulation time, NaN for none. Returns an error message; empty:
// none.
EMSCRIPTEN_KEEPALIVE const char* clatter_start(const char* fragment, double until, int logs) {
  static std::string failure;
  try {
    page = std::make_unique<clatter::Page>(logs != 0);
    page->open(fragment, clatter::limit(until));
  } catch (const std::exception& error) {
    failure = error.what();
  }
  return failure.c_str();
}
EMSCRIPTEN_KEEPALIVE void clatter_open(const char* fragment, double until) {
  page->open(fragment, clatter::limit(until));
}
EMSCRIPTEN_KEEPALIVE void clatter_embed(const char* controls) {
  page->embed(controls);
}
EMSCRIPTEN_KEEPALIVE int clatter_draw() {
  return page->draw();
}
EMSCRIPTEN_KEEPALIVE void clatter_resize(double width, double height) {
  page->resize(static_cast<float>(width), static_cast<float>(height));
}
EMSCRIPTEN_KEEPALIVE void clatter_point(double x, double y, int buttons, double wheel) {
  page->point(static_cast<float>(x), static_cast<float>(y), buttons, static_cast<float>(wheel));
}
// Whether the gas has changes by hand that no file has.
EMSCRIPTEN_KEEPALIVE int clatter_unsaved() {
  return page->unsaved();
}
// Whether a place shows the gas and no panel.
EMSCRIPTEN_KEEPALIVE int clatter_shows_gas(double x, double y) {
  return page->shows_gas(static_cast<float>(x), static_cast<float>(y));
}
EMSCRIPTEN_KEEPALIVE void clatter_place(double x, double y) {
  page->place(static_cast<float>(x), static_cast<float>(y));
}
EMSCRIPTEN_KEEPALIVE void clatter_scroll(double x, double y, double pixels) {
  page->scroll(static_cast<float>(x), static_cast<float>(y), static_cast<float>(pixels));
}
EMSCRIPTEN_KEEPALIVE void clatter_lift() {
  page->lift();
}
EMSCRIPTEN_KEEPALIVE void clatter_key(int key, int sign, int shift, int ctrl, int down,
                                      int repeated) {
  page->use_key({key, static_cast<char>(sign), shift != 0, ctrl != 0}, down != 0, repeated != 0);
}
EMSCRIPTEN_KEEPALIVE void clatter_type(const char* text) {
  page->type(text);
}
// Whether a field for text has the focus.
EMSCRIPTEN_KEEPALIVE int clatter_wants_text() {
  return ImGui::GetIO().WantTextInput;
}
EMSCRIPTEN_KEEPALIVE void clatter_drop(const char* path) {
  page->drop(path);
}
EMSCRIPTEN_KEEPALIVE void clatter_tell(const char* message) {
  page->report(message);
}
}
