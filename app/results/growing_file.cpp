#include "app/results/growing_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "engine/error.h"
#include "engine/system/write_file.h"

namespace clatter {

GrowingFile::GrowingFile(std::filesystem::path path, std::uint64_t bytes)
    : path_(std::move(path)),
      file_(open(path_.c_str(), O_WRONLY | O_CLOEXEC | (bytes > 0 ? 0 : O_CREAT), 0666)),
      bytes_(bytes) {
  const bool missing = !file_ && errno == ENOENT && bytes > 0;
  if (!file_ && !missing) fail();
  if (!missing && flock(file_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw UserError({path_.string()}, "another run writes this file", "give another name");
  }
  struct stat status;
  if (missing || fstat(file_.get(), &status) != 0 ||
      static_cast<std::uint64_t>(status.st_size) < bytes) {
    throw UserError({path_.string()}, "lacks records that precede the checkpoint",
                    "name the file of the interrupted run");
  }
  // Records after the checkpoint are written again.
  if (ftruncate(file_.get(), static_cast<off_t>(bytes)) != 0) fail();
}

void GrowingFile::append(std::string_view records) {
  try {
    write(bytes_, records);
  } catch (const RunError&) {
    // The next append overwrites an incomplete record. Until then the file ends before it.
    static_cast<void>(ftruncate(file_.get(), static_cast<off_t>(bytes_)) == 0);
    throw;
  }
  bytes_ += records.size();
}

void GrowingFile::write(std::uint64_t place, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written =
        pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (written < 0 && errno != EINTR) fail();
    if (written <= 0) continue;
    bytes.remove_prefix(static_cast<std::size_t>(written));
    place += static_cast<std::uint64_t>(written);
  }
}

void GrowingFile::sync() {
  if (lost_ == 0 && file_ && !file_.sync()) lost_ = errno;
  if (lost_ == 0 && file_ && !is_at(file_, path_)) lost_ = ENOENT;
  errno = lost_;
  if (lost_ != 0) fail();
}

void GrowingFile::close() {
  sync();
  if (!file_.close()) fail();
}

void GrowingFile::fail() const {
  throw RunError("cannot write " + path_.string() + ": " + std::strerror(errno));
}

}  // namespace clatter
