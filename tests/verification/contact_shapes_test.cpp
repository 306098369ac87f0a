// A particle is led over facets, edges and corners of a held block, and over facets that are not flat; a body
// touches itself.
//
// On the way the force is known: the particle is kept at a distance from the block, so its overlap δ, and
// hence k δ, is the same over facets (its radius is more than the length of an element, so it reaches many at
// once), around an edge, and around a corner. Where the block is not flat, the force still is that of a
// potential ½ k |d|², d moving no faster than the particle does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include "verification/contact_support.hpp"

namespace geist::verification {
namespace {

constexpr double radius = 0.6, depth = 0.06, clearance = radius - depth;
constexpr double layer = 1000 * 0.8 / (1.2 * 0.6), stiffness = 2 * radius * layer;

using Way = std::function<Vec3(double)>;  ///< position of the particle's centre; from 0 to 1

const std::string head = R"(units = { length = "mm", mass = "g", time = "ms" }
[materials.m]
density = 0.001
young = 1000
poisson = 0.2
[coupling]
type = "none"
[[contact]]
between = ["block", "ball"]
[[supports]]
where = { region = "block" }
fix = ["x", "y", "z"]
[probes.x]
where = { region = "ball" }
quantity = "contact-force"
component = "x"
[probes.y]
where = { region = "ball" }
quantity = "contact-force"
component = "y"
[probes.z]
where = { region = "ball" }
quantity = "contact-force"
component = "z"
[probes.ux]
where = { region = "ball" }
quantity = "displacement"
component = "x"
[probes.uy]
where = { region = "ball" }
quantity = "displacement"
component = "y"
[probes.uz]
where = { region = "ball" }
quantity = "displacement"
component = "z"
)";

constexpr int points = 1000;
constexpr double time_step = 1e-4;  // in a way of duration 1

/// Lead the particle. It begins where nothing touches it, and may be far from there at time 0 only by a
/// curve.
Recording lead(const std::string& block, const Way& way) {
  const Vec3 start = way(0);
  std::string text =
      head + block + fmt::format("[analysis]\ntype = \"dynamic\"\nduration = 1\ntime_step = {}\n", time_step);
  text += fmt::format(
      "[regions.ball]\ntype = \"lattice\"\nmaterial = \"m\"\nbox = [[{}, {}, {}], [{}, {}, {}]]\nradius = "
      "{}\n",
      start.x - radius, start.y - radius, start.z - radius, start.x + radius, start.y + radius,
      start.z + radius, radius);
  for (int c = 0; c < 3; ++c) {
    const char name = "xyz"[c];
    text += fmt::format("[curves.{}]\npoints = [", name);
    for (int i = 0; i <= points; ++i)
      text += fmt::format("[{}, {}], ", double(i) / points, way(double(i) / points)[c] - start[c]);
    text += fmt::format(
        "]\n[[supports]]\nwhere = {{ region = \"ball\" }}\ndisplacement = {{ {0} = 1 }}\ncurve = \"{0}\"\n",
        name);
  }
  return run_text(text, time_step);
}

Vec3 vector(const Recording& r, std::size_t first, std::size_t row) {
  return {r.probe[first][row], r.probe[first + 1][row], r.probe[first + 2][row]};
}
Vec3 force(const Recording& r, std::size_t row) { return vector(r, 0, row); }

/// Between rows, the force changes by no more than k times the way; `steepest`: |∂d/∂x|.
void expect_no_jumps(const Recording& r, double steepest) {
  double worst = 0;
  for (std::size_t i = 1; i < r.time.size(); ++i) {
    const double moved = norm(vector(r, 3, i) - vector(r, 3, i - 1));
    if (moved > 1e-8) worst = std::max(worst, norm(force(r, i) - force(r, i - 1)) / (stiffness * moved));
  }
  EXPECT_LT(worst, steepest);
  ::testing::Test::RecordProperty("steepest", fmt::format("{:.4f}", worst));
}

/// The support's work is what the spring holds, to the square of a step's share of the way.
void expect_work_stored(const Recording& r) {
  double worst = 0, most = 0;
  for (const Ledger& l : r.ledger)
    worst = std::max(worst, std::abs(l.balance())), most = std::max(most, l.contact);
  EXPECT_LT(worst, 1e-4 * most);
  ::testing::Test::RecordProperty("balance", fmt::format("{:.2g}", worst / most));
}

const std::string cube = R"([regions.block]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [4, 4, 4]]
divisions = [8, 8, 8]
)";

