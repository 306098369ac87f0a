// Static analysis with finite rotations: cantilevers of hexahedra, of particles and of both bent to sixty
// degrees, against the elastica and against dynamic relaxation; what is no state of rest.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "de/rotation.hpp"
#include "model/hash.hpp"
#include "verification/elastica.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

constexpr const char* hexahedra_40 = R"([regions.beam]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [40, 1, 1]]
divisions = [20, 1, 1]
formulation = "assumed-strain"
)";
constexpr const char* row_41 = R"([regions.beam]
type = "lattice"
material = "m"
box = [[0, 0, 0], [41, 1, 1]]
radius = 0.5
)";
constexpr const char* four_rows_41 = R"([regions.beam]
type = "lattice"
material = "m"
box = [[0, 0, 0], [41, 2, 2]]
radius = 0.5
)";
constexpr const char* coupled_40 = R"([regions.left]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [14, 2, 2]]
divisions = [14, 2, 2]
formulation = "assumed-strain"
[regions.middle]
type = "lattice"
material = "m"
box = [[14, 0, 0], [26, 2, 2]]
radius = 0.25
[regions.right]
type = "hexahedra"
material = "m"
box = [[26, 0, 0], [40, 2, 2]]
divisions = [14, 2, 2]
formulation = "assumed-strain"
)";
constexpr const char* statics = "type = \"static\"\n";
constexpr double young = 1000;

/// A beam along x that stands at x = 0.
struct Beam {
  std::string regions;
  bool lattice_at_ends = false;
  double poisson = 0;
  double length = 40, inertia = 1.0 / 12;  ///< of its section
  double end = 40;                         ///< x of the face that loads act on

  double unit_load() const { return young * inertia / (length * length); }
  Case with(const std::string& rest, const std::string& analysis, std::vector<std::string> set = {}) const {
    set.insert(set.begin(), "analysis.kinematics=finite");
    return read_case_text(
        fmt::format("method = \"consistent\"\nunits = {{ length = \"mm\", mass = \"g\", time = \"ms\" }}\n"
                    "[materials.m]\ndensity = 0.001\nyoung = {}\npoisson = {}\n"
                    "{}[[supports]]\nwhere = {{ x = 0 }}\nfix = [\"x\", \"y\", \"z\"{}]\n{}[analysis]\n{}",
                    young, poisson, regions, lattice_at_ends ? ", \"rx\", \"ry\", \"rz\"" : "", rest,
                    analysis),
        "beam.toml", set);
  }
  Case under(Vec3 load, const std::string& analysis, std::vector<std::string> set = {}) const {
    return with(fmt::format("[[loads]]\nwhere = {{ x = {} }}\ntotal_force = [{}, {}, {}]\n", end, load.x,
                            load.y, load.z),
                analysis, std::move(set));
  }
};

const Beam of_hexahedra{hexahedra_40}, row{row_41, true, 0.2, 40, 1.0 / 12, 41},
    four_rows{four_rows_41, true, 0.2, 40, 16.0 / 12, 41}, coupled{coupled_40, false, 0.2, 40, 16.0 / 12, 40};

/// Mean displacement of the loaded end.
Vec3 tip_of(const Simulation& sim) {
  Vec3 u;
  double count = 0;
  for (const NodeForce& p : sim.loads[0].nodes) u += sim.model.mesh.u.vector(p.node), ++count;
  for (const ParticleForce& p : sim.loads[0].particles)
    u += sim.model.lattices[p.lattice].motion.vector(p.site), ++count;
  return 1 / count * u;
}

/// Largest difference of a displacement, and of a rotation matrix's entries.
double difference(const Model& a, const Model& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.mesh.nodes(); ++i)
    most = std::max(most, norm(a.mesh.u.vector(i) - b.mesh.u.vector(i)));
  for (std::size_t l = 0; l < a.lattices.size(); ++l)
    for (std::size_t s = 0; s < a.lattices[l].grid.size(); ++s) {
      if (!a.lattices[l].word[s]) continue;
      most = std::max(most, norm(a.lattices[l].motion.vector(s) - b.lattices[l].motion.vector(s)));
      for (int c = 0; c < 9; ++c)
        most = std::max(most, std::abs(a.lattices[l].rotation[c][s] - b.lattices[l].rotation[c][s]));
    }
  return most;
}

double seconds(const Simulation& sim) {
  double total = 0;
  for (std::size_t i = 0; i < phase_names.size(); ++i) total += sim.timers.seconds(static_cast<Phase>(i));
  return total;
}

