#pragma once

#include <memory>
#include <optional>

#include "engine/system/child_process.h"
#include "render/output/film_join.h"
#include "render/output/frame_sink.h"
#include "render/output/movie_format.h"
#include "render/output/wav_file.h"
#include "render/output/work_queue.h"

namespace clatter {

/// Whether the encoder of films starts.
bool has_film_encoder();

/// The folder for the pieces of a film at `path`: FILE.part beside the file, or beside the target
/// of a link.
std::filesystem::path pieces_folder(const std::filesystem::path& path);

/// A film, encoded by ffmpeg in parallel with the simulation. Pieces of kPiece pictures are encoded
/// separately in the folder FILE.part, and then joined without encoding them again. So a crash
/// loses no complete piece, and a restarted film is bit for bit identical to an uninterrupted one.
class Movie final : public FrameSink {
 public:
  /// Opens a film; the extension of `path` determines its format, also if `path` is a link to
  /// another file. `encoder` is a name on the PATH. Throws UserError if `path` is a device or a
  /// pipe, if pieces of a restarted film are missing, or if the folder has other pieces.
  /// Throws DamagedPiece if pieces have changed, and RunError if files cannot be written or the
  /// encoder cannot start.
  Movie(const std::filesystem::path& path, const SinkOptions& options,
        const std::string& encoder = "ffmpeg");
  ~Movie() override;

  /// True for the extensions ".mp4", ".mov", ".webm", ".gif" and ".mkv".
  static bool knows(const std::string& extension);
  /// True for the extensions of films that can be transparent.
  static bool has_alpha(const std::string& extension);
  /// True for the extensions of films with a choice of the Encoding.
  static bool has_encodings(const std::string& extension);

  void add(Image image, std::vector<PngText> notes) override;
  void add_sound(std::span<const StereoSample> samples) override { sound_->append(samples); }
  std::uint32_t sound_checksum() const override { return sound_ ? sound_->checksum() : 0; }
  /// Waits for the sound only: add() of the last picture of a piece waits for the encoder.
  void flush() override;
  /// Joins the pieces to the film at its path. Then removes the pieces of a whole film, and their
  /// folder unless it has files of others.
  void finish(Ending ending) override;
  std::vector<std::uint32_t> checksums() const override { return checksums_; }

 private:
  std::filesystem::path piece_path(long first) const;
  void hold_folder();
  bool is_own(const std::string& name) const;
  void remove_own_files();
  void require_earlier_pieces();
  std::vector<FilmPart> pieces() const;
  void start_piece();
  void end_piece();
  NewFile new_file(const std::string& name);
  void join();
  void tidy();
  void require_pictures(const std::filesystem::path& film, long count);
  void require_unchanged(const std::vector<FilmPart>& pieces);
  std::string place_of_pieces() const;
  [[noreturn]] void fail(ChildProcess& process);
  [[noreturn]] void fail(const std::string& reason);

  std::filesystem::path path_;
  std::filesystem::path folder_;  ///< folder of the pieces
  FileDescriptor held_;           ///< lock on that folder, against other films of this name
  const MovieFormat* format_;
  SinkOptions options_;
  std::string program_;                    ///< name of the encoder
  std::vector<std::uint32_t> checksums_;   ///< checksums of the complete pieces, in order
  std::vector<PngText> notes_;             ///< texts of the last picture
  long next_;                              ///< number of the next picture
  long piece_ = 0;                         ///< number of the first picture of the current piece
  std::optional<WavFile> sound_;           ///< whole sound, beside the pieces; absent: none
  FileDescriptor file_;                    ///< file of the current piece
  std::unique_ptr<ChildProcess> encoder_;  ///< encoder of the current piece; null: not started
  WorkQueue queue_;                        ///< last member: its thread must end first
};

}  // namespace clatter
