// Functions with vector arguments or results are inlined, so that the calling convention does not
// matter.
#pragma GCC diagnostic ignored "-Wpsabi"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/dynamics/contact_kernel.h"
#include "engine/dynamics/particle.h"
#include "engine/physics/flight.h"
#include "engine/physics/pair_contact.h"
#include "engine/physics/random.h"

using namespace clatter;

namespace {

struct Pair {
  Flight<2> a, b;
  Vec2 shift;
};

const Vec2 kNone = Vec2::Zero();
const Vec2 kGravities[] = {kNone, {0.3, -0.7}};

double encounter(const Flight<2>& a, const Flight<2>& b, const Vec2& shift, double diameter = 1.0,
                 const Vec2& gravity = kNone) {
  const auto formula =
      gravity == kNone ? pair_contact_time<2, false, double> : pair_contact_time<2, true, double>;
  return formula(a.r.data(), a.v.data(), a.time, b.r.data(), b.v.data(), b.time, shift.data(),
                 diameter, gravity.data(), nullptr);
}

// Two particles in a box of 10 x 8, after a few collision times, at most one image apart.
Pair random_flights(std::uint32_t number) {
  Random random(11, Stream::Placement, number, 0);
  const auto image = [&] { return static_cast<double>(random.below(3)) - 1.0; };
  Pair pair;
  for (Flight<2>* flight : {&pair.a, &pair.b}) {
    flight->r = {10.0 * random.uniform(), 8.0 * random.uniform()};
    flight->v = {random.normal(), random.normal()};
    flight->time = random.below(4) == 0 ? 0.0 : 3.0 * random.uniform();
  }
  pair.shift = {10.0 * image(), 8.0 * image()};
  return pair;
}

double later_start(const Pair& p) {
  return std::max(p.a.time, p.b.time);
}

double distance(const Pair& p, double time, const Vec2& gravity = kNone) {
  return (p.a.at(time, gravity) - p.b.at(time, gravity) + p.shift).norm();
}

std::uint64_t bit_pattern(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

}  // namespace

TEST_CASE("Encounter: exchanging the particles changes no bit") {
  int different = 0, meetings = 0;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const Pair p = random_flights(i);
    for (const Vec2& gravity : kGravities) {
      const double one = encounter(p.a, p.b, p.shift, 1.0, gravity);
      const double other = encounter(p.b, p.a, -p.shift, 1.0, gravity);
      different += bit_pattern(one) != bit_pattern(other);
      meetings += std::isfinite(one);
    }
  }
  CHECK(different == 0);
  CHECK(meetings > 3000);
}

// Distances are below 50. The rounding error of positions is below 1e-14, and the error of a
// distance at contact is a few times as large.
TEST_CASE("Encounter: particles are one diameter apart at contact, and farther before") {
  for (const Vec2& gravity : kGravities) {
    double worst = 0.0, missed = 0.0;
    for (std::uint32_t i = 0; i < 100000; ++i) {
      const Pair p = random_flights(i);
      const double time = encounter(p.a, p.b, p.shift, 1.0, gravity);
      const double start = later_start(p);
      // Falling particles later are so far away that rounding errors dominate.
      if (!std::isfinite(time) || (gravity != kNone && time > 20.0)) continue;
      REQUIRE(time > start);
      worst = std::max(worst, std::fabs(distance(p, time, gravity) - 1.0));
      for (int k = 0; k < 8; ++k) {
        const double before = start + k / 8.0 * (time - start);
        missed = std::max(missed, 1.0 - distance(p, before, gravity));
      }
    }
    CHECK(worst < (gravity == kNone ? 1e-13 : 1e-12));
    CHECK(missed < (gravity == kNone ? 1e-13 : 1e-12));
  }
}

TEST_CASE("Encounter: particles that never meet stay apart, and touching ones are recognised") {
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const Pair p = random_flights(i);
    const double time = encounter(p.a, p.b, p.shift);
    if (std::isfinite(time)) continue;
    const double start = later_start(p);
    const Vec2 x = p.a.at(start, kNone) - p.b.at(start, kNone) + p.shift;
    const Vec2 g = p.a.v - p.b.v;
    if (time == kTouching) {
      REQUIRE(x.norm() <= 1.0);
      continue;
    }
    const double closest = start - std::min(0.0, x.dot(g)) / g.squaredNorm();
    REQUIRE((x.dot(g) >= 0.0 || distance(p, closest) > 1.0 - 1e-13));
  }
}

TEST_CASE("Encounter: a grazing pass is met, a near miss is not") {
  const Flight<2> still;
  for (const double below : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    Pair p{.a = {{-5.0, 1.0 - below}, {1.0, 0.0}, 0.0, 0}, .b = still, .shift = Vec2::Zero()};
    const double time = encounter(p.a, p.b, p.shift);
    REQUIRE(std::isfinite(time));
    CHECK(std::fabs(distance(p, time) - 1.0) < 1e-14);
    p.a.r.y() = 1.0 + below;
    CHECK(encounter(p.a, p.b, p.shift) == kNever);
  }
}

