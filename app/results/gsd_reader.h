#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace clatter {

/// Reads a GSD file of the schema "hoomd". Every function throws UserError if the file is damaged.
class GsdReader {
 public:
  explicit GsdReader(const std::filesystem::path& path);

  /// Number of frames.
  std::uint64_t frames() const { return frames_; }
  /// The numbers of a chunk of a frame, or of the first frame if that frame lacks it; empty: the
  /// file has none. Throws UserError if there are not `count` numbers.
  std::vector<double> numbers(const std::string& name, std::uint64_t frame, std::uint64_t count);

 private:
  struct Chunk {
    std::uint64_t frame;
    std::uint64_t count;
    std::uint64_t place;
    std::uint16_t name;
    std::uint8_t type;
  };

  std::string bytes_at(std::uint64_t place, std::uint64_t size);
  [[noreturn]] void refuse_damaged(const std::string& what) const;

  std::filesystem::path path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::vector<std::string> names_;
  std::vector<Chunk> chunks_;  // in the order of frames
  std::uint64_t frames_ = 0;
};

}  // namespace clatter
