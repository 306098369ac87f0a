// Finite rotations around every formulation: what is indifferent to the frame, and that forces are exact
// derivatives.
#include <gtest/gtest.h>

#include "fe/corotational.hpp"
#include "support.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace geist::fe {
namespace {

using namespace testing;

template <class F>
struct CorotationalOf : ::testing::Test {};
TYPED_TEST_SUITE(CorotationalOf, EveryFormulation, FormulationName);

/// A formulation that turns with the element, compiled once.
template <class F>
struct Turning {
  Corotational<F> law{F(steel_like)};

  template <class T>
  [[gnu::noinline]] T forces(const Corners<T>& X, const Corners<T>& u, const Corners<T>& v,
                             Corners<T>& f) const {
    return law.forces(X, u, v, f);
  }
  template <class T>
  [[gnu::noinline]] Stored<T> energy(const Corners<T>& X, const Corners<T>& u) const {
    return law.energy(X, u);
  }
  static constexpr bool uses_velocity = F::uses_velocity;
};

const Corners<double> rest{};
using Matrix3 = Eigen::Matrix3d;
using Vector3 = Eigen::Vector3d;

double total(const Stored<double>& e) { return e.strain + e.hourglass; }

Vector3 corner(const Corners<double>& x, int a) { return {x[a][0], x[a][1], x[a][2]}; }
void set(Corners<double>& x, int a, const Vector3& p) {
  for (int i = 0; i < 3; ++i) x[a][i] = p(i);
}

/// Angles about axes of all kinds, half turns among them.
std::vector<Matrix3> rotations() {
  std::vector<Matrix3> all;
  for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 0, 1), Vector3(1, -2, 3), Vector3(1, 1, 1)})
    for (const double degrees : {1e-6, 1.0, 60.0, 90.0, 179.0, 180.0, 250.0})
      all.push_back(Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()).toRotationMatrix());
  return all;
}

/// u of x → Q x + c, x = X + u.
Corners<double> moved(const Corners<double>& X, const Corners<double>& u, const Matrix3& Q,
                      const Vector3& c) {
  Corners<double> w;
  for (int a = 0; a < 8; ++a) set(w, a, Q * (corner(X, a) + corner(u, a)) + c - corner(X, a));
  return w;
}

Corners<double> scaled(double s, Corners<double> u) {
  for (auto& a : u.at)
    for (double& i : a) i *= s;
  return u;
}

/// Displacements of a strain of about 20 % that is not uniform, turned far.
Corners<double> strained_and_turned(const Corners<double>& X, int seed) {
  const Matrix3 Q = rotations()[static_cast<std::size_t>(seed) % rotations().size()];
  return moved(X, scaled(0.1, random_field(seed)), Q, {1, -2, 3});
}

double largest(const Corners<double>& f) {
  double most = 0;
  for (int a = 0; a < 8; ++a) most = std::max(most, corner(f, a).norm());
  return most;
}

void expect_equal(const Corners<double>& a, const Corners<double>& b, double tolerance) {
  for (int c = 0; c < 8; ++c) EXPECT_LT((corner(a, c) - corner(b, c)).norm(), tolerance) << "corner " << c;
}

TYPED_TEST(CorotationalOf, RigidMotionsCostNothing) {
  const Turning<TypeParam> law;
  const Corners<double> X = to_array(distorted(3));
  for (const Matrix3& Q : rotations()) {
    Corners<double> f;
    const Corners<double> u = moved(X, rest, Q, {0.7, -0.4, 1.1});
    law.forces(X, u, rest, f);
    EXPECT_LT(largest(f), 3e-14);
    EXPECT_LT(total(law.energy(X, u)), 1e-28);
  }
}

TYPED_TEST(CorotationalOf, EnergyAndForcesAreIndifferentToTheFrame) {
  const Turning<TypeParam> law;
  for (int seed = 0; seed < 3; ++seed) {
    const Corners<double> X = to_array(distorted(seed));
    const Corners<double> u = scaled(0.1, random_field(seed)), v = random_field(seed + 10);
    Corners<double> f, g, turned_v, turned_f;
    const double power = law.forces(X, u, v, f);
    for (const Matrix3& Q : rotations()) {
      const Corners<double> w = moved(X, u, Q, {3, 1, -2});
      for (int a = 0; a < 8; ++a) set(turned_v, a, Q * corner(v, a)), set(turned_f, a, Q * corner(f, a));
      EXPECT_NEAR(law.forces(X, w, turned_v, g), power, 2e-14);
      expect_equal(g, turned_f, 1e-13 * largest(f));
      EXPECT_NEAR(total(law.energy(X, w)) / total(law.energy(X, u)), 1, 1e-13);
    }
  }
}

