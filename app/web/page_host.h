#pragma once

#include "app/view/host.h"

namespace clatter {

/// The MediaRecorder of a browser.
class PageRecorder final : public ScreenRecorder {
 public:
  std::string extension() const override;
  void begin(Size size) override;
  void add(int x, int y, Size size) override;
  void end(const std::string& name) override;
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
  ScreenRecorder* recorder() override;
  Loudspeaker* loudspeaker() override { return nullptr; }

 private:
  PageRecorder recorder_;
};

}  // namespace clatter
