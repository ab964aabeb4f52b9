#pragma once

namespace clatter {

/// The commit of the checkout that the program was built from; empty where there was none. Defined
/// by cmake/Commit.cmake.
extern const char* const kCommit;

}  // namespace clatter
