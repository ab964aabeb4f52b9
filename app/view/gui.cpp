#include "app/view/gui.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/plots/plots.h"
#include "app/view/gui_keys.h"
#include "app/view/lesson.h"
#include "app/view/panels.h"
#include "app/view/style.h"
#include "app/view/table_plots.h"
#include "app/view/top_bar.h"
#include "engine/error.h"
#include "engine/scene/enum_names.h"
#include "engine/scene/key_writer.h"
#include "engine/scene/scene_file.h"
#include "engine/text.h"

namespace clatter {

static constexpr float kPanelWidth = 17.0f;   // usual width of a panel, in text sizes
static constexpr float kPanelShare = 0.175f;  // width of a panel over the width of the window
// A narrower window has sheets: this many text sizes and heights of buttons.
static constexpr float kNarrowText = 25.0f, kNarrowFrames = 14.0f;
static constexpr float kTextSize = 14.0f;  // usual size of the text, points

Gui::Gui(Host& host, const Gl& gl, WindowInput& input, EngineLink& engine, ScriptLog& log)
    : host_(host),
      gl_(&gl),
      input_(input),
      log_(log),
      session_(engine, log),
      controls_(session_, log),
      viewport_(gl),
      gallery_(gl, viewport_.renderer()),
      gui_(gl) {}

void Gui::open(const Scene& scene, std::uint64_t seed, std::optional<double> until,
               const std::vector<Scene>& others) {
  profile_axis_ = static_cast<int>(scene.measure.profile_axis);
  session_.open(scene, seed, !until, others);
  if (until) session_.play_until(*until);
}

void Gui::listen(bool on) {
  Loudspeaker* loudspeaker = host_.loudspeaker();
  if (!loudspeaker) return;
  try {
    if (on) {
      loudspeaker->open();
    } else {
      loudspeaker->close();
    }
  } catch (const RunError& error) {
    return session_.report(error.what());
  }
  session_.listen(on);
}

// A loudspeaker that fails is closed.
void Gui::play_sound() {
  const std::string failure = host_.loudspeaker()->play(session_.frame().played);
  if (failure.empty()) return;
  listen(false);
  session_.report(failure);
}

// Reads the scale of the window and loads the fonts for it.
void Gui::begin() {
  const float size = std::round(letters() * kTextSize * host_.content_scale());
  if (size != fonts_.unit()) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    fonts_ = add_fonts(atlas, size);
    ImGui::GetIO().FontDefault = fonts_.text.face;
    gui_.upload(atlas);
  }
  constexpr float kTarget = 44.0f;  // points that a finger hits
  const float target = panels_.lecture ? kTarget * host_.content_scale() : 0.0f;
  apply_style(size, std::max(host_.least_target(), target), panel_theme(shown_view()));
  scale_ = std::max(1.0f, ImGui::GetIO().DisplayFramebufferScale.x);
  begin_picture(input_.presses());
}

