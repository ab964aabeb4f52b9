#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/checkpoint/archive.h"
#include "engine/picture/flight_recorder.h"
#include "engine/picture/live_field.h"
#include "engine/picture/rotations.h"

// Pictures of a time span need ViewObservers: a field's averages, the flights of an exposure and of
// trails, the rotation angles of disks and the orientations of spheres. Both are exact over each
// flight. A Snapshot has flights as FlightPieces, and layers draw them as chords. The opacity of a
// blurred disk in a pixel is the share of time in which it covers the pixel, an integral along its
// chord (swept.frag). Disks never overlap, so the shares are additive. Spheres hide each other, so
// their blur is the average of 16 instants of their flights.

namespace clatter {

/// The observers of a simulation that pictures need beside its state at an instant. Only the
/// observers that the view needs exist.
template <int D>
class ViewObservers {
 public:
  /// Watches a simulation for `view`, with an exposure time `exposure` >= 0 per picture. With
  /// `before` it continues the data of those observers of the same simulation.
  ViewObservers(Simulation<D>& simulation, const View& view, double exposure,
                ViewObservers* before = nullptr);
  /// Continues saved observers. The simulation must be at the same time under the same laws. Throws
  /// UserError if they belong to another view.
  ViewObservers(Simulation<D>& simulation, const View& view, double exposure, ArchiveReader saved);
  ViewObservers(const ViewObservers&) = delete;
  ViewObservers& operator=(const ViewObservers&) = delete;

  /// The state that determines later pictures, together with simulation and view; empty: none.
  std::string save();
  /// Ends the present part of averages that continue under the next laws.
  void before_laws();
  /// Watches the simulation under its new laws or with its new particles. The averages continue or
  /// restart.
  void on_laws(bool averages_go_on);
  /// [N] rotations of the particles at the simulation's time; empty: they have no spins.
  std::vector<Rotation<D>> rotations() const;
  /// Continues from these rotations, as rotations() returned them at the simulation's time.
  void set_rotations(const std::vector<Rotation<D>>& rotations);
  /// Writes the data of the view at the simulation's time into the snapshot.
  void publish(Snapshot& snapshot);

 private:
  void watch_field(ViewObservers* before);
  void watch_flights(ViewObservers* before);
  void watch_tracer(ViewObservers* before);
  void watch_spins(ViewObservers* before);

  Simulation<D>& simulation_;
  bool spins_;  // whether particles have spins under the present laws
  View view_;
  double exposure_;
  std::optional<LiveField<D>> field_;
  std::optional<FlightRecorder<D>> flights_;
  std::optional<FlightRecorder<D>> traced_;  // of the tracer
  std::optional<Rotations<D>> rotations_;    // present if particles spin
};

}  // namespace clatter
