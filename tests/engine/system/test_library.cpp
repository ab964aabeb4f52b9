#include <doctest/doctest.h>

#include "engine/error.h"
#include "engine/system/library.h"

namespace clatter {

TEST_CASE("Library: a missing library or function is named, with its package") {
  CHECK_THROWS_WITH_AS(Library("libmissing.so.1", "libmissing1"),
                       doctest::Contains("libmissing.so.1: cannot open"), RunError);
  CHECK_THROWS_WITH_AS(Library("libmissing.so.1", "libmissing1"),
                       doctest::Contains("apt install libmissing1"), RunError);
  const Library library("libm.so.6", "libc6");
  CHECK(library.function<double (*)(double)>("cos")(0.0) == 1.0);
  CHECK_THROWS_WITH_AS(library.function<void (*)()>("no_such"), doctest::Contains("no_such"),
                       RunError);
}

}  // namespace clatter
