#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"
#include "engine/picture/snapshot.h"

namespace clatter {

/// Observer that keeps the particles' recent flights, for exposures and trails.
template <int D>
class FlightRecorder : public Observer<D> {
 public:
  /// Watches a simulation from now on and keeps the flights of the last `span` > 0 of simulation
  /// time: those of all particles, or `only` those of one.
  FlightRecorder(Simulation<D>& simulation, double span, std::optional<std::uint32_t> only = {});
  /// Continues with the flights of the recorder `before` of the same simulation, which are those of
  /// the same particles.
  FlightRecorder(Simulation<D>& simulation, double span, FlightRecorder&& before);

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;
  void before_laws(const Model<D>& next) override;

  /// Time covered by the kept flights, at most the span.
  double reach() const;
  /// The flights of the last reach(): first the ended flights, then each particle's current flight.
  std::vector<FlightPiece> pieces() const;

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    io(since_, ended_);
    for (const Ended& flight : ended_) {
      io.require(flight.particle < simulation_.particles().size() &&
                 flight.end <= simulation_.base_time());
    }
  }

 private:
  struct Ended {
    std::uint32_t particle = 0;
    Flight<D> flight;
    double end = 0.0;  // on the moving base
    Vec<D> gravity = Vec<D>::Zero();

    template <class Archive>
    void visit(Archive& io) {
      io(particle, flight, end, gravity);
    }
  };

  bool keeps(std::uint32_t particle) const { return !only_ || *only_ == particle; }
  void end_flight(const ParticleChange<D>& change, double time);
  void forget();
  void add_sheared_pieces(std::vector<FlightPiece>& pieces, const Ended& ended, double from) const;
  void add_piece(std::vector<FlightPiece>& pieces, const Ended& flight) const;

  const Simulation<D>& simulation_;
  double span_;
  std::optional<std::uint32_t> only_;  // absent: all particles
  double since_;                       // on the moving base
  std::vector<Ended> ended_;
  std::size_t forget_at_ = 0;  // number of flights at which old ones are removed
  Observation<D> observation_;
};

}  // namespace clatter
