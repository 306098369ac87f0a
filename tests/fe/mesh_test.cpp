// Elements together: patch test, masses, energies, dissipation, threads, locking, the published beam's static
// limit.
#include <gtest/gtest.h>
#include <omp.h>

#include "support.hpp"

namespace geist::fe {
namespace {

using namespace testing;

const Material material{"m", 2.3, 10, 0.3};
const std::vector<std::string> names{"full", "selective-reduced", "assumed-strain", "one-point",
                                     "one-point-viscous"};

const Mat3 gradient{{Vec3{0.1, 0.4, -0.2}, Vec3{0.3, -0.5, 0.6}, Vec3{0.2, 0.1, 0.7}}};

void set_linear(Mesh& mesh) {
  for (std::size_t n = 0; n < mesh.nodes(); ++n) mesh.u.set(n, gradient * mesh.points[n] + Vec3{1, 2, 3});
}

void set_random(Mesh& mesh) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-1, 1);
  for (std::size_t n = 0; n < mesh.nodes(); ++n) {
    mesh.u.set(n, {value(random), value(random), value(random)});
    mesh.v.set(n, {value(random), value(random), value(random)});
  }
}

TEST(Mesh, PatchOfDistortedHexahedraHoldsConstantStress) {
  const int n = 3;
  for (const std::string& name : names) {
    Mesh mesh = box({n, n, n}, {1, 1, 1}, name, material, scatter_inside(0.07));
    set_linear(mesh);
    EXPECT_NEAR(internal_forces(mesh), 0, 1e-28);
    const Mat3 s = stress(gradient, material.lambda(), material.mu());
    for (std::size_t p = 0; p < mesh.nodes(); ++p) {
      // traction σ n on the share of every face that the node has; nothing inside
      const Vec3 X = mesh.points[p];
      Vec3 expected;
      for (int d = 0; d < 3; ++d) {
        double share = 1;
        for (int o : {(d + 1) % 3, (d + 2) % 3}) share *= (X[o] == 0 || X[o] == 1 ? 0.5 : 1.0) / n;
        for (int i = 0; i < 3; ++i) expected[i] += (X[d] == 0 ? 1 : X[d] == 1 ? -1 : 0) * share * s[i][d];
      }
      EXPECT_LT(norm(mesh.f.vector(p) - expected), 1e-13) << name << " node " << p;
    }
    for (const auto& found : centre_stresses(mesh)) {
      const double voigt[6] = {s[0][0], s[1][1], s[2][2], s[0][1], s[1][2], s[0][2]};
      for (int c = 0; c < 6; ++c) EXPECT_NEAR(found[c], voigt[c], 1e-13);
    }
  }
}

/// u = (Q U − 1) X on distorted elements, Q by a third of a turn about the diagonal: stresses are those of U
/// − 1, turned, the same in every element, and nothing is out of balance inside.
TEST(Mesh, PatchThatTurnsFarHoldsConstantStress) {
  const Mat3 U{{Vec3{1.05, 0.02, 0}, Vec3{0.02, 0.97, -0.03}, Vec3{0, -0.03, 1.1}}};
  const Mat3 s = stress({{U[0] - Vec3{1, 0, 0}, U[1] - Vec3{0, 1, 0}, U[2] - Vec3{0, 0, 1}}},
                        material.lambda(), material.mu());
  for (const std::string& name : names) {
    Mesh mesh = box({3, 3, 3}, {1, 1, 1}, name, material, scatter_inside(0.07));
    mesh.kinematics = Kinematics::finite;
    for (std::size_t n = 0; n < mesh.nodes(); ++n) {
      const Vec3 X = mesh.points[n], x = U * X;
      mesh.u.set(n, Vec3{x.z, x.x, x.y} - X + Vec3{1, 2, 3});
    }
    EXPECT_NEAR(internal_forces(mesh), 0, 1e-28);
    for (std::size_t p = 0; p < mesh.nodes(); ++p) {
      const Vec3 X = mesh.points[p];
      if (X.x * X.y * X.z * (1 - X.x) * (1 - X.y) * (1 - X.z) > 1e-12) {
        EXPECT_LT(norm(mesh.f.vector(p)), 2e-14) << name << " node " << p;
      }
    }
    const auto turned = [&](int i, int j) { return s[(i + 2) % 3][(j + 2) % 3]; };
    const double voigt[6] = {turned(0, 0), turned(1, 1), turned(2, 2),
                             turned(0, 1), turned(1, 2), turned(0, 2)};
    for (const auto& found : centre_stresses(mesh))
      for (int c = 0; c < 6; ++c) EXPECT_NEAR(found[c], voigt[c], 1e-13);
  }
}

