// Whole runs of consistent lattices with ν > ¼, where cells and skins resist dilatation beside the bonds
// (de/dilatation.hpp).
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "core/parallel.hpp"
#include "model/hash.hpp"
#include "verification/bodies.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

/// A beam of particles alone, clamped and loaded at the first and last centres, against 30 layers of
/// assumed-strain hexahedra of that length: they agree with 20 layers' within 0.05 %.
void expect_beam(double poisson, double radius, double hexahedra, double excess) {
  const double tip = static_tip(example(
      "beam",
      {fmt::format(
           "regions={{all={{type=\"lattice\",material=\"polymer\",box=[[0,0,0],[20,2,2]],radius={}}}}}",
           radius),
       fmt::format("materials.polymer.poisson={}", poisson), "supports.0.fix=[\"x\",\"y\",\"z\"]",
       "method=consistent", "analysis.type=static"}));
  EXPECT_NEAR(tip / hexahedra - 1, excess, 0.001) << tip;
}

TEST(Dilatation, BeamsOfParticles) {
  expect_beam(0.3, 0.25, 1.8557, 0.0356);
  expect_beam(0.3, 0.125, 1.92777, 0.0098);
  expect_beam(0.45, 0.25, 1.83906, 0.0396);
  expect_beam(0.45, 0.125, 1.91066, 0.0101);
}

/// Coupled, loaded and thrown, at the very bound of the time step.
Simulation thrown(double poisson, const std::vector<std::string>& more) {
  std::vector<std::string> set{"method=consistent", fmt::format("materials.polymer.poisson={}", poisson),
                               "analysis.safety=1", "analysis.kinematics=small"};
  set.insert(set.end(), more.begin(), more.end());
  return std::move(build(read_case_text(box_in_an_L, "thrown.toml", set)).simulation);
}

TEST(Dilatation, IsStableAtTheBoundOfTheTimeStep) {
  for (const double poisson : {0.3, 0.45, 0.49}) {
    Simulation sim = thrown(poisson, {});
    sim.start();
    double most = 0, worst = 0;
    for (int n = 1; n <= 10000; ++n) {
      const bool observe = n % 50 == 0;
      sim.step(observe);
      if (!observe) continue;
      const Ledger now = sim.ledger();
      most = std::max(most, now.kinetic() + now.internal()), worst = std::max(worst, std::abs(now.balance()));
    }
    EXPECT_LT(worst, 0.05 * most) << poisson;
    RecordProperty(fmt::format("balance_{:.0f}", 100 * poisson), fmt::format("{:.2g}", worst / most));
  }
}

TEST(Dilatation, KeepsBothMomenta) {
  Simulation sim = thrown(0.45, {"supports=[]", "loads=[]"});
  sim.start();
  const Ledger first = sim.ledger();
  for (int n = 1; n <= 2000; ++n) sim.step(n == 2000);
  const Ledger last = sim.ledger();
  EXPECT_LT(norm(last.linear - first.linear), 1e-12 * norm(first.linear));
  EXPECT_LT(norm(last.angular - first.angular), 1e-11 * norm(first.angular));
}

TEST(Dilatation, HasGoldenBitsForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3, 4}) {
    set_threads(threads);
    Simulation sim = thrown(0.4, {});
    sim.start();
    for (int n = 0; n < 2000; ++n) sim.step(n % 100 == 0);
    EXPECT_EQ(state_hash(sim.model), "24071ec468b4e1d5");
  }
  set_threads(1);
}

}  // namespace
}  // namespace geist::verification
