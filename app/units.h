#pragma once

#include "engine/scene/scene.h"

namespace clatter {

/// What the letters in units stand for.
inline constexpr const char* kUnits = "a: disk diameter, m: disk mass, t: time unit of the scene";

/// Unit of a field's values in terms of these, for instance "m a^2/t^2".
const char* unit_of(Field field);

}  // namespace clatter
