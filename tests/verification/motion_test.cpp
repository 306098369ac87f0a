// Free bodies: momentum and angular momentum are kept, and rigid motion costs no energy.
//
// All forces come in pairs that cancel, up to the last bit of the sums that they go into, so momenta change
// only by rounding. A step rounds every velocity once, by at most ε = 1.1e-16 of it, at random: √n ε of Σ m
// |v| after n steps (of Σ |X| m |v| + I |ω| for angular momentum) would be the most, if all roundings of a
// step had one sign. In rigid motion u grows like n and forces are the rounding of u, ε k |u| on every bond;
// the velocity they leave behind is of order n ε k Δt² / m |v|, and k Δt²/m is of order one. Hence 10 √n ε is
// allowed for the vibrating body and 10 n ε for the flying one.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "coupling/ghosts.hpp"
#include "fe/elements.hpp"
#include "verification/bodies.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon() / 2;
constexpr long steps = 5000;

/// The shipped beam, without supports and loads, with initial motion.
Simulation free_beam(const std::string& initial, const std::string& method = "published") {
  const Case input = example(
      "beam", {"method=" + method, "supports=[]", "loads=[]", "initial=[" + initial + "]",
               "regions.middle.radius=0.2", "analysis={type=\"dynamic\",kinematics=\"small\",duration=1}"});
  return std::move(build(input).simulation);
}

/// Sums of absolute values: what momenta are measured by.
struct Scale {
  double linear = 0, angular = 0;
};

Scale scale_of(const Model& model) {
  Scale scale;
  const auto add = [&scale](Vec3 X, double mass, Vec3 v) {
    scale.linear += mass * norm(v), scale.angular += mass * norm(X) * norm(v);
  };
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i)
    add(model.mesh.points[i], model.mesh.mass[i], model.mesh.v.vector(i));
  for (const Lattice& lattice : model.lattices)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (lattice.is(s, site::particle))
        add(lattice.grid.centre(s), lattice.mass, lattice.velocity.vector(s));
      scale.angular += lattice.inertia * norm(lattice.velocity.vector(s, 3));
    }
  return scale;
}

/// Run freely; the momenta at the end may differ from those at the beginning by `allowed` of their scales.
/// The ledger before and after.
std::pair<Ledger, Ledger> expect_momenta_kept(Simulation& sim, double allowed) {
  set_threads(1);
  sim.start();
  const Ledger before = sim.ledger();
  Scale scale = scale_of(sim.model);
  for (long n = 1; n <= steps; ++n) {
    sim.step(n == steps);
    if (n % 500) continue;
    const Scale now = scale_of(sim.model);
    scale = {std::max(scale.linear, now.linear), std::max(scale.angular, now.angular)};
  }
  const Ledger after = sim.ledger();
  const double linear = norm(after.linear - before.linear) / scale.linear;
  const double angular = norm(after.angular - before.angular) / scale.angular;
  EXPECT_LT(linear, allowed);
  EXPECT_LT(angular, allowed);
  ::testing::Test::RecordProperty("momenta", fmt::format("{:.2e} {:.2e}", linear, angular));
  return {before, after};
}

class FreeBodyByMethod : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Method, FreeBodyByMethod, ::testing::Values("published", "consistent"),
                         [](const auto& method) { return method.param; });

TEST_P(FreeBodyByMethod, RigidFlightKeepsMomentaAndEnergy) {
  Simulation sim = free_beam("{velocity=[1,-2,3],spin=[0.3,-0.2,0.5],about=[10,1,1]}", GetParam());
  const auto [before, after] = expect_momenta_kept(sim, 10 * epsilon * steps);
  EXPECT_GT(norm(before.linear), 0.1);
  EXPECT_GT(norm(before.angular), 0.1);
  EXPECT_LT(after.internal(), 1e-20 * after.kinetic());  // squares of rounding
  EXPECT_NEAR(after.kinetic() / before.kinetic(), 1, 10 * epsilon * steps);
}

/// One end is hit, so that everything vibrates; ghosts spin as they like.
TEST_P(FreeBodyByMethod, VibrationKeepsMomenta) {
  Simulation sim = free_beam(
      "{velocity=[1,-2,3],spin=[0.3,-0.2,0.5],about=[10,1,1]},{where={x=[15,20]},velocity=[4,30,-20]}",
      GetParam());
  const auto [before, after] = expect_momenta_kept(sim, 10 * epsilon * std::sqrt(double(steps)));
  EXPECT_GT(after.internal(), 0.05 * after.kinetic());
  EXPECT_GT(after.strain_coupling, 1e-4 * after.internal());
  EXPECT_LT(std::abs(after.balance()), 1e-2 * (after.kinetic() + after.internal()));  // v jumps at x = 15
}

