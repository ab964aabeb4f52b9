#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "engine/system/file_descriptor.h"
#include "render/sound/synthesiser.h"

namespace clatter {

/// Largest number of samples in a WAV file, whose sizes have 32 bits: about 6 hours.
constexpr long kMaxWavSamples = (0xffffffffL - 36) / static_cast<long>(sizeof(StereoSample));

/// A WAV file that grows with a film: stereo, 16 bits, kSampleRate. It is written in place.
class WavFile {
 public:
  /// Opens a file with its first `samples` samples, whose checksum() was `checksum`. Throws
  /// DamagedPiece if it has others, and RunError if it cannot be written.
  WavFile(std::filesystem::path path, long samples, std::uint32_t checksum);

  /// Appends samples. Throws RunError.
  void append(std::span<const StereoSample> samples);
  /// Writes the header for the present length and waits until the file is on the disk. Throws
  /// RunError, also if the file has been removed.
  void flush();
  /// CRC-32 of all samples.
  std::uint32_t checksum() const { return checksum_; }
  const std::filesystem::path& path() const { return path_; }  ///< of the file

 private:
  [[noreturn]] void fail() const;
  std::uint64_t end() const;
  void require_samples(std::uint32_t expected);

  std::filesystem::path path_;
  FileDescriptor file_;
  long samples_;
  std::uint32_t checksum_ = 0;
};

}  // namespace clatter