void Gui::draw() {
  begin();
  if (session_.update()) {
    // While a scene is being opened, the former gas stands still.
    if (!session_.frame().opening) viewport_.redraw();
    const std::vector<const Frame*> gases = frames_of(session_.frame());
    std::erase_if(histories_, [&](const auto& known) {
      return std::ranges::find(gases, known.first, &Frame::id) == gases.end();
    });
    for (const Frame* gas : gases) histories_[gas->id].add(*gas);
    name_gases();
  }
  if (title_ != session_.opened().title) {
    title_ = session_.opened().title;
    // Opens the plots with a scene that has some.
    if (!panels_.lecture && !controls_.chooses() && !session_.opened().view.plots.empty()) {
      panels_.plots = true;
    }
    host_.set_title(*title_ + " – clatter");
  }
  if (session_.listens()) play_sound();
  watch_film();
  use_keys();
  const bool in_lecture = panels_.lecture && !panels_.panels && tools_.plot &&
                          session_.view().lecture.plot == LecturePlot::Profile;
  session_.show_profile(panels_.shows_plots() ? profiled_by(profiled())
                        : in_lecture          ? Profiled::Fields
                                              : Profiled::Nothing,
                        profile_axis());
  panels();
  viewport();
  ImGui::Render();

  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const Gl& gl = *gl_;
  const Size size{static_cast<int>((area_.high.x - area_.low.x) * scale_),
                  static_cast<int>((area_.high.y - area_.low.y) * scale_)};
  if (size.width > 0 && size.height > 0 && session_.frame().scene) {
    if (std::exchange(drawn_views_, session_.views()) != session_.views()) viewport_.redraw();
    // Until the engine has opened a scene of another dimension, its view does not fit the frame.
    if (session_.scene().dimension() == session_.frame().scene->dimension()) {
      constexpr double kLeast = 0.8;  // smallest text of the picture, in text sizes of the panels
      // Lecture mode has title and caption in a strip of their own.
      const bool heading = !panels_.lecture || panels_.panels;
      viewport_.draw(session_.frame(), shown_view(), size, letters(), kLeast * fonts_.unit(),
                     heading, titles_);
    }
    viewport_.show(static_cast<int>(area_.low.x * scale_),
                   static_cast<int>((whole.y - area_.high.y) * scale_));
    if (screen_film_) {
      add_to_screen_film(static_cast<int>(area_.low.x * scale_),
                         static_cast<int>(area_.low.y * scale_), size);
    }
  }
  gl.Viewport(0, 0, static_cast<int>(whole.x * scale_), static_cast<int>(whole.y * scale_));
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gui_.draw(*ImGui::GetDrawData());
  log_.event("picture", nlohmann::json::object());
}

void Gui::panels() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  area_ = {ImVec2(0, 0), whole};
  if (controls_.chooses()) return chosen_controls();
  if (panels_.lecture && !panels_.panels) return lecture_panels();
  const float unit = ImGui::GetFontSize();
  panels_.narrow = whole.x < kNarrowText * unit + kNarrowFrames * ImGui::GetFrameHeight();
  if (panels_.narrow) return sheets();
  // The least width has room for the longest indented name and its number.
  const float width = std::round(
      std::clamp(kPanelShare * whole.x, 0.88f * kPanelWidth * unit, 1.3f * kPanelWidth * unit));
  if (panels_.panels) {
    area_.low.y = top_panel();
    left_panel(area_.low.y, width);
    area_.low.x = width;
  }
  if (panels_.plots && session_.frame().scene) {
    plots_drawer(area_.low.y, width);
    area_.high.x -= width;
  }
  // The gallery shows these texts itself.
  if (panels_.lesson && !panels_.gallery) {
    area_.high.y -= lesson_strip(session_.scene(), area_, controls_, panels_.lesson);
  }
  if (panels_.panels && session_.frame().scene) {
    area_.high.y -= timeline_.draw(session_, controls_, log_, area_);
  }
}

// The panel along the upper edge. Returns its height.
float Gui::top_panel() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float unit = ImGui::GetFontSize();
  const float top = std::round(ImGui::GetFrameHeight() + 0.9f * unit);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(ImGui::GetStyle().WindowPadding.x, 0.45f * unit));
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(ImVec2(whole.x, top));
  ImGui::Begin("top", nullptr, kFixedPanel | ImGuiWindowFlags_NoScrollbar);
  const BarButton pressed = top_bar(session_, controls_, panels_, host_.loudspeaker() != nullptr);
  ImGui::End();
  ImGui::PopStyleVar();
  if (pressed == BarButton::Sound) listen(!session_.listens());
  if (pressed == BarButton::Lecture) lecture(!panels_.lecture);
  return top;
}

void Gui::left_panel(float top, float width) {
  ImGui::SetNextWindowPos(ImVec2(0, top));
  ImGui::SetNextWindowSize(ImVec2(width, ImGui::GetIO().DisplaySize.y - top));
  ImGui::Begin("left", nullptr, kFixedPanel);
  controls_.group_row({"Gas", "Box and walls", "View", "Record"});
  ImGui::BeginChild("groups");
  all_controls();
  record();
  if (controls_.group("Window")) window_controls();
  ImGui::EndChild();
  ImGui::End();
}

