#pragma once

#include <array>
#include <cstdint>

// The file layer of GSD, version 2.0: https://gsd.readthedocs.io/en/stable/file-layer.html

namespace clatter {

/// The first bytes of a file, and the versions of schema and file layer, major in the upper half.
inline constexpr std::uint64_t kGsdMagic = 0x65DF65DF65DF65DF;
inline constexpr std::uint32_t kSchemaVersion = 1 << 16 | 4;
inline constexpr std::uint32_t kGsdVersion = 2 << 16;
/// The list of names is a multiple of these bytes.
inline constexpr std::uint64_t kGsdNameUnit = 64;

/// Type of the numbers in a chunk.
enum class GsdType : std::uint8_t {
  UInt8 = 1,
  UInt16,
  UInt32,
  UInt64,
  Int8,
  Int16,
  Int32,
  Int64,
  Float,
  Double
};

/// Bytes of a number; 0: unknown type.
inline std::uint64_t gsd_number_size(GsdType type) {
  switch (type) {
    case GsdType::UInt8:
    case GsdType::Int8:
      return 1;
    case GsdType::UInt16:
    case GsdType::Int16:
      return 2;
    case GsdType::UInt32:
    case GsdType::Int32:
    case GsdType::Float:
      return 4;
    case GsdType::UInt64:
    case GsdType::Int64:
    case GsdType::Double:
      return 8;
  }
  return 0;
}

/// The begin of a file.
struct GsdHeader {
  std::uint64_t magic = kGsdMagic;
  std::uint64_t index = 0;  ///< place
  std::uint64_t index_entries = 0;
  std::uint64_t names = 0;        ///< place
  std::uint64_t names_units = 0;  ///< size of the names, in kGsdNameUnit bytes
  std::uint32_t schema_version = kSchemaVersion;
  std::uint32_t file_version = kGsdVersion;
  std::array<char, 64> application = {"clatter " CLATTER_VERSION};
  std::array<char, 64> schema = {"hoomd"};
  std::array<char, 80> reserved = {};
};
static_assert(sizeof(GsdHeader) == 256);

/// The place of a chunk of a frame.
struct GsdEntry {
  std::uint64_t frame;
  std::uint64_t rows;
  std::int64_t place;  ///< of the data in the file; 0: the entry is free
  std::uint32_t columns;
  std::uint16_t name;  ///< number in the list of names
  std::uint8_t type;
  std::uint8_t flags = 0;
};
static_assert(sizeof(GsdEntry) == 32);

}  // namespace clatter
