#include "render/output/movie.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>

#include "engine/error.h"
#include "engine/system/platform.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

// Thrown on the writing thread; the caller's thread asks the encoder for the reason.
struct EncoderStopped {};

std::filesystem::path folder_for(const std::filesystem::path& path) {
  return path.string() + ".part";
}

void require_no_pieces(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (std::filesystem::is_empty(folder, ignored) || ignored) return;
  throw UserError({folder.string()}, "holds what there is of a film that was cut",
                  "go on with it by --resume, or give --overwrite to film anew");
}

FileDescriptor open_new(const std::filesystem::path& path) {
  unlink(path.c_str());
  return FileDescriptor(open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
}

void make_folder(const std::filesystem::path& folder, const std::filesystem::path& film) {
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (error) throw RunError("cannot write " + film.string() + ": " + error.message());
}

}  // namespace

Movie::Movie(std::filesystem::path path, const SinkOptions& options, const std::string& encoder)
    : path_(std::move(path)),
      folder_(folder_for(path_)),
      format_(find_movie_format(path_.extension())),
      options_(options),
      program_(encoder),
      next_(options.next),
      queue_(1, 4) {
  if (options.next == options.begin && !options.goes_on) {
    if (options.overwrite) std::filesystem::remove_all(folder_);
    require_no_pieces(folder_);
  }
  for (long piece = options.begin; piece < options.next; piece = start_of_piece(piece) + kPiece) {
    if (std::filesystem::exists(piece_path(piece))) continue;
    throw UserError(
        {path_.string()},
        "the film goes on, but its piece " + piece_path(piece).string() + " is not there",
        (std::filesystem::exists(path_) ? "the film may be whole already; else " : "") +
            ("name the film that was cut, or begin one by --frames " +
             std::to_string(options.next) + ":"));
  }
  make_folder(folder_, path_);
  start_piece();
}

Movie::~Movie() {
  tidy();
}

bool Movie::knows(const std::string& extension) {
  return find_movie_format(extension) != nullptr;
}

std::filesystem::path Movie::piece_path(long first) const {
  return folder_ / fmt::format("{:06}{}", first, format_->extension);
}

// The number of the first picture in the piece that has this one.
long Movie::start_of_piece(long number) const {
  return std::max(options_.begin, number / kPiece * kPiece);
}

void Movie::start_piece() {
  piece_ = next_;
  const std::filesystem::path piece = piece_path(piece_);
  // Found out now rather than after the first hour of a run.
  file_ = open_new(piece);
  if (!file_) fail(std::strerror(errno));
  // An encoder may open its file late, after its run was killed. By this name it cannot write into
  // the file of the run that goes on.
  const std::string name = name_while_open(file_, piece.string());
  try {
    encoder_ = std::make_unique<ChildProcess>(encoding_command(program_, *format_, options_, name));
  } catch (const RunError& error) {
    unlink(piece.c_str());
    fail(std::string(error.what()) + "; films need ffmpeg (apt install ffmpeg)");
  }
}

void Movie::add(Image image, std::vector<PngText> notes) {
  if (!encoder_) start_piece();
  try {
    queue_.add([this, image = std::move(image)] {
      if (!encoder_->write(image.rgba)) throw EncoderStopped();
    });
  } catch (const EncoderStopped&) {
    fail(*encoder_);
  }
  notes_ = std::move(notes);
  ++next_;
  if (next_ % kPiece == 0) end_piece();
}

void Movie::end_piece() {
  try {
    queue_.drain();
  } catch (const EncoderStopped&) {
    fail(*encoder_);
  }
  if (!encoder_->wait()) fail(*encoder_);
  encoder_.reset();
  require_pictures(piece_path(piece_), next_ - piece_);
  // A checkpoint may count on it from now on.
  if (!file_.sync()) fail(std::strerror(errno));
}

void Movie::finish(Ending ending) {
  if (encoder_ && next_ > piece_) end_piece();
  tidy();
  if (next_ > options_.begin) join();
  if (ending == Ending::Whole) std::filesystem::remove_all(folder_);
}

// Of the whole film up to now, in order.
std::vector<Movie::Piece> Movie::pieces() const {
  std::vector<Piece> all;
  for (long first = options_.begin, after; first < next_; first = after) {
    after = std::min(start_of_piece(first) + kPiece, next_);
    all.push_back({piece_path(first), after - first});
  }
  return all;
}

void Movie::join() {
  const std::filesystem::path list = folder_ / "pieces.txt";
  std::string text = "ffconcat version 1.0\n";
  for (const Piece& piece : pieces()) {
    text += fmt::format("file {}\nduration {:.9f}\n", piece.path.filename().string(),
                        static_cast<double>(piece.count) / options_.fps);
  }
  write_file(list, text);

  std::vector<PngText> texts = notes_;
  texts.insert(texts.end(), options_.texts.begin(), options_.texts.end());
  const std::filesystem::path joined = folder_ / ("joined" + format_->extension);
  const FileDescriptor file = open_new(joined);
  if (!file) fail(std::strerror(errno));
  ChildProcess joiner(
      joining_command(program_, *format_, texts, list, name_while_open(file, joined.string())));
  if (!joiner.wait()) {
    unlink(joined.c_str());
    fail(joiner);
  }
  try {
    require_pictures(joined, next_ - options_.begin);
  } catch (const RunError&) {
    unlink(joined.c_str());
    // A piece that has changed since is the reason to name.
    for (const Piece& piece : pieces()) require_pictures(piece.path, piece.count);
    throw;
  }
  try {
    rename_synced(joined, path_);
  } catch (const RunError& error) {
    throw RunError(error.what() + place_of_pieces());
  }
}

// Ends the encoder under way, and removes what holds no picture.
void Movie::tidy() {
  if (encoder_) {
    encoder_->kill();
    const std::filesystem::path piece = piece_path(piece_);
    if (pictures_in(piece) == 0) unlink(piece.c_str());
  }
  rmdir(folder_.c_str());
}

// As many as a player would find; -1 where the encoder cannot be started.
long Movie::pictures_in(const std::filesystem::path& film) const {
  std::string list;
  try {
    ChildProcess reader(listing_command(program_, film));
    reader.wait();
    list = reader.new_words();
  } catch (const RunError&) {
    return -1;
  }
  long pictures = 0;
  std::istringstream lines(list);
  for (std::string line; std::getline(lines, line);) pictures += line.starts_with("0,");
  return pictures;
}

// An encoder may lose pictures and succeed, for one where a disk is full at the end of a film.
void Movie::require_pictures(const std::filesystem::path& film, long count) {
  const long found = pictures_in(film);
  if (found == count) return;
  fail(fmt::format("{} has {} of {} pictures; is the disk full?", film.string(), found, count));
}

void Movie::fail(ChildProcess& process) {
  process.kill();
  fail(process.last_words());
}

void Movie::fail(const std::string& reason) {
  tidy();
  throw RunError("ffmpeg could not write " + path_.string() + ": " + reason + place_of_pieces());
}

// To be added to an error.
std::string Movie::place_of_pieces() const {
  if (!std::filesystem::exists(folder_)) return "";
  return "; what was filmed before is in " + folder_.string();
}

}  // namespace clatter