// The limit is a few times the rounding error of the start, 1000 * 1.1e-16. The discriminant
// (x.g)^2 - g^2 (x^2 - a^2) would have a 100 times larger error.
TEST_CASE("Encounter: a start from far away costs no more than its rounding") {
  double worst = 0.0;
  int meetings = 0;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Random random(12, Stream::Placement, i, 0);
    const double angle = 7.0 * random.uniform();
    const Vec2 from = {std::cos(angle), std::sin(angle)};
    Pair p;
    p.a.v = {random.normal(), random.normal()};
    p.b.v = p.a.v + from * (0.1 + random.uniform());
    p.a.r = 1000.0 * from + Vec2(-from.y(), from.x()) * (2.0 * random.uniform() - 1.0);
    p.shift = Vec2::Zero();
    const double time = encounter(p.a, p.b, p.shift);
    if (time == kNever) continue;
    ++meetings;
    // Only along the line of approach: the positions themselves become large.
    const Vec2 x = p.a.r + (p.a.v - p.b.v) * time;
    worst = std::max(worst, std::fabs(x.norm() - 1.0));
  }
  CHECK(meetings > 99000);
  CHECK(worst < 2e-12);
}

TEST_CASE("Encounter: scaling by powers of two changes no bit") {
  int different = 0;
  for (const int length : {-40, -3, 40}) {
    for (const int speed : {-30, 5, 30}) {
      const double l = std::ldexp(1.0, length), s = std::ldexp(1.0, speed);
      for (std::uint32_t i = 0; i < 10000; ++i) {
        const Pair p = random_flights(i);
        Pair q = p;
        for (Flight<2>* flight : {&q.a, &q.b}) {
          flight->r *= l;
          flight->v *= s;
          flight->time *= l / s;
        }
        q.shift *= l;
        different += bit_pattern(encounter(q.a, q.b, q.shift, l)) !=
                     bit_pattern(encounter(p.a, p.b, p.shift) * (l / s));
      }
    }
  }
  CHECK(different == 0);
}

namespace {

// A particle, its candidates, and the pair_contact_time of each.
struct Crowd {
  Vec2 box{10.0, 8.0};
  std::vector<Particle<2>> particles;  // the last is the particle of the prediction
  Candidates<2> candidates;
  std::vector<double> times;  // [candidates.size]

  Crowd(std::uint32_t number, int size, const Vec2& gravity) {
    Random random(13, Stream::Placement, number, 0);
    const auto image = [&] { return static_cast<double>(random.below(3)) - 1.0; };
    std::vector<Vec2> images;
    for (int i = 0; i <= size; ++i) {
      Particle<2> particle;
      particle.flight = random_flights(1000 * number + static_cast<std::uint32_t>(i)).a;
      images.push_back({image(), image()});
      particle.image = packed_image<2>(images.back());
      particles.push_back(particle);
    }
    candidates.size = size;
    const bool wraps = random.below(2) == 0;
    for (int i = 0; i < size; ++i) {
      const Particle<2>& particle = particles[static_cast<std::size_t>(i)];
      candidates.neighbours[i] = static_cast<Neighbour>(i);
      Vec2 shift = images[static_cast<std::size_t>(i)] - images.back();
      for (int k = 0; wraps && k < 2; ++k) {
        const double wrap = image();
        candidates.neighbours[i] |= (static_cast<Neighbour>(static_cast<int>(wrap)) & 3u)
                                    << (kParticleBits<2> + 2 * k);
        shift[k] -= wrap;
      }
      times.push_back(encounter(particles.back().flight, particle.flight, shift.cwiseProduct(box),
                                1.0, gravity));
    }
  }
};

// The first contact with all candidates, and with the first half of them, in one call.
using Answers = std::array<FirstContact, 2>;

template <bool kFalling, bool kShifted>
[[gnu::always_inline]] inline Answers ask(const Crowd& crowd, const Vec2& gravity) {
  std::array<Candidates<2>, 2> candidates = {crowd.candidates, crowd.candidates};
  candidates[1].size /= 2;
  const auto self = static_cast<std::uint32_t>(crowd.particles.size() - 1);
  return first_contacts<2, kFalling, kShifted, 2>(crowd.particles.front().flight.r.data(),
                                                  {self, self}, candidates, {crowd.box.data()}, 1.0,
                                                  gravity.data());
}

template <bool kFalling, bool kShifted>
Answers ask_baseline(const Crowd& crowd, const Vec2& gravity) {
  return ask<kFalling, kShifted>(crowd, gravity);
}

#if defined(__x86_64__)
template <bool kFalling, bool kShifted>
[[gnu::target("avx2")]] Answers ask_avx2(const Crowd& crowd, const Vec2& gravity) {
  return ask<kFalling, kShifted>(crowd, gravity);
}
#endif

bool same(const FirstContact& a, const FirstContact& b) {
  return bit_pattern(a.time) == bit_pattern(b.time) && a.unique == b.unique &&
         (!a.unique || a.time == kNever || a.candidate == b.candidate);
}

// The result of the kernel with every instruction set of the processor.
template <bool kFalling, bool kShifted>
Answers ask_any(const Crowd& crowd, const Vec2& gravity) {
  const Answers answers = ask_baseline<kFalling, kShifted>(crowd, gravity);
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    const Answers others = ask_avx2<kFalling, kShifted>(crowd, gravity);
    REQUIRE(same(answers[0], others[0]));
    REQUIRE(same(answers[1], others[1]));
  }
#endif
  return answers;
}

