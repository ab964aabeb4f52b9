#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/view/controls.h"
#include "app/view/playlist.h"
#include "app/view/session.h"
#include "app/view/window_input.h"
#include "app/view/window_parts.h"
#include "engine/embedded_file.h"

namespace clatter {

/// Answer to the question whether to save changes.
enum class Answer { None, Save, Discard, Cancel };

/// Draws the question whether to save the changes of the scene with this title, in the middle of
/// the window. It blocks all other widgets. Returns the answer: that of a button, or the one that
/// was `typed`.
Answer unsaved_question(Controls& controls, const std::string& title, Answer typed);

class Gallery;
class PlotsPanel;
class Recorder;

/// Opens scenes: files, scenes of the gallery and of a playlist. Before unsaved changes are lost,
/// it asks the user. In a lecture there is no question: undo returns to the former scene.
class SceneOpener {
 public:
  SceneOpener(const WindowParts& parts, const Gallery& gallery, PlotsPanel& plots,
              Recorder& recorder);
  SceneOpener(const SceneOpener&) = delete;
  SceneOpener& operator=(const SceneOpener&) = delete;

  /// Starts a scene without a question, and `others` beside it in step. With `until` they play from
  /// time 0 to that simulation time.
  void open(Scene scene, std::uint64_t seed, std::optional<double> until = {},
            const std::vector<Scene>& others = {});
  /// Opens a scene of the gallery, and closes the gallery.
  void open(const EmbeddedFile& scene);
  /// Opens a scene file, or a picture of clatter, which contains its scene.
  void open_file(const std::string& file);

  /// The scenes of step(), instead of those of the gallery. The first one has been opened.
  void set_playlist(std::vector<PlaylistItem> playlist);
  /// Opens the scene some places further in the playlist, or in the gallery.
  void step(int step);
  /// Place in the playlist, such as "2/5"; empty: there is no playlist.
  std::string place() const;

  /// Whether the window may close now. With unsaved changes it asks first, and closes the window
  /// after the answer.
  bool may_close();
  /// Whether there is a question.
  bool asks() const { return static_cast<bool>(delayed_); }
  /// Answers the question by a key.
  void press(const KeyPress& press);
  /// Draws the question, if there is one, and acts on its answer. Scenes are saved with `theme`.
  void draw_question(Theme theme);

 private:
  void before_loss(std::function<void()> action);
  void use(Answer answer, Theme theme);

  Host& host_;
  ScriptLog& log_;
  Session& session_;
  Controls& controls_;
  PanelVisibility& panels_;
  const Gallery& gallery_;
  PlotsPanel& plots_;
  Recorder& recorder_;
  std::vector<PlaylistItem> playlist_;  // empty: the scenes of the gallery
  std::size_t at_ = 0;                  // of the scene in the playlist
  std::function<void()> delayed_;       // action after the question; empty: none
  Answer typed_answer_ = Answer::None;  // to the question, by a key
};

}  // namespace clatter
