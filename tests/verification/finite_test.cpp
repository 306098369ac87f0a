// Finite rotations as whole runs: a body that spins, a beam that bends to sixty degrees, an element that is
// turned inside out.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "core/parallel.hpp"
#include "fe/elements.hpp"
#include "verification/elastica.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

const std::vector<std::string> formulations{"full", "selective-reduced", "assumed-strain", "one-point",
                                            "one-point-viscous"};

class FiniteBy : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Formulation, FiniteBy, ::testing::ValuesIn(formulations), [](const auto& name) {
  std::string text = name.param;
  for (char& c : text) c = c == '-' ? '_' : c;
  return text;
});

/// The lines of a region that name a formulation.
std::string formulation_lines(const std::string& name) {
  if (name == "one-point-viscous") return "formulation = \"one-point\"\nhourglass = \"viscous\"\n";
  return fmt::format("formulation = \"{}\"\n", name);
}

/// A free body, not symmetric and not of equal elements, that spins about no axis of its own.
Case spinning(const std::string& formulation) {
  return read_case_text(fmt::format(R"(
units = {{ length = "mm", mass = "g", time = "ms" }}
[materials.m]
density = 0.001
young = 1000
poisson = 0.3
[regions.body]
type = "hexahedra"
material = "m"
corners = [[0, 0, 0], [4, 0.3, 0], [3.6, 2, 0], [0, 2, 0.2], [0, 0.1, 1], [4, 0, 1.2], [4, 2, 1], [0.3, 2, 1]]
divisions = [4, 3, 2]
{}
[[initial]]
velocity = [3, -2, 1]
spin = [1, 2, 6]
about = [2, 1, 0.5]
[analysis]
type = "dynamic"
kinematics = "finite"
duration = {}
)",
                                    formulation_lines(formulation), 10 * 2 * M_PI / std::sqrt(41)),
                        "spin.toml");
}

/// Largest change of a distance between any two nodes, relative to the body's size.
double change_of_shape(const Mesh& mesh) {
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 X = mesh.points[i] - mesh.points[j], x = X + mesh.u.vector(i) - mesh.u.vector(j);
      worst = std::max(worst, std::abs(norm(x) - norm(X))), size = std::max(size, norm(X));
    }
  return worst / size;
}

/// Angular speed of 6.4 rad/ms: material moves at 15 mm/ms, waves at 1160. Centrifugal strains are of the
/// order of (15/1160)² ≈ 10⁻⁴, and the body, which is set spinning unstrained, vibrates by them.
TEST_P(FiniteBy, TenTurnsOfAFreeBody) {
  const Case input = spinning(GetParam());
  set_threads(1);
  Simulation sim = std::move(build(input).simulation);
  sim.start();
  const Ledger before = sim.ledger();
  double shape = 0, balance = 0, linear = 0, angular = 0;
  while (sim.model.time < input.analysis.duration) {
    const bool watch = (sim.model.step + 1) % 500 == 0;
    sim.step(watch);
    if (!watch) continue;
    const Ledger now = sim.ledger();
    shape = std::max(shape, change_of_shape(sim.model.mesh));
    balance = std::max(balance, std::abs(now.balance()) / now.kinetic());
    linear = std::max(linear, norm(now.linear - before.linear) / norm(before.linear));
    angular = std::max(angular, norm(now.angular - before.angular) / norm(before.angular));
    EXPECT_NEAR(now.kinetic() / before.kinetic(), 1, 1e-3);
  }
  EXPECT_LT(shape, 5e-4);
  EXPECT_LT(balance, 1e-6);
  EXPECT_LT(linear, 1e-12);
  EXPECT_LT(angular, 1e-12);
  RecordProperty("figures", fmt::format("steps {} shape {:.2g} balance {:.2g} linear {:.2g} angular {:.2g}",
                                        sim.model.step, shape, balance, linear, angular));
}

/// Bisshopp and Drucker, Quart. Appl. Math. 3 (1945) 272–275, have elliptic integrals for it; Mattiasson,
/// IJNME 17 (1981) 145–153, tabulates them: a = 3 gives 0.60325 L across, 0.25442 L along, 0.98602 rad at the
/// tip.
TEST(Elastica, AgreesWithTheTables) {
  const Elastica tip = elastica(3);
  EXPECT_NEAR(tip.across, 0.60325, 1e-5);
  EXPECT_NEAR(1 - tip.along, 0.25442, 1e-5);
  EXPECT_NEAR(tip.slope, 0.98602, 1e-5);
}

