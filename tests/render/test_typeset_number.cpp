#include <doctest/doctest.h>

#include "render/typeset_number.h"

namespace clatter {

TEST_CASE("Typeset number: numbers with an exponent have a superscript, other texts stay") {
  CHECK(typeset_number("8.85e-06") == "8.85×10⁻⁶");
  CHECK(typeset_number("T = 1.20e+13") == "T = 1.20×10¹³");
  CHECK(typeset_number("0.231") == "0.231");
  CHECK(power_text(0) == "10⁰");
  CHECK(power_text(-307) == "10⁻³⁰⁷");
}

TEST_CASE("Typeset number: groups of three digits have thin spaces between them") {
  CHECK(grouped_digits(0) == "0");
  CHECK(grouped_digits(999) == "999");
  CHECK(grouped_digits(1000) == "1\u2009000");
  CHECK(grouped_digits(12'345'678) == "12\u2009345\u2009678");
}

}  // namespace clatter
