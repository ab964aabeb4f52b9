#include "engine/publish/view_observers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace clatter {

template <int D>
ViewObservers<D>::ViewObservers(Simulation<D>& simulation, const View& view, double exposure,
                                ViewObservers* before)
    : view_(view), exposure_(exposure) {
  if (view.shows_averages()) watch_field(simulation, before);
  if (exposure > 0.0 || view.trails) watch_flights(simulation, before);
  if (view.tracer) watch_tracer(simulation, before);
  if (simulation.model().spins) watch_spins(simulation, before);
}

template <int D>
ViewObservers<D>::ViewObservers(Simulation<D>& simulation, const View& view, double exposure,
                                ArchiveReader saved)
    : view_(view), exposure_(exposure) {
  if (view.shows_averages()) {
    std::string averages;
    saved(averages);
    field_.emplace(simulation, view, ArchiveReader(averages, "averages"));
  }
  if (exposure > 0.0 || view.trails) watch_flights(simulation, nullptr);
  if (view.tracer) watch_tracer(simulation, nullptr);
  if (simulation.model().spins) watch_spins(simulation, nullptr);
  if (flights_) saved(*flights_);
  if (traced_) saved(*traced_);
  if (rotations_) saved(*rotations_);
  saved.finish();
}

template <int D>
std::string ViewObservers<D>::save() {
  ArchiveWriter writer;
  if (field_) {
    std::string averages = field_->save();
    writer(averages);
  }
  if (flights_) writer(*flights_);
  if (traced_) writer(*traced_);
  if (rotations_) writer(*rotations_);
  return writer.written();
}

template <int D>
std::vector<Rotation<D>> ViewObservers<D>::rotations() const {
  return rotations_ ? rotations_->rotations() : std::vector<Rotation<D>>();
}

template <int D>
void ViewObservers<D>::set_rotations(const std::vector<Rotation<D>>& rotations) {
  if (rotations_) rotations_->set_rotations(rotations);
}

template <int D>
void ViewObservers<D>::watch_field(Simulation<D>& simulation, ViewObservers* before) {
  if (before && before->field_ && before->view_.averages_like(view_)) {
    field_.emplace(simulation, view_, std::move(*before->field_));
  } else {
    field_.emplace(simulation, view_);
  }
}

template <int D>
void ViewObservers<D>::watch_flights(Simulation<D>& simulation, ViewObservers* before) {
  const double span = std::max(exposure_, view_.trails.value_or(0.0));
  if (before && before->flights_) {
    flights_.emplace(simulation, span, std::move(*before->flights_));
  } else {
    flights_.emplace(simulation, span);
  }
}

template <int D>
void ViewObservers<D>::watch_tracer(Simulation<D>& simulation, ViewObservers* before) {
  const auto& [particle, time] = *view_.tracer;
  if (before && before->traced_ && before->view_.tracer->particle == particle) {
    traced_.emplace(simulation, time, std::move(*before->traced_));
  } else {
    traced_.emplace(simulation, time, static_cast<std::uint32_t>(particle));
  }
}

template <int D>
void ViewObservers<D>::watch_spins(Simulation<D>& simulation, ViewObservers* before) {
  if (before && before->rotations_) {
    rotations_.emplace(simulation, std::move(*before->rotations_));
  } else {
    rotations_.emplace(simulation);
  }
}

static void publish_rotations(const std::vector<DiskRotation>& rotations, Snapshot& snapshot) {
  snapshot.angles.clear();
  for (const DiskRotation& rotation : rotations) {
    snapshot.angles.push_back(std::remainder(rotation.angle, 2.0 * std::numbers::pi));
  }
}
static void publish_rotations(const std::vector<SphereRotation>& rotations, Snapshot& snapshot) {
  snapshot.orientations.clear();
  for (const SphereRotation& rotation : rotations) {
    snapshot.orientations.push_back(rotation.quaternion());
  }
}

template <int D>
void ViewObservers<D>::publish(Snapshot& snapshot) {
  if (field_) field_->publish(snapshot);
  if (rotations_) publish_rotations(rotations_->rotations(), snapshot);
  if (traced_) snapshot.traced = traced_->pieces();
  if (!flights_) return;
  snapshot.exposure = std::min(exposure_, flights_->reach());
  snapshot.flights = flights_->pieces();
}

template class ViewObservers<2>;
template class ViewObservers<3>;

}  // namespace clatter
