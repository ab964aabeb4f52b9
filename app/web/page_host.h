#pragma once

#include "app/view/host.h"
#include "render/sound/live_sound.h"

namespace clatter {

/// The MediaRecorder of a browser.
class PageRecorder final : public ScreenRecorder {
 public:
  void begin(Size size) override;
  std::string extension() const override;
  std::string add(int x, int y, Size size) override;
  void end(const std::string& name) override;
};

/// The Web Audio of a browser. It is silent until the user has pressed a key or a button.
class PageSpeaker final : public Loudspeaker {
 public:
  void open() override;
  std::string play(const std::vector<std::shared_ptr<const PlayedStretch>>& played) override;
  void close() override;

 private:
  LiveSound sound_;
};

/// A page of a browser, through the functions of `Module.page` in page.js.
class PageHost final : public Host {
 public:
  float content_scale() const override;
  float least_target() const override;
  void set_title(const std::string& title) override;
  void copy(const std::string& text) override;
  void toggle_full_screen() override;
  void close() override {}
  bool has_user_files() const override { return false; }
  void deliver(const std::string& file) override;
  bool has_processes() const override { return false; }
  std::string link_to(const std::string& fragment) const override;
  ScreenRecorder* recorder() override { return &recorder_; }
  Loudspeaker* loudspeaker() override { return &speaker_; }

 private:
  PageRecorder recorder_;
  PageSpeaker speaker_;
};

}  // namespace clatter
