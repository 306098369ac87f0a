// Lattices with finite rotations as whole runs: bodies that spin, a cantilever bent to sixty degrees.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "core/parallel.hpp"
#include "de/rotation.hpp"
#include "verification/elastica.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

Simulation finite_body(const std::string& box, const std::string& rest, std::vector<std::string> set = {}) {
  const std::string text = fmt::format(R"(
units = {{ length = "mm", mass = "g", time = "ms" }}
[materials.polymer]
density = 0.001
young = 1000
poisson = 0.2
[regions.body]
type = "lattice"
material = "polymer"
box = [[0, 0, 0], {}]
radius = 0.5
{})",
                                       box, rest);
  set_threads(1);
  set.push_back("analysis.kinematics=finite");
  return std::move(build(read_case_text(text, "finite.toml", set)).simulation);
}

class SpinningBlock : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Method, SpinningBlock, ::testing::Values("published", "consistent"),
                         [](const auto& method) { return method.param; });

/// Largest change of the distance of two corners, by the distance.
double distortion(const Lattice& lattice) {
  std::vector<std::size_t> corners;
  for (const int i : {0, 5})
    for (const int j : {0, 4})
      for (const int k : {0, 3}) corners.push_back(lattice.grid.index(i, j, k));
  double most = 0;
  for (const std::size_t a : corners)
    for (const std::size_t b : corners) {
      const Vec3 X = lattice.grid.centre(b) - lattice.grid.centre(a);
      const Vec3 x = X + lattice.motion.vector(b) - lattice.motion.vector(a);
      if (a != b) most = std::max(most, std::abs(norm(x) / norm(X) - 1));
    }
  return most;
}

/// Largest so far, relative.
struct Record {
  double distortion = 0, linear = 0, angular = 0;
  double balance = 0, balance_at_first = 0;  ///< of all turns, of the first two
  long steps = 0;
  double roundings() const { return 1.1e-16 * std::sqrt(static_cast<double>(steps)); }
};

/// Σ m |v|
double scale_of(const Lattice& lattice) {
  double scale = 0;
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    if (lattice.is(s, site::particle)) scale += lattice.mass * norm(lattice.velocity.vector(s));
  return scale;
}

Simulation spinning_block(const std::string& method, const std::string& more, double safety) {
  const Vec3 spin = 6 / norm(Vec3{1, 2, 3}) * Vec3{1, 2, 3};
  return finite_body(
      "[6, 5, 4]",
      fmt::format("[[initial]]\nspin = [{}, {}, {}]\nabout = [3, 2.5, 2]\nvelocity = [5, 0, -2]\n"
                  "{}\n[analysis]\ntype = \"dynamic\"\nduration = 1\nsafety = {}\n",
                  spin.x, spin.y, spin.z, more, safety),
      {"method=" + method});
}

/// Ten turns; the initial motion is `more` than a spin of 6 / ms.
Record ten_turns(const std::string& method, const std::string& more, double safety = 0.9) {
  Simulation sim = spinning_block(method, more, safety);
  sim.start();
  const Ledger before = sim.ledger();
  const Lattice& lattice = sim.model.lattices[0];
  const double turn = 2 * M_PI / 6, scale = scale_of(lattice);
  Record record;
  for (int n = 1; sim.model.time < 10 * turn; ++n) {
    sim.step(n % 50 == 0);
    if (n % 50) continue;
    const Ledger now = sim.ledger();
    record.distortion = std::max(record.distortion, distortion(lattice));
    record.balance = std::max(record.balance, std::abs(now.balance()) / now.kinetic());
    if (sim.model.time < 2 * turn) record.balance_at_first = record.balance;
    record.linear = std::max(record.linear, norm(now.linear - before.linear) / scale);
    record.angular = std::max(record.angular, norm(now.angular - before.angular) / norm(before.angular));
  }
  record.steps = sim.model.step;
  ::testing::Test::RecordProperty("distortion, energy, linear, angular",
                                  fmt::format("{:.2e} {:.2e} {:.2e} {:.2e} in {} steps", record.distortion,
                                              record.balance, record.linear, record.angular, record.steps));
  return record;
}

/// At its corners it moves with 22 m/s where waves run with 1000: centrifugal forces strain it by the square
/// of that, and as they come at once, by twice that. Momenta: each step rounds at random.
TEST_P(SpinningBlock, KeepsShapeEnergyAndMomentaForTenTurns) {
  const Record record = ten_turns(GetParam(), "");
  EXPECT_LT(record.distortion, 1e-3);
  EXPECT_LT(record.balance, 1e-5);
  EXPECT_LT(record.linear, 10 * record.roundings());
  EXPECT_LT(record.angular, 10 * record.roundings());
}

