#pragma once

namespace clatter {

/// The commit of the checkout from which the program was built. Empty if there was no checkout.
/// Defined by cmake/Commit.cmake.
extern const char* const kCommit;

}  // namespace clatter
