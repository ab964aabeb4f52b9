#include "app/import/gsd_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "app/results/gsd_layout.h"
#include "engine/error.h"

namespace clatter {

namespace {

template <class T>
std::vector<double> as_doubles(const std::string& bytes) {
  std::vector<T> numbers(bytes.size() / sizeof(T));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(T));
  return {numbers.begin(), numbers.end()};
}

std::vector<double> as_doubles(const std::string& bytes, GsdType type) {
  switch (type) {
    case GsdType::UInt8:
      return as_doubles<std::uint8_t>(bytes);
    case GsdType::UInt16:
      return as_doubles<std::uint16_t>(bytes);
    case GsdType::UInt32:
      return as_doubles<std::uint32_t>(bytes);
    case GsdType::UInt64:
      return as_doubles<std::uint64_t>(bytes);
    case GsdType::Int8:
      return as_doubles<std::int8_t>(bytes);
    case GsdType::Int16:
      return as_doubles<std::int16_t>(bytes);
    case GsdType::Int32:
      return as_doubles<std::int32_t>(bytes);
    case GsdType::Int64:
      return as_doubles<std::int64_t>(bytes);
    case GsdType::Float:
      return as_doubles<float>(bytes);
    case GsdType::Double:
      return as_doubles<double>(bytes);
  }
  return {};
}

}  // namespace

void GsdReader::refuse_damaged(const std::string& what) const {
  throw UserError({path_.string()}, "the file is damaged: " + what, "give a complete GSD file");
}

std::string GsdReader::bytes_at(std::uint64_t place, std::uint64_t size) {
  if (place > size_ || size > size_ - place) refuse_damaged("it is too short");
  std::string bytes(size, '\0');
  file_.seekg(static_cast<std::streamoff>(place));
  file_.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!file_) refuse_damaged("it cannot be read");
  return bytes;
}

GsdReader::GsdReader(const std::filesystem::path& path)
    : path_(path), file_(path, std::ios::binary) {
  file_.seekg(0, std::ios::end);
  size_ = file_ ? static_cast<std::uint64_t>(file_.tellg()) : 0;
  GsdHeader header;
  if (size_ < sizeof(header)) refuse_damaged("it has no header");
  std::memcpy(&header, bytes_at(0, sizeof(header)).data(), sizeof(header));
  if (header.magic != kGsdMagic) {
    throw UserError({path_.string()}, "this is not a GSD file", "give a trajectory of this format");
  }
  const auto text_of = [](const auto& bytes) {
    return std::string(bytes.begin(), std::ranges::find(bytes, '\0'));
  };
  if (text_of(header.schema) != "hoomd" || header.schema_version >> 16 > 2 ||
      header.file_version >> 16 > 2) {
    throw UserError({path_.string()},
                    "the GSD file is not of the schema \"hoomd\", versions 0 to 2",
                    "give a trajectory of HOOMD-blue");
  }
  if (header.names_units > size_ / kGsdNameUnit ||
      header.index_entries > size_ / sizeof(GsdEntry)) {
    refuse_damaged("it is too short");
  }
  std::string name;
  for (const char letter : bytes_at(header.names, header.names_units * kGsdNameUnit)) {
    if (letter != '\0') {
      name += letter;
    } else if (!name.empty()) {
      names_.push_back(name);
      name.clear();
    }
  }
  const std::string index = bytes_at(header.index, header.index_entries * sizeof(GsdEntry));
  bool ended = false;  // free entries follow the others
  for (std::size_t place = 0; place < index.size(); place += sizeof(GsdEntry)) {
    GsdEntry entry;
    std::memcpy(&entry, index.data() + place, sizeof(entry));
    ended = ended || entry.place == 0;
    if (entry.place == 0) continue;
    const std::uint64_t size = gsd_number_size(static_cast<GsdType>(entry.type));
    const auto begin = static_cast<std::uint64_t>(entry.place);
    const bool fits = size > 0 && entry.columns > 0 && begin <= size_ &&
                      entry.rows <= (size_ - begin) / size / entry.columns;
    const bool ordered = !ended && entry.frame < header.index_entries &&
                         (chunks_.empty() || entry.frame >= chunks_.back().frame);
    if (!fits || !ordered || entry.name >= names_.size() || entry.flags != 0) {
      refuse_damaged("an entry of its index is wrong");
    }
    chunks_.push_back({entry.frame, entry.rows, entry.columns, begin, entry.name, entry.type});
  }
  frames_ = chunks_.empty() ? 0 : chunks_.back().frame + 1;
}

const GsdReader::Chunk* GsdReader::find(const std::string& name, std::uint64_t frame) const {
  const auto number = std::ranges::find(names_, name) - names_.begin();
  const auto begin = std::ranges::lower_bound(chunks_, frame, {}, &Chunk::frame);
  const auto end = std::ranges::upper_bound(chunks_, frame, {}, &Chunk::frame);
  const auto chunk = std::find_if(
      begin, end, [&](const Chunk& each) { return std::ptrdiff_t{each.name} == number; });
  return chunk == end ? nullptr : &*chunk;
}

std::optional<std::vector<double>> GsdReader::numbers(const std::string& name, std::uint64_t frame,
                                                      std::uint64_t rows, std::uint64_t columns) {
  const Chunk* const chunk = find(name, frame);
  if (!chunk) return std::nullopt;
  if (chunk->rows != rows || chunk->columns != columns) {
    throw UserError({path_.string()},
                    "the chunk " + name + " has the shape " + std::to_string(chunk->rows) + " x " +
                        std::to_string(chunk->columns) + " instead of " + std::to_string(rows) +
                        " x " + std::to_string(columns),
                    "give a GSD file whose chunks have the shapes of HOOMD-blue");
  }
  const auto type = static_cast<GsdType>(chunk->type);
  return as_doubles(bytes_at(chunk->place, rows * columns * gsd_number_size(type)), type);
}

std::vector<std::string> GsdReader::texts(const std::string& name, std::uint64_t frame) {
  const Chunk* const chunk = find(name, frame);
  if (!chunk) return {};
  if (gsd_number_size(static_cast<GsdType>(chunk->type)) != 1) {
    throw UserError({path_.string()}, "the chunk " + name + " has no texts",
                    "give a GSD file whose chunks have the types of HOOMD-blue");
  }
  std::vector<std::string> texts;
  for (std::uint64_t row = 0; row < chunk->rows; ++row) {
    const std::string bytes = bytes_at(chunk->place + row * chunk->columns, chunk->columns);
    texts.push_back(bytes.substr(0, bytes.find('\0')));
  }
  return texts;
}

}  // namespace clatter
