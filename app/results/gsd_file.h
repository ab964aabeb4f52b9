#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/results/gsd_layout.h"
#include "engine/system/growing_file.h"

namespace clatter {

/// A chunk of a GSD file: an array of numbers.
struct GsdChunk {
  std::string name;
  GsdType type;
  std::uint64_t rows;
  std::uint32_t columns = 1;
  bool once = false;  ///< whether only the first frame has it; readers use it for all frames
};

/// A GSD file (file layer 2.0, schema "hoomd" 1.4) that grows with a run. All frames have the same
/// chunks. A file consists of the header, the names of the chunks, the index, and the data of the
/// frames. A full index is replaced by one of twice the size at the end of the file. The places of
/// all parts follow from the number of frames, so that a continued file has the same bytes as an
/// uninterrupted one.
class GsdFile {
 public:
  /// Opens a file with the first `bytes` bytes of its content; 0: a new file. Throws UserError if
  /// it has fewer, and RunError if it cannot be written.
  GsdFile(const std::filesystem::path& path, std::vector<GsdChunk> chunks, std::uint64_t bytes);

  /// Whether the file has no frame.
  bool empty() const { return layout_.frames == 0; }
  /// Size of the file with its complete frames.
  std::uint64_t bytes() const { return layout_.bytes; }
  /// Appends a frame: the bytes of each of its chunks, in the order of the chunks. Readers see the
  /// frame when it is complete. Throws RunError.
  void add(const std::vector<std::string>& data);
  /// Waits until the frames are on the disk. Throws RunError, see GrowingFile.
  void sync() { file_->sync(); }
  /// Ends the file with the frames on the disk. Throws RunError.
  void close() { file_->close(); }

 private:
  // The places of the parts of a file.
  struct Layout {
    std::uint64_t bytes = 0;     // of the file
    std::uint64_t index = 0;     // place of the index
    std::uint64_t capacity = 0;  // entries that fit the index
    std::uint64_t entries = 0;   // of all frames
    std::uint64_t frames = 0;
  };

  Layout first_layout() const;
  Layout with_next_frame(Layout layout) const;
  // Bytes of the header, and of the entries of the frame that follows a layout.
  std::string header_of(const Layout& layout) const;
  std::string entries_after(const Layout& layout) const;
  void write_index(std::uint64_t place);
  void clear_index();

  std::vector<GsdChunk> chunks_;
  std::string names_;
  Layout layout_;
  std::optional<GrowingFile> file_;
};

}  // namespace clatter
