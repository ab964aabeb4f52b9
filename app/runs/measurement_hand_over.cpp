#include "app/runs/measurement_hand_over.h"

#include <string>

#include "engine/dynamics/boundary.h"

namespace clatter {

// A flight is booked at its end, with the gravity of that time. Another wall motion restarts
// flights. With other spins the fields need other sums, and the energy of cells changes.
template <int D>
static bool flights_go_on(const RunState<D>& saved, const Model<D>& model) {
  return saved.gravity == model.gravity && saved.wall_motions == wall_motions<D>(model);
}

template <int D>
bool averages_go_on(const RunState<D>& saved, bool same_inertia, const Model<D>& model,
                    const Measure& measure) {
  const bool same_spins =
      saved.flights.empty() || (saved.spins.empty() != model.spins && same_inertia);
  const bool same_sums = measure.fields.empty() || same_spins;
  return same_sums && flights_go_on(saved, model);
}

template <int D>
bool hand_over(std::optional<Measurement<D>>& measurement, const Simulation<D>& before,
               Simulation<D>& next, const Measure& measure, double end) {
  const bool same_inertia = before.model().inertia == next.model().inertia;
  const bool same_particles = before.particles().size() == next.particles().size();
  const RunState<D> state = before.save();
  const bool go_on = same_particles && averages_go_on(state, same_inertia, next.model(), measure);
  if (!flights_go_on(state, next.model())) measurement->end_flights();
  const std::string saved = measurement->save();
  measurement.emplace(next, measure, end, ArchiveReader(saved, "the measurement"),
                      go_on ? Averages::GoOn : Averages::Restart);
  return go_on;
}

template bool averages_go_on(const RunState<2>&, bool, const Model<2>&, const Measure&);
template bool averages_go_on(const RunState<3>&, bool, const Model<3>&, const Measure&);
template bool hand_over(std::optional<Measurement<2>>&, const Simulation<2>&, Simulation<2>&,
                        const Measure&, double);
template bool hand_over(std::optional<Measurement<3>>&, const Simulation<3>&, Simulation<3>&,
                        const Measure&, double);

}  // namespace clatter
