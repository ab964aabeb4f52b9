#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/live/played_stretch.h"
#include "render/camera.h"

namespace clatter {

/// Makes films of the picture in the window, in real time.
class ScreenRecorder {
 public:
  virtual ~ScreenRecorder() = default;

  /// Begins a film of pictures of `size` pixels. Throws RunError if the host cannot record films.
  virtual void begin(Size size) = 0;
  /// Extension of the file of this film, such as ".mp4".
  virtual std::string extension() const = 0;
  /// Adds the picture of `size` pixels that is now on the window, with its upper left corner at
  /// (x, y). It is scaled to the size of the film. Returns why the host records no more; empty: it
  /// does.
  virtual std::string add(int x, int y, Size size) = 0;
  /// Ends the film, and gives it to the user as a file with this name.
  virtual void end(const std::string& name) = 0;
};

/// Plays the sound of the gas in the window.
class Loudspeaker {
 public:
  virtual ~Loudspeaker() = default;

  /// Opens the device for sound. Throws RunError if there is none.
  virtual void open() = 0;
  /// Plays the stretches since the last call, see Frame::played. The device must be open. Returns
  /// why it plays no more; empty: it does.
  virtual std::string play(const std::vector<std::shared_ptr<const PlayedStretch>>& played) = 0;
  /// Closes the device, and ends the sound.
  virtual void close() = 0;
};

/// The surroundings of the window: a desktop, or a page of a browser.
class Host {
 public:
  virtual ~Host() = default;

  /// Scale of the text: pixels per point of the display.
  virtual float content_scale() const = 0;
  /// Smallest height of a widget that the pointer hits easily, pixels; 0: any.
  virtual float least_target() const = 0;
  /// Sets the title of the window.
  virtual void set_title(const std::string& title) = 0;
  /// Puts a text into the clipboard.
  virtual void copy(const std::string& text) = 0;
  /// Enters or leaves full screen.
  virtual void toggle_full_screen() = 0;
  /// Closes the window.
  virtual void close() = 0;
  /// Whether the files of the program are those of the user.
  virtual bool has_user_files() const = 0;
  /// Gives a written file to the user, unless the user has it already.
  virtual void deliver(const std::string& file) = 0;
  /// The address that opens this window with a fragment of link_of(); empty: there is none.
  virtual std::string link_to(const std::string& fragment) const = 0;
  /// Whether the program can start processes, which make films.
  virtual bool has_processes() const = 0;
  /// The recorder of the window; nullptr: there is none.
  virtual ScreenRecorder* recorder() = 0;
  /// The loudspeaker; nullptr: there is none.
  virtual Loudspeaker* loudspeaker() = 0;
};

}  // namespace clatter
