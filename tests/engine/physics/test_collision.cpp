#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/physics/collision.h"
#include "engine/physics/random.h"
#include "tests/engine/support/models.h"
#include "tests/support/contact_laws.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// Two rough particles (D = 3: spheres) at contact. r_2 is within a few diameters of the origin.
template <int D>
struct RoughPair {
  Vec<D> r_1, r_2, v_1, v_2;
  Spin<D> spin_1, spin_2;
  Grain first, second;
  ContactLaw law;

  Vec<D> x() const { return r_1 - r_2; }
  Vec<D> n() const { return x() / x().norm(); }
  Spin<D> surface() const { return first.radius * spin_1 + second.radius * spin_2; }
  double reduced_mass() const { return 1.0 / (1.0 / first.mass + 1.0 / second.mass); }
  Exchange<D> exchange() const {
    return rough_impulse<D>(x(), v_1 - v_2, surface(), law, {first, second});
  }
  double dissipated() const {
    return dissipated_energy<D>(x(), v_1 - v_2, surface(), law, {first, second});
  }
  /// Relative velocity of the touching surfaces (theory 3.1).
  Vec<D> surface_velocity() const { return v_1 - v_2 + cross_spin<D>(n(), surface()); }
  void collide() {
    const Exchange<D> gained = exchange();
    v_1 += gained.momentum / first.mass;
    v_2 -= gained.momentum / second.mass;
    spin_1 += gained.spins[0];
    spin_2 += gained.spins[1];
  }
  static double moment(const Grain& grain) {
    const double diameter = 2.0 * grain.radius;
    return 0.25 * grain.inertia * grain.mass * diameter * diameter;
  }
  double energy() const {
    return 0.5 * (first.mass * v_1.squaredNorm() + second.mass * v_2.squaredNorm()) +
           0.5 * (moment(first) * spin_1.squaredNorm() + moment(second) * spin_2.squaredNorm());
  }
  /// Relative to the origin.
  Spin<D> angular_momentum() const {
    return first.mass * cross<D>(r_1, v_1) + second.mass * cross<D>(r_2, v_2) +
           moment(first) * spin_1 + moment(second) * spin_2;
  }
};

// Every second pair has equal partners.
template <int D>
RoughPair<D> random_pair(std::uint32_t number) {
  Random random(33, Stream::Velocity, number, D);
  RoughPair<D> pair;
  pair.law = random_law(random);
  pair.first = random_grain(random);
  pair.second = number % 2 ? random_grain(random) : pair.first;
  const double distance = pair.first.radius + pair.second.radius;
  const double spin_speed = 2.0 * random.uniform() / distance;
  pair.r_2 = 3.0 * random_vector<Vec<D>>(random);
  pair.r_1 = pair.r_2 + distance * random_vector<Vec<D>>(random).normalized();
  pair.v_1 = random_vector<Vec<D>>(random);
  pair.v_2 = random_vector<Vec<D>>(random);
  if (pair.x().dot(pair.v_1 - pair.v_2) > 0.0) std::swap(pair.v_1, pair.v_2);
  pair.spin_1 = spin_speed * random_vector<Spin<D>>(random);
  pair.spin_2 = spin_speed * random_vector<Spin<D>>(random);
  return pair;
}

constexpr std::uint32_t kPairs = 100000;

template <class Vector>
bool same_bits(const Vector& a, const Vector& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double one, double other) {
    return std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other);
  });
}

}  // namespace

// (theory 3.2, 3.6) with beta = -1.
TEST_CASE(
    "Collision: smooth pairs lose the energy of theory 3.6 and keep the tangential velocity") {
  double energy_off = 0.0, tangential_off = 0.0, normal_off = 0.0;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Random random(31, Stream::Velocity, i, 0);
    const double angle = 7.0 * random.uniform();
    const Vec2 n = {std::cos(angle), std::sin(angle)};
    const Vec2 v_1 = {random.normal(), random.normal()};
    const Vec2 v_2 = {random.normal(), random.normal()};
    const Vec2 g = v_1 - v_2;
    const double alpha = i % 3 == 0 ? 1.0 : random.uniform();
    const Grain first = random_grain(random), second = i % 2 ? random_grain(random) : first;
    const double m_1 = first.mass, m_2 = second.mass, reduced = 1.0 / (1.0 / m_1 + 1.0 / m_2);
    // The length of x differs from the sum of the radii by a rounding error, as in real contacts.
    const Vec2 x = n * ((first.radius + second.radius) * (1.0 + 1e-14));
    const Vec2 impulse = collision_impulse<2>(x, g, alpha, {first, second});
    const Vec2 w_1 = v_1 + impulse / m_1, w_2 = v_2 - impulse / m_2;

    const double gain =
        0.5 * m_1 * (w_1 - v_1).dot(w_1 + v_1) + 0.5 * m_2 * (w_2 - v_2).dot(w_2 + v_2);
    const double g_n = n.dot(g);
    const double scale = 0.5 * (m_1 * v_1.squaredNorm() + m_2 * v_2.squaredNorm());
    const double loss = 0.5 * reduced * (1.0 - alpha * alpha) * g_n * g_n;
    energy_off = std::max(energy_off, std::fabs(gain + loss) / scale);
    normal_off = std::max(normal_off, std::fabs(n.dot(w_1 - w_2) + alpha * g_n));
    const Vec2 t = {-n.y(), n.x()};
    tangential_off = std::max(tangential_off, std::fabs(t.dot(impulse)) / reduced);
  }
  CHECK(energy_off < 1e-13);
  CHECK(normal_off < 1e-13);
  CHECK(tangential_off < 1e-13);
}