/// The same at any angle: a coupled body with corners in its interfaces turns ten times, hexahedra, ghosts
/// and particles together. What is left of the balance is the time step's.
void expect_ten_turns(const char* text, const std::string& rotation) {
  constexpr double spin = 6;  // rad/ms
  const Case input = read_case_text(
      text, "free.toml",
      {"method=consistent", "coupling.rotation=" + rotation, "supports=[]", "loads=[]",
       fmt::format("initial=[{{velocity=[1,-2,3],spin=[{},{},{}]}}]", spin / 3, 2 * spin / 3, -2 * spin / 3),
       "analysis={type=\"dynamic\",kinematics=\"finite\",duration=1}"});
  Simulation sim = std::move(build(input).simulation);
  set_threads(1);
  sim.start();
  const Ledger before = sim.ledger();
  const auto turns = static_cast<long>(20 * M_PI / spin / sim.dt);
  for (long n = 1; n <= turns; ++n) sim.step(n == turns);
  const Ledger after = sim.ledger();
  const Scale scale = scale_of(sim.model);
  const double lost = 10 * epsilon * std::sqrt(double(turns));
  EXPECT_LT(norm(after.linear - before.linear), lost * scale.linear);
  EXPECT_LT(norm(after.angular - before.angular), 10 * lost * scale.angular);
  EXPECT_LT(std::abs(after.balance()), 1e-4 * before.kinetic());
  EXPECT_LT(after.internal(), 1e-3 * before.kinetic());  // it is strained by its spin alone
  ::testing::Test::RecordProperty(
      "turns", fmt::format("momenta {:.1e} {:.1e}, balance {:.1e}, strained {:.1e}",
                           norm(after.linear - before.linear) / scale.linear,
                           norm(after.angular - before.angular) / scale.angular,
                           after.balance() / before.kinetic(), after.internal() / before.kinetic()));
}

TEST(FreeBody, CoupledBodiesTurnTenTimes) {
  expect_ten_turns(box_in_an_L, "continuum");
  expect_ten_turns(box_in_an_L, "one-step-back");
  expect_ten_turns(L_around_a_box, "continuum");
}

/// Without the ghosts' spin their moments would be lost: the sum counts them, and must.
TEST(FreeBody, AngularMomentumNeedsTheGhostsSpin) {
  Simulation sim = free_beam("{where={x=[15,20]},velocity=[4,30,-20]}");
  sim.start();
  for (int n = 0; n < 1000; ++n) sim.step(n == 999);
  Vec3 ghosts;
  const Lattice& lattice = sim.model.lattices[0];
  for (const Ghost& g : lattice.ghosts) ghosts += lattice.inertia * lattice.velocity.vector(g.site, 3);
  EXPECT_GT(norm(ghosts), 1e-9 * scale_of(sim.model).angular);  // 10⁶ times what may be lost
}

/// Energy of displacements u = A X (and rotations θ) put on everything.
double energy_of(Simulation& sim, const Mat3& A, Vec3 theta) {
  Mesh& mesh = sim.model.mesh;
  for (std::size_t i = 0; i < mesh.nodes(); ++i) mesh.u.set(i, A * mesh.points[i]);
  double energy = 0;
  for (Lattice& lattice : sim.model.lattices) {
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (!lattice.word[s]) continue;
      lattice.motion.set(s, A * lattice.grid.centre(s));
      lattice.motion.set(s, theta, 3);
    }
    coupling::follow(lattice, mesh);
    const de::BondEnergies bonds = de::energies(lattice);
    energy += bonds.bonds + bonds.coupling;
  }
  const fe::Energies elements = fe::energies(mesh);
  return energy + elements.strain + elements.hourglass;
}

/// u = θ × X on everything, θ on particles and ghosts. Differences of u between neighbours are rounded to ε
/// |u|, against a strain of the same size times a pitch: an energy of (ε × 20 mm / 0.4 mm)² ≈ 1e-28 of that
/// of the strain.
TEST_P(FreeBodyByMethod, SmallRigidRotationCostsNoEnergy) {
  Simulation sim = free_beam("{velocity=[0,0,1]}", GetParam());
  for (const Vec3 t : {Vec3{1e-3, 0, 0}, Vec3{0, 1e-3, 0}, Vec3{0, 0, 1e-3}, Vec3{1e-3, -2e-3, 3e-3}}) {
    const Mat3 rotation{{Vec3{0, -t.z, t.y}, Vec3{t.z, 0, -t.x}, Vec3{-t.y, t.x, 0}}};
    const Mat3 strain{{Vec3{0, t.z, t.y}, Vec3{t.z, 0, t.x}, Vec3{t.y, t.x, 0}}};
    const double ratio = energy_of(sim, rotation, t) / energy_of(sim, strain, {});
    EXPECT_LT(ratio, 1e-25);
    RecordProperty(fmt::format("about {:g} {:g} {:g}", t.x, t.y, t.z), fmt::format("{:.2e}", ratio));
    EXPECT_GT(energy_of(sim, rotation, {}), 0.05 * energy_of(sim, strain, {}));  // particles must turn along
  }
}

}  // namespace
}  // namespace geist::verification
