#pragma once

#include <optional>
#include <string>

#include "app/view/controls.h"
#include "app/view/gallery.h"
#include "app/view/history.h"
#include "app/view/keys.h"
#include "app/view/notes.h"
#include "app/view/script_log.h"
#include "app/view/session.h"
#include "app/view/stage.h"
#include "render/context/glfw_context.h"
#include "render/layers/gui_layer.h"

namespace clatter {

/// What the window shows and does: the stage, the panels around it, the keys.
class Explorer {
 public:
  Explorer(const GlfwContext& context, Keys& keys, Worker& worker, ScriptLog& log);

  /// Starts a scene.
  void open(const Scene& scene, std::uint64_t seed);
  /// Takes what the person has done and draws the window's next picture.
  void draw();

 private:
  struct Shown {
    bool panels = true;
    bool plots = false;
    bool gallery = false;
    bool help = false;
    bool lecture = false;
    bool hint = true;
  };

  void begin();
  void use_keys();
  void use_function_key(const KeyPress& press);
  void use_key(const KeyPress& press);
  void use_control_key(const KeyPress& press);
  void use_signs();
  void close_something();
  void panels();
  void left_panel(float top, float width);
  void plots_drawer(float top, float width);
  void stage();
  void open_gallery_scene(const std::string& name);
  void open_file(const std::string& file);
  void toggle_full_screen();
  void fix_range();
  void screenshot();
  std::string save_scene();
  void copy_command();

  const GlfwContext& context_;
  Keys& keys_;
  ScriptLog& log_;
  Session session_;
  Controls controls_;
  Stage stage_;
  Gallery gallery_;
  History history_;
  GuiLayer gui_;
  Shown shown_;
  std::uint64_t drawn_views_ = 0;     // of Session::views()
  bool told_gallery_ = false;         // whether the script log knows that it is open
  float text_size_ = 0.0f;            // of the loaded fonts, pixels; 0: none
  float scale_ = 1.0f;                // pixels per unit of the window
  Area area_;                         // of the stage
  std::array<int, 4> windowed_ = {};  // place and extent before full screen
};

}  // namespace clatter
