#pragma once

#include <chrono>
#include <utility>

#include "engine/live/worker.h"

namespace clatter::testing {

/// Executes a command, and works until the gases halt. Returns the frame then.
inline const Frame& execute(SlicedWorker& engine, Command command) {
  engine.send(std::move(command));
  while (engine.busy()) engine.work(std::chrono::milliseconds(50));
  engine.frames().update();
  return engine.frames().front();
}

}  // namespace clatter::testing