/// A way of pieces of the same duration, each begun and ended at rest: a support that changes its velocity at
/// once would do work that no trapezoidal rule sees.
Way pieces(std::vector<Way> list) {
  return [list](double t) {
    const double n = static_cast<double>(list.size());
    const auto i = std::min(list.size() - 1, static_cast<std::size_t>(t * n));
    const double s = t * n - static_cast<double>(i);
    return list[i](s * s * (3 - 2 * s));
  };
}
Way straight(Vec3 from, Vec3 to) {
  return [=](double t) { return from + t * (to - from); };
}
/// A quarter of a circle around `centre`, from direction a to direction b.
Way around(Vec3 centre, Vec3 a, Vec3 b) {
  return [=](double t) {
    const double angle = t * std::numbers::pi / 2;
    return centre + clearance * (std::cos(angle) * a + std::sin(angle) * b);
  };
}

/// From above down, over the facets, and on: everywhere the force is k δ. The curve's chords are nearer by a
/// part (π/2/250)²/8 of the radius of the turn, which changes δ by 5e-5 of itself.
void expect_one_force(const Recording& r, double from, double to) {
  for (std::size_t i = 0; i < r.time.size(); ++i)
    if (r.time[i] > from && r.time[i] < to) {
      ASSERT_NEAR(norm(force(r, i)) / (stiffness * depth), 1, 2e-4) << r.time[i];
    }
}

constexpr double top = 4 + clearance;

TEST(ParticleOnBlock, OverFacetsAndAnEdge) {
  const Way way = pieces({straight({1.1, 1.9, 4 + radius + 0.01}, {1.1, 1.9, top}),
                          straight({1.1, 1.9, top}, {4, 2.3, top}), around({4, 2.3, 4}, {0, 0, 1}, {1, 0, 0}),
                          straight({4 + clearance, 2.3, 4}, {4 + clearance, 1.2, 1.7})});
  const Recording r = lead(cube, way);
  expect_one_force(r, 0.2501, 1);
  expect_no_jumps(r, 1.01);  // around the edge it turns, by δ/(r − δ) = 0.11 of the way only
  expect_work_stored(r);
}

TEST(ParticleOnBlock, OverACorner) {
  const Vec3 out = (1 / std::sqrt(2)) * Vec3{1, 1, 0};
  const Way way = pieces({straight({2.9, 2.9, 4 + radius + 0.01}, {2.9, 2.9, top}),
                          straight({2.9, 2.9, top}, {4, 4, top}), around({4, 4, 4}, {0, 0, 1}, out),
                          straight(Vec3{4, 4, 4} + clearance * out, Vec3{4, 4, 1} + clearance * out)});
  const Recording r = lead(cube, way);
  expect_one_force(r, 0.2501, 1);
  expect_no_jumps(r, 1.01);
  expect_work_stored(r);
}

/// The block's upper face is a saddle, 0.8 mm from its highest to its lowest corner, in 6 × 6 facets that are
/// not flat either: ridges and grooves of a few degrees. In a groove both flanks push, and d moves at most
/// 1/sin of half of the angle between them times as fast as the particle, hardly more than 1.
TEST(ParticleOnBlock, OverFacetsThatAreNotFlat) {
  const std::string saddle = R"([regions.block]
type = "hexahedra"
material = "m"
corners = [[0, 0, 0], [3, 0, 0], [3, 3, 0], [0, 3, 0], [0, 0, 3.4], [3, 0, 2.6], [3, 3, 3.4], [0, 3, 2.6]]
divisions = [6, 6, 3]
)";
  const double z = 3 + radius - 0.12;
  const Way way =
      pieces({straight({1.6, 1.4, z + 0.3}, {1.6, 1.4, z}), straight({1.6, 1.4, z}, {2.4, 1.1, z}),
              straight({2.4, 1.1, z}, {1.1, 2.4, z}), straight({1.1, 2.4, z}, {-0.5, 1.3, z})});
  const Recording r = lead(saddle, way);
  double most = 0;
  for (std::size_t i = 0; i < r.time.size(); ++i) most = std::max(most, norm(force(r, i)));
  EXPECT_GT(most, stiffness * 0.1);
  expect_no_jumps(r, 1.1);
  expect_work_stored(r);
}

