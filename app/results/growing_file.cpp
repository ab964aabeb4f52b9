#include "app/results/growing_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <utility>

#include "engine/error.h"

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
  if (!keep_complete_records()) fail();
}

bool GrowingFile::keep_complete_records() {
  const auto bytes = static_cast<off_t>(bytes_);
  return ftruncate(file_.get(), bytes) == 0 && lseek(file_.get(), bytes, SEEK_SET) == bytes;
}

void GrowingFile::append(const std::string& records) {
  if (lost_ == 0 && !file_.write_all(std::as_bytes(std::span(records)))) {
    const int error = errno;
    if (!keep_complete_records()) lost_ = error;
    errno = error;
    fail();
  }
  require_no_loss();
  bytes_ += records.size();
}

void GrowingFile::sync() {
  if (lost_ == 0 && !file_.sync()) lost_ = errno;
  require_no_loss();
}

void GrowingFile::require_no_loss() const {
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
