// Isotropic linear elasticity in small strains, and what formulations take and give.
//
//   σ = λ tr(L) 1 + μ (L + Lᵀ)      w = ½ λ tr(L)² + ½ μ |L + Lᵀ|²/2      L_ij = ∂u_i/∂x_j
#pragma once
#include "core/pack.hpp"

namespace geist::fe {

/// Constants of a region. λ, μ: Lamé's constants (stress); density (mass/length³); hourglass: dimensionless.
struct Parameters {
  double lambda = 0, mu = 0, density = 0, hourglass = 0;
};

/// Usual coefficient of hourglass control.
inline constexpr double default_hourglass_coefficient = 0.05;

/// Energy stored in an element: by its strain, and by hourglass control of the stiffness kind.
template <class T>
struct Stored {
  T strain, hourglass;
};

/// Stress σ from the displacement gradient L: both may be scaled by the same factor.
template <class T>
GEIST_INLINE void hooke(double lambda, double mu, const T (&L)[3][3], T (&sigma)[3][3]) {
  const T pressure = lambda * (L[0][0] + L[1][1] + L[2][2]);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    sigma[i][i] = fma(2 * mu, L[i][i], pressure);
    sigma[i][j] = sigma[j][i] = mu * (L[i][j] + L[j][i]);
  }
}

/// Strain energy per volume w.
template <class T>
GEIST_INLINE T energy_density(double lambda, double mu, const T (&L)[3][3]) {
  const T trace = L[0][0] + L[1][1] + L[2][2];
  T square = constant<T>(0);  // |sym L|²
  for (int i = 0; i < 3; ++i) {
    const T shear = L[i][(i + 1) % 3] + L[(i + 1) % 3][i];
    square = fma(L[i][i], L[i][i], fma(0.5 * shear, shear, square));
  }
  return fma(0.5 * lambda * trace, trace, mu * square);
}

}  // namespace geist::fe
