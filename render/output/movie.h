#pragma once

#include "render/output/child_process.h"
#include "render/output/frame_sink.h"
#include "render/output/work_queue.h"

namespace clatter {

/// A film, encoded by ffmpeg beside the simulation. It gets its name when it is whole.
class Movie final : public FrameSink {
 public:
  /// The kind of film is that of the extension. Throws RunError where the file cannot be written or
  /// `encoder`, a name on the PATH, cannot be started.
  Movie(std::filesystem::path path, const SinkOptions& options,
        const std::string& encoder = "ffmpeg");
  ~Movie() override;

  /// Whether there is a kind of film of this extension: ".mp4", ".webm", ".gif", ".mkv".
  static bool knows(const std::string& extension);

  void add(Image image, double time) override;
  void finish() override;

 private:
  [[noreturn]] void fail();
  void index();  // into a second file, where there is room

  std::filesystem::path path_;
  std::filesystem::path part_;  ///< what ffmpeg writes, playable at any time; empty once renamed
  std::string program_;         ///< that encodes
  ChildProcess encoder_;
  WorkQueue queue_;  ///< last, so that its thread ends before the rest
};

}  // namespace clatter
