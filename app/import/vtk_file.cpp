#include "app/import/vtk_file.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>

#include "engine/error.h"
#include "engine/system/read_file.h"
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

constexpr std::size_t kLargestVtkFile = 4'000'000'000;  // bytes
constexpr std::uint64_t kAnySize = std::numeric_limits<std::uint64_t>::max();

constexpr std::string_view kVtkBlanks = " \t\r\n";

// The numbers of six bits of the letters of base64. Other characters have kNoLetter.
constexpr unsigned char kNoLetter = 64;
constexpr std::array<unsigned char, 256> kSixBits = [] {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<unsigned char, 256> numbers;
  numbers.fill(kNoLetter);
  for (std::size_t k = 0; k < kLetters.size(); ++k) {
    numbers[static_cast<unsigned char>(kLetters[k])] = static_cast<unsigned char>(k);
  }
  return numbers;
}();

// The first bytes of a text in base64, at most `size`. Padding may follow each part of the bytes:
// writers encode the header and the data together or one by one.
std::string bytes_in_base64(std::string_view text, std::size_t size) {
  std::string bytes;
  unsigned bits = 0, letters = 0, count = 0;
  for (const char letter : text) {
    if (bytes.size() >= size) break;
    if (kVtkBlanks.find(letter) != kVtkBlanks.npos) continue;
    const unsigned number = kSixBits[static_cast<unsigned char>(letter)];
    if (number == kNoLetter && letter != '=') break;
    bits = bits << 6 | number % kNoLetter;
    letters += number == kNoLetter ? 0 : 1;
    if (++count < 4) continue;
    for (unsigned k = 0; k + 1 < letters; ++k) {
      bytes += static_cast<char>(bits >> (16 - 8 * k) & 0xffu);
    }
    bits = letters = count = 0;
  }
  bytes.resize(std::min(bytes.size(), size));
  return bytes;
}

// Binary data of an array.
struct BinaryData {
  std::string_view text;
  bool base64;

  // The first bytes, fewer if the data end.
  std::string first(std::size_t size) const {
    return base64 ? bytes_in_base64(text, size) : std::string(text.substr(0, size));
  }
  // No more bytes than these are in the data.
  std::size_t most() const { return text.size(); }
};

template <class T>
T number_at(const char* bytes, bool swapped) {
  std::array<char, sizeof(T)> own;
  std::memcpy(own.data(), bytes, sizeof(T));
  if (swapped) std::ranges::reverse(own);
  return std::bit_cast<T>(own);
}

template <class T>
std::vector<double> numbers_of(const std::string& bytes, bool swapped) {
  std::vector<double> numbers;
  numbers.reserve(bytes.size() / sizeof(T));
  for (std::size_t place = 0; place < bytes.size(); place += sizeof(T)) {
    numbers.push_back(static_cast<double>(number_at<T>(&bytes[place], swapped)));
  }
  return numbers;
}

// A type of numbers of VTK.
struct NumberType {
  std::string_view name;
  std::size_t size;
  std::vector<double> (*numbers)(const std::string& bytes, bool swapped);
};

constexpr std::array<NumberType, 10> kNumberTypes = {{{"Float64", 8, numbers_of<double>},
                                                      {"Float32", 4, numbers_of<float>},
                                                      {"Int64", 8, numbers_of<std::int64_t>},
                                                      {"UInt64", 8, numbers_of<std::uint64_t>},
                                                      {"Int32", 4, numbers_of<std::int32_t>},
                                                      {"UInt32", 4, numbers_of<std::uint32_t>},
                                                      {"Int16", 2, numbers_of<std::int16_t>},
                                                      {"UInt16", 2, numbers_of<std::uint16_t>},
                                                      {"Int8", 1, numbers_of<std::int8_t>},
                                                      {"UInt8", 1, numbers_of<std::uint8_t>}}};

