#pragma once

#include "engine/scene/field.h"

namespace clatter {

/// What the letters in units stand for.
inline constexpr const char* kUnits =
    "a: particle diameter, m: particle mass, t: time unit of the scene";

/// The unit of a field in terms of these, in plain text such as "m a^2/t^2"; "1" of bare numbers.
const char* unit_of(Field field);

}  // namespace clatter
