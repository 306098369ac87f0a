// Laws: against closed forms and collisions of two bodies that the tests integrate themselves.
#include "contact/law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/response.hpp"

namespace geist::contact {
namespace {

const Material stone{"stone", 2, 30, 0.2}, rubber{"rubber", 1, 0.5, 0.45};

/// Schwager and Pöschel (2007): restitution of a linear dashpot that never pulls.
double closed_restitution(double zeta) {
  if (zeta > 1) {
    const double root = std::sqrt(zeta * zeta - 1);
    return std::exp(-zeta / root * std::log((zeta + root) / (zeta - root)));
  }
  const double root = std::sqrt(1 - zeta * zeta);
  return std::exp(-zeta / root * (std::numbers::pi - std::atan2(2 * zeta * root, 1 - 2 * zeta * zeta)));
}

/// Speed after / speed before of two bodies on a line that respond() drives.
double collide(const PairLaw& law, double k, double reduced_mass, double speed, double step) {
  const NormalStiffness spring{k, law.law.normal == Law::Normal::hertz};
  // A time that the collision takes: of the linear law at the largest overlap, ½ m v² = energy.
  const double deepest = spring.hertz ? std::pow(1.25 * reduced_mass * speed * speed / k, 0.4)
                                      : speed * std::sqrt(reduced_mass / k);
  const double dt = step * deepest / speed;
  double overlap = 0, v = speed;  // δ, δ̇
  Memory memory;
  for (int i = 0; i < 100'000'000; ++i) {
    overlap += dt * v;
    if (overlap <= 0) return -v / speed;
    const Response r =
        respond(law, {spring, overlap, 1, {0, 0, 1}, {0, 0, -v}, 1 / reduced_mass}, dt, memory);
    v -= dt * r.normal / reduced_mass;
  }
  return NAN;
}

TEST(DampingRatio, OfTheLinearLawIsTheClosedForm) {
  for (const double e : {0.001, 0.01, 0.1, 0.13, 0.2, 0.209, 0.3, 0.5, 0.7, 0.9, 0.99})
    EXPECT_NEAR(closed_restitution(damping_ratio(Law::Normal::penalty, e)), e, 5e-3 * e) << e;
  EXPECT_EQ(damping_ratio(Law::Normal::penalty, 1), 0);
  EXPECT_EQ(damping_ratio(Law::Normal::hertz, 1), 0);
}

TEST(DampingRatio, FallsWithRestitution) {
  for (const Law::Normal normal : {Law::Normal::penalty, Law::Normal::hertz}) {
    double before = 1e300;
    for (const double e : {0.001, 0.01, 0.05, 0.1, 0.3, 0.6, 0.9, 0.999}) {
      const double zeta = damping_ratio(normal, e);
      EXPECT_LT(zeta, before);
      EXPECT_GT(zeta, 0);
      before = zeta;
    }
  }
}

TEST(Collision, EndsWithTheGivenRestitution) {
  for (const Law::Normal normal : {Law::Normal::penalty, Law::Normal::hertz})
    for (const double e : {0.2, 0.4, 0.6, 0.8, 0.95, 1.0}) {
      const PairLaw law({normal, 1, e, 0}, stone, rubber);
      EXPECT_NEAR(collide(law, 3e4, 0.2, 1.7, 2e-4), e, 1e-3 * e) << e;
    }
}

TEST(Collision, DependsOnNoScale) {
  for (const Law::Normal normal : {Law::Normal::penalty, Law::Normal::hertz}) {
    const PairLaw law({normal, 1, 0.5, 0}, stone, stone);
    for (const double k : {1e-3, 1e6})
      for (const double mass : {1e-6, 1e3})
        for (const double speed : {1e-4, 1e3}) EXPECT_NEAR(collide(law, k, mass, speed, 3e-4), 0.5, 5e-4);
  }
}

TEST(NormalStiffness, BelongsToItsEnergy) {
  for (const bool hertz : {false, true}) {
    const NormalStiffness spring{7, hertz};
    for (const double d : {1e-3, 0.1, 2.0}) {
      const double h = 1e-5 * d;
      EXPECT_NEAR((spring.energy(d + h) - spring.energy(d - h)) / (2 * h), spring.force(d),
                  1e-8 * spring.force(d));
      EXPECT_NEAR((spring.force(d + h) - spring.force(d - h)) / (2 * h), spring.tangent(d),
                  1e-8 * spring.tangent(d));
    }
  }
}

TEST(PairModuli, AreHertzAndMindlins) {
  const PairModuli same(stone, stone);
  EXPECT_NEAR(same.E, 30 / (2 * (1 - 0.04)), 1e-13);
  EXPECT_NEAR(same.G, 12.5 / (2 * (2 - 0.2)), 1e-13);
  EXPECT_NEAR(same.tangential_ratio(), 2 * (1 - 0.2) / (2 - 0.2), 1e-14);  // Mindlin, equal materials
  const PairModuli a(stone, rubber), b(rubber, stone);
  EXPECT_EQ(a.E, b.E);
  EXPECT_EQ(a.G, b.G);
  EXPECT_LT(a.E, rubber.young / (1 - 0.45 * 0.45));
}

TEST(LayerModulus, IsLambdaPlusTwoMu) {
  EXPECT_NEAR(layer_modulus(stone), 30 * (1 - 0.2) / ((1 + 0.2) * (1 - 2 * 0.2)), 1e-13);
}

TEST(LawTable, KeepsWhatIsSetForEitherOrder) {
  LawTable table(3);
  EXPECT_TRUE(table.empty());
  table.set(2, 0, {Law::Normal::hertz, 2, 0.5, 0.1});
  table.set(1, 1, {Law::Normal::penalty, 3, 1, 0});
  EXPECT_EQ(table.at(0, 2), table.at(2, 0));
  EXPECT_EQ(table.law(table.at(0, 2)).factor, 2);
  EXPECT_EQ(table.law(table.at(1, 1)).factor, 3);
  EXPECT_EQ(table.at(0, 1), -1);
  EXPECT_EQ(table.at(0, 0), -1);
  EXPECT_EQ(table.count(), 2);
  const auto [a, b] = table.regions_of(table.at(0, 2));
  EXPECT_EQ(a + b, 2);
}

}  // namespace
}  // namespace geist::contact
