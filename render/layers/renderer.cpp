#include "render/layers/renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/camera_path.h"
#include "render/layers/line_layer.h"
#include "render/species_colours.h"
#include "render/theme.h"

namespace clatter {

namespace {

constexpr std::uint8_t kGrid = 140;  // alpha of the grid

Colour thin(Colour colour, std::uint8_t alpha) {
  colour.alpha = alpha;
  return colour;
}

// The colour of the hatching of cells without a value. Smooth fields have no hatching.
Colour gap_colour(const ThemeColours& theme, FieldStyle style) {
  constexpr std::uint8_t kHatch = 70;
  return thin(theme.static_wall, style == FieldStyle::Cells ? kHatch : 0);
}

// Moves the particles along their flights to a time relative to the time of the snapshot, at which
// the images of a sheared box have this offset.
void move_to(Snapshot& snapshot, double time, double offset) {
  if (snapshot.slide != 0.0) {
    const double lengths = (offset + snapshot.slide * time) / snapshot.box[0];
    snapshot.offset = (lengths - std::floor(lengths)) * snapshot.box[0];
  }
  for (const FlightPiece& piece : snapshot.flights) {
    if (time < piece.from || time >= piece.to) continue;
    VecX place = piece.at(time);
    for (Eigen::Index axis = 0; axis < place.size(); ++axis) {
      const double length = snapshot.box[axis];
      if (!snapshot.walls[2 * axis]) place[axis] -= std::floor(place[axis] / length) * length;
    }
    snapshot.positions.col(static_cast<Eigen::Index>(piece.particle)) = place;
  }
}

bool blurs_spheres(const Snapshot& snapshot) {
  return snapshot.exposure > 0.0 && snapshot.box.size() == 3;
}

// Whether a picture is the sum of several.
bool is_sum(const Snapshot& snapshot, const View& view) {
  return view.opacity > 0.0 && (view.opacity < 1.0 || blurs_spheres(snapshot));
}

}  // namespace

// The duration of trails. Those of very fast particles would fill the picture, so a particle of the
// mean square speed has a trail of at most a quarter of the narrowest side.
static double trail_time(const Snapshot& gas, double asked) {
  constexpr double kLongest = 0.25;  // of the side
  const double speed = std::sqrt(static_cast<double>(gas.box.size()) * gas.temperature);
  return std::min(asked, kLongest * gas.box.minCoeff() / std::max(speed, 1e-300));
}

Renderer::Renderer(const Gl& gl, int samples, bool transparent, StopRequest stop)
    : gl_(&gl),
      samples_(samples),
      transparent_(transparent),
      stop_(std::move(stop)),
      average_(gl),
      field_(gl),
      grid_(gl),
      walls_(gl),
      trails_(gl),
      disks_(gl),
      arrows_(gl),
      overlay_(gl) {}

Camera Renderer::fit(const Snapshot& snapshot, Size size, const View& view, const OverlayText& text,
                     const Legends& legends) {
  const double wall = wall_thickness(size);
  Margins margins{wall, wall, wall, wall};
  if (view.overlay) margins = overlay_.margins(snapshot, size, view, legends, text);
  if (snapshot.box.size() == 3) return whole_box(snapshot, view, size, margins);
  // Disks extend over a periodic border by half their diameter.
  Vec2 overhang(0.0, 0.0);
  for (int axis : {0, 1}) {
    if (!snapshot.walls[2 * axis]) overhang[axis] = 0.5 * snapshot.diameter;
  }
  const Faces faces = outermost_faces(snapshot);
  return Camera::fit(faces.low - overhang, faces.high + overhang, size, margins);
}

void Renderer::draw(const Snapshot& snapshot, const Camera& camera, Size size, const View& view,
                    const OverlayText& text, Legends legends) {
  const Projection projection{camera, size};
  if (legends.arrows) legends.arrows->pixels *= projection.scale();
  const ThemeColours theme = theme_of(view);
  gl_->Enable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  // Framebuffer 0, the window, may not be sRGB. Averaging writes sRGB values into any framebuffer.
  GLint target = 0;
  gl_->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
  const bool disks = snapshot.box.size() == 2;
  const bool own_canvas = gl_->api == Api::Es;  // for blend_in_light()
  if (samples_ == 1 && target != 0 && disks && !own_canvas && !is_sum(snapshot, view)) {
    draw_layers(snapshot, projection, view, legends, theme);
  } else {
    draw_averaged(snapshot, projection, view, legends, theme, static_cast<GLuint>(target));
  }
  if (view.overlay) overlay_.draw(snapshot, projection, view, legends, text);
}

DiskColours Renderer::disk_colours(const Snapshot& snapshot, const View& view,
                                   const Legends& legends, const ThemeColours& theme) const {
  DiskColours colours;
  colours.colour_by = view.colour_by;
  if (legends.disks) colours.scale = legends.disks->scale;
  colours.plain = theme.disk;
  colours.blending = transparent_ ? Blending::Encoded : Blending::Light;
  if (view.tracer) colours.tracer = static_cast<std::size_t>(view.tracer->particle);
  colours.traced = theme.text;
  if (view.colour_by == ColourBy::Species) {
    colours.species = species_colours(snapshot.species, theme.background);
  }
  return colours;
}

// The picture without the overlay.
void Renderer::draw_layers(const Snapshot& snapshot, const Projection& projection, const View& view,
                           const Legends& legends, const ThemeColours& theme) {
  if (snapshot.box.size() == 2) {
    draw_disks(snapshot, projection, view, legends, theme);
  } else {
    draw_spheres(snapshot, projection, view, legends, theme);
  }
}

void Renderer::draw_disks(const Snapshot& snapshot, const Projection& projection, const View& view,
                          const Legends& legends, const ThemeColours& theme) {
  clear(projection, theme);
  const Tiling tiling = tiling_of(snapshot, projection, view);
  if (legends.field && has_values(*snapshot.field)) {
    const FieldStyle style = style_of(snapshot.field->field, view);
    field_.draw(snapshot, projection, legends.field->scale, style, gap_colour(theme, style),
                tiling);
  }
  pause(projection);
  if (view.grid) grid_.draw(snapshot, projection, thin(theme.static_wall, kGrid));
  const WallColours walls = wall_colours(theme, legends, view, 2);
  if (has_fixtures(snapshot)) {
    if (!fixtures_) fixtures_.emplace(*gl_);
    fixtures_->draw(snapshot, projection, walls, tiling);
  }
  walls_.draw(snapshot, projection, walls);
  const DiskColours colours = disk_colours(snapshot, view, legends, theme);
  blend_in_light(true);
  if (view.trails)
    trails_.draw(snapshot, snapshot.flights, projection, colours,
                 trail_time(snapshot, *view.trails), tiling);
  pause(projection);
  if (view.opacity > 0.0) disks_.draw(snapshot, projection, colours, tiling);
  if (view.tracer) {
    trails_.draw(snapshot, snapshot.traced, projection, colours, view.tracer->time, tiling);
  }
  blend_in_light(false);
  pause(projection);
  if (legends.arrows) {
    arrows_.draw(*snapshot.arrows, projection, projection.samples * legends.arrows->pixels,
                 theme.text, theme.background);
  }
}

// Draws the layers of a large picture one after the other, so that a stop request is obeyed soon.
void Renderer::pause(const Projection& projection) const {
  constexpr double kLarge = 1 << 24;  // pixels
  const Size drawn = projection.drawn();
  if (1.0 * drawn.width * drawn.height <= kLarge) return;
  gl_->Finish();
  stop_.check();
}

// OpenGL ES: the layers between two calls blend in linear light. OpenGL has a switch instead, see
// encode_light().
void Renderer::blend_in_light(bool on) {
  if (gl_->api == Api::Desktop || transparent_) return;
  if (!light_copy_) light_copy_.emplace(*gl_);
  light_copy_->blend_in_light(*fine_, on);
}

void Renderer::clear(const Projection& projection, const ThemeColours& theme) {
  const Size drawn = projection.drawn();
  gl_->Viewport(0, 0, drawn.width, drawn.height);
  const Colour background = transparent_ ? Colour{0, 0, 0, 0} : theme.background;
  gl_->ClearColor(background.red / 255.0f, background.green / 255.0f, background.blue / 255.0f,
                  background.alpha / 255.0f);
  gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Renderer::draw_spheres(const Snapshot& snapshot, const Projection& projection,
                            const View& view, const Legends& legends, const ThemeColours& theme) {
  const Eye eye(projection, snapshot.diameter);
  DiskColours colours = disk_colours(snapshot, view, legends, theme);
  colours.away = -eye.axes().row(2).transpose();
  if (!space_) space_.emplace(*gl_, colours.blending);
  const WallColours walls = wall_colours(theme, legends, view, 3);
  clear(projection, theme);
  gl_->Enable(GL_DEPTH_TEST);
  space_->box.draw_sides(snapshot, projection, eye, walls);
  const bool field = legends.field && has_values(*snapshot.field);
  const bool volume = field && view.volume > 0.0;
  std::vector<Slice> slices;
  if (field) {
    slices = slices_of(snapshot, view);
    const FieldStyle style = style_of(snapshot.field->field, view);
    space_->slices.draw(snapshot, slices, projection, eye, legends.field->scale, style,
                        gap_colour(theme, style));
  }
  const bool fixtures = has_fixtures(snapshot);
  Bodies bodies;
  if (fixtures) {
    bodies = bodies_of(snapshot, view.slab);
    if (!space_->bodies) space_->bodies.emplace(*gl_, colours.blending);
    space_->bodies->draw_blocks(bodies, snapshot, projection, eye, walls);
  }
  pause(projection);
  // Spheres without a shape and the volume have no depths, so edges behind them are drawn first.
  const bool light = view.opacity > 0.0 && SphereLight::draws(eye, snapshot);
  const bool depthless = light || volume;
  using Sides = BoxLayer::Sides;
  if (depthless) space_->box.draw_edges(snapshot, projection, eye, walls, Sides::Far);
  if (depthless && fixtures) space_->bodies->draw_edges(bodies, snapshot, projection, eye, walls);
  blend_in_light(true);
  const auto draw_balls = [&](BodyLayer::Part part) {
    if (fixtures) space_->bodies->draw_balls(bodies, snapshot, projection, eye, walls, part);
  };
  draw_balls(BodyLayer::Part::Inside);
  // All spheres without a shape are behind a plane across the view, and the others before it.
  if (light) space_->light.draw(snapshot, projection, eye, colours, view.slab, slices, bodies);
  // The volume would end at the faint parts of spheres in front of it.
  if (view.opacity > 0.0) {
    space_->spheres.draw(snapshot, projection, eye, colours, view.slab, !volume);
  }
  draw_balls(BodyLayer::Part::Edge);
  pause(projection);
  if (volume) {
    fine_->bind_colours();
    space_->volume.draw(snapshot, view, projection, eye, legends.field->scale,
                        fine_->depth_texture());
    fine_->bind();
    pause(projection);
  }
  blend_in_light(false);
  if (fixtures) {
    if (!depthless) space_->bodies->draw_edges(bodies, snapshot, projection, eye, walls);
    space_->bodies->draw_partitions(bodies, snapshot, projection, eye, walls);
  }
  draw_lines(snapshot, projection, view, legends, theme, colours, eye);
  space_->box.draw_edges(snapshot, projection, eye, walls, depthless ? Sides::Near : Sides::All);
  gl_->Disable(GL_DEPTH_TEST);
}

// Arrows are in front of all spheres, which would hide them.
void Renderer::draw_lines(const Snapshot& snapshot, const Projection& projection, const View& view,
                          const Legends& legends, const ThemeColours& theme,
                          const DiskColours& colours, const Eye& eye) {
  LineLayer& lines = space_->lines;
  const double width = std::max(1.0 * projection.samples, 0.0025 * projection.drawn().height);
  if (view.trails) {
    lines.draw(
        trail_lines(snapshot, snapshot.flights, colours, trail_time(snapshot, *view.trails), width),
        snapshot.box, projection, eye);
  }
  if (view.tracer) {
    gl_->Disable(GL_DEPTH_TEST);
    lines.draw(trail_lines(snapshot, snapshot.traced, colours, view.tracer->time, width),
               snapshot.box, projection, eye);
    gl_->Enable(GL_DEPTH_TEST);
  }
  if (legends.arrows) {
    const double scale = projection.samples * legends.arrows->pixels / projection.scale();
    gl_->Disable(GL_DEPTH_TEST);
    lines.draw(arrow_lines(*snapshot.arrows, eye, scale, width, theme.text), snapshot.box,
               projection, eye);
    gl_->Enable(GL_DEPTH_TEST);
  }
}

// A picture with the particles, whose weight is their opacity, and one without them. Blurred
// spheres are the average of exact instants in the middle of equal parts of the exposure.
void Renderer::draw_sum(const Snapshot& snapshot, const Projection& projection, const View& view,
                        const Legends& legends, const ThemeColours& theme, GLuint target) {
  constexpr int kInstants = 16;
  // Browsers on phones do not blend numbers of 32 bits, which a sum of two pictures does not need.
  const GLint format = blurs_spheres(snapshot) ? GL_RGBA32F : GL_RGBA16F;
  if (!sum_ || !(sum_->size() == projection.size) || sum_->format() != format) {
    sum_.emplace(*gl_, projection.size, format);
  }
  sum_->bind();
  gl_->ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  gl_->Clear(GL_COLOR_BUFFER_BIT);
  const auto add = [&](const Snapshot& shown, double opacity, double weight) {
    View part = view;
    part.opacity = opacity;
    fine_->bind();
    draw_layers(shown, projection, part, legends, theme);
    sum_->bind();
    average_.add(*fine_, samples_, transparent_, weight, stop_);
  };
  if (view.opacity < 1.0) add(snapshot, 0.0, 1.0 - view.opacity);
  if (blurs_spheres(snapshot)) {
    Snapshot instant = snapshot;
    instant.exposure = 0.0;
    instant.orientations.clear();
    for (int k = 0; k < kInstants; ++k) {
      move_to(instant, snapshot.exposure * ((k + 0.5) / kInstants - 1.0), snapshot.offset);
      add(instant, 1.0, view.opacity / kInstants);
    }
  } else {
    add(snapshot, 1.0, view.opacity);
  }
  gl_->BindFramebuffer(GL_FRAMEBUFFER, target);
  average_.draw_sum(*sum_, transparent_, stop_);
}

void Renderer::draw_averaged(const Snapshot& snapshot, const Projection& projection,
                             const View& view, const Legends& legends, const ThemeColours& theme,
                             GLuint target) {
  const Projection finer{projection.camera, projection.size, samples_};
  const Size drawn = finer.drawn();
  const bool disks = snapshot.box.size() == 2;
  const Depth depth = disks ? Depth::None : Depth::Buffer;
  if (!fine_ || !(fine_->size() == drawn) || fine_->depth() != depth) {
    fine_.emplace(*gl_, drawn, GL_SRGB8_ALPHA8, depth);
  }
  if (is_sum(snapshot, view)) {
    draw_sum(snapshot, finer, view, legends, theme, target);
    return;
  }
  fine_->bind();
  draw_layers(snapshot, finer, view, legends, theme);
  if (samples_ == 1) {
    fine_->copy_to(target);
    return;
  }
  gl_->BindFramebuffer(GL_FRAMEBUFFER, target);
  average_.draw(*fine_, samples_, transparent_, stop_);
}

}  // namespace clatter
