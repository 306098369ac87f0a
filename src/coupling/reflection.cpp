#include "coupling/reflection.hpp"

#include <cmath>
#include <complex>

#include <Eigen/Dense>

namespace geist::coupling {
namespace {

using Complex = std::complex<double>;

double modulus(const Material& m) { return m.lambda() + 2 * m.mu(); }

/// u_{n+1}/u_n of a wave that goes to growing n, or dies away there: m ω² = 2 k (1 − cos), cos = c.
Complex advance(double c) {
  if (std::abs(c) <= 1) return {c, -std::sqrt(1 - c * c)};
  return c - std::copysign(std::sqrt(c * c - 1), c);
}

}  // namespace

double reflected(const Side& hexahedra, const Side& lattice, double wavelength, bool consistent) {
  const double h = hexahedra.spacing, r = lattice.spacing / 2, rho = hexahedra.material.density;
  const double k_h = modulus(hexahedra.material) / h, k_d = modulus(lattice.material) / (2 * r);
  const double share = consistent ? 1 - r / h : 1, k_c = share * k_h, N_0 = 1 - r / h, N_h = r / h;
  const double m_0 = consistent ? rho * (h * h - r * r) / (2 * h) : rho * h / 2, m_h = 1.5 * rho * h - m_0;
  const double w2 = modulus(hexahedra.material) / rho * std::pow(2 * M_PI / wavelength, 2);
  const double m_d = lattice.material.density * 2 * r;
  const Complex e = advance(1 - w2 * rho * h / (2 * k_h)), f = advance(1 - w2 * m_d / (2 * k_d));
  // u_{−nh} = e^{1−n} + R e^{n−1}, u_0, u_{(2n+1)r} = T f^n: equations of motion at −h, 0 and r
  Eigen::Matrix3cd A;
  Eigen::Vector3cd b;
  const Complex at_h = w2 * m_h - k_h - k_c - N_h * N_h * k_d;
  A.row(0) << at_h + k_h * e, k_c - N_h * N_0 * k_d, N_h * k_d;
  A.row(1) << k_c - N_0 * N_h * k_d, w2 * m_0 - k_c - N_0 * N_0 * k_d, N_0 * k_d;
  A.row(2) << N_h * k_d, N_0 * k_d, w2 * m_d + k_d * (f - 2.0);
  b << -(at_h + k_h / e), -(k_c - N_0 * N_h * k_d), -N_h * k_d;
  return std::abs(Eigen::Vector3cd(A.partialPivLu().solve(b))(0));
}

double finest_wavelength(double spacing) { return M_PI * spacing / std::sqrt(6 * 0.01); }

}  // namespace geist::coupling