/// The tip against the elastica, and every node and particle against dynamic relaxation.
void expect_sixty_degrees(const Beam& beam, double stiffer = 1) {
  const double a = load_to(M_PI / 3);
  const Vec3 load{0, 0, stiffer * a * beam.unit_load()};
  const Case at_once = beam.under(load, "type = \"static\"\ntolerance = 1e-9\n"),
             in_time = beam.under(load, "type = \"quasi-static\"\ntolerance = 1e-9\n");
  Built found = build(at_once), relaxed = build(in_time);
  const Outcome outcome = run_to_end(at_once, found);
  ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_LE(outcome.last.residual, 1e-9);
  EXPECT_NEAR(outcome.last.ledger.balance(), 0, 1e-12);
  EXPECT_EQ(outcome.last.ledger.kinetic(), 0);
  const Elastica exact = elastica(a);
  const Vec3 tip = tip_of(found.simulation);
  EXPECT_NEAR(tip.z / beam.length / exact.across, 1, 0.01);
  EXPECT_NEAR(-tip.x / beam.length / (1 - exact.along), 1, 0.01);
  ASSERT_EQ(run_to_end(in_time, relaxed).status, Status::completed);
  const double apart = difference(found.simulation.model, relaxed.simulation.model);
  EXPECT_LT(apart, 1e-6 * beam.length);
  ::testing::Test::RecordProperty(
      "figures",
      fmt::format("across {:+.3f} %, along {:+.3f} %, from relaxation {:.1e}, {} iterations, {} steps, "
                  "{:.3f} s and {:.3f} s",
                  100 * (tip.z / beam.length / exact.across - 1),
                  100 * (-tip.x / beam.length / (1 - exact.along) - 1), apart,
                  outcome.equilibrium->iterations, relaxed.simulation.model.step, seconds(found.simulation),
                  seconds(relaxed.simulation)));
}

TEST(FiniteStatics, HexahedraFollowTheElasticaToSixtyDegrees) { expect_sixty_degrees(of_hexahedra); }
TEST(FiniteStatics, RowFollowsTheElasticaToSixtyDegrees) { expect_sixty_degrees(row); }
TEST(FiniteStatics, CoupledBeamFollowsTheElasticaToSixtyDegrees) { expect_sixty_degrees(coupled); }

/// Two by two rows have an EI of their own, which their small deflections tell.
TEST(FiniteStatics, FourRowsFollowTheElasticaToSixtyDegrees) {
  const double tiny = 1e-4;
  const Case input = four_rows.under({0, 0, tiny}, statics, {"analysis.kinematics=small"});
  Built built = build(input);
  ASSERT_EQ(run_to_end(input, built).status, Status::completed);
  const double deflection = tiny * four_rows.length / (3 * four_rows.unit_load());
  expect_sixty_degrees(four_rows, deflection / tip_of(built.simulation).z);
}

/// What small displacements leave out is of second order.
TEST(FiniteStatics, SmallLoadsAreThoseOfSmallDisplacements) {
  for (const Beam& beam : {of_hexahedra, four_rows, coupled}) {
    double apart[2];
    for (int i = 0; i < 2; ++i) {
      const Vec3 load{0, 0, (i + 1) * 0.01 * beam.unit_load()};
      const Case one = beam.under(load, statics),
                 other = beam.under(load, statics, {"analysis.kinematics=small"});
      Built finite = build(one), small = build(other);
      ASSERT_EQ(run_to_end(one, finite).status, Status::completed);
      ASSERT_EQ(run_to_end(other, small).status, Status::completed);
      apart[i] = norm(tip_of(finite.simulation) - tip_of(small.simulation));
    }
    EXPECT_LT(apart[0], 1e-5 * beam.length);
    EXPECT_NEAR(apart[1] / apart[0], 4, 0.05);
  }
}

/// Simpson's rule over 16 equilibria: the loads' work is what is stored.
TEST(FiniteStatics, WorkAlongThePathIsWhatIsStored) {
  constexpr int n = 16;
  const double full = 3 * coupled.unit_load();
  double along = 0, stored = 0;  // ∫ P dz = P z − ∫ z dP
  for (int i = 1; i <= n; ++i) {
    const double load = full * i / n;
    const Case input = coupled.under({0, 0, load}, statics);
    Built built = build(input);
    const Outcome outcome = run_to_end(input, built);
    ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
    double z = 0;
    for (const NodeForce& p : built.simulation.loads[0].nodes)
      z += dot(p.force, built.simulation.model.mesh.u.vector(p.node)) / load;
    along -= full / n / 3 * z * (i == n ? 1 : i % 2 ? 4 : 2);
    if (i == n) along += full * z, stored = outcome.last.ledger.internal();
  }
  EXPECT_NEAR(along / stored, 1, 1e-4);
  RecordProperty("relative difference", fmt::format("{:.1e}", along / stored - 1));
}

