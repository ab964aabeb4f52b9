#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>

namespace clatter {

/// Closes a stream of the C library.
struct CloseStream {
  void operator()(std::FILE* stream) const { std::fclose(stream); }
};

/// Owner of a stream of the C library.
using CStream = std::unique_ptr<std::FILE, CloseStream>;

/// All bytes of a file that the user named. Throws UserError if it cannot be read or has more than
/// `largest` bytes. `wanted` is the advice of the latter error.
std::string read_file(const std::string& path, std::size_t largest, const std::string& wanted);

}  // namespace clatter
