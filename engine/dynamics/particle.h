#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "engine/dynamics/large_array.h"
#include "engine/dynamics/packed_image.h"
#include "engine/physics/flight.h"

// A particle's state fills one cache line (Particle), because a prediction reads some 20 of them.
// The flight keeps the frame of its start when it crosses a periodic border. Its image counts the
// boxes since then, in 24 bits at the end of the line; ParticleArray keeps the few that are larger.
// The word also has the particle's kind, which saves a second cache miss for its radius.

namespace clatter {

/// Box side in diameters beyond which a run keeps the rounding errors of positions. There positions
/// are coarser than 2e-12, and short flights of grains near rest would be lost in rounding.
inline constexpr double kLongBox = 16384.0;

/// A particle's stored state, in one cache line. It changes only in the particle's own physical
/// events. Contact kernels read it as a row of doubles, see Candidates.
template <int D>
struct alignas(64) Particle {
  [[no_unique_address]] Flight<D> flight;  ///< since its last physical event
  /// See ParticleArray::image() and kind(). It lies at the end of the flight.
  PackedImage image = 0;
};

/// The stored states of all particles, and the periodic images of their flights.
template <int D>
class ParticleArray {
 public:
  /// Particles at rest at the origin.
  explicit ParticleArray(std::size_t count = 0) : particles_(count) {}

  /// Changes the number of particles. The images of all become invalid.
  void resize(std::size_t count) {
    particles_.resize(count);
    far_images_.clear();
  }

  /// Number of particles.
  std::size_t size() const { return particles_.size(); }
  /// Whether there are no particles.
  bool empty() const { return particles_.empty(); }
  /// The particles in the order of their numbers.
  auto begin() const { return particles_.begin(); }
  auto end() const { return particles_.end(); }
  /// The first of the particles, which are rows of contact kernels.
  const Particle<D>* data() const { return particles_.data(); }
  /// The particle of a number.
  const Particle<D>& operator[](std::size_t number) const { return particles_[number]; }
  /// The flight of a particle, to be changed.
  Flight<D>& flight(std::size_t number) { return particles_[number].flight; }

  /// Copies a particle with its kind, but not its image.
  void copy(std::uint32_t to, const Particle<D>& source) {
    particles_[to].flight = source.flight;
    set_kind(to, kind_of(source.image));
  }
  /// The kind of a particle of a mixture, see GrainArray::kinds().
  std::uint32_t kind(std::uint32_t number) const { return kind_of(particles_[number].image); }
  /// Sets the kind of a particle, below 2^kKindBits.
  void set_kind(std::uint32_t number, std::uint32_t kind) {
    PackedImage& word = particles_[number].image;
    word = (word & kImageMask) | static_cast<PackedImage>(kind << kAllImageBits);
  }

  /// Whole box lengths from the frame of a particle's cell to the frame of its flight.
  Vec<D> image(std::uint32_t number) const {
    const PackedImage packed = particles_[number].image;
    if (packed < 0) [[unlikely]]
      return far_images_.at(number);
    Vec<D> image;
    for (int axis = 0; axis < D; ++axis) image[axis] = image_component<D>(packed, axis);
    return image;
  }
  /// Sets the image of a particle, in whole box lengths.
  void set_image(std::uint32_t number, const Vec<D>& image) {
    PackedImage& word = particles_[number].image;
    word = (word & ~kImageMask) | packed_image<D>(image);
    if (word < 0) [[unlikely]]
      far_images_[number] = image;
  }
  /// Adds whole box lengths to an image.
  [[gnu::always_inline]] void move_image(std::uint32_t number, const Vec<D>& boxes) {
    if ((boxes.array() != 0.0).any()) set_image(number, image(number) + boxes);
  }

 private:
  LargeArray<Particle<D>> particles_;
  std::unordered_map<std::uint32_t, Vec<D>> far_images_;  // of the particles with kFarImage
};

}  // namespace clatter
