#pragma once

#include <memory>

#include "engine/system/child_process.h"
#include "render/output/frame_sink.h"
#include "render/output/movie_format.h"
#include "render/output/work_queue.h"

namespace clatter {

/// A film, encoded by ffmpeg beside the simulation: in pieces of so many pictures, each by itself,
/// in a folder FILE.part, which are then joined without encoding them anew. So a film that was cut
/// and taken up again is the same to the bit, and what is encoded is safe.
class Movie final : public FrameSink {
 public:
  /// The kind of film is that of the extension. Throws UserError where the folder lacks pieces of a
  /// film that goes on, or holds those of another one; RunError where files cannot be written or
  /// `encoder`, a name on the PATH, cannot be started.
  Movie(std::filesystem::path path, const SinkOptions& options,
        const std::string& encoder = "ffmpeg");
  ~Movie() override;

  /// Whether there is a kind of film of this extension: ".mp4", ".webm", ".gif", ".mkv".
  static bool knows(const std::string& extension);

  void add(Image image, std::vector<PngText> notes) override;
  /// Has nothing to do: add() waits for the encoder of a piece with its last picture.
  void flush() override {}
  /// The film gets its name once it is whole; one that is cut keeps its pieces, too.
  void finish(Ending ending) override;
  std::vector<std::uint32_t> checksums() const override { return checksums_; }

 private:
  struct Piece {
    std::filesystem::path path;
    long count;  // of its pictures
  };

  std::filesystem::path piece_path(long first) const;
  std::filesystem::path name_in_folder(const std::string& file) const;
  void open_folder();
  void require_earlier_pieces();
  long start_of_piece(long number) const;
  std::vector<Piece> pieces() const;
  void start_piece();
  void end_piece();
  void join();
  void tidy();
  long pictures_in(const std::filesystem::path& film) const;
  void require_pictures(const std::filesystem::path& film, long count);
  void require_unchanged(const std::vector<Piece>& pieces);
  std::string place_of_pieces() const;
  [[noreturn]] void fail(ChildProcess& process);
  [[noreturn]] void fail(const std::string& reason);

  std::filesystem::path path_;
  std::filesystem::path folder_;  ///< of the pieces
  FileDescriptor held_;           ///< that folder, locked against other films of this name
  const MovieFormat* format_;
  SinkOptions options_;
  std::string program_;                    ///< that encodes
  std::vector<std::uint32_t> checksums_;   ///< of the pieces that are whole, in order
  std::vector<PngText> notes_;             ///< of the last picture
  long next_;                              ///< number of the next picture
  long piece_ = 0;                         ///< number of the first picture of the piece under way
  FileDescriptor file_;                    ///< of that piece, or the one before
  std::unique_ptr<ChildProcess> encoder_;  ///< of that piece; none: it has not begun
  WorkQueue queue_;                        ///< last, so that its thread ends before the rest
};

}  // namespace clatter
