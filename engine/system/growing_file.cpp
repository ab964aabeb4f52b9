#include "engine/system/growing_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include "engine/error.h"
#include "engine/system/write_file.h"

namespace clatter {

GrowingFile::GrowingFile(std::filesystem::path path, std::uint64_t bytes)
    : path_(std::move(path)), file_(open_for_writing(path_, bytes == 0)), bytes_(bytes) {
  const bool missing = !file_ && errno == ENOENT && bytes > 0;
  if (!file_ && !missing) fail();
  if (!missing && !file_.lock()) {
    throw UserError({path_.string()}, "another run writes this file", "give another name");
  }
  if (missing || file_.size().value_or(0) < bytes) {
    throw UserError({path_.string()}, "lacks records that precede the checkpoint",
                    "name the file of the interrupted run");
  }
  // Records after the checkpoint are written again.
  if (!file_.resize(bytes)) fail();
}

void GrowingFile::append(std::string_view records) {
  try {
    write(bytes_, records);
  } catch (const RunError&) {
    // The next append overwrites an incomplete record. Until then the file ends before it.
    static_cast<void>(file_.resize(bytes_));
    throw;
  }
  bytes_ += records.size();
}

void GrowingFile::write(std::uint64_t place, std::string_view bytes) {
  if (!file_.write_at(place, bytes)) fail();
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
