#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace clatter {

/// Reads a GSD file of the schema "hoomd". Every function throws UserError if the file is damaged.
class GsdReader {
 public:
  /// Opens a file.
  explicit GsdReader(const std::filesystem::path& path);

  /// Number of frames.
  std::uint64_t frames() const { return frames_; }
  /// Whether a frame has a chunk.
  bool has(const std::string& name, std::uint64_t frame) const {
    return find(name, frame) != nullptr;
  }
  /// The numbers of a chunk of a frame with rows of `columns` numbers; absent: the frame has no
  /// such chunk. Throws UserError if the chunk has another shape.
  std::optional<std::vector<double>> numbers(const std::string& name, std::uint64_t frame,
                                             std::uint64_t rows, std::uint64_t columns);
  /// The texts in the rows of a chunk of a frame; empty: the frame has no such chunk. Throws
  /// UserError if it has no bytes.
  std::vector<std::string> texts(const std::string& name, std::uint64_t frame);

 private:
  struct Chunk {
    std::uint64_t frame;
    std::uint64_t rows;
    std::uint64_t columns;
    std::uint64_t place;
    std::uint16_t name;
    std::uint8_t type;
  };

  const Chunk* find(const std::string& name, std::uint64_t frame) const;
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