// Where the top bar has no such button.
void Gui::sound_control() {
  if (host_.loudspeaker() && sound_button(session_, controls_, ImGui::GetContentRegionAvail().x)) {
    listen(!session_.listens());
  }
}

void Gui::window_controls() {
  scale_slider();
  if (controls_.button("full_screen", "Full screen", "Enter or leave (F11)",
                       ImGui::GetContentRegionAvail().x)) {
    host_.toggle_full_screen();
  }
}

// The buttons of the record panel and their actions.
void Gui::record() {
  std::optional<double> filmed;
  if (film_) filmed = film_->done();
  if (screen_film_) filmed = ImGui::GetTime() - screen_film_->since;
  const Films films = host_.has_processes() ? Films::OfRun
                      : host_.recorder()    ? Films::OfScreen
                                            : Films::None;
  switch (record_panel(controls_, films, filmed)) {
    case Recording::Screenshot:
      screenshot();
      break;
    case Recording::SaveScene:
      save_scenes();
      break;
    case Recording::RestoreScene:
      session_.restore();
      break;
    case Recording::CopyLink:
      copy_link();
      break;
    case Recording::Film:
      open_film_dialog();
      break;
    case Recording::StopFilm:
      film_->interrupt();
      break;
    case Recording::FilmScreen:
      film_screen();
      break;
    case Recording::StopScreen:
      stop_screen_film();
      break;
    case Recording::None:
      break;
  }
}

// The chosen axis of the profile; x if the box lacks it.
Axis Gui::profile_axis() const {
  return profile_axis_ < session_.scene().dimension() ? static_cast<Axis>(profile_axis_) : Axis::X;
}

void Gui::plots_drawer(float top, float width) {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(whole.x - width, top));
  ImGui::SetNextWindowSize(ImVec2(width, whole.y - top));
  ImGui::Begin("plots", nullptr, kFixedPanel);
  plots();
  ImGui::End();
}

// The plots and their choices, in the current window.
void Gui::plots() {
  const float height = std::round(0.62f * ImGui::GetWindowWidth());
  const ThemeColours theme = panel_theme(shown_view());
  std::vector<std::string> axes;
  for (int axis = 0; axis < session_.scene().dimension(); ++axis) {
    axes.emplace_back(kAxes[static_cast<std::size_t>(axis)].name);
  }
  int axis = static_cast<int>(profile_axis());
  if (controls_.choice("plots.axis", "Profile along", "Axis of the profile", axes, axis,
                       static_cast<int>(session_.opened().measure.profile_axis))) {
    profile_axis_ = axis;
  }
  controls_.choice(
      "plots.profile", "Profile of",
      "Averages with a band of one standard error, or the relative residuals of the balances of "
      "mass, momentum and energy in the worst window. They start when the plots open, or when "
      "laws, averages or trails change. The engine then does about twice the work",
      profile_names(profile_axis()), profiled_, 0);
  observable_plots(height);
  const std::vector<PlottedGas> gases = plotted_gases();
  if (gases.size() > 1) {
    controls_.toggle("plots.differences", "Differences from A",
                     "The curves of the other gases minus that of the first one", differences_);
  }
  for (const LivePlot& plot : plots_of(gases, profiled(), theme, differences_)) {
    draw_plot(plot, height);
    ImGui::Spacing();
  }
}