/// One end is hit as well: strains of some per cent at all frequencies. What the balance lacks does not grow
/// with time, and falls with the square of the step.
TEST_P(SpinningBlock, KeepsEnergyAndMomentaWhileItVibrates) {
  const std::string hit = "[[initial]]\nwhere = { x = [4, 6] }\nvelocity = [12, -9, 6]\nspin = [9, 0, -7]\n";
  const Record record = ten_turns(GetParam(), hit);
  EXPECT_LT(record.distortion, 0.1);
  EXPECT_GT(record.distortion, 0.01);
  EXPECT_LT(record.balance, 0.05);
  EXPECT_LT(record.balance, 1.5 * record.balance_at_first);
  EXPECT_LT(record.linear, 10 * record.roundings());
  EXPECT_LT(record.angular, 10 * record.roundings());
  EXPECT_NEAR(ten_turns(GetParam(), hit, 0.45).balance / record.balance, 0.25, 0.1);
}

/// Place and slope of the tip of n × 1 × 1 or n × 2 × 2 particles under a load, by relaxation.
Elastica relaxed(int n, int rows, double load, bool finitely) {
  Simulation sim = finite_body(
      fmt::format("[{}, {}, {}]", n, rows, rows),
      fmt::format("[[supports]]\nwhere = {{ x = 0 }}\nfix = [\"x\", \"y\", \"z\", \"rx\", \"ry\", \"rz\"]\n"
                  "[[loads]]\nwhere = {{ x = {} }}\ntotal_force = [0, 0, {}]\n"
                  "[analysis]\ntype = \"quasi-static\"\n",
                  n, load),
      {"method=consistent"});
  if (!finitely) sim.model.lattices[0].kinematics = Kinematics::small;
  RunPlan plan;
  plan.quasi_static = true, plan.tolerance = 1e-6, plan.max_steps = 2'000'000;
  plan.balance_tolerance = 1e9;
  const Outcome outcome = run(sim, plan, {});
  EXPECT_EQ(outcome.status, Status::completed) << outcome.message;
  const Lattice& lattice = sim.model.lattices[0];
  Vec3 u;
  double slope = 0;
  for (int j = 0; j < rows; ++j)
    for (int k = 0; k < rows; ++k) {
      const std::size_t s = lattice.grid.index(n - 1, j, k);
      u += 1.0 / (rows * rows) * lattice.motion.vector(s);
      slope -= 1.0 / (rows * rows) * de::rotation_vector(lattice, s).y;
    }
  const double length = n - 1;
  ::testing::Test::RecordProperty("steps", std::to_string(sim.model.step));
  return {slope, 1 + u.x / length, u.z / length};
}

void expect_elastica(const Elastica& found, const Elastica& expected) {
  EXPECT_NEAR(found.slope / expected.slope, 1, 0.01);
  EXPECT_NEAR(found.along / expected.along, 1, 0.01);
  EXPECT_NEAR(found.across / expected.across, 1, 0.01);
  ::testing::Test::RecordProperty(
      "slope, along, across",
      fmt::format("{:.5f} {:.5f} {:.5f}, elastica {:.5f} {:.5f} {:.5f}", found.slope, found.along,
                  found.across, expected.slope, expected.along, expected.across));
}

TEST(ElasticaIntegrator, KnowsTheTables) {  // Bisshopp and Drucker 1945, at P l²/EI = 1 and 10
  EXPECT_NEAR(elastica(1).across, 0.30172, 1e-5);
  EXPECT_NEAR(elastica(10).across, 0.81061, 1e-5);
}

/// A row of particles has EI = E (2r)⁴/12. It shears by 3 EI/κGA l² = 0.0004 of its deflection.
TEST(FiniteBeam, RowFollowsTheElasticaToSixtyDegrees) {
  const int n = 41;
  const double a = load_to(M_PI / 3), EI = 1000.0 / 12, length = n - 1;
  expect_elastica(relaxed(n, 1, a * EI / (length * length), true), elastica(a));
}

/// Two by two rows have an EI of their own, which their small deflections tell.
TEST(FiniteBeam, FourRowsFollowTheElasticaToSixtyDegrees) {
  const int n = 41;
  const double a = load_to(M_PI / 3), tiny = 1e-3;
  const double flexibility = relaxed(n, 2, tiny, false).across / tiny;  // l²/3EI
  expect_elastica(relaxed(n, 2, a / (3 * flexibility), true), elastica(a));
}

/// A prescribed rotation arrives: one end of a row is turned about its axis by a curve, the other is free.
TEST(FiniteSupports, TurnByWhatTheirCurveSays) {
  Simulation sim = finite_body("[5, 1, 1]", R"([[supports]]
where = { x = 0 }
fix = ["x", "y", "z", "ry", "rz"]
[[supports]]
where = { x = 0 }
displacement = { rx = 2.5 }
curve = "ramp"
[curves.ramp]
points = [[0, 0], [1, 1]]
[analysis]
type = "dynamic"
duration = 1
)",
                               {"method=consistent"});
  sim.start();
  const Lattice& lattice = sim.model.lattices[0];
  while (sim.model.time < 1) sim.step(false);
  EXPECT_NEAR(norm(de::rotation_vector(lattice, 0) - Vec3{2.5, 0, 0}), 0, 1e-12);
}

}  // namespace
}  // namespace geist::verification