// Without the sum of contact_square the mean is 3.6e-17, or 40 standard errors.
TEST_CASE("Collision: rounding does not change the mean energy of elastic spheres" *
          doctest::skip(std::numeric_limits<long double>::digits <= 53)) {
  constexpr int kCollisions = 300000;
  Random random(12, Stream::Placement, 0, 0);
  const auto normal = [&] { return Vec<3>(random.normal(), random.normal(), random.normal()); };
  const auto twice_energy = [](const Vec<3>& a, const Vec<3>& b) {
    return a.cast<long double>().squaredNorm() + b.cast<long double>().squaredNorm();
  };
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kCollisions; ++i) {
    const Vec<3> x = normal().normalized(), a = normal(), b = normal();
    const Vec<3> impulse = collision_impulse<3>(x, a - b, 1.0, {});
    const auto gain =
        static_cast<double>(0.5L * (twice_energy(a + impulse, b - impulse) - twice_energy(a, b)));
    sum += gain;
    squares += gain * gain;
  }
  const double standard_error = std::sqrt(squares) / kCollisions;
  CHECK(standard_error < 1.5e-18);
  CHECK(std::fabs(sum / kCollisions) < 4.0 * standard_error);
}

TEST_CASE("Collision: smooth pairs have the velocities computed by hand") {
  // Head-on and elastic: velocities are exchanged. Wholly inelastic: both continue with the mean
  // velocity.
  CHECK(collision_impulse<2>({1.0, 0.0}, {-2.0, 5.0}, 1.0, {}) == Vec2(2.0, 0.0));
  CHECK(collision_impulse<2>({1.0, 0.0}, {-2.0, 5.0}, 0.0, {}) == Vec2(1.0, 0.0));
  CHECK(collision_impulse<2>({0.0, -1.0}, {0.0, 4.0}, 0.5, {}) == Vec2(0.0, -3.0));
  CHECK(collision_impulse<3>({1.0, 0.0, 0.0}, {-2.3, 5.0, 7.0}, 1.0, {}) == Vec<3>(2.3, 0.0, 0.0));
  CHECK(collision_impulse<3>({0.0, 0.0, -1.0}, {3.0, 0.0, 4.1}, 1.0, {}) == Vec<3>(0.0, 0.0, -4.1));
}

TEST_CASE_TEMPLATE("Collision: rough pairs keep their angular momentum", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  double angular_off = 0.0;
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    const RoughPair<D> before = random_pair<D>(i);
    RoughPair<D> after = before;
    after.collide();
    const auto scale_of = [](const Grain& grain, const Vec<D>& r, const Vec<D>& v,
                             const Spin<D>& w) {
      return grain.mass * (r.norm() + grain.radius) * (v.norm() + grain.radius * w.norm());
    };
    const double scale = scale_of(before.first, before.r_1, before.v_1, before.spin_1) +
                         scale_of(before.second, before.r_2, before.v_2, before.spin_2);
    angular_off = std::max(angular_off,
                           (after.angular_momentum() - before.angular_momentum()).norm() / scale);
  }
  CHECK(angular_off < 1e-14);
}

TEST_CASE_TEMPLATE("Collision: the dissipation of rough pairs equals their loss of energy",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  double off = 0.0;
  int conserving = 0;
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    const RoughPair<D> before = random_pair<D>(i);
    RoughPair<D> after = before;
    after.collide();
    const double lost = before.energy() - after.energy();
    off = std::max(off, std::fabs(before.dissipated() - lost) / before.energy());
    REQUIRE(before.dissipated() >= 0.0);
    if (before.law.restitution == 1.0 && keeps_spin_and_slip_energy(before.law)) {
      ++conserving;
      REQUIRE(before.dissipated() == 0.0);
    }
  }
  CHECK(off < 1e-13);
  CHECK(conserving > 10000);
}

