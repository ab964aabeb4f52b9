#include "app/plots/history.h"

#include <algorithm>
#include <cmath>

#include "engine/observables/counted_cells.h"

namespace clatter {

void VelocityHistogram::add(const Snapshot& snapshot) {
  constexpr double kForgets = 1.0 / 600.0;  // weights decay over 600 frames
  if (snapshot.count() == 0) return;
  for (int axis = 0; axis < snapshot.velocities.rows(); ++axis) {
    Eigen::RowVectorXd velocities = snapshot.velocities.row(axis);
    for (std::size_t i = 0; i < snapshot.grains.size(); ++i) {
      velocities[static_cast<Eigen::Index>(i)] *= std::sqrt(snapshot.grains[i].mass);
    }
    const double deviation =
        std::sqrt(velocities.squaredNorm() / static_cast<double>(snapshot.count()));
    if (!(deviation > 0.0)) continue;
    auto& weights = weights_[static_cast<std::size_t>(axis)];
    for (double& weight : weights) weight *= 1.0 - kForgets;
    for (const double v : velocities) {
      const double place = (v / deviation + kReach) / (2.0 * kReach) * kClasses;
      if (place >= 0.0 && place < kClasses) weights[static_cast<std::size_t>(place)] += 1.0;
    }
  }
}

std::vector<Vec2> VelocityHistogram::density(int axis) const {
  const auto& weights = weights_[static_cast<std::size_t>(axis)];
  constexpr double kWidth = 2.0 * kReach / kClasses;
  double all = 0.0;
  for (const double weight : weights) all += weight;
  std::vector<Vec2> points;
  for (int i = 0; i < kClasses; ++i) {
    const double weight = weights[static_cast<std::size_t>(i)];
    points.emplace_back((i + 0.5) * kWidth - kReach, all > 0.0 ? weight / (all * kWidth) : 0.0);
  }
  return points;
}

void SpeciesAverages::add(const Snapshot& snapshot, std::size_t species) {
  squares_.resize(species);
  freedoms_.resize(species);
  for (std::size_t i = 0; i < snapshot.grains.size(); ++i) {
    const Grain& grain = snapshot.grains[i];
    const auto velocity = snapshot.velocities.col(static_cast<Eigen::Index>(i));
    squares_[grain.species] += grain.mass * velocity.squaredNorm();
    freedoms_[grain.species] += static_cast<double>(velocity.size());
  }
}

std::vector<double> SpeciesAverages::take() {
  std::vector<double> temperatures;
  for (std::size_t s = 0; s < squares_.size(); ++s) {
    temperatures.push_back(squares_[s] / freedoms_[s]);
  }
  clear();
  return temperatures;
}

// The mixing in cells of about ten particles.
static Mixing mixing_in(const Snapshot& snapshot, std::size_t species) {
  constexpr double kParticles = 10.0;
  const auto count = static_cast<double>(std::max<std::size_t>(snapshot.count(), 1));
  VecX sides = snapshot.box;
  std::ranges::sort(sides);
  double volume = sides.prod() * kParticles / count;  // of a cell across the further axes
  double edge = 0.0;
  for (Eigen::Index k = 0; k < sides.size(); ++k) {
    edge = std::pow(volume, 1.0 / static_cast<double>(sides.size() - k));
    if (sides[k] >= edge) break;
    volume /= sides[k];  // one cell along a short side
  }
  const CountedCells cells(snapshot.box, {.cell = edge});
  std::vector<std::uint32_t> numbers(cells.size() * species);
  for (std::size_t i = 0; i < snapshot.grains.size(); ++i) {
    const std::size_t cell =
        cells.of(snapshot.positions.col(static_cast<Eigen::Index>(i)), snapshot.box);
    ++numbers[cell * species + snapshot.grains[i].species];
  }
  return mixing_of(numbers, species);
}

// The share of the particles below a divider, which is where a piston is now.
static double share_below(const Divider& divider, const Snapshot& snapshot) {
  if (snapshot.count() == 0) return 0.0;
  const double place = snapshot.free_piston.value_or(divider.position);
  const auto below = (snapshot.positions.row(divider.axis).array() < place).count();
  return static_cast<double>(below) / static_cast<double>(snapshot.count());
}

void History::predict(const std::shared_ptr<const Scene>& scene) {
  if (!scene || scene == scene_) return;
  scene_ = scene;
  theory_.reset();
}

const SpeciesTheory& History::species_theory() const {
  if (!theory_) {
    const bool mixed = scene_ && !scene_->species.empty();
    theory_ = mixed ? clatter::species_theory(*scene_) : SpeciesTheory();
  }
  return *theory_;
}

void History::add(const Frame& frame) {
  if (frame.run != run_) {
    run_ = frame.run;
    futures_ = frame.futures;
    last_ = empty_tally(static_cast<int>(frame.tally.temperature_integral.size()));
    spacing_ = 0.0;
    samples_.clear();
    velocities_.clear();
    species_.clear();
  }
  if (frame.futures != futures_) fork(frame);
  const double span = frame.tally.time - last_.time;
  predict(frame.scene);
  if (frame.snapshot.time < frame.head || !(span > 0.0)) return;
  velocities_.add(frame.snapshot);
  const std::size_t species = frame.scene->species.size();
  if (species > 0) species_.add(frame.snapshot, species);
  constexpr double kRounding = 1e-9;  // frames of films are apart by the spacing
  if (span < (1.0 - kRounding) * spacing_) return;
  Sample sample;
  sample.time = frame.snapshot.time - 0.5 * span;
  sample.temperature = (frame.tally.temperature_integral - last_.temperature_integral) / span;
  sample.spin_temperature =
      (frame.tally.spin_temperature_integral - last_.spin_temperature_integral) / span;
  sample.walls_in = (frame.tally.walls_in - last_.walls_in) / span;
  sample.bulk_in = (frame.tally.bulk_in - last_.bulk_in) / span;
  sample.nudges_in = (frame.tally.nudges_in - last_.nudges_in) / span;
  sample.gravity_in = (frame.tally.gravity_in - last_.gravity_in) / span;
  sample.shear_in = (frame.tally.shear_in - last_.shear_in) / span;
  sample.dissipated = (frame.tally.dissipated - last_.dissipated) / span;
  sample.ledger_residual = std::fabs(frame.ledger_residual);
  sample.deepest_overlap = frame.deepest_overlap;
  sample.species_temperature = species_.take();
  if (species > 0) sample.mixing = mixing_in(frame.snapshot, species);
  if (const auto divider = divider_of(*frame.scene)) {
    sample.piston = frame.snapshot.free_piston.value_or(0.0);
    sample.share_left = share_below(*divider, frame.snapshot);
  }
  samples_.push_back(sample);
  last_ = frame.tally;
  // A shorter average would resolve single collisions.
  spacing_ = std::max(spacing_, frame.speed / kPerSecond);
  constexpr std::size_t kMax = 1200;
  if (samples_.size() > kMax) thin_out();
}

void History::fork(const Frame& frame) {
  futures_ = frame.futures;
  last_ = frame.tally;
  species_.clear();
  std::erase_if(samples_, [&](const Sample& sample) { return sample.time > frame.forked_at; });
}

// Merges pairs of samples, and doubles the spacing of later ones.
void History::thin_out() {
  std::vector<Sample> thinned;
  for (std::size_t i = 0; i + 1 < samples_.size(); i += 2) {
    const Sample &a = samples_[i], &b = samples_[i + 1];
    const auto mean = [&](auto member) { return 0.5 * (a.*member + b.*member); };
    const auto larger = [&](auto member) { return std::max(a.*member, b.*member); };
    thinned.push_back({.time = mean(&Sample::time),
                       .temperature = 0.5 * (a.temperature + b.temperature),
                       .spin_temperature = mean(&Sample::spin_temperature),
                       .walls_in = mean(&Sample::walls_in),
                       .bulk_in = mean(&Sample::bulk_in),
                       .nudges_in = mean(&Sample::nudges_in),
                       .gravity_in = mean(&Sample::gravity_in),
                       .shear_in = mean(&Sample::shear_in),
                       .dissipated = mean(&Sample::dissipated),
                       .ledger_residual = larger(&Sample::ledger_residual),
                       .deepest_overlap = larger(&Sample::deepest_overlap),
                       .species_temperature = b.species_temperature,
                       .share_left = b.share_left,
                       .piston = b.piston,
                       .mixing = b.mixing});
    for (std::size_t s = 0; s < b.species_temperature.size(); ++s) {
      const double before = a.species_temperature[s];
      double& temperature = thinned.back().species_temperature[s];
      if (!std::isnan(before)) temperature = 0.5 * (before + temperature);
    }
  }
  samples_ = std::move(thinned);
  spacing_ *= 2.0;
}

}  // namespace clatter
