// One contact's friction and energy, step by step.
#include "contact/response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace geist::contact {
namespace {

const Material stone{"stone", 2, 30, 0.2};
constexpr double dt = 1e-3, k = 50;

PairLaw law_of(double friction, double restitution = 1, Law::Normal normal = Law::Normal::penalty) {
  return {{normal, 1, restitution, friction}, stone, stone};
}

Meeting meeting(double overlap, Vec3 velocity, bool hertz = false) {
  return {{k, hertz}, overlap, 1, {0, 0, 1}, velocity, 4};
}

TEST(Friction, SticksLikeASpring) {
  const PairLaw law = law_of(0.5);
  const double kt = law.moduli.tangential_ratio() * k;
  Memory memory;
  Vec3 s;
  for (int i = 0; i < 20; ++i) {
    const Vec3 v{0.1 * i, -0.2, 0};
    s += dt * v;
    const Response r = respond(law, meeting(0.1, v), dt, memory);
    EXPECT_LE(norm(r.tangent + kt * s), 1e-15);
    EXPECT_NEAR(r.stored, 0.5 * k * 0.01 + 0.5 * kt * dot(s, s), 1e-15);
    EXPECT_NEAR(r.friction, 0, 1e-16);
  }
}

TEST(Friction, SlipsAtCoulombsLimitAgainstTheMotion) {
  const PairLaw law = law_of(0.3);
  Memory memory;
  Response r;
  double dissipated = 0, before = 0;
  const Vec3 v{3, -4, 0};
  for (int i = 0; i < 1000; ++i) {
    before = dissipated;
    r = respond(law, meeting(0.1, v), dt, memory);
    dissipated += r.friction;
  }
  EXPECT_NEAR(norm(r.tangent), 0.3 * k * 0.1, 1e-13);
  EXPECT_NEAR(dot(r.tangent, v), -norm(r.tangent) * norm(v), 1e-12);
  EXPECT_NEAR(dissipated - before, 0.3 * k * 0.1 * 5 * dt, 1e-15);  // μ N |v| dt
}

TEST(Friction, ReversesThroughStick) {
  const PairLaw law = law_of(0.3);
  const double kt = law.moduli.tangential_ratio() * k, limit = 0.3 * k * 0.1;
  Memory memory;
  for (int i = 0; i < 2000; ++i) respond(law, meeting(0.1, {1, 0, 0}), dt, memory);
  const int steps = static_cast<int>(limit / (kt * dt));  // until the force has gone back to zero
  Response r;
  for (int i = 1; i <= steps; ++i) {
    r = respond(law, meeting(0.1, {-1, 0, 0}), dt, memory);
    EXPECT_NEAR(r.tangent.x, -limit + kt * i * dt, 1e-13);
    EXPECT_NEAR(r.friction, 0, 1e-15);
  }
  for (int i = 0; i < 2000; ++i) r = respond(law, meeting(0.1, {-1, 0, 0}), dt, memory);
  EXPECT_NEAR(r.tangent.x, limit, 1e-13);
}

TEST(Friction, IsLimitedByWhatPressesInAGroove) {
  const PairLaw law = law_of(0.3);
  Memory memory;
  Meeting at = meeting(0.1, {1, 0, 0});
  at.pressing = 1.7;
  Response r;
  for (int i = 0; i < 2000; ++i) r = respond(law, at, dt, memory);
  EXPECT_NEAR(norm(r.tangent), 0.3 * 1.7 * k * 0.1, 1e-13);
}

TEST(Friction, LosesTheLimitWithTheNormalForce) {
  const PairLaw law = law_of(0.3, 0.3);
  Memory memory;
  respond(law, meeting(0.1, {0.01, 0, 0}), dt, memory);
  const Response r = respond(law, meeting(0.1, {0.01, 0, 1e6}), dt, memory);  // the dashpot would pull
  EXPECT_EQ(r.normal, 0);
  EXPECT_EQ(norm(r.tangent), 0);
}

TEST(Friction, TurnsWithTheNormalAndKeepsItsLength) {
  const PairLaw law = law_of(10);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  Memory memory;
  respond(law, meeting(0.1, {5, 2, 0}), dt, memory);
  const double length = norm(memory.tangent);
  Vec3 n{0, 0, 1};
  for (int i = 0; i < 200; ++i) {
    n += 0.1 * Vec3{number(random), number(random), number(random)};
    n *= 1 / norm(n);
    Meeting at = meeting(0.1, {});
    at.normal = n;
    const Response r = respond(law, at, dt, memory);
    EXPECT_NEAR(norm(r.tangent), length, 1e-12 * length);
    EXPECT_NEAR(dot(r.tangent, n), 0, 1e-13 * length);
  }
}

TEST(Release, GivesUpWhatTheSpringsHeldAndEndsTheStep) {
  const PairLaw law = law_of(0.5);
  Memory memory;
  Response held;
  for (int i = 0; i < 30; ++i) held = respond(law, meeting(0.1, {1, 0, 0}), dt, memory);
  const double tangential = held.stored - 0.5 * k * 0.01;
  const Response r = release(dt, memory);
  EXPECT_NEAR(r.friction, tangential + 0.5 * dt * norm(held.tangent), 1e-15);  // half a step more at speed 1
  EXPECT_EQ(r.stored, 0);
  EXPECT_EQ(r.normal, 0);
  EXPECT_EQ(norm(r.tangent), 0);
  EXPECT_FALSE(memory.touching);
  EXPECT_EQ(release(dt, memory).friction, 0);
}

TEST(Damping, NeverPulls) {
  const PairLaw law = law_of(0, 0.1);
  for (const double v : {-1.0, 0.0, 0.1, 1.0, 100.0}) {
    Memory memory;
    const Response r = respond(law, meeting(0.01, {0, 0, v}), dt, memory);
    EXPECT_GE(r.normal, 0);
  }
}

TEST(Damping, IsNoneWhereNothingCanMove) {
  const PairLaw law = law_of(0, 0.1);
  Memory memory;
  Meeting at = meeting(0.01, {0, 0, -7});
  at.inverse_mass = 0;
  EXPECT_NEAR(respond(law, at, dt, memory).normal, k * 0.01, 1e-15);
}

/// Work of the forces by the trapezoidal rule against what the responses say became of it, along a wandering
/// path.
struct Balance {
  double work = 0, found = 0, scale = 0, most_negative = 0;
};
Balance wander(const PairLaw& law, bool hertz, int steps, double amplitude, double step_time) {
  Memory memory;
  Balance b;
  Vec3 force_before;
  double stored_before = 0, overlap_before = 0;
  const auto overlap_at = [&](double t) { return 0.05 + amplitude * std::sin(9 * t); };
  for (int i = 0; i <= steps; ++i) {
    const double t = i * step_time, overlap = overlap_at(t);
    Vec3 v{std::cos(5 * t), 0.7 * std::sin(3 * t), 0};
    v.z = i ? -(overlap - overlap_before) / step_time : 0;
    if (i == 0) v = {};
    const Response r = respond(law, meeting(overlap, v, hertz), i ? step_time : 0, memory);
    const Vec3 force = r.normal * Vec3{0, 0, 1} + r.tangent;
    if (i) {
      b.work -= 0.5 * step_time * dot(force + force_before, v);
      b.found += r.stored - stored_before + r.friction + r.damping;
      b.scale += std::abs(0.5 * step_time * dot(force + force_before, v));
      b.most_negative = std::min(b.most_negative, r.friction);
    }
    force_before = force, stored_before = r.stored, overlap_before = overlap;
  }
  return b;
}

TEST(Energy, IsExactForTheLinearLaw) {
  for (const double friction : {0.0, 0.05, 0.5, 100.0})
    for (const double restitution : {1.0, 0.5}) {
      const Balance b = wander(law_of(friction, restitution), false, 3000, 0.04, 1e-3);
      EXPECT_NEAR(b.work, b.found, 1e-13 * b.scale) << friction << ' ' << restitution;
      EXPECT_GE(b.most_negative, -1e-15);
    }
}

TEST(Energy, ConvergesForHertz) {
  for (const double friction : {0.05, 0.5, 100.0}) {
    const PairLaw law = law_of(friction, 0.5, Law::Normal::hertz);
    const Balance coarse = wander(law, true, 3000, 0.04, 1e-3), fine = wander(law, true, 30'000, 0.04, 1e-4);
    EXPECT_LE(std::abs(coarse.work - coarse.found), 5e-3 * coarse.scale) << friction;
    EXPECT_LE(std::abs(fine.work - fine.found), 0.15 * std::abs(coarse.work - coarse.found) + 1e-12);
  }
}

TEST(Energy, OfHertzAtRestingOverlapIsExact) {
  const Balance b = wander(law_of(0.2, 1, Law::Normal::hertz), true, 3000, 0, 1e-3);
  EXPECT_NEAR(b.work, b.found, 1e-13 * b.scale);
}

TEST(Energy, IsNotMadeByLoadingUnderFriction) {
  // Thornton, Cummins and Cleary (2013): push tangentially at a large overlap, come back at a small one.
  for (const bool hertz : {false, true}) {
    const PairLaw law = law_of(100, 1, hertz ? Law::Normal::hertz : Law::Normal::penalty);
    for (const double turn : {0.0, std::numbers::pi}) {
      Memory memory;
      double work = 0;
      Vec3 before;
      const int n = 4000;
      for (int i = 1; i <= n; ++i) {
        const double phase = 2 * std::numbers::pi * i / n;
        const Vec3 v{std::cos(phase), 0, 0};
        const Response r = respond(law, meeting(0.05 + 0.03 * std::sin(phase + turn), v, hertz), dt, memory);
        work -= 0.5 * dt * dot(r.tangent + before, v);
        before = r.tangent;
      }
      EXPECT_GE(work, -1e-6) << hertz << ' ' << turn;
    }
  }
}

}  // namespace
}  // namespace geist::contact
