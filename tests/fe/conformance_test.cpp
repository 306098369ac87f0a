// What every element formulation must do; runs over the whole list.
#include <gtest/gtest.h>

#include "support.hpp"

#include <Eigen/Eigenvalues>

namespace geist::fe {
namespace {

using namespace testing;

template <class F>
struct Formulation : ::testing::Test {};
TYPED_TEST_SUITE(Formulation, EveryFormulation, FormulationName);

const Corners<double> rest{};

double total(const Stored<double>& e) { return e.strain + e.hourglass; }

double scalar(const Corners<double>& a, const Corners<double>& b) {
  double s = 0;
  for (int c = 0; c < 8; ++c)
    for (int i = 0; i < 3; ++i) s += a[c][i] * b[c][i];
  return s;
}

TYPED_TEST(Formulation, ForceIsMinusTheDerivativeOfTheEnergy) {
  const Outlined<TypeParam> law;
  const Corners<double> X = to_array(distorted(1));
  Corners<double> u = random_field(2), f;
  law.forces(X, u, rest, f);
  const double h = 1e-2;  // the energy is a quadratic form: central differences have no truncation error
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) {
      const double middle = u[a][i];
      u[a][i] = middle + h;
      const double up = total(law.energy(X, u));
      u[a][i] = middle - h;
      const double down = total(law.energy(X, u));
      u[a][i] = middle;
      EXPECT_NEAR(f[a][i], -(up - down) / (2 * h), 1e-11);
    }
}

TYPED_TEST(Formulation, StiffnessIsSymmetric) {
  const Outlined<TypeParam> law;
  for (int seed = 0; seed < 5; ++seed) {
    const Matrix24 K = stiffness_matrix(law, to_array(distorted(seed)));
    EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
  }
}

TYPED_TEST(Formulation, RigidMotionsCostNothing) {
  const Outlined<TypeParam> law;
  const hex8::Corners x = distorted(3);
  const Mat3 turn{{Vec3{0, -0.3, 0.2}, Vec3{0.3, 0, -0.1}, Vec3{-0.2, 0.1, 0}}};
  Corners<double> u = linear_field(x, turn), f;
  for (int a = 0; a < 8; ++a) u[a][0] += 0.7, u[a][1] -= 0.4, u[a][2] += 1.1;
  law.forces(to_array(x), u, rest, f);
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(f[a][i], 0, 2e-15);
  EXPECT_NEAR(total(law.energy(to_array(x), u)), 0, 1e-28);
}

TYPED_TEST(Formulation, LinearFieldsAreExact) {
  const Outlined<TypeParam> law;
  const Mat3 L{{Vec3{0.1, 0.4, -0.2}, Vec3{0.3, -0.5, 0.6}, Vec3{0.2, 0.1, 0.7}}};
  const Mat3 s = stress(L, steel_like.lambda, steel_like.mu);
  for (int seed = 0; seed < 5; ++seed) {
    const hex8::Corners x = distorted(seed);
    const auto b = mean_position_gradient(x);
    const double V = hex8::volume(x);
    const Corners<double> u = linear_field(x, L);
    Corners<double> f;
    law.forces(to_array(x), u, rest, f);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(f[a][i], -V * dot(s[i], b[a]), 1e-14);
    double work = 0;
    for (int i = 0; i < 3; ++i) work += dot(s[i], L[i]);
    const Stored<double> e = law.energy(to_array(x), u);
    EXPECT_NEAR(e.strain, 0.5 * work * V, 1e-14);
    EXPECT_NEAR(e.hourglass, 0, 1e-28);
  }
}

/// Number of eigenvalues that are zero to rounding; the others must be positive.
int zeros(const Matrix24& K) {
  const auto values = Eigen::SelfAdjointEigenSolver<Matrix24>(K).eigenvalues();
  int count = 0;
  for (double v : values) {
    count += std::abs(v) < 1e-12 * values(23);
    EXPECT_GT(v, -1e-12 * values(23));
    EXPECT_TRUE(std::abs(v) < 1e-12 * values(23) || v > 1e-3 * values(23)) << v;
  }
  return count;
}

TYPED_TEST(Formulation, OnlyRigidMotionsAreFree) {
  const Outlined<TypeParam> law;
  const bool stores_no_hourglass_energy = TypeParam::uses_velocity;
  for (const hex8::Corners& x : {parallelepiped(), distorted(4), distorted(5)}) {
    const Matrix24 K = stiffness_matrix(law, to_array(x));
    EXPECT_EQ(zeros(K), stores_no_hourglass_energy ? 18 : 6);
    if (stores_no_hourglass_energy) {  // what is not resisted is damped: twelve motions
      EXPECT_EQ(zeros(damping_matrix(law, to_array(x))), 12);
    }
  }
}

/// Corner a of a turned element is corner order[a] of the first: about ζ by a right angle, and about the
/// diagonal through corners 0 and 6 by 120°. Together they make all 24 orders.
constexpr int turns[2][8] = {{1, 2, 3, 0, 5, 6, 7, 4}, {0, 3, 7, 4, 1, 2, 6, 5}};

TYPED_TEST(Formulation, OrderOfCornersDoesNotMatter) {
  const Outlined<TypeParam> law;
  const hex8::Corners x = distorted(7);
  const Corners<double> u = random_field(8), v = random_field(9);
  Corners<double> f, turned_f;
  law.forces(to_array(x), u, v, f);
  for (const auto& order : turns) {
    hex8::Corners turned_x;
    Corners<double> turned_u, turned_v;
    for (int a = 0; a < 8; ++a) {
      turned_x[a] = x[order[a]];
      for (int i = 0; i < 3; ++i) turned_u[a][i] = u[order[a]][i], turned_v[a][i] = v[order[a]][i];
    }
    law.forces(to_array(turned_x), turned_u, turned_v, turned_f);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(turned_f[a][i], f[order[a]][i], 2e-14);
  }
}

Corners<double> turned(const Mat3& R, const Corners<double>& u) {
  Corners<double> t;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) t[a][i] = R[i].x * u[a][0] + R[i].y * u[a][1] + R[i].z * u[a][2];
  return t;
}

