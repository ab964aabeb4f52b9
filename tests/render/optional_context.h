#pragma once

#include <doctest/doctest.h>

#include <memory>

#include "engine/error.h"
#include "render/context/context.h"
#include "render/context/egl_context.h"

namespace clatter {

/// A context of a backend. On a machine without it the function returns nullptr, and CTest reports
/// the case as skipped.
inline std::unique_ptr<GlContext> open_or_skip(Backend backend) {
  try {
    return open_context(backend);
  } catch (const RunError& error) {
    MESSAGE("[skipped] " << std::string(error.what()));
    return nullptr;
  }
}

/// A context of OpenGL ES. On a machine without one it returns nullptr, and CTest reports the case
/// as skipped.
inline std::unique_ptr<GlContext> open_es_context() {
  try {
    return std::make_unique<EglContext>(Api::Es);
  } catch (const RunError& error) {
    MESSAGE("[skipped] " << std::string(error.what()));
    return nullptr;
  }
}

}  // namespace clatter