/// Numerical differentiation of fourth order: truncation h⁴, rounding 10⁻¹⁶/h, both near 10⁻¹³.
template <class Law>
double minus_slope(const Law& law, const Corners<double>& X, Corners<double> u, int a, int i) {
  constexpr double h = 1e-3;
  const double middle = u[a][i];
  const auto at = [&](double shift) {
    u[a][i] = middle + shift;
    return total(law.energy(X, u));
  };
  return -(8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

TYPED_TEST(CorotationalOf, ForceIsMinusTheDerivativeOfTheEnergy) {
  const Turning<TypeParam> law;
  for (int seed = 0; seed < 12; ++seed) {
    const Corners<double> X = to_array(distorted(seed)), u = strained_and_turned(X, seed);
    Corners<double> f;
    law.forces(X, u, rest, f);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(f[a][i], minus_slope(law, X, u, a, i), 2e-11 * largest(f));
  }
}

/// The forces in turned axes have a moment, which the turning of the axes takes out. One-point elements at
/// rest have none: their stress has the axes of the strain, and their hourglass forces have the directions of
/// q.
TYPED_TEST(CorotationalOf, AxesTurnWithEveryCorner) {
  const Turning<TypeParam> law;
  const Corners<double> X = to_array(distorted(1)), u = scaled(0.1, random_field(1));
  const TurningAxes<double> axes(X, u);
  Corners<double> x, w, f, without;
  law.forces(X, u, rest, f);
  axes.positions(X, u, x, w);
  law.law.law.forces(X, w, rest, without);
  Vector3 moment = Vector3::Zero();
  for (int a = 0; a < 8; ++a) moment += corner(x, a).cross(corner(without, a));
  const bool one_point = TypeParam::name.starts_with("one-point");
  EXPECT_EQ(moment.norm() > 1e-3 * largest(f), !one_point);
}

TYPED_TEST(CorotationalOf, MomentaAreKept) {
  const Turning<TypeParam> law;
  for (int seed = 0; seed < 12; ++seed) {
    const Corners<double> X = to_array(distorted(seed)), u = strained_and_turned(X, seed);
    Corners<double> f;
    law.forces(X, u, random_field(seed + 20), f);
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    for (int a = 0; a < 8; ++a) {
      force += corner(f, a);
      moment += (corner(X, a) + corner(u, a)).cross(corner(f, a));
    }
    EXPECT_LT(force.norm(), 1e-14 * largest(f));
    EXPECT_LT(moment.norm(), 5e-14 * largest(f));
  }
}

TYPED_TEST(CorotationalOf, SmallDisplacementsAreThoseOfSmallKinematics) {
  const Turning<TypeParam> law;
  const Corners<double> X = to_array(distorted(4)), u = random_field(5), v = random_field(6);
  double before = 0;
  for (const double s : {1e-2, 1e-3, 1e-4}) {
    Corners<double> finite, small;
    law.forces(X, scaled(s, u), scaled(s, v), finite);
    law.law.law.forces(X, scaled(s, u), scaled(s, v), small);
    double difference = 0;
    for (int a = 0; a < 8; ++a)
      difference = std::max(difference, (corner(finite, a) - corner(small, a)).norm());
    if (before > 0) {
      EXPECT_NEAR(before / difference, 100, 5);
    }
    before = difference;
  }
}

/// Of the second order, too: turned far and strained by s, forces are R f_small(s) + O(s²).
TYPED_TEST(CorotationalOf, SmallStrainsMayTurnFar) {
  const Turning<TypeParam> law;
  const Corners<double> X = to_array(distorted(4)), u = random_field(5);
  const double s = 1e-6;
  Corners<double> finite, small;
  law.law.law.forces(X, scaled(s, u), rest, small);
  for (const Matrix3& Q : rotations()) {
    law.forces(X, moved(X, scaled(s, u), Q, {0, 0, 0}), rest, finite);
    for (int a = 0; a < 8; ++a)
      EXPECT_LT((corner(finite, a) - Q * corner(small, a)).norm(), 1e-5 * largest(small));
  }
}

TYPED_TEST(CorotationalOf, DissipatesWhatItSaysAndNothingInARigidSpin) {
  const Turning<TypeParam> law;
  for (int seed = 0; seed < 4; ++seed) {
    const Corners<double> X = to_array(distorted(seed)), u = strained_and_turned(X, seed);
    const Corners<double> v = random_field(seed + 30);
    Corners<double> f, elastic, spin;
    const double power = law.forces(X, u, v, f);
    law.forces(X, u, rest, elastic);
    double lost = 0;
    for (int a = 0; a < 8; ++a) lost -= (corner(f, a) - corner(elastic, a)).dot(corner(v, a));
    EXPECT_NEAR(power, lost, 1e-13);
    EXPECT_EQ(power > 0, TypeParam::uses_velocity);
    for (int a = 0; a < 8; ++a)
      set(spin, a, Vector3(1, 2, -3).cross(corner(X, a) + corner(u, a)) + Vector3(1, 0, 2));
    EXPECT_NEAR(law.forces(X, u, spin, f), 0, 1e-27);
    expect_equal(f, elastic, 1e-13);
  }
}

TYPED_TEST(CorotationalOf, EightLanesAreEightScalars) {
  const Turning<TypeParam> law;
  Corners<Pack> X, u, v, f;
  for (int l = 0; l < lanes; ++l) {
    const Corners<double> x = to_array(distorted(l)), w = strained_and_turned(x, l), r = random_field(l + 50);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) X[a][i][l] = x[a][i], u[a][i][l] = w[a][i], v[a][i][l] = r[a][i];
  }
  const Pack power = law.forces(X, u, v, f);
  const Stored<Pack> stored = law.energy(X, u);
  for (int l = 0; l < lanes; ++l) {
    const Corners<double> x = to_array(distorted(l)), w = strained_and_turned(x, l);
    Corners<double> g;
    EXPECT_EQ(law.forces(x, w, random_field(l + 50), g), power[l]);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) EXPECT_EQ(g[a][i], f[a][i][l]);
    EXPECT_EQ(law.energy(x, w).strain, stored.strain[l]);
    EXPECT_EQ(law.energy(x, w).hourglass, stored.hourglass[l]);
  }
}

