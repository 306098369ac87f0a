// Each formulation against its definition, written out with matrices; the list and its names.
#include <gtest/gtest.h>

#include "support.hpp"

#include <Eigen/Eigenvalues>

namespace geist::fe {
namespace {

using namespace testing;

constexpr double lambda = steel_like.lambda, mu = steel_like.mu;

void expect_equal(const Matrix24& A, const Matrix24& B) { EXPECT_LT((A - B).norm(), 1e-14 * B.norm()); }

TEST(Formulations, FullIsGaussIntegration) {
  for (int seed = 0; seed < 5; ++seed) {
    const hex8::Corners x = distorted(seed);
    expect_equal(stiffness_matrix(Full(steel_like), to_array(x)), gauss_stiffness(x, lambda, mu));
  }
}

TEST(Formulations, SelectiveReducedIsGaussIntegrationOfMuAndTheMeanOfLambda) {
  for (int seed = 0; seed < 5; ++seed) {
    const hex8::Corners x = distorted(seed);
    expect_equal(stiffness_matrix(SelectiveReduced(steel_like), to_array(x)),
                 gauss_stiffness(x, 0, mu) + mean_stiffness(x, lambda, 0));
  }
}

TEST(Formulations, SelectiveReducedIsOnePointForLambdaOnParallelepipeds) {
  const hex8::Corners x = parallelepiped();
  const MatrixB B = strain_matrix(hex8::position_gradient(x, {0, 0, 0}));
  const Matrix24 centre = B.transpose() * elasticity(lambda, 0) * B * 8 * det(hex8::jacobian(x, {0, 0, 0}));
  expect_equal(stiffness_matrix(SelectiveReduced(steel_like), to_array(x)),
               gauss_stiffness(x, 0, mu) + centre);
}

TEST(Formulations, OnePointIsTheMeanAndHourglassControl) {
  for (int seed = 0; seed < 5; ++seed) {
    const hex8::Corners x = distorted(seed);
    const double S = 0.5 * steel_like.hourglass * (lambda + 2 * mu) * square_of_gradient(x) / hex8::volume(x);
    expect_equal(stiffness_matrix(OnePoint(steel_like), to_array(x)),
                 mean_stiffness(x, lambda, mu) + S * hourglass_patterns(x));
  }
}

TEST(Formulations, ViscousControlIsADashpot) {
  for (int seed = 0; seed < 5; ++seed) {
    const hex8::Corners x = distorted(seed);
    const double rho_c = std::sqrt(steel_like.density * (lambda + 2 * mu));
    const double S = 2 * steel_like.hourglass * rho_c * std::sqrt(2.0 / 3 * square_of_gradient(x));
    expect_equal(stiffness_matrix(OnePointViscous(steel_like), to_array(x)), mean_stiffness(x, lambda, mu));
    expect_equal(damping_matrix(OnePointViscous(steel_like), to_array(x)), S * hourglass_patterns(x));
  }
}

TEST(Formulations, WithoutControlTwelveMotionsAreFree) {
  Parameters bare = steel_like;
  bare.hourglass = 0;
  for (const hex8::Corners& x : {parallelepiped(), distorted(1)}) {
    const Matrix24 K = stiffness_matrix(OnePoint(bare), to_array(x));
    const auto values = Eigen::SelfAdjointEigenSolver<Matrix24>(K).eigenvalues();
    EXPECT_LT(std::abs(values(17)), 1e-13 * values(23));
    EXPECT_GT(values(18), 1e-2 * values(23));
    EXPECT_EQ(damping_matrix(OnePointViscous(bare), to_array(x)).norm(), 0);
  }
}

TEST(Formulations, NamesAreListedAndUnknownOnesRefused) {
  EXPECT_EQ(formulation_names(), "full, selective-reduced, assumed-strain, one-point, one-point-viscous");
  std::string seen;
  visit_formulation("one-point", steel_like, [&](auto f) { seen = decltype(f)::name; });
  EXPECT_EQ(seen, "one-point");
  try {
    visit_formulation("fulll", steel_like, [](auto) { FAIL(); });
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(std::string(e.what()), "unknown formulation 'fulll'; known: " + formulation_names());
  }
}

}  // namespace
}  // namespace geist::fe
