#pragma once

#include "engine/scene/scene.h"

namespace clatter {

/// The unit of a field, in plain text such as "m a^2/t^2": a is the diameter of a disk, m its mass,
/// t the scene's unit of time.
const char* unit_of(Field field);

}  // namespace clatter