TEST_CASE_TEMPLATE("Collision: the impulse between rough pairs is Walton's and Coulomb's",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  double impulse_off = 0.0, coulomb_excess = -1.0;
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    const RoughPair<D> pair = random_pair<D>(i);
    const Vec<D> n = pair.n(), g = pair.surface_velocity();
    const double mass = pair.reduced_mass();
    const double pressed = -mass * (1.0 + pair.law.restitution) * n.dot(g);
    const auto per_impulse = [](const Grain& grain) {
      return (1.0 + 1.0 / grain.inertia) / grain.mass;
    };
    const Vec<D> dragged = friction_by_law<D>(n, g, pressed, pair.law,
                                              per_impulse(pair.first) + per_impulse(pair.second));
    const Vec<D> tangential = pair.exchange().momentum - pressed * n;
    impulse_off = std::max(impulse_off, (tangential - dragged).norm() / (mass * g.norm()));
    if (pair.law.friction == 0.0) continue;
    const double share = tangential.norm() / (pair.law.friction * pressed);
    if (pair.law.friction * pressed < 1e-2 * mass * g.norm()) continue;  // rounding of `pressed`
    coulomb_excess = std::max(coulomb_excess, share - 1.0);
  }
  CHECK(impulse_off < 1e-13);
  CHECK(coulomb_excess < 1e-13);
  CHECK(coulomb_excess > -1e-13);  // sliding pairs reach the Coulomb limit
}

TEST_CASE_TEMPLATE(
    "Collision: without friction, or with beta_0 = -1, rough pairs have the bits of smooth ones",
    Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  int different = 0;
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    RoughPair<D> pair = random_pair<D>(i);
    (i % 2 ? pair.law.friction : pair.law.tangential_restitution) = i % 2 ? 0.0 : -1.0;
    const Vec<D> x = pair.x(), v = pair.v_1 - pair.v_2;
    different +=
        !same_bits(pair.exchange().momentum,
                   collision_impulse<D>(x, v, pair.law.restitution, {pair.first, pair.second}));
    for (const Spin<D>& spin : pair.exchange().spins) {
      different += !same_bits(spin, Spin<D>(Spin<D>::Zero()));
    }
    different += pair.dissipated() !=
                 dissipated_energy<D>(x, v, pair.law.restitution, {pair.first, pair.second});
  }
  CHECK(different == 0);
}

TEST_CASE_TEMPLATE("Collision: exchanging the partners of rough pairs changes no bit", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  int different = 0;
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    const RoughPair<D> pair = random_pair<D>(i);
    RoughPair<D> other = pair;
    std::swap(other.r_1, other.r_2);
    std::swap(other.v_1, other.v_2);
    std::swap(other.spin_1, other.spin_2);
    std::swap(other.first, other.second);
    different += pair.exchange().momentum != -other.exchange().momentum;
    different += pair.exchange().spins[0] != other.exchange().spins[1];
    different += pair.exchange().spins[1] != other.exchange().spins[0];
    different += pair.dissipated() != other.dissipated();
  }
  CHECK(different == 0);
}

TEST_CASE_TEMPLATE("Collision: scaling rough pairs by powers of two changes no bit", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  constexpr double kLength = 0x1p-7, kSpeed = 0x1p-45, kMass = 0x1p20;
  int different = 0;
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    const RoughPair<D> pair = random_pair<D>(i);
    RoughPair<D> scaled = pair;
    for (auto* grain : {&scaled.first, &scaled.second}) {
      grain->radius *= kLength;
      grain->mass *= kMass;
    }
    for (auto* r : {&scaled.r_1, &scaled.r_2}) *r *= kLength;
    for (auto* v : {&scaled.v_1, &scaled.v_2}) *v *= kSpeed;
    for (auto* spin : {&scaled.spin_1, &scaled.spin_2}) *spin *= kSpeed / kLength;
    different += scaled.exchange().momentum != pair.exchange().momentum * (kMass * kSpeed);
    for (int k = 0; k < 2; ++k) {
      different += scaled.exchange().of(k).spin != pair.exchange().of(k).spin * (kSpeed / kLength);
    }
    different += scaled.dissipated() != pair.dissipated() * (kMass * kSpeed * kSpeed);
  }
  CHECK(different == 0);
}

