#include "render/output/movie.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "engine/error.h"
#include "engine/system/checksum.h"
#include "engine/system/platform.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

// Inputs of ffmpeg in the folder of the pieces.
constexpr const char* kTexts = "texts.txt";
constexpr const char* kPartList = "pieces.txt";
constexpr const char* kSound = "sound.wav";

// Thrown on the writing thread. The calling thread then reads the error of the encoder.
struct EncoderStopped {};

void require_no_pieces(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (std::filesystem::is_empty(folder, ignored) || ignored) return;
  throw UserError({folder.string()}, "holds the pieces of an interrupted film",
                  "continue it with --resume, or replace it with --overwrite");
}

FileDescriptor open_new(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return open_for_writing(path);
}

// Locks the open folder; false if another program holds the lock. The child of a killed film holds
// it until the child begins its own program, hence the short wait.
bool lock(FileDescriptor& folder) {
  constexpr int kAttempts = 100;
  constexpr std::chrono::milliseconds kPause{10};
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (folder.lock()) return true;
    std::this_thread::sleep_for(kPause);
  }
  return false;
}

}  // namespace

bool has_film_encoder() {
  try {
    return ChildProcess({"ffmpeg", "-version"}).wait();
  } catch (const RunError&) {
    return false;
  }
}

std::filesystem::path pieces_folder(const std::filesystem::path& path) {
  return target_of(path).string() + ".part";
}

Movie::Movie(const std::filesystem::path& path, const SinkOptions& options,
             const std::string& encoder)
    : path_(target_of(path)),
      folder_(pieces_folder(path_)),
      format_(find_movie_format(path.extension())),
      options_(options),
      program_(encoder),
      checksums_(options.checksums),
      notes_(options.notes),
      next_(options.next),
      queue_(1, 4) {
  require_no_device(path_);
  require_writable(path_);
  const bool begins = options.next == options.begin && !options.goes_on;
  if (begins && !options.overwrite) require_no_pieces(folder_);
  require_earlier_pieces();
  hold_folder();
  if (begins) remove_own_files();
  if (options.sound) sound_.emplace(folder_ / kSound, *options.sound, options.sound_checksum);
  start_piece();
}

// Locks the folder, because two films of one name would overwrite each other's pieces. The previous
// film may remove the folder between open_folder() and lock(), hence the loop.
void Movie::hold_folder() {
  std::error_code ignored;
  if (std::filesystem::is_symlink(folder_, ignored)) {
    throw UserError({folder_.string()}, "the folder for the pieces of the film is a link",
                    "remove it, or give another name");
  }
  do {
    std::error_code error;
    std::filesystem::create_directory(folder_, error);
    held_ = open_folder(folder_);
    if (error || !held_) {
      throw RunError("cannot write " + path_.string() + ": " +
                     (error ? error.message() : std::strerror(errno)));
    }
    if (!lock(held_)) {
      throw UserError({path_.string()}, "another program is filming to this name",
                      "wait for its end, or give another name");
    }
  } while (!is_at(held_, folder_));
}

// Whether films write files of this name into the folder: pieces, the joined film, and the inputs
// of ffmpeg with their temporary files.
bool Movie::is_own(const std::string& name) const {
  for (const std::string input : {kPartList, kTexts}) {
    if (name == input || name.starts_with("." + input + ".")) return true;
  }
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  return name == kSound || name == "joined" + format_->extension ||
         (digits >= 6 && name.substr(digits) == format_->extension);
}

void Movie::remove_own_files() {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
    if (is_own(entry.path().filename())) std::filesystem::remove(entry.path(), ignored);
  }
}

void Movie::require_earlier_pieces() {
  const std::vector<FilmPart> earlier = pieces();
  for (const FilmPart& piece : earlier) {
    if (std::filesystem::exists(piece.path)) continue;
    throw UserError({path_.string()},
                    "the piece " + piece.path.string() + " of the film is missing",
                    (std::filesystem::exists(path_) ? "if the film is not complete yet, " : "") +
                        ("name the interrupted film, or start one with --frames " +
                         std::to_string(next_) + ":"));
  }
  for (std::size_t i = checksums_.size(); i < earlier.size(); ++i) {
    checksums_.push_back(checksum_of_file(earlier[i].path).value_or(0));
  }
  checksums_.resize(earlier.size());
  try {
    require_unchanged(earlier);
  } catch (const RunError& error) {
    throw DamagedPiece({path_.string()}, error.what(),
                       "draw the film again with --overwrite, without --resume");
  }
}

Movie::~Movie() {
  tidy();
}

bool Movie::knows(const std::string& extension) {
  return find_movie_format(extension) != nullptr;
}

bool Movie::has_alpha(const std::string& extension) {
  return knows(extension) && !find_movie_format(extension)->clear_pixels.empty();
}

