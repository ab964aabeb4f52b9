#include "engine/picture/view_observers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace clatter {

template <int D>
ViewObservers<D>::ViewObservers(Simulation<D>& simulation, const View& view, double exposure,
                                ViewObservers* before)
    : simulation_(simulation), spins_(simulation.model().spins), view_(view), exposure_(exposure) {
  if (view.shows_averages()) watch_field(before);
  if (exposure > 0.0 || view.trails) watch_flights(before);
  if (view.tracer) watch_tracer(before);
  if (spins_) watch_spins(before);
}

template <int D>
ViewObservers<D>::ViewObservers(Simulation<D>& simulation, const View& view, double exposure,
                                ArchiveReader saved)
    : simulation_(simulation), spins_(simulation.model().spins), view_(view), exposure_(exposure) {
  if (view.shows_averages()) {
    std::string averages;
    saved(averages);
    field_.emplace(simulation_, view, ArchiveReader(averages, "averages"));
  }
  if (exposure > 0.0 || view.trails) watch_flights(nullptr);
  if (view.tracer) watch_tracer(nullptr);
  if (spins_) watch_spins(nullptr);
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
void ViewObservers<D>::before_laws() {
  if (field_) field_->look();
}

template <int D>
void ViewObservers<D>::on_laws(bool averages_go_on) {
  const bool spins = simulation_.model().spins;
  if (field_ && !(averages_go_on && spins == spins_)) field_.emplace(simulation_, view_);
  if (spins && !rotations_) rotations_.emplace(simulation_);
  if (!spins) rotations_.reset();
  spins_ = spins;
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
void ViewObservers<D>::watch_field(ViewObservers* before) {
  if (before && before->field_ && before->view_.averages_like(view_)) {
    field_.emplace(simulation_, view_, std::move(*before->field_));
  } else {
    field_.emplace(simulation_, view_);
  }
}

template <int D>
void ViewObservers<D>::watch_flights(ViewObservers* before) {
  const double span = std::max(exposure_, view_.trails.value_or(0.0));
  if (before && before->flights_) {
    flights_.emplace(simulation_, span, std::move(*before->flights_));
  } else {
    flights_.emplace(simulation_, span);
  }
}

template <int D>
void ViewObservers<D>::watch_tracer(ViewObservers* before) {
  const auto& [particle, time] = *view_.tracer;
  if (before && before->traced_ && before->view_.tracer->particle == particle) {
    traced_.emplace(simulation_, time, std::move(*before->traced_));
  } else {
    traced_.emplace(simulation_, time, static_cast<std::uint32_t>(particle));
  }
}

template <int D>
void ViewObservers<D>::watch_spins(ViewObservers* before) {
  if (before && before->rotations_) {
    rotations_.emplace(simulation_, std::move(*before->rotations_));
  } else {
    rotations_.emplace(simulation_);
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
