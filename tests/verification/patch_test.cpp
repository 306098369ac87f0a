// Patch tests of the coupled method: a body whose border is moved as a homogeneous strain would move it must
// be strained so everywhere, hexahedra, interface and lattice alike. docs/theory.md, "Every point counted
// once".
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

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

/// A displacement field and the size of its strains.
struct FieldOf {
  std::function<Vec3(Vec3)> u;
  double strain;
};

FieldOf homogeneous(const Mat3& G) {
  return {[G](Vec3 X) { return G * X; }, std::sqrt(dot(G[0], G[0]) + dot(G[1], G[1]) + dot(G[2], G[2]))};
}

/// Pure bending about y of a body in 0 ≤ z ≤ height (Saint-Venant): ε_xx = κ z', ε_yy = ε_zz = −ν κ z'.
FieldOf bending(double height) {
  constexpr double kappa = 1e-3, nu = 0.2;
  return {
      [=](Vec3 X) {
        const double z = X.z - height / 2, y = X.y - height / 2;
        return Vec3{kappa * X.x * z, -nu * kappa * y * z, -kappa / 2 * (X.x * X.x + nu * (z * z - y * y))};
      },
      kappa * height / 2};
}

/// Everything that is held moves as the field says.
void move_border(Simulation& sim, const FieldOf& field) {
  for (HeldComponent& h : sim.supports.held) {
    const Vec3 u = field.u(h.lattice < 0 ? sim.model.mesh.points[h.place]
                                         : sim.model.lattices[h.lattice].grid.centre(h.place));
    h.motion = static_cast<std::int32_t>(sim.supports.motions.size());
    sim.supports.motions.push_back(
        {Motion::Kind::displacement, u[static_cast<std::size_t>(h.component)], {}});
  }
}

/// The largest error of (u_b − u_a)/|X_b − X_a|, as a share of the strain: of corners of one element, and of
/// bonded sites. Elements of which the lattice has left nothing do not count.
struct Worst {
  double hexahedra = 0, lattice = 0;
};

