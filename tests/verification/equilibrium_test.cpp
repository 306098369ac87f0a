// Static analysis of the beams, mostly by the published method: the direct solutions of statics_test.cpp to
// every digit that they have, and dynamic relaxation where it is pushed that far.
#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "model/hash.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

Outcome solve(std::vector<std::string> set, Built& built, int threads = 1,
              const std::string& method = "published") {
  set.insert(set.end(), {"method=" + method, "analysis={type=\"static\",tolerance=1e-9}"});
  const Case input = example("beam", set);
  built = build(input);
  set_threads(threads);
  return run(built.simulation, plan_of(input), {});
}

/// The references are means over the end face by tributary area, which is f·u of the load of 1 N.
void expect_tip(double reference, const std::vector<std::string>& set) {
  Built built;
  const Outcome outcome = solve(set, built);
  ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
  const Ledger& l = outcome.last.ledger;
  EXPECT_NEAR(2 * l.external, reference, 1e-6 * reference);
  EXPECT_NEAR(l.balance(), 0, 1e-9 * l.internal());
  EXPECT_EQ(l.kinetic_rotation, 0);
  EXPECT_LE(outcome.last.residual, 1e-9);
  EXPECT_LT(outcome.equilibrium->iterations, 200);
  ::testing::Test::RecordProperty("iterations", std::to_string(outcome.equilibrium->iterations));
}

TEST(StaticAnalysis, AllHexahedra) {
  expect_tip(1.970252, {hexahedra("middle", 7, 13, "[12,4,4]")});
  expect_tip(1.947522, {hexahedra("middle", 7, 13, "[12,4,4]"), "regions.left.formulation=full",
                        "regions.middle.formulation=full", "regions.right.formulation=full"});
}

TEST(StaticAnalysis, CoupledBeams) {
  expect_tip(2.048088, {});
  expect_tip(2.043438, {"regions.left.divisions=[14,4,5]", "regions.right.divisions=[14,4,5]"});
  expect_tip(2.018786, {hexahedra("left", 0, 8, "[16,4,4]"), "regions.middle.box=[[8,0,0],[12,2,2]]",
                        hexahedra("right", 12, 20, "[16,4,4]")});
  expect_tip(2.156817, {"regions.middle.radius=0.2"});
  expect_tip(1.207094, {"regions.middle.radius=0.2", "coupling.rotation=none"});
}

/// Every node and every particle, not the tip alone.
TEST(StaticAnalysis, AgreesWithDynamicRelaxation) {
  const std::vector<std::string> coarse{"regions.middle.radius=0.2"};
  Built at_once;
  ASSERT_EQ(solve(coarse, at_once).status, Status::completed);
  const Case input = published("beam", {coarse[0], "analysis.tolerance=1e-9"});
  Built relaxed = build(input);
  ASSERT_EQ(run_to_end(input, relaxed).status, Status::completed);
  const Model &a = at_once.simulation.model, &b = relaxed.simulation.model;
  for (std::size_t i = 0; i < a.mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(a.mesh.u[c][i], b.mesh.u[c][i], 2e-6) << i;
  const Lattice& lattice = a.lattices[0];
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    for (int c = 0; lattice.word[s] && c < 6; ++c)
      ASSERT_NEAR(lattice.motion[c][s], b.lattices[0].motion[c][s], 2e-6) << s;
}

TEST(StaticAnalysis, GivesTheSameBitsOnAnyNumberOfThreads) {
  for (const std::string method : {"published", "consistent"}) {
    std::string hash;
    for (int threads = 1; threads <= 4; ++threads) {
      Built built;
      ASSERT_EQ(solve({}, built, threads, method).status, Status::completed);
      if (threads == 1) hash = state_hash(built.simulation.model);
      EXPECT_EQ(state_hash(built.simulation.model), hash) << method << threads;
    }
  }
}

/// To every digit what it was when first computed, and 0.04 % from converged hexahedra.
TEST(StaticAnalysis, BeamAsShipped) {
  Built built;
  const Outcome outcome = solve({}, built, 1, "consistent");
  ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_NEAR(2 * outcome.last.ledger.external, 2.008417, 5e-5);
  EXPECT_NEAR(2 * outcome.last.ledger.external / 2.0077, 1, 5e-4);
}

/// Smaller particles do not take more of them.
TEST(StaticAnalysis, TakesFewIterationsWhateverTheSizeOfParticles) {
  for (const char* radius : {"0.25", "0.125", "0.1"}) {
    Built built;
    const Outcome outcome = solve({std::string("regions.middle.radius=") + radius}, built);
    EXPECT_EQ(outcome.status, Status::completed) << radius << outcome.message;
    EXPECT_LT(outcome.equilibrium->iterations, 120) << radius;
  }
}

}  // namespace
}  // namespace geist::verification
