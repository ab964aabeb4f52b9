#include "render/output/wav_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/system/checksum.h"
#include "engine/system/write_file.h"
#include "render/output/frame_sink.h"

namespace clatter {

namespace {

constexpr long kHeader = 44;  // bytes
constexpr long kBytes = sizeof(StereoSample);

void append_number(std::string& bytes, std::uint32_t number, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
}

std::string header_of(long samples) {
  const auto data = static_cast<std::uint32_t>(samples * kBytes);
  std::string bytes = "RIFF";
  append_number(bytes, data + 36, 4);
  bytes += "WAVEfmt ";
  append_number(bytes, 16, 4);  // length of this part
  append_number(bytes, 1, 2);   // linear
  append_number(bytes, 2, 2);   // channels
  append_number(bytes, kSampleRate, 4);
  append_number(bytes, kSampleRate * kBytes, 4);
  append_number(bytes, kBytes, 2);
  append_number(bytes, 16, 2);  // bits
  bytes += "data";
  append_number(bytes, data, 4);
  return bytes;
}

std::string bytes_of(std::span<const StereoSample> samples) {
  std::string bytes;
  for (const StereoSample& sample : samples) {
    for (const std::int16_t value : sample) {
      append_number(bytes, static_cast<std::uint16_t>(value), 2);
    }
  }
  return bytes;
}

}  // namespace

WavFile::WavFile(std::filesystem::path path, long samples, std::uint32_t checksum)
    : path_(std::move(path)), file_(open_for_update(path_)), samples_(samples) {
  if (!file_) fail();
  require_samples(checksum);
  if (!file_.resize(end())) fail();
  flush();
}

void WavFile::require_samples(std::uint32_t expected) {
  std::vector<char> bytes(1 << 20);
  for (std::uint64_t place = kHeader; place < end();) {
    const std::size_t most = std::min<std::uint64_t>(bytes.size(), end() - place);
    const std::size_t count = file_.read_at(place, {bytes.data(), most});
    if (count == 0) break;
    checksum_ = continued_checksum(checksum_, {bytes.data(), count});
    place += count;
  }
  if (samples_ == 0 || checksum_ == expected) return;
  throw DamagedPiece({path_.string()}, path_.string() + " is not the sound of the film",
                     "draw the film again with --overwrite, without --resume");
}

// Place of the next sample in the file.
std::uint64_t WavFile::end() const {
  return static_cast<std::uint64_t>(kHeader + samples_ * kBytes);
}

void WavFile::append(std::span<const StereoSample> samples) {
  const std::string bytes = bytes_of(samples);
  if (!file_.write_at(end(), bytes)) fail();
  samples_ += static_cast<long>(samples.size());
  checksum_ = continued_checksum(checksum_, bytes);
}

void WavFile::flush() {
  if (!file_.write_at(0, header_of(samples_)) || !file_.sync()) fail();
  errno = ENOENT;
  if (!is_at(file_, path_)) fail();
}

void WavFile::fail() const {
  throw RunError("cannot write " + path_.string() + ": " + std::strerror(errno));
}

}  // namespace clatter