/// What is left is half of every gradient and half of the volume: half of everything, turned far and
/// strained.
TEST(Mesh, CutHexahedraTurnToo) {
  for (const std::string& name : names) {
    Mesh mesh = box({1, 1, 2}, {1, 1, 2}, name, material, scatter_inside(0.07));
    mesh.kinematics = Kinematics::finite;
    set_random(mesh);
    for (std::size_t n = 0; n < mesh.nodes(); ++n) {
      const Vec3 x = mesh.points[n] + 0.1 * mesh.u.vector(n);
      mesh.u.set(n, Vec3{x.z, x.x, x.y} - mesh.points[n]);
    }
    const double power = internal_forces(mesh);
    std::vector<Vec3> whole;
    for (std::size_t n = 0; n < mesh.nodes(); ++n) whole.push_back(mesh.f.vector(n));
    const Energies stored = energies(mesh);
    std::vector<HexCut> cuts(2);
    for (int e = 0; e < 2; ++e) {
      const hex8::Corners x = hex8::corners(mesh, e);
      cuts[e].element = e, cuts[e].volume = 0.5 * hex8::volume(x);
      const auto b = mean_position_gradient(x);
      for (int a = 0; a < 8; ++a) cuts[e].gradient[a] = cuts[e].volume * b[a];
    }
    set_cuts(mesh, cuts);
    EXPECT_NEAR(internal_forces(mesh), 0.5 * power, 1e-13);
    EXPECT_NEAR(energies(mesh).strain, 0.5 * stored.strain, 1e-13);
    EXPECT_NEAR(energies(mesh).hourglass, 0.5 * stored.hourglass, 1e-13);
    for (std::size_t n = 0; n < mesh.nodes(); ++n)
      EXPECT_LT(norm(mesh.f.vector(n) - 0.5 * whole[n]), 1e-13) << name;
  }
}

TEST(Mesh, FirstElementTurnedInsideOut) {
  Mesh mesh = box({1, 1, 3}, {1, 1, 3}, "one-point", material);
  for (std::size_t n = 0; n < mesh.nodes(); ++n)
    if (mesh.points[n].z >= 2) mesh.u.set(n, {0, 0, -1.1});
  EXPECT_FALSE(first_inverted(mesh));  // it may be, where displacements are small
  mesh.kinematics = Kinematics::finite;
  EXPECT_EQ(first_inverted(mesh), std::optional<std::size_t>(1));
  internal_forces(mesh);
  EXPECT_TRUE(std::isnan(norm(mesh.f.vector(8))));
  EXPECT_FALSE(std::isnan(norm(mesh.f.vector(0))));
  mesh.u.set(8, {std::nan(""), 0, 0});
  for (std::size_t n = 0; n < mesh.nodes(); ++n)
    if (n != 8) mesh.u.set(n, {});
  EXPECT_FALSE(first_inverted(mesh));  // no number is no shape at all
}

TEST(Mesh, PatchIsReallyDistorted) {
  const Mesh mesh = box({3, 3, 3}, {1, 1, 1}, "full", material, scatter_inside(0.07));
  double twist = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    EXPECT_TRUE(hex8::valid(hex8::corners(mesh, e)));
    const auto x = hex8::corners(mesh, e);
    twist = std::max(twist, norm((x[1] - x[0]) - (x[6] - x[7])));
  }
  EXPECT_GT(twist, 0.05);
}

TEST(Mesh, MassesAreThoseOfTheirVolume) {
  Mesh mesh = box({3, 4, 5}, {1, 1, 1}, "full", material, scatter_inside(0.05));
  lump_masses(mesh);
  double whole = 0;
  Vec3 moment;
  for (std::size_t n = 0; n < mesh.nodes(); ++n)
    whole += mesh.mass[n], moment += mesh.mass[n] * mesh.points[n];
  EXPECT_NEAR(whole, 2.3, 1e-13);
  EXPECT_LT(norm(moment - 2.3 * Vec3{0.5, 0.5, 0.5}), 1e-12);
  double sum = 0;
  for (double m : corner_masses(mesh, 17)) sum += m;
  EXPECT_NEAR(sum, 2.3 * hex8::volume(hex8::corners(mesh, 17)), 1e-15);
}

