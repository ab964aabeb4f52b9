#pragma once

namespace clatter {

/// Dual number: a value and its derivative along one variable. Arithmetic computes both (automatic
/// differentiation).
struct Dual {
  double value = 0.0;
  double slope = 0.0;

  /// A constant.
  constexpr Dual(double constant = 0.0) : value(constant) {}
  /// A variable, or a value with a known derivative.
  constexpr Dual(double value, double slope) : value(value), slope(slope) {}
};

constexpr Dual operator-(Dual a) {
  return {-a.value, -a.slope};
}
constexpr Dual operator+(Dual a, Dual b) {
  return {a.value + b.value, a.slope + b.slope};
}
constexpr Dual operator-(Dual a, Dual b) {
  return {a.value - b.value, a.slope - b.slope};
}
constexpr Dual operator*(Dual a, Dual b) {
  return {a.value * b.value, a.value * b.slope + a.slope * b.value};
}
constexpr Dual operator/(Dual a, Dual b) {
  const double ratio = a.value / b.value;
  return {ratio, (a.slope - ratio * b.slope) / b.value};
}

/// The value without the derivative.
constexpr double value_of(Dual a) {
  return a.value;
}
constexpr double value_of(double a) {
  return a;
}

}  // namespace clatter