// The words between blanks and ends of lines.
std::vector<std::string_view> words_between(std::string_view text) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = text.find_first_not_of(kVtkBlanks);
    if (begin == text.npos) return words;
    text.remove_prefix(begin);
    const std::size_t end = std::min(text.find_first_of(kVtkBlanks), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

// Unsigned numbers, of four or of eight bytes each.
std::vector<std::uint64_t> words_in(const std::string& bytes, std::size_t word, bool swapped) {
  std::vector<std::uint64_t> words;
  for (std::size_t place = 0; place + word <= bytes.size(); place += word) {
    words.push_back(word == 8 ? number_at<std::uint64_t>(&bytes[place], swapped)
                              : number_at<std::uint32_t>(&bytes[place], swapped));
  }
  return words;
}

// Appends what a block of zlib has, which must be `size` bytes. Returns whether it is.
bool add_inflated(const char* block, std::size_t length, std::size_t size, std::string& bytes) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
      decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  const std::size_t before = bytes.size();
  bytes.resize(before + size);
  return libdeflate_zlib_decompress(decompressor.get(), block, length, &bytes[before], size,
                                    nullptr) == LIBDEFLATE_SUCCESS;
}

// Other formats are text, as for VTK.
bool is_binary_array(const XmlElement& array) {
  const std::string format = array.attribute("format");
  return format == "binary" || format == "appended";
}

// The bytes behind a header that has their number. Absent: they are cut off, or more or fewer than
// expected.
std::optional<std::string> uncompressed_bytes(const BinaryData& data, std::size_t word,
                                              bool swapped, std::uint64_t expected) {
  const std::vector<std::uint64_t> head = words_in(data.first(word), word, swapped);
  if (head.empty() || head[0] > data.most()) return std::nullopt;
  if (expected != kAnySize && head[0] != expected) return std::nullopt;
  std::string bytes = data.first(word + head[0]);
  if (bytes.size() != word + head[0]) return std::nullopt;
  return bytes.substr(word);
}

// The same of compressed bytes. Their header has the number of blocks, the size of a block and of
// the last one, which is 0 if all are alike, and the compressed sizes.
std::optional<std::string> inflated_bytes(const BinaryData& data, std::size_t word, bool swapped,
                                          std::uint64_t expected) {
  constexpr std::uint64_t kMostRatio = 1040;  // that of zlib is 1032
  const std::vector<std::uint64_t> begin = words_in(data.first(3 * word), word, swapped);
  const bool empty = !begin.empty() && begin[0] == 0;
  if (empty && (expected == 0 || expected == kAnySize)) return "";
  if (empty || begin.size() < 3 || begin[0] > data.most() / word) return std::nullopt;
  const std::uint64_t blocks = begin[0], size = begin[1], last = begin[2] == 0 ? size : begin[2];
  const std::uint64_t most = kMostRatio * data.most();
  if (size > most || last > most || (blocks > 1 && size > most / (blocks - 1))) return std::nullopt;
  const std::uint64_t all = (blocks - 1) * size + last;
  if (expected != kAnySize && all != expected) return std::nullopt;
  const std::size_t head_size = (3 + blocks) * word;
  const std::vector<std::uint64_t> head = words_in(data.first(head_size), word, swapped);
  if (head.size() < 3 + blocks) return std::nullopt;
  std::uint64_t end = head_size;
  for (std::size_t k = 3; k < head.size(); ++k) {
    if (head[k] > data.most()) return std::nullopt;
    end += head[k];
  }
  const std::string compressed = end > data.most() ? "" : data.first(end);
  if (compressed.size() != end) return std::nullopt;
  std::string bytes;
  std::size_t place = head_size;
  for (std::size_t k = 3; k < head.size(); place += head[k++]) {
    const std::size_t block = k + 1 == head.size() ? last : size;
    if (!add_inflated(&compressed[place], head[k], block, bytes)) return std::nullopt;
  }
  return bytes;
}

}  // namespace