// The tables of the scene's observables, one of them plotted.
void Gui::observable_plots(float height) {
  const auto& tables = session_.frame().observables;
  if (!tables) return;
  if (tables->empty()) {
    ImGui::TextDisabled("The observables of the scene have no values yet.");
    return;
  }
  std::vector<std::string> titles;
  for (const ResultTable& table : *tables) titles.push_back(table_title(table));
  const auto known = std::ranges::find(titles, observable_);
  int chosen = known == titles.end() ? 0 : static_cast<int>(known - titles.begin());
  controls_.choice("plots.observable", "Observable",
                   "A table of measure.observables, with bands of one standard error. Averages "
                   "start with the run, and again when laws change",
                   titles, chosen, 0);
  const auto index = static_cast<std::size_t>(chosen);
  if (std::exchange(observable_, titles[index]) != titles[index]) {
    log_.event("observable", {{"table", observable_}});
  }
  const Frame& frame = session_.frame();
  const std::vector<LivePlot> plots =
      table_plots((*tables)[index], *frame.scene, histories_.at(frame.id),
                  panel_theme(shown_view()));
  for (const LivePlot& plot : plots) {
    draw_plot(plot, height);
    ImGui::Spacing();
  }
}

void Gui::viewport() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const Frame& frame = session_.frame();
  if (std::exchange(told_gallery_, panels_.gallery) != panels_.gallery) {
    log_.event("gallery", {{"open", panels_.gallery}});
  }
  if (panels_.gallery) {
    const EmbeddedFile* chosen = gallery_.draw(controls_, whole.x, whole.y, panels_.gallery);
    if (chosen) open_gallery_scene(*chosen);
  }
  ask_about_changes();
  use_film_dialog();
  if (panels_.help) help_window(session_.scene().dimension(), whole.x, whole.y);
  if (frame.opening) opening_note(session_, controls_, area_);
  if (!frame.scene) return;
  use_viewport();
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel != 0.0f || ImGui::IsMouseDown(0) || panels_.gallery) panels_.hint = false;
  message_.draw(session_, area_);
  const bool quiet = message_.shown() || panels_.help || panels_.lecture || panels_.narrow ||
                     controls_.chooses() || !session_.view().captions.empty();
  const char* hint = mouse_tools_.hint();
  if (!quiet && hint) hint_line(hint, area_);
  log_.widget("viewport", area_.low.x, area_.low.y, area_.high.x - area_.low.x,
              area_.high.y - area_.low.y);
}

// Handles the mouse on the viewport and draws the marks there.
void Gui::use_viewport() {
  if (!viewport_.drawn()) return;
  const Frame& frame = session_.frame();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const Area cell = viewport_.cell(area_.low, scale_);
  const bool over = contains(cell, mouse) && !ImGui::GetIO().WantCaptureMouse;
  const WindowMap map = viewport_.map(area_.low, scale_);
  if (log_.on()) log_handles(map);
  mouse_tools_.use(session_, map, over);
  const bool free = !mouse_tools_.active() && !(panels_.lecture && tools_.pen);
  if (const auto resized = wall_grip_.use(map, frame, over && free)) {
    controls_.set({{"box.size", value_text(session_.scene().box)}},
                  {{"box.size", value_text(resized->box)}}, resized->shift);
  }
  piston_hand_.use(session_, wall_grip_.piston());
  if (const char* help = wall_grip_.help()) ImGui::SetTooltip("%s", help);
  View view = session_.view();
  const bool draws = use_pen(over);
  const bool turned = viewport_.use_mouse(frame, view, map, over && !draws && !wall_grip_.active(),
                                          !mouse_tools_.active());
  controls_.show(view, turned);
  session_.pick(viewport_.picked());

  // A zoom has changed the mapping.
  const WindowMap now = viewport_.map(area_.low, scale_);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect(cell.low, cell.high);
  wall_grip_.mark(list, now, frame);
  viewport_.mark(list, frame, now);
  mouse_tools_.mark(list, frame, now);
  paint_ink(list, over);
  list.PopClipRect();
  if (const auto place = viewport_.picked_place(frame, now)) {
    particle_label(frame, *viewport_.picked(), viewport_.follows(), *place, cell);
  }
  use_cells();
}