TYPED_TEST(Formulation, ForcesTurnWithTheElement) {
  const Outlined<TypeParam> law;
  const double t = 1.0 / 3;
  const Mat3 R{{t * Vec3{2, -1, 2}, t * Vec3{2, 2, -1}, t * Vec3{-1, 2, 2}}};
  const Corners<double> X = to_array(distorted(7)), u = random_field(8), v = random_field(9);
  Corners<double> f, found;
  law.forces(X, u, v, f);
  law.forces(turned(R, X), turned(R, u), turned(R, v), found);
  const Corners<double> expected = turned(R, f);
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[a][i], expected[a][i], 2e-14);
}

TYPED_TEST(Formulation, EightLanesAreEightScalars) {
  const Outlined<TypeParam> law;
  Corners<Pack> X, u, v, f;
  for (int l = 0; l < lanes; ++l) {
    const Corners<double> x = to_array(distorted(l)), w = random_field(l), r = random_field(l + 50);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) X[a][i][l] = x[a][i], u[a][i][l] = w[a][i], v[a][i][l] = r[a][i];
  }
  const Pack power = law.forces(X, u, v, f);
  const Stored<Pack> stored = law.energy(X, u);
  for (int l = 0; l < lanes; ++l) {
    Corners<double> g;
    EXPECT_EQ(law.forces(to_array(distorted(l)), random_field(l), random_field(l + 50), g), power[l]);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) EXPECT_EQ(g[a][i], f[a][i][l]);
    const Stored<double> e = law.energy(to_array(distorted(l)), random_field(l));
    EXPECT_EQ(e.strain, stored.strain[l]);
    EXPECT_EQ(e.hourglass, stored.hourglass[l]);
  }
}

TYPED_TEST(Formulation, DissipatesExactlyWhatItSays) {
  const Outlined<TypeParam> law;
  const hex8::Corners x = distorted(6);
  const Corners<double> X = to_array(x), v = random_field(8);
  Corners<double> f;
  const double power = law.forces(X, rest, v, f);
  EXPECT_NEAR(power, -scalar(f, v), 1e-13);
  if (TypeParam::uses_velocity) {
    EXPECT_GT(power, 0);
  } else {
    EXPECT_EQ(power, 0);
  }
  const Mat3 L{{Vec3{0.1, 0.4, -0.2}, Vec3{0.3, -0.5, 0.6}, Vec3{0.2, 0.1, 0.7}}};
  EXPECT_NEAR(law.forces(X, rest, linear_field(x, L), f), 0, 1e-28);
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(f[a][i], 0, 1e-14);
}

}  // namespace
}  // namespace geist::fe