TEST(FiniteStatics, NeedsEveryBodyHeld) {
  const Case input = of_hexahedra.under({0, 0, 1}, statics, {"supports=[{where={x=0},fix=[\"x\",\"z\"]}]"});
  Built built = build(input);
  const Outcome outcome = run_to_end(input, built);
  EXPECT_EQ(outcome.status, Status::failed);
  EXPECT_NE(outcome.message.find("region 'beam' is free to move"), std::string::npos) << outcome.message;
}

/// Euler's load of a cantilever is π² EI / 4 L². Below it a straight column is stable, above it is not.
TEST(FiniteStatics, SaysThatAColumnBuckles) {
  const double euler = M_PI * M_PI / 4;
  for (const double factor : {0.98, 1.02, 2.0}) {
    const Case input = of_hexahedra.under({-factor * euler * of_hexahedra.unit_load(), 0, 0}, statics);
    Built built = build(input);
    const Outcome outcome = run_to_end(input, built);
    EXPECT_EQ(outcome.status, factor < 1 ? Status::completed : Status::not_converged) << factor;
    if (factor > 1) {
      EXPECT_NE(outcome.message.find("is not stable: the body buckles"), std::string::npos)
          << outcome.message;
    }
  }
}

TEST(FiniteStatics, SaysHowFarTheLoadGot) {
  const Case input = of_hexahedra.with(
      "[[supports]]\nwhere = { x = 2 }\nfix = [\"y\", \"z\"]\ndisplacement = { x = -3 }\ncurve = "
      "\"c\"\n[curves.c]\npoints = [[0, 0], [1, 1]]\n",
      statics);
  Built built = build(input);
  const Outcome outcome = run_to_end(input, built);
  EXPECT_EQ(outcome.status, Status::not_converged);
  EXPECT_NE(outcome.message.find("no equilibrium beyond 0.66"), std::string::npos) << outcome.message;
}

/// The far end of a row is turned, and every particle by its share.
TEST(FiniteStatics, TurnsByAPrescribedRotation) {
  const std::string far = "[[supports]]\nwhere = { x = 41 }\n";
  const Case input = row.with(far +
                                  "fix = [\"x\", \"y\", \"z\"]\ndisplacement = { rx = 2.5, ry = 0, rz = 0 "
                                  "}\ncurve = \"c\"\n[curves.c]\npoints = [[0, 0], [1, 1]]\n",
                              statics);
  Built built = build(input);
  const Outcome outcome = run_to_end(input, built);
  ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
  const Lattice& lattice = built.simulation.model.lattices[0];
  for (int i = 0; i <= 40; ++i)
    EXPECT_NEAR(norm(de::rotation_vector(lattice, lattice.grid.index(i, 0, 0)) - Vec3{2.5 * i / 40, 0, 0}), 0,
                i == 40 ? 1e-13 : 1e-6);
}

TEST(FiniteStatics, RefusesOneComponentOfARotation) {
  const Case input = row.with(
      "[[supports]]\nwhere = { x = 41 }\ndisplacement = { rx = 2.5 }\ncurve = \"c\"\n[curves.c]\npoints = "
      "[[0, 0], [1, 1]]\n",
      statics);
  Built built = build(input);
  const Outcome outcome = run_to_end(input, built);
  EXPECT_EQ(outcome.status, Status::failed);
  EXPECT_NE(outcome.message.find("finite rotations are prescribed with all of rx, ry and rz"),
            std::string::npos)
      << outcome.message;
}

/// A motion from equilibrium keeps it, with ghosts of either kind.
TEST(FiniteStatics, AMotionStartsAtRest) {
  for (const char* rotation : {"continuum", "one-step-back"}) {
    const Case input = coupled.under({0, 0, 3 * coupled.unit_load()},
                                     "type = \"dynamic\"\nstart = \"static\"\nduration = 0.5\n",
                                     {fmt::format("coupling.rotation={}", rotation)});
    Built built = build(input);
    const Outcome outcome = run_to_end(input, built);
    ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
    EXPECT_GT(built.simulation.model.step, 100);
    EXPECT_LT(outcome.last.ledger.kinetic(), 1e-14 * outcome.last.ledger.internal());
    EXPECT_GT(tip_of(built.simulation).z, 0.6 * coupled.length);
  }
}

TEST(FiniteStatics, GivesTheSameBitsOnAnyNumberOfThreads) {
  std::string hash;
  for (int threads = 1; threads <= 4; ++threads) {
    const Case input = coupled.under({0, 0, 3 * coupled.unit_load()}, statics);
    Built built = build(input);
    set_threads(threads);
    ASSERT_EQ(run(built.simulation, plan_of(input), {}).status, Status::completed);
    if (threads == 1) hash = state_hash(built.simulation.model);
    EXPECT_EQ(state_hash(built.simulation.model), hash) << threads;
  }
}

}  // namespace
}  // namespace geist::verification
