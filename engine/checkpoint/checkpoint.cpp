#include "engine/checkpoint/checkpoint.h"

#include <algorithm>
#include <fstream>
#include <limits>

#include "engine/checkpoint/archive.h"
#include "engine/error.h"
#include "engine/system/checksum.h"
#include "engine/system/read_file.h"
#include "engine/system/write_file.h"

namespace clatter {

// A file consists of the magic, the head, the body, and the CRC-32 of all bytes before it.
static constexpr std::string_view kMagic = "clatter checkpoint\r\n\x1a\n";
// Raise it when a struct in the checkpoint changes.
static constexpr std::uint32_t kVersion = 36;

// Program and command come first in every version, so that the error for another version can name
// them.
template <class Archive>
static void visit(Archive& io, Checkpoint& checkpoint) {
  auto& [program, command, scene, start_temperature, seed, saved, measurement, film, trajectory,
         events] = checkpoint;
  io(program, command, scene, start_temperature, seed, saved, measurement, film, trajectory,
     events);
}

namespace {

struct Head {
  std::uint32_t version = kVersion;
  std::uint64_t length = 0;  // of the body, bytes
};

constexpr std::size_t kHeadBytes = sizeof(std::uint32_t) + sizeof(std::uint64_t);
constexpr std::size_t kChecksumBytes = sizeof(std::uint32_t);
constexpr std::size_t kLargest =
    std::min<std::uint64_t>(1'000'000'000'000, std::numeric_limits<std::size_t>::max() / 2);

template <class Archive>
void visit(Archive& io, Head& head) {
  auto& [version, length] = head;
  io(version, length);
}

template <class T>
std::string bytes_of(T& value) {
  ArchiveWriter writer;
  writer(value);
  return writer.written();
}

template <class T>
void read(T& value, std::string_view bytes, const std::filesystem::path& file) {
  ArchiveReader reader(bytes, file.string());
  reader(value);
  reader.finish();
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  const std::filesystem::path previous = previous_checkpoint(file);
  std::error_code ignored;
  throw UserError({file.string()}, what,
                  std::filesystem::exists(previous, ignored)
                      ? "the previous checkpoint is " + previous.string()
                      : "give a file that --checkpoint, an interrupt or a stop has left");
}

std::string read_whole(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) refuse(file, "there is no such file");
  if (!std::filesystem::is_regular_file(file, ignored)) refuse(file, "this is not a file");
  if (!std::ifstream(file)) refuse(file, "the file cannot be read");
  if (!is_checkpoint(file)) refuse(file, "this is not a checkpoint");
  return read_file(file.string(), kLargest, "a checkpoint has about 100 bytes per particle");
}

// Of the body of another version only the beginning is known.
[[noreturn]] void refuse_version(const std::filesystem::path& file, std::uint32_t version,
                                 std::string_view body) {
  std::string program;
  std::string command;
  ArchiveReader reader(body, file.string());
  reader(program, command);
  throw UserError({file.string()},
                  "`" + command + "` of " + program + " wrote this checkpoint, in version " +
                      std::to_string(version) + "; this program reads version " +
                      std::to_string(kVersion),
                  "resume it with " + program);
}

}  // namespace

std::string checkpoint_bytes(Checkpoint& checkpoint) {
  const std::string body = bytes_of(checkpoint);
  Head head{.length = body.size()};
  std::string bytes = std::string(kMagic) + bytes_of(head) + body;
  std::uint32_t sum = checksum(bytes);
  return bytes + bytes_of(sum);
}

Checkpoint checkpoint_of(std::string_view whole, const std::filesystem::path& file) {
  if (!whole.starts_with(kMagic)) refuse(file, "this is not a checkpoint");
  std::string_view bytes = whole;
  const auto take = [&](std::size_t count) {
    if (bytes.size() < count) refuse(file, "the checkpoint is truncated");
    const std::string_view taken = bytes.substr(0, count);
    bytes.remove_prefix(count);
    return taken;
  };
  take(kMagic.size());
  Head head;
  read(head, take(kHeadBytes), file);
  const std::string_view body = take(head.length);
  std::uint32_t sum = 0;
  read(sum, take(kChecksumBytes), file);
  if (!bytes.empty()) refuse(file, "the checkpoint is damaged: extra bytes follow its end");
  if (sum != checksum({whole.data(), whole.size() - kChecksumBytes})) {
    refuse(file, "the checkpoint is damaged: its checksum differs");
  }
  if (head.version != kVersion) refuse_version(file, head.version, body);
  Checkpoint checkpoint;
  read(checkpoint, body, file);
  return checkpoint;
}

void write_checkpoint(const std::filesystem::path& file, Checkpoint& checkpoint) {
  write_file(file, checkpoint_bytes(checkpoint), previous_checkpoint(file));
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  return checkpoint_of(read_whole(file), file);
}

std::filesystem::path previous_checkpoint(const std::filesystem::path& file) {
  return file.string() + ".previous";
}

bool is_checkpoint(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(kMagic.size(), '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  return stream && start == kMagic;
}

}  // namespace clatter
