#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace clatter {

/// The shortest decimal that reads back to exactly this number: "0.1", "20", "1e-07".
std::string number_text(double number);

/// The text between double quotes, escaped so that both TOML and JSON read it back.
std::string in_quotes(std::string_view text);

/// The first 40 characters of a text between double quotes, to show what a message is about.
std::string quoted_start(std::string_view text);

/// A name of scenes and files for use in sentences: "heat flux x" for "heat_flux_x".
std::string in_words(std::string_view name);

/// A number of things: "1 frame", "2 frames".
std::string counted(std::size_t count, const std::string& thing);

/// The valid numbers of particles as an advice: "particles are numbered from 0 to 9".
std::string particle_numbers(int count);

/// The correct spelling of `word`: the most similar candidate. Empty if no candidate is similar.
std::string_view near_miss(std::string_view word, std::span<const std::string> candidates);

/// The text with its control characters as \u00XX. It then is one line, of full length also as a C
/// string.
std::string printable(std::string_view text);

}  // namespace clatter
