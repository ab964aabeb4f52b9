#pragma once

#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"
#include "engine/publish/snapshot.h"

namespace clatter {

/// Keeps the particles' flights of the last while, for pictures that show more than an instant.
template <int D>
class FlightRecorder : public Observer<D> {
 public:
  /// Watches a simulation from now on; its flights of a time `span` > 0 are kept.
  FlightRecorder(Simulation<D>& simulation, double span);
  /// Goes on with what that of the simulation before has kept: this one has its particles at its
  /// time, maybe under other laws.
  FlightRecorder(Simulation<D>& simulation, double span, FlightRecorder&& before);

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;

  /// For how long it has watched, at most its span.
  double reach() const;
  /// The flights of the last reach(): first those that have ended, then each particle's own.
  std::vector<FlightPiece> pieces() const;

  /// What a checkpoint keeps, of a simulation that goes on at the same time.
  template <class Archive>
  void visit(Archive& io) {
    io(since_, ended_);
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

  void end_flight(const ParticleChange<D>& change, double time);
  void forget();
  void add_piece(std::vector<FlightPiece>& pieces, const Ended& flight) const;

  const Simulation<D>& simulation_;
  double span_;
  double since_;  // on the moving base
  std::vector<Ended> ended_;
  std::size_t forget_at_ = 0;  // how many flights there are when those too old are left out
};

}  // namespace clatter
