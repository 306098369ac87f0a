// Patch tests of the coupled method: a body whose border is moved as a homogeneous strain would move it must
// be strained so everywhere, hexahedra, interface and lattice alike. docs/theory.md, "Every point counted
// once".
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/parallel.hpp"
#include "geometry/hex8.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

constexpr const char* head = R"(
units = { length = "mm", mass = "g", time = "ms" }
[materials.polymer]
density = 0.001
young = 1000
poisson = 0.2
[analysis]
type = "static"
tolerance = 1e-12
[[loads]]
gravity = [0, 0, 0]
)";

std::string block(const std::string& name, Vec3 low, Vec3 high, std::array<int, 3> n,
                  const std::string& formulation) {
  return fmt::format(
      "[regions.{}]\ntype = \"hexahedra\"\nmaterial = \"polymer\"\nformulation = \"{}\"\n"
      "box = [[{}, {}, {}], [{}, {}, {}]]\ndivisions = [{}, {}, {}]\n",
      name, formulation, low.x, low.y, low.z, high.x, high.y, high.z, n[0], n[1], n[2]);
}

std::string lattice(Vec3 low, Vec3 high, double radius) {
  return fmt::format(
      "[regions.particles]\ntype = \"lattice\"\nmaterial = \"polymer\"\n"
      "box = [[{}, {}, {}], [{}, {}, {}]]\nradius = {}\n",
      low.x, low.y, low.z, high.x, high.y, high.z, radius);
}

std::string hold(char axis, double at) {
  return fmt::format("[[supports]]\nwhere = {{ {} = {} }}\nfix = [\"x\", \"y\", \"z\"]\n", axis, at);
}

/// Everything that is held moves by G X.
void move_border(Simulation& sim, const Mat3& G) {
  for (HeldComponent& h : sim.supports.held) {
    const Vec3 X =
        h.lattice < 0 ? sim.model.mesh.points[h.place] : sim.model.lattices[h.lattice].grid.centre(h.place);
    const Vec3 u = G * X;
    h.motion = static_cast<std::int32_t>(sim.supports.motions.size());
    sim.supports.motions.push_back(
        {Motion::Kind::displacement, u[static_cast<std::size_t>(h.component)], {}});
  }
}

double size(const Mat3& G) { return std::sqrt(dot(G[0], G[0]) + dot(G[1], G[1]) + dot(G[2], G[2])); }

/// The largest |∂u/∂x − G|/|G| over all edges of elements, and over all pairs of neighbouring particles or of
/// a particle and a ghost.
struct Worst {
  double hexahedra = 0, lattice = 0;
};

Worst worst_strain(const Model& model, const Mat3& G) {
  Worst worst;
  const auto error = [&](Vec3 a, Vec3 b, Vec3 u_a, Vec3 u_b) {
    return norm((u_b - u_a) - G * (b - a)) / (norm(b - a) * size(G));
  };
  const Mesh& mesh = model.mesh;
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    const auto& e = mesh.elements[k];
    const HexCut* const cut = cut_of(mesh, k);
    if (cut && cut->volume < 1e-5 * hex8::volume(hex8::corners(mesh, k))) continue;
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < a; ++b)
        worst.hexahedra = std::max(worst.hexahedra, error(mesh.points[e[a]], mesh.points[e[b]],
                                                          mesh.u.vector(e[a]), mesh.u.vector(e[b])));
  }
  for (const Lattice& l : model.lattices)
    for (std::size_t s = 0; s < l.grid.size(); ++s)
      for (int d = 9; d < 18; ++d)
        if (l.word[s] >> d & 1) {
          const std::size_t t = s + l.grid.offset(d);
          worst.lattice = std::max(worst.lattice, error(l.grid.centre(s), l.grid.centre(t),
                                                        l.motion.vector(s), l.motion.vector(t)));
        }
  return worst;
}

Worst patch(const std::string& text, const Mat3& G, const std::string& method = "consistent") {
  const Case input = read_case_text(text, "patch.toml", {"method=" + method});
  Built built = build(input);
  move_border(built.simulation, G);
  set_threads(2);
  const Outcome outcome = run(built.simulation, plan_of(input), {});
  EXPECT_EQ(outcome.status, Status::completed) << outcome.message;
  return worst_strain(built.simulation.model, G);
}

const Mat3 pull_x{{Vec3{1e-3, 0, 0}, Vec3{0, -2e-4, 0}, Vec3{0, 0, -2e-4}}};
const Mat3 pull_y{{Vec3{-2e-4, 0, 0}, Vec3{0, 1e-3, 0}, Vec3{0, 0, -2e-4}}};
const Mat3 pull_z{{Vec3{-2e-4, 0, 0}, Vec3{0, -2e-4, 0}, Vec3{0, 0, 1e-3}}};
const Mat3 shear_xy{{Vec3{0, 1e-3, 0}, Vec3{1e-3, 0, 0}, Vec3{0, 0, 0}}};
const Mat3 any{{Vec3{1e-3, 3e-4, -5e-4}, Vec3{3e-4, -7e-4, 2e-4}, Vec3{-5e-4, 2e-4, 4e-4}}};

/// A lattice wholly inside hexahedra: three by three by three blocks without the middle one.
std::string embedded(double r, std::array<int, 3> n, const std::string& formulation) {
  std::string text = head;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        if (i != 1 || j != 1 || k != 1)
          text += block(fmt::format("b{}{}{}", i, j, k), {1.0 * i, 1.0 * j, 1.0 * k},
                        {i + 1.0, j + 1.0, k + 1.0}, n, formulation);
  text += lattice({1, 1, 1}, {2, 2, 2}, r);
  for (const char axis : {'x', 'y', 'z'}) text += hold(axis, 0) + hold(axis, 3);
  return text;
}

TEST(Probe, Embedded) {
  for (const char* f : {"full", "one-point", "assumed-strain"})
    for (const auto& [r, n] : std::vector<std::pair<double, int>>{
             {0.25, 2}, {0.125, 2}, {0.1, 2}, {0.25, 4}, {0.125, 1}, {0.05, 2}, {0.1, 3}}) {
      const Worst w = patch(embedded(r, {n, n, n}, f), any),
                  p = patch(embedded(r, {n, n, n}, f), any, "published");
      fmt::print("{} r {} h/r {:.3g}: hexahedra {:.2g} lattice {:.2g}   published {:.2g} {:.2g}\n", f, r,
                 1.0 / n / r, w.hexahedra, w.lattice, p.hexahedra, p.lattice);
    }
}

}  // namespace
}  // namespace geist::verification