/// ν = 0, so that bending is that of beam theory across any section; 40 × 1 × 1 mm of one element across.
TEST(Finite, CantileverFollowsTheElastica) {
  const double E = 1000, L = 40, I = 1.0 / 12, a = 3.42;
  const Case input = read_case_text(fmt::format(R"(
units = {{ length = "mm", mass = "g", time = "ms" }}
[materials.m]
density = 0.001
young = {}
poisson = 0
[regions.beam]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [{}, 1, 1]]
divisions = [20, 1, 1]
formulation = "assumed-strain"
[[supports]]
where = {{ x = 0 }}
fix = ["x", "y", "z"]
[[loads]]
where = {{ x = {} }}
total_force = [0, 0, {}]
[analysis]
type = "quasi-static"
kinematics = "finite"
)",
                                                E, L, L, a * E * I / (L * L)),
                                    "elastica.toml");
  Built built = build(input);
  ASSERT_EQ(run_to_end(input, built).status, Status::completed);
  const Mesh& mesh = built.simulation.model.mesh;
  Vec3 tip, normal;
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    if (mesh.points[i].x == L) {
      tip += 0.25 / L * mesh.u.vector(i);
      normal += (mesh.points[i].z - 0.5) * (mesh.points[i] + mesh.u.vector(i));
    }
  const Elastica exact = elastica(a);
  const double slope = std::atan2(-normal.x, normal.z);
  EXPECT_NEAR(slope, M_PI / 3, 0.01);
  EXPECT_NEAR(tip.z / exact.across, 1, 0.01);
  EXPECT_NEAR(-tip.x / (1 - exact.along), 1, 0.01);
  EXPECT_NEAR(slope / exact.slope, 1, 0.01);
  EXPECT_NEAR(tip.y, 0, 1e-9);
  RecordProperty("figures",
                 fmt::format("steps {} across {:.4f} ({:+.2f} %) along {:.4f} ({:+.2f} %) slope {:.2f} "
                             "degrees ({:+.2f} %)",
                             built.simulation.model.step, tip.z, 100 * (tip.z / exact.across - 1), tip.x,
                             100 * (-tip.x / (1 - exact.along) - 1), slope * 180 / M_PI,
                             100 * (slope / exact.slope - 1)));
}

/// The bound of undeformed elements is used to the full, and half of the energy goes into strains of tens of
/// per cent: what grew would grow a thousandfold within a few hundred steps.
TEST_P(FiniteBy, StrainedBodyIsStableAtTheBound) {
  Case input = spinning(GetParam());
  input.analysis.safety = 1;
  set_threads(1);
  Simulation sim = std::move(build(input).simulation);
  Mesh& mesh = sim.model.mesh;
  for (std::size_t i = 0; i < mesh.nodes(); ++i) {
    const Vec3 X = mesh.points[i] - Vec3{2, 1, 0.5};
    mesh.v.add(i, 150 * Vec3{0, -X.x * X.z, X.x * X.y});  // twists
  }
  sim.start();
  double most = 0;
  for (int n = 1; n <= 10'000; ++n) {
    sim.step(n % 20 == 0);
    if (n % 20 != 0) continue;
    const Ledger now = sim.ledger();
    most = std::max(most, std::sqrt(2 * now.internal() / (1000 * 7.6)));
    ASSERT_LT(std::abs(now.balance()), 0.03 * now.initial) << n;
  }
  EXPECT_GT(most, 0.07);
  RecordProperty("strain", fmt::format("{:.3f}", most));
}

/// A cube is squashed to nothing by its supports: the run ends where its volume would be negative, and says
/// so.
TEST(Finite, AnElementTurnedInsideOutEndsTheRun) {
  const Case input = read_case_text(R"(
units = { length = "mm", mass = "g", time = "ms" }
[materials.m]
density = 0.001
young = 1000
poisson = 0.2
[regions.left]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [1, 1, 1]]
divisions = [1, 1, 1]
[regions.right]
type = "hexahedra"
material = "m"
box = [[1, 0, 0], [3, 1, 1]]
divisions = [1, 1, 1]
[[supports]]
where = { x = 0 }
fix = ["x", "y", "z"]
[[supports]]
where = { x = 1 }
fix = ["y", "z"]
velocity = { x = -10 }
[analysis]
type = "dynamic"
kinematics = "finite"
duration = 1
balance_tolerance = 1000
[output]
history = { every = 0.001 }
)",
                                    "squash.toml");
  Built built = build(input);
  const Outcome outcome = run_to_end(input, built);
  EXPECT_EQ(outcome.status, Status::failed);
  EXPECT_NEAR(built.simulation.model.time, 0.1, 1e-3);
  EXPECT_NE(outcome.message.find("region 'left', element 0 at (-"), std::string::npos) << outcome.message;
  EXPECT_NE(outcome.message.find("is turned inside out"), std::string::npos) << outcome.message;
}

}  // namespace
}  // namespace geist::verification
