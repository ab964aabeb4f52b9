#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// A Python value as a TOML value: a bool, a number, a str, a list, a tuple, a dict, or an array of
/// numpy. Throws TypeError for other types.
std::string toml_text(const pybind11::handle& value);

/// A nested dict as the text of a scene file.
std::string scene_text(const pybind11::dict& scene);

/// The keys and values of a dict, for example {"particles.count": 500}.
std::vector<Override> overrides_of(const pybind11::dict& settings);

}  // namespace clatter