VtkFile::VtkFile(const std::filesystem::path& path, const std::string& type)
    : path_(path), text_(read_file(path.string(), kLargestVtkFile, "give a smaller file")) {
  root_ = parse_xml(text_, "AppendedData", path);
  if (root_.name != "VTKFile" || root_.attribute("type") != type) {
    refuse(root_, "this is no file of VTK of the type " + type, "give one of this type");
  }
  const std::string compressor = root_.attribute("compressor");
  compressed_ = compressor == "vtkZLibDataCompressor";
  if (!compressed_ && !compressor.empty()) {
    refuse(root_, "the arrays are compressed by " + quoted_start(compressor),
           "write the file with the compressor zlib, or without one");
  }
  const std::string order = root_.attribute("byte_order");
  const bool is_little = std::endian::native == std::endian::little;
  swapped_ = order == (is_little ? "BigEndian" : "LittleEndian");
  if (root_.attribute("header_type") == "UInt64") word_ = 8;
  data_ = root_.child(type);
  if (data_ == nullptr) refuse(root_, "the element " + type + " is missing", "give a whole file");
  const XmlElement* const appended = root_.child("AppendedData");
  if (appended == nullptr) return;
  // The parser of XML does not see the end of the file.
  const std::string_view whole =
      std::string_view(text_).substr(0, text_.find_last_not_of(kVtkBlanks) + 1);
  const std::size_t begin = text_.find('_', appended->content);
  if (begin == text_.npos || !whole.ends_with("</VTKFile>")) {
    refuse(*appended, "the file is cut off within its data", "give a complete file");
  }
  appended_ = whole.substr(begin + 1);
  appended_in_base64_ = appended->attribute("encoding") == "base64";
}

void VtkFile::refuse(const XmlElement& element, const std::string& problem,
                     const std::string& advice) const {
  throw UserError({path_.string(), element.line}, problem, advice);
}

// The binary data of an array of `expected` bytes.
std::string VtkFile::bytes_of(const XmlElement& array, std::uint64_t expected) const {
  BinaryData data{array.text, true};
  if (array.attribute("format") == "appended") {
    const auto offset = whole_number<std::size_t>(array.attribute("offset"));
    const std::size_t begin = offset.value_or(appended_.size());
    data = {appended_.substr(std::min(begin, appended_.size())), appended_in_base64_};
  }
  const auto read = compressed_ ? inflated_bytes : uncompressed_bytes;
  const std::optional<std::string> bytes = read(data, word_, swapped_, expected);
  if (bytes) return *bytes;
  refuse(array, "the array " + quoted_start(array.attribute("Name")) + " is damaged or cut off",
         "give a complete file");
}

std::vector<double> VtkFile::numbers(const XmlElement& array, std::size_t count) const {
  const std::string name = "the array " + quoted_start(array.attribute("Name"));
  const std::string type = array.attribute("type");
  const auto found = std::ranges::find(kNumberTypes, type, &NumberType::name);
  if (found == kNumberTypes.end()) {
    refuse(array, name + " has the type " + quoted_start(type), "give numbers");
  }
  if (is_binary_array(array)) {
    return found->numbers(bytes_of(array, count * found->size), swapped_);
  }
  std::vector<double> numbers;
  for (const std::string_view word : words_between(array.text)) {
    const std::optional<double> number = signed_number<double>(word);
    if (!number) refuse(array, name + " has " + quoted_start(word), "give numbers");
    numbers.push_back(*number);
  }
  if (numbers.size() == count) return numbers;
  refuse(
      array,
      name + " has " + counted(numbers.size(), "number") + " instead of " + std::to_string(count),
      "give a complete file");
}

// Each text ends with a zero. As ASCII the bytes are numbers.
std::vector<std::string> VtkFile::texts(const XmlElement& array) const {
  std::string bytes;
  if (!is_binary_array(array)) {
    for (const std::string_view word : words_between(array.text)) {
      bytes += static_cast<char>(whole_number<int>(word).value_or('?'));
    }
  } else {
    bytes = bytes_of(array, kAnySize);
  }
  std::vector<std::string> texts;
  std::string_view rest = bytes;
  for (std::size_t end = rest.find('\0'); end != rest.npos; end = rest.find('\0')) {
    texts.emplace_back(rest.substr(0, end));
    rest.remove_prefix(end + 1);
  }
  return texts;
}

}  // namespace clatter
