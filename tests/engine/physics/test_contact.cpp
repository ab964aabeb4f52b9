#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "engine/physics/collision.h"
#include "engine/physics/contact.h"
#include "engine/physics/random.h"

using namespace clatter;

static const Vec2 kNoGravity = Vec2::Zero();

static Flight<2> flight(Vec2 r, Vec2 v, double time = 0.0) {
  return {r, v, time, 0};
}

TEST_CASE("Contact: particles meet head on, also through an image") {
  // Gaps of 3 and of 10 - 4 - 1 = 5, closed at speed 2.
  const auto a = flight({1.0, 2.0}, {1.0, 0.0});
  const auto b = flight({5.0, 2.0}, {-1.0, 0.0});
  CHECK(contact_time<2>(a, b, Vec2::Zero(), 1.0, kNoGravity) == 1.5);
  const auto away = flight({1.0, 2.0}, {-1.0, 0.0});
  const auto too = flight({5.0, 2.0}, {1.0, 0.0});
  CHECK(contact_time<2>(away, too, Vec2::Zero(), 1.0, kNoGravity) == kNever);
  CHECK(contact_time<2>(away, too, {10.0, 0.0}, 1.0, kNoGravity) == 2.5);
}

TEST_CASE("Contact: touching particles collide at once if they approach faster than rounding") {
  const Vec2 none = Vec2::Zero();
  const Vec2 drift = {0.3, -0.7};
  for (const double overlap : {0.0, 1e-15, 1e-13}) {
    const auto a = [&](double speed, double time) {
      return flight(Vec2(1.0 - overlap, 0.0) + drift * time, drift - Vec2(speed, 0.0), time);
    };
    const auto b = flight({0.0, 0.0}, drift);
    CHECK(contact_time<2>(a(1.0, 0.0), b, none, 1.0, kNoGravity) == 0.0);
    CHECK(contact_time<2>(a(1e-9, 0.0), b, none, 1.0, kNoGravity) == 0.0);
    CHECK(contact_time<2>(a(1e-14, 0.0), b, none, 1.0, kNoGravity) == 0.0);
    // Speeds are .76, so that 8 epsilon of both is 2.7e-15.
    CHECK(contact_time<2>(a(1e-15, 0.0), b, none, 1.0, kNoGravity) == kNever);
    CHECK(contact_time<2>(a(0.0, 0.0), b, none, 1.0, kNoGravity) == kNever);
    CHECK(contact_time<2>(a(-1.0, 0.0), b, none, 1.0, kNoGravity) == kNever);
  }
  // An immediate contact has the later of the two start times.
  const auto early = flight({0.0, 0.0}, {1.0, 0.0}, 2.0);
  const auto late = flight({4.0, 0.0}, {-1.0, 0.0}, 5.0);
  CHECK(contact_time<2>(early, late, none, 1.0, kNoGravity) == 5.0);
  CHECK(contact_time<2>(late, early, none, 1.0, kNoGravity) == 5.0);
}

TEST_CASE("Contact: a collision is not followed by another one at once") {
  // Contact positions are rounded: half of these pairs overlap. After an elastic or a wholly
  // inelastic collision no pair may collide again. Exception: a few pairs are almost at rest
  // afterwards, with rounding errors of the velocities before. One more collision separates them.
  int again = 0, unsettled = 0;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Random random(21, Stream::Velocity, i, 0);
    const double angle = 7.0 * random.uniform();
    const Vec2 r = {20.0 * random.uniform(), 20.0 * random.uniform()};
    auto a = flight(r, {random.normal(), random.normal()});
    auto b = flight(r + Vec2(std::cos(angle), std::sin(angle)), {random.normal(), random.normal()});
    const Vec2 x = a.r - b.r;
    if (x.dot(a.v - b.v) > 0.0) b.v = 2.0 * a.v - b.v;
    const auto collides_again = [&] {
      const Vec2 impulse = collision_impulse<2>(x, a.v - b.v, i % 2, {});
      a.v += impulse;
      b.v -= impulse;
      return contact_time<2>(a, b, Vec2::Zero(), 1.0, kNoGravity) == 0.0;
    };
    if (!collides_again()) continue;
    ++again;
    unsettled += collides_again();
  }
  CHECK(again < 10);
  CHECK(unsettled == 0);
}

TEST_CASE("Contact: exchanging touching particles changes no bit") {
  int different = 0, at_once = 0;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Random random(22, Stream::Velocity, i, 0);
    const double angle = 7.0 * random.uniform();
    const Vec2 n = {std::cos(angle), std::sin(angle)};
    const Vec2 shift = {7.0, -3.0};
    const auto a = flight({random.uniform(), 1.0}, {random.normal(), random.normal()}, 0.25);
    auto b = flight(a.r - n * (1.0 - 1e-15) + shift, a.v, 0.25);
    b.v += n * (1e-15 * random.normal());
    const double one = contact_time<2>(a, b, shift, 1.0, kNoGravity);
    different += one != contact_time<2>(b, a, -shift, 1.0, kNoGravity);
    at_once += one == 0.25;
  }
  CHECK(different == 0);
  CHECK(at_once > 0);
}

TEST_CASE("Contact: a particle reaches a plane at the time computed by hand") {
  const auto right = flight({2.0, 3.0}, {0.5, -1.0}, 1.0);
  CHECK(plane_contact_time<2>(right, 0, 9.5, -1.0, kNoGravity) == 16.0);
  CHECK(plane_contact_time<2>(right, 0, 0.5, 1.0, kNoGravity) == kNever);
  CHECK(plane_contact_time<2>(right, 1, 0.5, 1.0, kNoGravity) == 3.5);
  CHECK(plane_contact_time<2>(right, 1, 9.5, -1.0, kNoGravity) == kNever);
}

TEST_CASE("Contact: a particle at the wall hits it at once if it moves outwards") {
  for (const double beyond : {0.0, 1e-15}) {
    CHECK(plane_contact_time<2>(flight({0.5 - beyond, 3.0}, {-1e-300, 1.0}, 4.0), 0, 0.5, 1.0,
                                kNoGravity) == 4.0);
    CHECK(plane_contact_time<2>(flight({0.5 - beyond, 3.0}, {0.0, 1.0}, 4.0), 0, 0.5, 1.0,
                                kNoGravity) == kNever);
    CHECK(plane_contact_time<2>(flight({0.5 - beyond, 3.0}, {-0.0, 1.0}, 4.0), 0, 0.5, 1.0,
                                kNoGravity) == kNever);
    CHECK(plane_contact_time<2>(flight({0.5 - beyond, 3.0}, {1.0, 1.0}, 4.0), 0, 0.5, 1.0,
                                kNoGravity) == kNever);
  }
}
