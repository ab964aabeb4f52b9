#pragma once

#include <string>

#include "render/context/context.h"

namespace clatter {

/// WebGL 2 in a canvas of a page.
class WebContext final : public GlContext {
 public:
  /// `canvas` is a CSS selector, such as "#canvas". Throws RunError if WebGL 2 is missing.
  explicit WebContext(const std::string& canvas);
  ~WebContext() override;

  const char* name() const override { return "webgl"; }

 private:
  int handle_ = 0;
};

}  // namespace clatter