TEST_CASE("Collision: rough pairs have the impulses computed by hand") {
  // n = (1,0), a = 1, q = 1/2, and g_t = v_y - (omega_1 + omega_2)/2.
  const ContactLaw perfectly_rough = {1.0, kInfinity, 1.0};
  const auto collide = [](const ContactLaw& law, Vec2 v, double spin_sum) {
    return rough_impulse<2>({1.0, 0.0}, v, Spin<2>(0.5 * spin_sum), law, {}).of(0);
  };
  const auto dissipated = [](const ContactLaw& law) {
    return dissipated_energy<2>({1.0, 0.0}, {-2.0, 3.0}, Spin<2>(0.0), law, {});
  };
  // g_t = 3 - 6/2 = 0: no slip, and no division by it.
  CHECK(collide(perfectly_rough, {-2.0, 3.0}, 6.0).momentum == Vec2(2.0, 0.0));
  CHECK(collide(perfectly_rough, {-2.0, 3.0}, 6.0).spin[0] == 0.0);
  CHECK(collide({1.0, 0.25, 1.0}, {-2.0, 3.0}, 6.0).momentum == Vec2(2.0, 0.0));
  // g_t = 3, eta = .5 * 2/(2 * 1.5) = 1/3: momentum -1, spin 2 (1/3) 3/(.5) = 4.
  CHECK(collide(perfectly_rough, {-2.0, 3.0}, 0.0).momentum.isApprox(Vec2(2.0, -1.0), 1e-15));
  CHECK(collide(perfectly_rough, {-2.0, 3.0}, 0.0).spin[0] == doctest::Approx(4.0).epsilon(1e-15));
  // Coulomb: |J_t| = .25 |J_n| = .5 < 1, spin 2 |J_t|/q = 2.
  CHECK(collide({1.0, 0.25, 1.0}, {-2.0, 3.0}, 0.0).momentum.isApprox(Vec2(2.0, -0.5), 1e-15));
  CHECK(collide({1.0, 0.25, 1.0}, {-2.0, 3.0}, 0.0).spin[0] == doctest::Approx(2.0).epsilon(1e-15));
  // The loss is .75 of the energy 6.5. The translational energy is then 5.25, the spin energy .5.
  CHECK(dissipated({1.0, 0.25, 1.0}) == doctest::Approx(0.75).epsilon(1e-15));
  // With alpha = 1/2, J_n = 1.5 and J_t = .375. The final energy is 5.046875, of which .28125 is in
  // the spins.
  CHECK(dissipated({0.5, 0.25, 1.0}) == doctest::Approx(1.453125).epsilon(1e-15));
  // No normal impulse: finite friction has no effect, infinite friction has its usual effect.
  CHECK(collide({1.0, 0.25, 1.0}, {0.0, 3.0}, 0.0).momentum == Vec2(0.0, 0.0));
  CHECK(collide(perfectly_rough, {0.0, 3.0}, 0.0).momentum.isApprox(Vec2(0.0, -1.0), 1e-15));
  CHECK(collide({1.0, 0.25, 1.0}, {0.0, 3.0}, 6.0).momentum == Vec2(0.0, 0.0));  // nor slip
  // All mass at the centre: the spins reverse without momentum, g_t' = 3 - 6 = -g_t.
  const Grain light = {.inertia = 0.0};
  const Exchange<2> reversed =
      rough_impulse<2>({1.0, 0.0}, {-2.0, 3.0}, Spin<2>(0.0), perfectly_rough, {light, light});
  CHECK(reversed.momentum == Vec2(2.0, 0.0));
  CHECK(reversed.spins[0][0] == 6.0);
}

// A disk of mass 2, diameter 2 and q = 1/2 hits one of mass 6, diameter 1 and q = 1/3 that is at
// rest: m_12 = 3/2, k = (3/2) (1/1 + 1/2) = 9/4. Perfectly rough: J_t = -(3/2) 2/(1 + 9/4) 13 =
// -12, J_n = (3/2) 2 2 = 6. The spin gains are -(d/2I) n x J: I = 1 and 1/2, so 12 and 12.
TEST_CASE("Collision: unequal rough disks have the velocities computed by hand") {
  const Grain first = {.radius = 1.0, .mass = 2.0, .inertia = 0.5};
  const Grain second = {.radius = 0.5, .mass = 6.0, .inertia = 1.0 / 3.0};
  const Partners partners(first, second);
  CHECK(partners.distance == 1.5);
  CHECK(partners.mass == 1.5);
  CHECK(1.0 / partners.inertia == doctest::Approx(2.25).epsilon(1e-15));
  const Exchange<2> gain =
      rough_impulse<2>({1.5, 0.0}, {-2.0, 13.0}, Spin<2>(0.0), {1.0, kInfinity, 1.0}, partners);
  CHECK(gain.momentum.isApprox(Vec2(6.0, -12.0), 1e-15));
  CHECK(gain.spins[0][0] == doctest::Approx(12.0).epsilon(1e-15));
  CHECK(gain.spins[1][0] == doctest::Approx(12.0).epsilon(1e-15));
}
