#pragma once

#include <limits>

namespace clatter {

/// The allowed numbers of a key, from `lowest` to `highest`, which may be infinite. `above`
/// excludes `lowest` itself.
struct Limits {
  double lowest = -std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::max();
  bool above = false;

  /// Whether a number is within the limits; false for NaN.
  bool allow(double number) const {
    return (above ? number > lowest : number >= lowest) && number <= highest;
  }
};

/// Numbers from `lowest` to `highest`, both included.
constexpr Limits between(double lowest, double highest) {
  return {.lowest = lowest, .highest = highest};
}
/// Finite numbers from `lowest` on.
constexpr Limits at_least(double lowest) {
  return {.lowest = lowest};
}
/// Finite numbers greater than `lowest`.
constexpr Limits above(double lowest) {
  return {.lowest = lowest, .above = true};
}
/// Numbers from `lowest` on, infinity included.
constexpr Limits at_least_or_infinite(double lowest) {
  return {.lowest = lowest, .highest = std::numeric_limits<double>::infinity()};
}

/// Whether a table must, may or must not have a key.
struct Presence {
  enum Kind { Required, Optional, Forbidden };
  Kind kind = Optional;
  const char* reason = "";  ///< if forbidden: "has no meaning ..."
  const char* advice = "";  ///< the fix
};
inline constexpr Presence kRequired = {Presence::Required};
inline constexpr Presence kOptional = {Presence::Optional};
inline constexpr Presence kNotOfWall = {Presence::Forbidden, "has no meaning for this kind of wall",
                                        "remove it or choose another kind"};
inline constexpr Presence kNotWithoutFile = {Presence::Forbidden,
                                             "has no meaning without layout = \"file\"",
                                             "remove it, or set particles.start.layout = \"file\""};
inline constexpr Presence kNotBesideFile = {
    Presence::Forbidden, "has no meaning beside layout = \"file\": the file has the velocities",
    "remove it, or choose another layout"};
inline constexpr Presence kNotBesideMass = {Presence::Forbidden, "has no meaning beside mass",
                                            "remove one of the two"};
inline constexpr Presence kNotOfObstacle = {Presence::Forbidden,
                                            "has no meaning for this kind of obstacle",
                                            "remove it or choose another kind"};
inline constexpr Presence kNotOfThermal = {
    Presence::Forbidden, "has no meaning beside temperature: a thermal surface emits all particles",
    "remove one of the two"};
inline constexpr Presence kNotWithoutDrive = {Presence::Forbidden,
                                              "has no meaning without drive_speed for all species",
                                              "remove it, or give drive_speed, which may be 0"};
inline constexpr Presence kNotWithoutTemperature = {
    Presence::Forbidden, "has no meaning without a temperature for all species",
    "remove it, or give a temperature"};
inline constexpr Presence kNotWithoutSpins = {
    Presence::Forbidden, "has no meaning where nothing spins",
    "remove it, or make the particles or a wall rough: give friction above 0, or "
    "tangential_restitution above -1"};
inline constexpr Presence kNotWithoutRamp = {Presence::Forbidden,
                                             "has no meaning without a ramp or a piston",
                                             "remove it, or set ramp = \"linear\""};
inline constexpr Presence kNotOfExact = {
    Presence::Forbidden, "has no meaning for the exact estimator, which counts flights as a whole",
    "remove it, or set estimator = \"snapshot\""};
inline constexpr Presence kNotOfBox = {Presence::Forbidden,
                                       "has no meaning for the box kernel: cells have their size",
                                       "remove it, or set measure.kernel = \"gaussian\""};

inline constexpr Presence kNotObserved = {
    Presence::Forbidden, "has no meaning without its observable",
    "remove it, or add the name of the table to measure.observables"};

inline constexpr Presence kNotBesideParticle = {
    Presence::Forbidden, "has no meaning for one particle",
    "remove it, or give centre and radius of a region instead of particle"};
inline constexpr Presence kOneOfNudge = {Presence::Forbidden,
                                         "contradicts another key: a nudge has one of scale, add "
                                         "and set",
                                         "remove one of the two"};
inline constexpr Presence kNotOfSpheres = {
    Presence::Forbidden, "has no meaning for spheres, whose copies would hide the box",
    "remove it, or give box.size two numbers"};
inline constexpr Presence kNotBesideFollow = {Presence::Forbidden, "has no meaning beside follow",
                                              "remove one of the two"};

}  // namespace clatter