Answers first_of(const Crowd& crowd, const Vec2& gravity) {
  return gravity == kNone ? ask_any<false, true>(crowd, gravity)
                          : ask_any<true, true>(crowd, gravity);
}

Answers first_within_box(const Crowd& crowd, const Vec2& gravity) {
  return gravity == kNone ? ask_any<false, false>(crowd, gravity)
                          : ask_any<true, false>(crowd, gravity);
}

}  // namespace

TEST_CASE(
    "Contact kernel: it finds the first contact, to the bit, among any number of candidates") {
  constexpr std::uint32_t kRepeats = 1600;
  int different = 0, others = 0, met = 0, touching = 0;
  for (int size = 0; size <= Candidates<2>::kCapacity; ++size) {
    for (std::uint32_t repeat = 0; repeat < kRepeats; ++repeat) {
      const Vec2& gravity = kGravities[repeat % 2];
      const Crowd crowd(kRepeats * static_cast<std::uint32_t>(size) + repeat, size, gravity);
      const Answers answers = first_of(crowd, gravity);
      for (const int asked : {size, size / 2}) {
        const FirstContact& first = answers[asked == size ? 0 : 1];
        const auto earliest = std::min_element(crowd.times.begin(), crowd.times.begin() + asked);
        const double expected = asked > 0 ? *earliest : kNever;
        different += bit_pattern(first.time) != bit_pattern(expected);
        touching += first.time == kTouching;
        REQUIRE(first.unique == (expected != kTouching));
        if (!std::isfinite(expected)) continue;
        ++met;
        others += first.candidate != earliest - crowd.times.begin();
      }
    }
  }
  CHECK(different == 0);
  CHECK(others == 0);
  CHECK(met > 3000);
  CHECK(touching > 150);
}

TEST_CASE("Contact kernel: if all particles are in one frame, the shorter form gives the same") {
  int met = 0;
  for (std::uint32_t number = 0; number < 4000; ++number) {
    const Vec2& gravity = kGravities[number % 2];
    const int size = 1 + static_cast<int>(number % Candidates<2>::kCapacity);
    Crowd crowd(number, size, gravity);
    for (int i = 0; i < size; ++i) {
      crowd.candidates.neighbours[i] = particle_of<2>(crowd.candidates.neighbours[i]);
    }
    const Vec2 frame(static_cast<int>(number % 5) - 2, static_cast<int>(number % 7) - 3);
    for (Particle<2>& particle : crowd.particles) {
      particle.image =
          packed_image<2>(frame) | static_cast<PackedImage>(number % 3 << kAllImageBits);
    }
    const FirstContact first = first_within_box(crowd, gravity)[0];
    REQUIRE(same(first, first_of(crowd, gravity)[0]));
    met += std::isfinite(first.time);

    // One particle, a candidate or the predicted one, is in another frame.
    Particle<2>& off = crowd.particles[number % crowd.particles.size()];
    Vec2 image = frame;
    image[number / 2 % 2] += number % 3 == 0 ? 1.0 : -1.0;
    off.image = packed_image<2>(image);
    REQUIRE(!first_within_box(crowd, gravity)[0].unique);
    const FirstContact shifted = first_of(crowd, gravity)[0];
    REQUIRE(shifted.unique == (shifted.time != kTouching));
    off.image = kFarImage;
    REQUIRE(!first_of(crowd, gravity)[0].unique);
    for (Particle<2>& particle : crowd.particles) particle.image = kFarImage;
    REQUIRE(!first_within_box(crowd, gravity)[0].unique);
  }
  CHECK(met > 500);
}

TEST_CASE("Contact kernel: it says whether the first contact is unique; later ones do not matter") {
  int first_shared = 0, later_shared = 0;
  for (std::uint32_t number = 0; number < 2000; ++number) {
    Crowd crowd(number, 12, kNone);
    const FirstContact alone = first_of(crowd, kNone)[0];
    if (!std::isfinite(alone.time)) continue;
    const int copied = static_cast<int>(number % 12);
    const int copy = static_cast<int>(number / 12 % 12);
    if (copy == copied || copy == alone.candidate) continue;
    crowd.candidates.neighbours[copy] = crowd.candidates.neighbours[copied];
    const FirstContact first = first_of(crowd, kNone)[0];
    REQUIRE(bit_pattern(first.time) == bit_pattern(alone.time));
    REQUIRE(first.unique == (copied != alone.candidate));
    (copied == alone.candidate ? first_shared : later_shared) += 1;
  }
  CHECK(first_shared > 20);
  CHECK(later_shared > 200);
}