/// Minus the slopes of the forces.
template <class Law>
Matrix24 tangent(const Law& law, const Corners<double>& X, Corners<double> u) {
  constexpr double h = 1e-5;
  Matrix24 K;
  for (int j = 0; j < 24; ++j) {
    Corners<double> up, down;
    double& x = u[j / 3][j % 3];
    const double middle = x;
    x = middle + h, law.forces(X, u, rest, up);
    x = middle - h, law.forces(X, u, rest, down);
    x = middle;
    for (int i = 0; i < 24; ++i) K(i, j) = (down[i / 3][i % 3] - up[i / 3][i % 3]) / (2 * h);
  }
  return K;
}

double largest_eigenvalue(const Matrix24& K) {
  return Eigen::SelfAdjointEigenSolver<Matrix24>((K + K.transpose()) / 2).eigenvalues()(23);
}

/// The time step is that of the undeformed element. Strain adds forces times the turning of the axes to its
/// stiffness: the largest frequency must not grow by more than the usual safety factor, 0.9, allows.
TYPED_TEST(CorotationalOf, FrequencyStaysBelowTheSafetyFactor) {
  const Turning<TypeParam> law;
  for (const double strain : {0.05, 0.2, 0.4}) {
    double worst = 0;
    for (int seed = 0; seed < 24; ++seed) {
      const hex8::Corners x = distorted(seed);
      const Corners<double> X = to_array(x);
      const double side = strain * (seed % 2 ? 1 : -1), across = strain * (seed / 2 % 3 - 1);
      Corners<double> u = linear_field(x, {{Vec3{side, 0, 0}, Vec3{0, across, 0}, Vec3{0, 0, side}}});
      const Corners<double> more = scaled(strain / 4, random_field(seed));
      for (int a = 0; a < 8; ++a) set(u, a, corner(u, a) + corner(more, a));
      const double ratio = largest_eigenvalue(tangent(law, X, u)) / largest_eigenvalue(tangent(law, X, rest));
      worst = std::max(worst, std::sqrt(ratio));
    }
    this->RecordProperty(fmt::format("strain_{:g}", 100 * strain), fmt::format("{:.4f}", worst));
    EXPECT_LT(worst, 1 / 0.9) << strain;
  }
}

TEST(Polar, RotationOfAnyStretchAndTurn) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int n = 0; n < 2000; ++n) {
    const Eigen::Quaterniond q = Eigen::Quaterniond(value(random), value(random), value(random),
                                                    value(random)),
                             p = Eigen::Quaterniond(value(random), value(random), value(random),
                                                    value(random));
    const Matrix3 Q = q.normalized().toRotationMatrix(), P = p.normalized().toRotationMatrix();
    const Vector3 stretch = n % 2
                                ? Vector3(1 + value(random) / 2, 1 + value(random) / 2, 1 + value(random) / 2)
                                : Vector3(1e-3 + std::abs(value(random)), 1, 10 + value(random));
    const Matrix3 exact = Q * P * stretch.asDiagonal() * P.transpose();
    double F[3][3], R[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) F[i][j] = exact(i, j);
    rotation_of(F, R);
    double off = 0, skew = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        off = std::max(off, std::abs(R[i][j] - Q(i, j)));
        skew = std::max(skew, std::abs(dot(R[i], R[j]) - (i == j)));
      }
    EXPECT_LT(off, n % 2 ? 4e-15 : 1e-12);
    EXPECT_LT(skew, 2e-15);
  }
}

/// Neither a collapse nor a reflection hangs; what lies beside it in the block is not disturbed.
TEST(Polar, WhatIsTurnedInsideOutIsNotANumber) {
  Pack F[3][3], R[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) F[i][j] = broadcast(i == j);
  F[2][2][1] = 0, F[2][2][2] = -1, F[0][0][3] = 1e-300, F[0][0][4] = 1e300;
  rotation_of(F, R);
  EXPECT_TRUE(std::isnan(R[0][0][1]));
  EXPECT_TRUE(std::isnan(R[0][0][2]));
  for (const int l : {0, 5, 6, 7})
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) EXPECT_EQ(R[i][j][l], i == j);
}

}  // namespace
}  // namespace geist::fe