// --- A body that touches itself ---

/// A C, 8 × 1.6 × 4.2 mm, with a slit of 0.2 mm from x = 1.6 to its free end at x = 8. It is held at x = 0,
/// and pressed together from above and below until its lips meet.
const std::string slit = R"(units = { length = "mm", mass = "g", time = "ms" }
[materials.m]
density = 0.001
young = 1000
poisson = 0.2
[regions.c]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [8, 1.6, 4.2]]
divisions = [20, 4, 21]
minus = [{ box = [[1.6, 0, 2], [8, 1.6, 2.2]] }]
formulation = "one-point"
[[contact]]
between = ["c", "c"]
[[supports]]
where = { x = 0 }
fix = ["x", "y", "z"]
[curves.grow]
points = [[0, 0], [0.4, 1]]
[[loads]]
where = { z = 4.2 }
traction = [0, 0, -4]
curve = "grow"
[[loads]]
where = { z = 0 }
traction = [0, 0, 4]
curve = "grow"
[analysis]
type = "dynamic"
duration = 0.4
damping = 20
[probes.upper]
where = { z = [2.2, 4.2], x = [1.6, 8] }
quantity = "contact-force"
component = "z"
[probes.lower]
where = { z = [0, 2], x = [1.6, 8] }
quantity = "contact-force"
component = "z"
[probes.all]
where = { region = "c" }
quantity = "contact-force"
component = "magnitude"
)";

/// The narrowest place of the slit: pairs of nodes above each other. They slide along x by less than an
/// element's hundredth.
double narrowest(const Simulation& sim) {
  const Mesh& mesh = sim.model.mesh;
  double least = 1;
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    for (std::size_t j = 0; j < mesh.nodes() && std::abs(mesh.points[i].z - 2) < 1e-9; ++j) {
      const Vec3 apart = mesh.points[j] - mesh.points[i];
      if (mesh.points[i].x > 1.7 && norm(apart - Vec3{0, 0, 0.2}) < 1e-9)
        least = std::min(least, 0.2 + mesh.u.vector(j).z - mesh.u.vector(i).z);
    }
  return least;
}

TEST(SelfContact, LipsOfASlitMeet) {
  const Recording r = run_text(slit, 0, narrowest);
  const std::vector<double>&upper = r.of("upper"), &lower = r.of("lower"), &all = r.of("all");
  double first = 1, deepest = 0;
  for (std::size_t i = 0; i < r.time.size(); ++i) {
    // The lips are not level when they meet: their nodes touch when a facet is met, 1 % of the slit early or
    // late.
    if (r.watched[i] > 0.002) {
      ASSERT_EQ(upper[i], 0) << r.time[i];
    }
    if (r.watched[i] < -0.002) {
      ASSERT_GT(upper[i], 0) << r.time[i];
    }
    if (upper[i] > 0) first = std::min(first, r.time[i]);
    deepest = std::max(deepest, -r.watched[i]);
    ASSERT_NEAR(upper[i], -lower[i], 1e-12 * (1 + peak(upper)));
    ASSERT_LT(all[i], 1e-12 * (1 + peak(upper)));
  }
  EXPECT_GT(first, 0.02);
  EXPECT_LT(first, 0.35);
  EXPECT_GT(peak(upper), 1);
  EXPECT_LT(deepest, 0.01);  // of elements of 0.2 mm: the springs are as stiff as half of one
  EXPECT_TRUE(r.warnings.empty());
  EXPECT_LT(r.worst_balance(), 1e-3);
  RecordProperty("first",
                 fmt::format("{:.4f} ms, force {:.4g} N, overlap {:.3g} mm", first, peak(upper), deepest));
  RecordProperty("balance", fmt::format("{:.2g}", r.worst_balance()));
}

}  // namespace
}  // namespace geist::verification
