// From a case to a simulation: regions, masses, coupling, time step, and what only the geometry shows.
#include "case/build.hpp"

#include <cmath>

#include "small_case.hpp"

namespace geist {
namespace {

using namespace testing;

TEST(Build, MakesTheRegions) {
  const Built built = build(small_case());
  const Model& model = built.simulation.model;
  ASSERT_EQ(model.mesh.regions.size(), 1u);
  EXPECT_EQ(model.mesh.regions[0].name, "left");
  EXPECT_EQ(model.mesh.elements.size(), 8u);
  ASSERT_EQ(model.lattices.size(), 1u);
  const Lattice& lattice = model.lattices[0];
  EXPECT_EQ(lattice.name, "right");
  EXPECT_EQ(lattice.material.young, 1000);
  EXPECT_EQ(lattice.count(site::particle), 64u);
  EXPECT_EQ(lattice.count(site::ghost), 16u);
  EXPECT_EQ(lattice.grid.nx * lattice.grid.ny * lattice.grid.nz, 80);
}

TEST(Build, GivesEveryRegionTheMassOfItsVolume) {
  const Model model = build(small_case()).simulation.model;
  double nodes = 0;
  for (const double m : model.mesh.mass) nodes += m;
  EXPECT_NEAR(nodes, 0.001, 1e-17);
  EXPECT_NEAR(64 * model.lattices[0].mass, 0.001, 1e-17);  // of cells, not of spheres
}

TEST(Build, GivesParticlesTheRotaryInertiaAskedFor) {
  const double m = 0.001 / 64, r = 0.125;
  const Built sphere = build(small_case("", {"regions.right.rotary_inertia=sphere"}));
  EXPECT_NEAR(sphere.simulation.model.lattices[0].inertia, 0.4 * m * r * r, 1e-20);
  const Built cube = build(small_case());
  EXPECT_NEAR(cube.simulation.model.lattices[0].inertia, m * 4 * r * r / 6, 1e-20);
  EXPECT_GE(cube.simulation.dt, sphere.simulation.dt);
}

TEST(Build, LetsGhostsSpinOrNot) {
  const Built spinning = build(small_case("", {"coupling.rotation=one-step-back"}));
  for (const std::int32_t slot : spinning.simulation.model.lattices[0].ghost_slot)
    EXPECT_EQ(spinning.simulation.model.lattices[0].listed_held[slot], 0b000111);
  const Built still = build(small_case("", {"coupling.rotation=none", "analysis.kinematics=small"}));
  for (const std::int32_t slot : still.simulation.model.lattices[0].ghost_slot)
    EXPECT_EQ(still.simulation.model.lattices[0].listed_held[slot], 0b111111);
}

TEST(Build, UncoupledRegionsHaveNoGhosts) {
  const Built built = build(small_case("", {"coupling.type=none"}));
  EXPECT_TRUE(built.simulation.model.lattices[0].ghosts.empty());
  EXPECT_EQ(built.simulation.model.lattices[0].count(site::ghost), 0u);
}

TEST(Build, ChoosesATimeStepBelowTheBound) {
  const Built built = build(small_case());
  ASSERT_FALSE(built.bounds.empty());
  const double bound = critical(built.bounds).bound;
  for (const TimeStepBound& b : built.bounds) EXPECT_GE(b.bound, bound);
  EXPECT_LE(built.simulation.dt, 0.9 * bound);
  EXPECT_GE(built.simulation.dt, 0.85 * bound);
  EXPECT_LE(build(small_case("", {"analysis.safety=0.5"})).simulation.dt, 0.5 * bound);
  // A wave crosses a particle in 2 r/c = 2.5e-4 ms: the step must be of that order.
  EXPECT_GT(bound, 2e-5);
  EXPECT_LT(bound, 5e-4);
}

TEST(Build, TakesTheTimeStepGivenUnlessItIsTooLong) {
  EXPECT_EQ(build(small_case("", {"analysis.time_step=1e-5"})).simulation.dt, 1e-5);
  const std::string text = materials + two_regions + dynamic + "time_step = 0.01\n";
  expect_build_error(text, "[analysis]", {"time_step = 0.01", "safe bound", "region '"});
}

TEST(Build, MakesConsistentLattices) {
  EXPECT_FALSE(build(small_case("", {"method=published"})).simulation.model.lattices[0].consistent());
  EXPECT_TRUE(build(small_case()).simulation.model.lattices[0].consistent());
  std::string text = materials + two_regions + dynamic;
  const std::string poisson = "poisson = 0.2";
  text.replace(text.find(poisson), poisson.size(), "poisson = 0.3");
  const Case small = read_case_text(text, "small.toml", {"analysis.kinematics=small"});
  EXPECT_TRUE(build(small).simulation.model.lattices[0].dilates());
  expect_build_error(text, "[regions.right]",
                     {"'right'", "poisson = 0.3", "dilatation", "kinematics = \"small\"", "0.25"});
  text.replace(text.find("poisson = 0.3"), poisson.size(), "poisson = -0.2");
  expect_build_error(text, "[regions.right]",
                     {"'right'", "poisson = -0.2", "negative stiffness", "to 0.5000"});
}

/// Particles that fill a cavity have whole cells around them, corners and all.
TEST(Build, ConsistentLatticesEndWhereTheMaterialDoes) {
  const std::string cavity =
      "[regions.shell]\ntype = \"hexahedra\"\nmaterial = \"m\"\nbox = [[0, 0, 0], [3, 3, 3]]\n"
      "divisions = [3, 3, 3]\nminus = [{ box = [[1, 1, 1], [2, 2, 2]] }]\n"
      "[regions.core]\ntype = \"lattice\"\nmaterial = \"m\"\nbox = [[1, 1, 1], [2, 2, 2]]\nradius = 0.125\n";
  const auto ghosts_with = [&](const std::string& method) {
    const Case input = read_case_text(materials + cavity + dynamic, "cavity.toml", {"method=" + method});
    const Model model = build(input).simulation.model;
    const Lattice& lattice = model.lattices[0];
    for (std::size_t s = 0; s < lattice.word.size(); ++s) {
      EXPECT_FALSE(lattice.is(s, site::particle) && lattice.is(s, site::surface));
    }
    return lattice.ghosts.size();
  };
  EXPECT_EQ(ghosts_with("consistent"), 6u * 6 * 6 - 64);
  EXPECT_EQ(ghosts_with("published"), 6u * 6 * 6 - 64 - 8);
}

TEST(Build, TakesDamping) {
  EXPECT_EQ(build(small_case("", {"analysis.damping=2.5"})).simulation.alpha, 2.5);
}

TEST(Build, PointsAtTheRegionWhoseGeometryCannotBe) {
  const auto with = [](const std::string& line, const std::string& instead) {
    std::string text = materials + two_regions + dynamic;
    return text.replace(text.find(line), line.size(), instead);
  };
  const std::string radius = "radius = 0.125\n", divisions = "divisions = [2, 2, 2]\n";
  expect_build_error(with(radius, radius + "minus = [{ ball = { centre = [1.5, 0.5, 0.5], radius = 3 } }]\n"),
                     "[regions.right]", {"'right'", "no particle is left"});
  expect_build_error(with(divisions, divisions + "minus = [{ box = [[0, 0, 0], [1, 1, 1]] }]\n"),
                     "[regions.left]", {"'left'", "no element is left"});
  expect_build_error(with(divisions, divisions + "minus = [{ box = [[0, 0, 0], [0.6, 0.5, 0.5]] }]\n"),
                     "[regions.left]", {"'left'", "cuts through", "(0.75, 0.25, 0.25)"});
}

TEST(Build, SharesNodesOfRegionsThatTouch) {
  const Case input = small_case(
      "[regions.far]\ntype = \"hexahedra\"\nmaterial = \"m\"\nbox = [[-1, 0, 0], [0, 1, 1]]\n"
      "divisions = [1, 2, 2]\n");
  EXPECT_EQ(build(input).simulation.model.mesh.nodes(), 27u + 9);
}

/// The message about a radius that does not fit suggests these, rounded; they must be as good as it says.
TEST(Build, AcceptsTheRadiiThatMessagesSuggest) {
  for (const auto& [radius, particles] :
       {std::pair{"0.142857", 21u * 7 * 7}, std::pair{"0.1666667", 18u * 6 * 6}}) {
    const Case input = read_case(GEIST_SOURCE_DIR "/examples/beam/case.toml",
                                 {std::string("regions.middle.radius=") + radius});
    EXPECT_EQ(build(input).simulation.model.lattices[0].count(site::particle), particles) << radius;
  }
}

TEST(Build, RefusesWhatDoesNotFitIntoMemory) {
  const std::string huge =
      "[regions.a]\ntype = \"hexahedra\"\nmaterial = \"m\"\nbox = [[0, 0, 0], [1, 1, 1]]\n"
      "divisions = [1000, 1000, 1900]\n";
  expect_build_error(materials + huge + dynamic, "[regions.a]",
                     {"'a'", "1.9e+09 hexahedra", "GiB of memory"});
}

const std::string quarter_ball =
    "[regions.ball]\ntype = \"hexahedra\"\nmaterial = \"m\"\nball = { centre = [0, 0, 10], radius = 10 }\n"
    "divisions = [8, 4]\n"
    "minus = [{ box = [[-10, -10, 0], [0, 10, 20]] }, { box = [[0, -10, 0], [10, 0, 20]] }]\n"
    "[regions.ball.grading]\nx = { towards = \"middle\", ratio = 8 }\ny = { towards = \"middle\", ratio = 8 "
    "}\n"
    "radius = { towards = \"high\", ratio = 8 }\n";
const std::string pin =
    "[regions.pin]\ntype = \"hexahedra\"\nmaterial = \"m\"\n"
    "cylinder = { from = [30, 0, 0], to = [30, 0, 20], radius = 4 }\ndivisions = [6, 3, 15]\n";

TEST(Build, MakesBallsAndCylindersOfHexahedra) {
  const Case input = read_case_text(materials + quarter_ball + pin + dynamic, "round.toml");
  const Built built = build(input);
  const Mesh& mesh = built.simulation.model.mesh;
  EXPECT_EQ(mesh.regions[0].count, (512u + 6 * 64 * 4) / 4);
  EXPECT_EQ(mesh.regions[1].count, (36u + 4 * 6 * 3) * 15);
  double mass = 0;
  for (const double m : mesh.mass) mass += m;
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(mass / (0.001 * (pi / 3 * 1000 + pi * 16 * 20)), 1, 0.05);
  EXPECT_GT(built.simulation.dt, 0);
}

TEST(Build, CutsABallAlongFacesOnly) {
  std::string text = materials + quarter_ball + dynamic;
  const std::size_t at = text.find("\"middle\"");
  expect_build_error(text.replace(at, 8, "\"high\""), "[regions.ball]",
                     {"'ball'", "a box of 'minus' cuts through the element at"});
}

TEST(Build, RefusesABallThatDoesNotFitIntoMemory) {
  std::string text = materials + quarter_ball + dynamic;
  expect_build_error(text.replace(text.find("[8, 4]"), 6, "[700, 400]"), "[regions.ball]",
                     {"'ball'", "1.52e+09 hexahedra", "GiB of memory"});
}

TEST(Build, NeedsNoCoupling) {
  const Case hexahedra =
      read_case_text(materials +
                         "[regions.a]\ntype = \"hexahedra\"\nmaterial = \"m\"\nbox = [[0, 0, 0], [1, 1, 1]]\n"
                         "divisions = [1, 1, 1]\n" +
                         dynamic,
                     "a.toml");
  EXPECT_EQ(build(hexahedra).simulation.model.mesh.nodes(), 8u);
  const Case particles = read_case_text(
      materials +
          "[regions.a]\ntype = \"lattice\"\nmaterial = \"m\"\nbox = [[0, 0, 0], [1, 1, 1]]\nradius = 0.5\n" +
          dynamic,
      "b.toml");
  EXPECT_EQ(build(particles).simulation.model.lattices[0].count(site::particle), 1u);
}

}  // namespace
}  // namespace geist