bool Movie::has_encodings(const std::string& extension) {
  return knows(extension) && find_movie_format(extension)->has_encodings();
}

std::filesystem::path Movie::piece_path(long first) const {
  return folder_ / fmt::format("{:06}{}", first, format_->extension);
}

void Movie::start_piece() {
  piece_ = next_;
  const std::filesystem::path piece = piece_path(piece_);
  // Opened before the run, so that an error appears immediately.
  file_ = open_new(piece);
  if (!file_) fail(std::strerror(errno));
  write_file(folder_ / kTexts, metadata_file(options_.texts));
  // An encoder may open its file after its run was killed. This name keeps it from the file of the
  // restarted run.
  const std::string name = name_while_open(file_, piece.string());
  std::error_code ignored;
  try {
    encoder_ = std::make_unique<ChildProcess>(
        encoding_command(program_, *format_, options_,
                         PartsFolder{folder_, held_}.safe_name(kTexts), name),
        Interrupts::Shielded, options_.stop);
  } catch (const RunError& error) {
    std::filesystem::remove(piece, ignored);
    fail(with_install_advice(error));
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

void Movie::flush() {
  if (sound_) sound_->flush();
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
  // A later checkpoint relies on this piece.
  if (!file_.sync()) fail(std::strerror(errno));
  const auto sum = checksum_of_file(piece_path(piece_));
  if (!sum) fail("cannot read " + piece_path(piece_).string());
  checksums_.push_back(*sum);
  // A network file system keeps a removed file, and so its folder, while it is open.
  file_ = FileDescriptor();
}

void Movie::finish(Ending ending) {
  if (encoder_ && next_ > piece_) end_piece();
  tidy();
  if (next_ > options_.begin) join();
  if (ending == Ending::Cut) return;
  remove_own_files();
  std::error_code ignored;
  std::filesystem::remove(folder_, ignored);
}

// The pieces of the film so far, in order. All but the first begin at a multiple of kPiece.
std::vector<FilmPart> Movie::pieces() const {
  std::vector<FilmPart> all;
  for (long first = options_.begin, after; first < next_; first = after) {
    after = std::min((first / kPiece + 1) * kPiece, next_);
    all.push_back({piece_path(first), after - first});
  }
  return all;
}

// A new file in the folder of the pieces, whose lock protects it too.
NewFile Movie::new_file(const std::string& name) {
  const std::filesystem::path path = folder_ / name;
  NewFile made{path, open_new(path)};
  if (!made.file) fail(std::strerror(errno));
  return made;
}

void Movie::join() {
  const std::vector<FilmPart> pieces = this->pieces();
  std::vector<PngText> texts = notes_;
  texts.insert(texts.end(), options_.texts.begin(), options_.texts.end());
  write_file(folder_ / kTexts, metadata_file(texts));
  require_unchanged(pieces);
  flush();
  NewFile list = new_file(kPartList), joined = new_file("joined" + format_->extension);
  try {
    join_films({folder_, held_}, pieces, options_.fps, folder_ / kTexts, sound_ ? kSound : "",
               *format_, list, joined, program_);
  } catch (const RunError& error) {
    fail(error.what());
  }
  try {
    rename_synced(joined.path, path_);
  } catch (const RunError& error) {
    throw RunError(error.what() + place_of_pieces());
  }
}

// The encoder does not notice a piece that was truncated or replaced.
void Movie::require_unchanged(const std::vector<FilmPart>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (checksum_of_file(pieces[i].path) == checksums_[i]) continue;
    throw RunError(pieces[i].path.string() + " is not the piece that was drawn");
  }
}

// Kills the current encoder, and removes files and folders without pictures.
void Movie::tidy() {
  std::error_code ignored;
  if (encoder_) {
    encoder_->kill();
    const std::filesystem::path piece = piece_path(piece_);
    if (pictures_in(piece, program_) == 0) std::filesystem::remove(piece, ignored);
  }
  std::filesystem::remove(folder_ / kTexts, ignored);
  std::filesystem::remove(folder_, ignored);
}

// An encoder may lose pictures without an error, for example if the disk is full at the end.
void Movie::require_pictures(const std::filesystem::path& film, long count) {
  const long found = pictures_in(film, program_);
  if (found == count) return;
  fail(fmt::format("{} has {} of {} pictures; is the disk full?", film.string(), found, count));
}

void Movie::fail(ChildProcess& process) {
  process.kill();
  fail(reason_of(process));
}

void Movie::fail(const std::string& reason) {
  tidy();
  throw RunError("ffmpeg could not write " + path_.string() + ": " + reason + place_of_pieces());
}

// Text to append to an error.
std::string Movie::place_of_pieces() const {
  if (!std::filesystem::exists(folder_)) return "";
  return "; earlier pictures are in " + folder_.string();
}

}  // namespace clatter