Worst worst_strain(const Model& model, const FieldOf& field) {
  Worst worst;
  const auto error = [&](Vec3 a, Vec3 b, Vec3 u_a, Vec3 u_b) {
    return norm((u_b - u_a) - (field.u(b) - field.u(a))) / (norm(b - a) * field.strain);
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

Worst patch(const std::string& text, const FieldOf& field, const std::string& method = "consistent") {
  const Case input = read_case_text(text, "patch.toml", {"method=" + method});
  Built built = build(input);
  move_border(built.simulation, field);
  set_threads(2);
  const Outcome outcome = run(built.simulation, plan_of(input), {});
  EXPECT_EQ(outcome.status, Status::completed) << outcome.message;
  return worst_strain(built.simulation.model, field);
}

const Mat3 pull_x{{Vec3{1e-3, 0, 0}, Vec3{0, -2e-4, 0}, Vec3{0, 0, -2e-4}}};
const Mat3 pull_y{{Vec3{-2e-4, 0, 0}, Vec3{0, 1e-3, 0}, Vec3{0, 0, -2e-4}}};
const Mat3 pull_z{{Vec3{-2e-4, 0, 0}, Vec3{0, -2e-4, 0}, Vec3{0, 0, 1e-3}}};
const Mat3 shear_xy{{Vec3{0, 1e-3, 0}, Vec3{1e-3, 0, 0}, Vec3{0, 0, 0}}};
const Mat3 any{{Vec3{1e-3, 3e-4, -5e-4}, Vec3{-4e-4, -7e-4, 2e-4}, Vec3{8e-4, 2e-4, 4e-4}}};  // turns too

/// h/r = 1/(n r): meshes that end at the lattice's cells, and such that do not.
struct Fineness {
  double r;
  int n;  ///< elements along an edge of 1
};
constexpr Fineness usual[] = {{0.25, 2}, {0.125, 2}, {0.1, 2}, {0.125, 1}, {0.05, 2}, {0.1, 3}};

void expect_exact(const std::string& text, const FieldOf& field, const std::string& what) {
  const Worst worst = patch(text, field);
  EXPECT_LT(worst.hexahedra, 1e-9) << what;
  EXPECT_LT(worst.lattice, 1e-9) << what;
}

std::string say(const Fineness& f, const std::string& formulation) {
  return fmt::format("r {}, h/r {:.3g}, {}", f.r, 1 / (f.n * f.r), formulation);
}

/// A lattice wholly inside hexahedra: three by three by three blocks without the middle one. If `skewed`, by
/// so much, the corners of the outer blocks that are not the lattice's lie elsewhere.
std::string embedded(const Fineness& f, const std::string& formulation, double skewed = 0) {
  const auto corner = [&](int i, int j, int k) {
    const bool inner = (i == 1 || i == 2) && (j == 1 || j == 2) && (k == 1 || k == 2);
    const double s = inner ? 0 : skewed;
    return fmt::format("[{}, {}, {}]", i + s * std::sin(1.0 * i + 2 * j + 3 * k),
                       j + s * std::sin(2.0 * i + 5 * j + k), k + s * std::sin(4.0 * i + j + 2 * k));
  };
  std::string text = head;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        if (i != 1 || j != 1 || k != 1)
          text += fmt::format(
              "[regions.b{}{}{}]\ntype = \"hexahedra\"\nmaterial = \"polymer\"\nformulation = "
              "\"{}\"\ncorners = [{}, "
              "{}, {}, {}, {}, {}, {}, {}]\ndivisions = [{}, {}, {}]\n",
              i, j, k, formulation, corner(i, j, k), corner(i + 1, j, k), corner(i + 1, j + 1, k),
              corner(i, j + 1, k), corner(i, j, k + 1), corner(i + 1, j, k + 1), corner(i + 1, j + 1, k + 1),
              corner(i, j + 1, k + 1), f.n, f.n, f.n);
  return text + lattice({1, 1, 1}, {2, 2, 2}, f.r);
}

std::string embedded_and_held(const Fineness& f, const std::string& formulation) {
  std::string text = embedded(f, formulation);
  for (const char axis : {'x', 'y', 'z'}) text += hold(axis, 0) + hold(axis, 3);
  return text;
}

TEST(Patch, EmbeddedLatticeInAnyStrain) {
  for (const std::string formulation : {"full", "selective-reduced", "one-point", "assumed-strain"})
    for (const Fineness& f : usual)
      expect_exact(embedded_and_held(f, formulation), homogeneous(any), say(f, formulation));
}

std::string bar(const Fineness& f, const std::string& formulation) {
  return head + block("left", {0, 0, 0}, {2, 1, 1}, {2 * f.n, f.n, f.n}, formulation) +
         block("right", {4, 0, 0}, {6, 1, 1}, {2 * f.n, f.n, f.n}, formulation) +
         lattice({2, 0, 0}, {4, 1, 1}, f.r) + hold('x', 0) + hold('x', 6);
}

TEST(Patch, StraightInterfacesInTension) {
  for (const std::string formulation : {"full", "one-point", "assumed-strain"})
    for (const Fineness& f : usual)
      expect_exact(bar(f, formulation), homogeneous(pull_x), say(f, formulation));
  // h = r: the lattice takes the first layer of hexahedra, of which 10⁻⁶ is left
  const Worst thin = patch(bar({0.25, 4}, "full"), homogeneous(pull_x));
  EXPECT_LT(std::max(thin.hexahedra, thin.lattice), 1e-5);
}

/// Blocks of unit cubes but for the middle one, which is the lattice's; `there(i, j, k)` says which exist.
template <class There>
std::string around(const Fineness& f, There there) {
  std::string text = head;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        if ((i != 1 || j != 1 || k != 1) && there(i, j, k))
          text += block(fmt::format("b{}{}{}", i, j, k), {1.0 * i, 1.0 * j, 1.0 * k},
                        {i + 1.0, j + 1.0, k + 1.0}, {f.n, f.n, f.n}, "selective-reduced");
  return text + lattice({1, 1, 1}, {2, 2, 2}, f.r);
}

/// Particles in the corner of an L, with free faces x = 2 and y = 2, and hexahedra at both ends.
TEST(Patch, LShapedInterface) {
  for (const Fineness& f : usual)
    expect_exact(around(f, [](int i, int j, int) { return i < 2 && j < 2; }) + hold('z', 0) + hold('z', 3),
                 homogeneous(pull_z), say(f, "L"));
}

/// Particles in a notch.
TEST(Patch, ThreeSidedInterface) {
  for (const Fineness& f : usual)
    for (const Mat3& G : {pull_x, pull_z})
      expect_exact(around(f, [](int, int j, int) { return j < 2; }) + hold('x', 0) + hold('x', 3) +
                       hold('z', 0) + hold('z', 3),
                   homogeneous(G), say(f, "notch"));
}

/// A plate with a hole that particles fill.
std::string plate(const Fineness& f) {
  std::string text = head;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      if (i != 1 || j != 1)
        text += block(fmt::format("b{}{}", i, j), {1.0 * i, 1.0 * j, 0}, {i + 1.0, j + 1.0, 1},
                      {f.n, f.n, f.n}, "selective-reduced");
  return text + lattice({1, 1, 0}, {2, 2, 1}, f.r) + hold('x', 0) + hold('x', 3) + hold('y', 0) +
         hold('y', 3);
}

TEST(Patch, FourSidedInterface) {
  for (const Fineness& f : usual)
    for (const Mat3& G : {pull_x, pull_y, shear_xy}) expect_exact(plate(f), homogeneous(G), say(f, "plate"));
}

/// Longer faces: what is corrected at one corner is led to the next.
TEST(Patch, FineMeshesAroundALattice) {
  for (const Fineness& f : {Fineness{0.0625, 8}, Fineness{0.05, 7}})
    expect_exact(plate(f), homogeneous(pull_x), say(f, "plate"));
}

/// A case must have a support; hold_border puts others in its place.
constexpr const char* some_support = "[[supports]]\nwhere = { region = \"b000\" }\nfix = [\"x\"]\n";

/// Hold every node near the border; where blocks are skewed it lies on no plane.
void hold_border(Simulation& sim) {
  sim.supports = {};
  std::fill(sim.model.mesh.held.begin(), sim.model.mesh.held.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < sim.model.mesh.nodes(); ++i) {
    const Vec3 X = sim.model.mesh.points[i];
    const double from_middle = std::max({std::abs(X.x - 1.5), std::abs(X.y - 1.5), std::abs(X.z - 1.5)});
    if (from_middle < 1) continue;
    sim.model.mesh.held[i] = 0b111;
    for (std::int32_t c = 0; c < 3; ++c) sim.supports.held.push_back({-1, i, -1, c, 0});
  }
}

/// Octants and faces are integrated in warped elements as if their faces were plane, and trilinear fields of
/// distorted elements are not polynomials: what is left grows with the distortion and falls with r/h.
TEST(Patch, DistortedHexahedra) {
  double worst = 0;
  for (const double skew : {0.05, 0.2})
    for (const Fineness& f : usual) {
      const Case input =
          read_case_text(embedded(f, "full", skew) + some_support, "patch.toml", {"method=consistent"});
      Built built = build(input);
      const FieldOf field = homogeneous(any);
      hold_border(built.simulation);
      move_border(built.simulation, field);
      const Outcome outcome = run(built.simulation, plan_of(input), {});
      ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
      const Worst found = worst_strain(built.simulation.model, field);
      EXPECT_LT(std::max(found.hexahedra, found.lattice), 0.05 * skew) << skew << " " << say(f, "full");
      worst = std::max({worst, found.hexahedra, found.lattice});
    }
  ::testing::Test::RecordProperty("worst", std::to_string(worst));
}

/// Pure bending is not homogeneous: faces and interface are left with what particles and elements of that
/// size cannot do. It is a fraction of the published method's.
TEST(Patch, BendingAcrossInterfaces) {
  for (const Fineness& f : {Fineness{0.25, 2}, Fineness{0.125, 2}, Fineness{0.05, 2}}) {
    const Worst consistent = patch(bar(f, "assumed-strain"), bending(1)),
                published = patch(bar(f, "assumed-strain"), bending(1), "published");
    EXPECT_LT(consistent.hexahedra, 0.2 * published.hexahedra) << say(f, "");
    EXPECT_LT(consistent.lattice, 0.5 * published.lattice) << say(f, "");
  }
}

/// Where cells and skins resist dilatation beside the bonds (de/dilatation.hpp).
class PatchByPoisson : public ::testing::TestWithParam<double> {
 protected:
  static std::string with_poisson(std::string text) {
    const std::string usual_one = "poisson = 0.2";
    return text.replace(text.find(usual_one), usual_one.size(), fmt::format("poisson = {}", GetParam()));
  }
  /// Uniaxial stress.
  static Mat3 pull(std::size_t axis) {
    Mat3 G{};
    for (std::size_t c = 0; c < 3; ++c) G[c][c] = c == axis ? 1e-3 : -GetParam() * 1e-3;
    return G;
  }
  static void expect_all_exact(const std::string& text, std::initializer_list<Mat3> states,
                               const std::string& what) {
    for (const Mat3& G : states)
      expect_exact(with_poisson(text), homogeneous(G), fmt::format("{}, nu {}", what, GetParam()));
  }
  static constexpr Fineness few[] = {{0.25, 2}, {0.1, 2}, {0.125, 1}};
};

TEST_P(PatchByPoisson, EmbeddedLatticeInAnyStrain) {
  for (const std::string formulation : {"full", "selective-reduced", "one-point", "assumed-strain"})
    for (const Fineness& f : few)
      expect_all_exact(embedded_and_held(f, formulation), {any}, say(f, formulation));
}

TEST_P(PatchByPoisson, FreeFaces) {
  for (const Fineness& f : few) {
    expect_all_exact(bar(f, "assumed-strain"), {pull(0)}, say(f, "bar"));
    expect_all_exact(
        around(f, [](int i, int j, int) { return i < 2 && j < 2; }) + hold('z', 0) + hold('z', 3), {pull(2)},
        say(f, "L"));
    expect_all_exact(around(f, [](int, int j, int) { return j < 2; }) + hold('x', 0) + hold('x', 3) +
                         hold('z', 0) + hold('z', 3),
                     {pull(0), pull(2)}, say(f, "notch"));
    expect_all_exact(plate(f), {pull(0), pull(1), shear_xy}, say(f, "plate"));
  }
}

INSTANTIATE_TEST_SUITE_P(Metals, PatchByPoisson, ::testing::Values(0.3, 0.4, 0.45));

/// The published method for comparison: its errors are per cents of the strain and more.
TEST(Patch, PublishedMethodFails) {
  const Worst worst = patch(bar({0.125, 2}, "full"), homogeneous(pull_x), "published");
  EXPECT_GT(std::max(worst.hexahedra, worst.lattice), 0.05);
}

}  // namespace
}  // namespace geist::verification
