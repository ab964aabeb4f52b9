#include "app/results/gsd_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
#include <utility>

#include "app/results/gsd_layout.h"

namespace clatter {

namespace {

constexpr std::uint64_t kFirstCapacity = 256;  // entries
constexpr std::uint64_t kGsdPiece = 1 << 20;   // bytes that are written at once

template <class T>
std::string plain_bytes(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

std::uint64_t gsd_chunk_size(const GsdChunk& chunk) {
  return chunk.rows * chunk.columns * gsd_number_size(chunk.type);
}

std::string gsd_names(const std::vector<GsdChunk>& chunks) {
  std::string names;
  for (const GsdChunk& chunk : chunks) names += chunk.name + '\0';
  names.resize((names.size() / kGsdNameUnit + 1) * kGsdNameUnit, '\0');
  return names;
}

// Whether the frame that follows `frames` others has a chunk.
bool frame_has(const GsdChunk& chunk, std::uint64_t frames) {
  return frames == 0 || !chunk.once;
}

}  // namespace

GsdFile::GsdFile(const std::filesystem::path& path, std::vector<GsdChunk> chunks,
                 std::uint64_t bytes)
    : chunks_(std::move(chunks)), names_(gsd_names(chunks_)), layout_(first_layout()) {
  while (layout_.bytes < bytes) layout_ = with_next_frame(layout_);
  file_.emplace(path, bytes);
  // An interrupted run may have listed later frames, also in a later index.
  file_->write(0, header_of(layout_) + names_);
  clear_index();
}

GsdFile::Layout GsdFile::first_layout() const {
  const std::uint64_t index = sizeof(GsdHeader) + names_.size();
  return {.bytes = index + kFirstCapacity * sizeof(GsdEntry),
          .index = index,
          .capacity = kFirstCapacity};
}

GsdFile::Layout GsdFile::with_next_frame(Layout layout) const {
  std::uint64_t bytes = 0;
  for (const GsdChunk& chunk : chunks_) {
    if (!frame_has(chunk, layout.frames)) continue;
    ++layout.entries;
    bytes += gsd_chunk_size(chunk);
  }
  if (layout.entries > layout.capacity) {
    layout.index = layout.bytes;
    layout.capacity *= 2;
    layout.bytes += layout.capacity * sizeof(GsdEntry);
  }
  layout.bytes += bytes;
  ++layout.frames;
  return layout;
}

std::string GsdFile::header_of(const Layout& layout) const {
  return plain_bytes(GsdHeader{.index = layout.index,
                               .index_entries = layout.capacity,
                               .names = sizeof(GsdHeader),
                               .names_units = names_.size() / kGsdNameUnit});
}

// The data of a frame end where the file ends. Entries are in the order of the names, because
// readers search them by bisection.
std::string GsdFile::entries_after(const Layout& layout) const {
  std::uint64_t place = with_next_frame(layout).bytes;
  for (const GsdChunk& chunk : chunks_)
    place -= frame_has(chunk, layout.frames) ? gsd_chunk_size(chunk) : 0;
  std::string entries;
  for (std::size_t k = 0; k < chunks_.size(); ++k) {
    const GsdChunk& chunk = chunks_[k];
    if (!frame_has(chunk, layout.frames)) continue;
    entries += plain_bytes(GsdEntry{.frame = layout.frames,
                                    .rows = chunk.rows,
                                    .place = static_cast<std::int64_t>(place),
                                    .columns = chunk.columns,
                                    .name = static_cast<std::uint16_t>(k),
                                    .type = static_cast<std::uint8_t>(chunk.type)});
    place += gsd_chunk_size(chunk);
  }
  return entries;
}

// Writes the entries of all frames at a place.
void GsdFile::write_index(std::uint64_t place) {
  std::string piece;
  for (Layout walk = first_layout(); walk.frames < layout_.frames; walk = with_next_frame(walk)) {
    piece += entries_after(walk);
    if (piece.size() < kGsdPiece && walk.frames + 1 < layout_.frames) continue;
    file_->write(place, piece);
    place += piece.size();
    piece.clear();
  }
}

// Clears the entries after those of the frames.
void GsdFile::clear_index() {
  const std::uint64_t end = layout_.index + layout_.capacity * sizeof(GsdEntry);
  std::uint64_t place = layout_.index + layout_.entries * sizeof(GsdEntry);
  while (place < end) {
    const std::string zeros(std::min(end - place, kGsdPiece), '\0');
    file_->write(place, zeros);
    place += zeros.size();
  }
}

void GsdFile::add(const std::vector<std::string>& data) {
  const Layout next = with_next_frame(layout_);
  const bool moves = next.index != layout_.index;
  if (moves) write_index(next.index);
  std::string frame;
  for (std::size_t k = 0; k < chunks_.size(); ++k) {
    if (frame_has(chunks_[k], layout_.frames)) frame += data[k];
  }
  file_->write(next.bytes - frame.size(), frame);
  file_->write(next.index + layout_.entries * sizeof(GsdEntry), entries_after(layout_));
  if (moves) file_->write(0, header_of(next));
  layout_ = next;
}

}  // namespace clatter