TEST(Mesh, EnergiesAreHalfTheWorkOfTheForces) {
  for (const std::string name : {"full", "selective-reduced", "assumed-strain", "one-point"}) {
    Mesh mesh = box({3, 3, 3}, {1, 1, 1}, name, material, scatter_inside(0.07));  // 27: last block not full
    set_random(mesh);
    internal_forces(mesh);
    double work = 0;
    for (std::size_t n = 0; n < mesh.nodes(); ++n) work -= dot(mesh.f.vector(n), mesh.u.vector(n)) / 2;
    const Energies e = energies(mesh);
    EXPECT_NEAR(e.strain + e.hourglass, work, 1e-12 * work);
    EXPECT_GT(e.strain, 0);
    EXPECT_EQ(e.hourglass > 0, name == "one-point");
  }
}

TEST(Mesh, DissipatedPowerCountsRealElementsOnly) {
  Mesh mesh = box({3, 3, 3}, {1, 1, 1}, "one-point-viscous", material, scatter_inside(0.07));
  set_random(mesh);
  for (std::size_t n = 0; n < mesh.nodes(); ++n) mesh.u.set(n, {});
  const double power = internal_forces(mesh);
  double work = 0;
  for (std::size_t n = 0; n < mesh.nodes(); ++n) work -= dot(mesh.f.vector(n), mesh.v.vector(n));
  EXPECT_GT(power, 0);
  EXPECT_NEAR(power, work, 1e-13 * power);
}

TEST(Mesh, SameBitsForAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  for (const std::string& name : names) {
    std::vector<Vec3> forces, first_forces;
    std::vector<double> numbers;
    for (int threads : {1, 3, 7}) {
      omp_set_num_threads(threads);
      Mesh mesh = box({12, 11, 13}, {1, 1, 1}, name, material, scatter_inside(0.01));
      set_random(mesh);
      const double power = internal_forces(mesh);
      const Energies e = energies(mesh);
      forces.clear();
      for (std::size_t n = 0; n < mesh.nodes(); ++n) forces.push_back(mesh.f.vector(n));
      if (threads == 1) first_forces = forces, numbers = {power, e.strain, e.hourglass};
      EXPECT_EQ(forces, first_forces);
      EXPECT_EQ(numbers, (std::vector<double>{power, e.strain, e.hourglass}));
    }
  }
  omp_set_num_threads(before);
}

/// Regions of different formulations that share nodes, in one sweep and in two of every other block each.
TEST(Mesh, SweepsAddUp) {
  Mesh mesh = box({12, 11, 13}, {1, 1, 1}, "full", material, scatter_inside(0.01));
  HexRegion& lower = mesh.regions[0];
  HexRegion upper = lower;
  lower.count = 700, upper.first = 700, upper.count -= 700, upper.formulation = "one-point-viscous";
  mesh.regions.push_back(upper);
  finish(mesh);
  set_random(mesh);
  const double power = internal_forces(mesh);
  EXPECT_GT(power, 0);
  std::vector<Vec3> all;
  for (std::size_t n = 0; n < mesh.nodes(); ++n) all.push_back(mesh.f.vector(n));
  std::vector<std::int32_t> some[2];
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) some[b % 2].push_back(static_cast<std::int32_t>(b));
  const Sweep even = make_sweep(mesh, some[0]), odd = make_sweep(mesh, some[1]);
  EXPECT_NEAR(add_internal_forces(mesh, even, 2) + add_internal_forces(mesh, odd, 2), power, 1e-12 * power);
  for (std::size_t n = 0; n < mesh.nodes(); ++n)
    EXPECT_LT(norm(mesh.f.vector(n) - 3 * all[n]), 1e-11 * norm(all[n]) + 1e-11) << n;
}

TEST(Mesh, BeamsDeflectAsPublished) {
  const Material beam{"beam", 0.001, 1000, 0.2};
  EXPECT_NEAR(tip_deflection(box({40, 4, 4}, {20, 2, 2}, "full", beam), 2), 1.947522, 1e-6);
  EXPECT_NEAR(tip_deflection(box({40, 4, 4}, {20, 2, 2}, "selective-reduced", beam), 2), 1.970252, 1e-6);
}

TEST(Mesh, NearlyIncompressibleBendingDoesNotLock) {
  const auto ratio = [](const std::string& name) {
    const auto tip = [&](double nu) {
      return tip_deflection(box({10, 2, 2}, {10, 1, 2}, name, {"rubber", 1, 1000, nu}), 2);
    };
    return tip(0.4999) / tip(0.3);
  };
  EXPECT_LT(ratio("full"), 0.5);
  EXPECT_NEAR(ratio("selective-reduced"), 1, 0.1);
  EXPECT_NEAR(ratio("assumed-strain"), 1, 0.1);
}

}  // namespace
}  // namespace geist::fe
