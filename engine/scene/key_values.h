#pragma once

#include <string>
#include <vector>

#include "engine/scene/key_rules.h"
#include "engine/scene/scene.h"

namespace clatter {

// The allowed values of a key in words: "a number between 0 and 1". The first argument is a value
// of the key. It sets the type and the length of an array.
std::string allowed_values(double number, Limits limits);
std::string allowed_values(int number, Limits limits);
std::string allowed_values(bool flag, Limits limits);
std::string allowed_values(const std::string& text, Limits limits);
std::string allowed_values(const std::vector<std::string>& texts, Limits limits);
std::string allowed_values(const Vec2& numbers, Limits limits);
std::string allowed_values(const std::vector<Vec2>& points, Limits limits);
std::string allowed_values(const VecX& numbers, Limits limits);
std::string allowed_values(const std::vector<int>& numbers, Limits limits);
std::string allowed_values(const std::vector<double>& numbers, Limits limits);
std::string allowed_values(const ColourRange& range, Limits limits);
std::string allowed_values(const Rgb& colour, Limits limits);

}  // namespace clatter
