#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/view/host.h"
#include "app/view/window_input.h"
#include "render/sound/live_sound.h"

struct GLFWwindow;

namespace clatter {

/// The usual sound device of the system, by OpenAL. All calls come from one thread.
class OpenAlSpeaker final : public Loudspeaker {
 public:
  OpenAlSpeaker();
  ~OpenAlSpeaker() override;

  void open() override;
  std::string play(const std::vector<std::shared_ptr<const PlayedStretch>>& played) override;
  void close() override;

 private:
  class Queue;

  LiveSound sound_;
  std::unique_ptr<Queue> queue_;  // absent: closed
};

/// A window of GLFW on a desktop.
class Desktop final : public Host {
 public:
  /// Installs callbacks that fill `input`. Must precede the set-up of Dear ImGui, whose callbacks
  /// call these.
  Desktop(GLFWwindow* window, WindowInput& input);

  float content_scale() const override;
  float least_target() const override { return 0.0f; }
  void set_title(const std::string& title) override;
  void copy(const std::string& text) override;
  void toggle_full_screen() override;
  void close() override;
  bool has_user_files() const override { return true; }
  void deliver(const std::string&) override {}
  std::string link_to(const std::string&) const override { return {}; }
  bool has_processes() const override { return true; }
  ScreenRecorder* recorder() override { return nullptr; }
  Loudspeaker* loudspeaker() override { return &speaker_; }

 private:
  GLFWwindow* window_;
  OpenAlSpeaker speaker_;
  std::array<int, 4> windowed_ = {};  // x, y, width and height before full screen
};

}  // namespace clatter
