#pragma once

#include <string>

#include "engine/dynamics/model.h"
#include "engine/dynamics/watchdog.h"

namespace clatter {

/// What to tell a person whose run stands still at a simulation time: why, where, and what would
/// carry on.
template <int D>
std::string standstill_message(const Model<D>& model, const Watchdog& watchdog, double time,
                               double temperature);

}  // namespace clatter