// A click on the cell of another gas selects it. The selected one has a frame.
void Gui::use_cells() {
  const std::size_t gases = viewport_.cells();
  if (gases == 1) return;
  const bool clicks = ImGui::IsMouseClicked(0) && !ImGui::GetIO().WantCaptureMouse;
  for (std::size_t gas = 0; gas < gases; ++gas) {
    const Area cell = viewport_.cell(area_.low, scale_, gas);
    if (clicks && contains(cell, ImGui::GetIO().MousePos)) session_.select(gas);
    log_.widget(std::string("cell.") + static_cast<char>('a' + gas), cell.low.x, cell.low.y,
                cell.high.x - cell.low.x, cell.high.y - cell.low.y);
  }
  const Area selected = viewport_.cell(area_.low, scale_);
  ImGui::GetBackgroundDrawList()->AddRect(selected.low, selected.high, packed(accent_colour()));
}

// Names the chosen controls that the panels of a new run lack.
void Gui::name_missing_controls() {
  const auto missing = controls_.take_missing();
  if (checked_run_ == session_.frame().run) return;
  for (const auto& [name, near] : missing) {
    session_.report("the scene has no control " + in_quotes(name) +
                  (near.empty() ? "" : "; try " + in_quotes(near)));
  }
}

// The titles of compared gases: a letter, and the keys in which they differ.
void Gui::name_gases() {
  const std::vector<const Frame*> gases = frames_of(session_.frame());
  std::vector<std::shared_ptr<const Scene>> scenes;
  for (const Frame* gas : gases) scenes.push_back(gas->scene);
  if (scenes == titled_) return;
  titled_ = scenes;
  titles_.clear();
  if (gases.size() == 1) return;
  std::vector<ComparedScene> compared;
  for (const Frame* gas : gases) {
    compared.push_back({*gas->scene, gas->seed});
    // Their laws at this time distinguish them. They have one view.
    compared.back().scene.changes.clear();
    compared.back().scene.view = {};
  }
  titles_ = cell_titles(compared);
}

std::vector<PlottedGas> Gui::plotted_gases() {
  std::vector<PlottedGas> gases;
  for (const Frame* gas : frames_of(session_.frame())) {
    const std::string name = gas->gas < titles_.size() ? titles_[gas->gas].substr(0, 1) : "";
    gases.push_back({&histories_[gas->id], gas, name});
  }
  return gases;
}

// Logs the longest handle of each wall.
void Gui::log_handles(const WindowMap& map) const {
  std::array<float, 6> longest{};
  std::array<Area, 6> areas;
  for (const auto& handle : WallGrip::handles(map, session_.frame())) {
    const auto [a, b] = handle.edge;
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    if (length <= longest[handle.side]) continue;
    longest[handle.side] = length;
    areas[handle.side] = handle.bounds();
  }
  for (std::size_t side = 0; side < longest.size(); ++side) {
    if (longest[side] == 0.0f) continue;
    const auto& [low, high] = areas[side];
    log_.widget(std::string("wall.") + kSideNames[side], low.x, low.y, high.x - low.x,
                high.y - low.y);
  }
}

// Scale of the texts of the window. In lecture mode the window keeps room for the gas.
float Gui::letters() const {
  if (!panels_.lecture) return static_cast<float>(text_scale_);
  constexpr float kLetters = 1.6f;                  // usual scale
  constexpr float kColumns = 39.0f, kRows = 20.0f;  // least size of the window, in text sizes
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float most =
      std::min(whole.x / kColumns, whole.y / kRows) / (kTextSize * host_.content_scale());
  return std::max(1.0f, std::min(kLetters * static_cast<float>(text_scale_), most));
}

// The view on screen. Lecture mode has a theme of its own.
View Gui::shown_view() const {
  View view = session_.view();
  if (panels_.lecture) view.theme = tools_.theme;
  return view;
}

void Gui::open_gallery_scene(const EmbeddedFile& scene) {
  before_loss([this, &scene] {
    panels_.gallery = false;
    open(load_gallery_scene(scene), session_.frame().seed);
  });
}

}  // namespace clatter
