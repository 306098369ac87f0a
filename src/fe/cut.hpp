// A hexahedron of which a part is left: docs/theory.md, "Every point counted once".
//
// With φ = V_left/V, L̄ the element's mean gradient and L the mean over what is left,
//
//   E = V_left w(L) + φ (E_whole − V w(L̄))       V_left L = Σ_a u_a ⊗ G_a,  G_a = ∫_left ∂N_a/∂x dV
//
// the constant part of the strain is integrated exactly over what is left, and of the rest, which no linear
// field stirs, the share φ is. So it passes the patch test whatever the formulation and the shape of the cut,
// and its energy is positive where the whole element's is.
#pragma once
#include "fe/hooke.hpp"
#include "fe/modes.hpp"
#include "model/mesh.hpp"

namespace geist::fe {

/// A formulation (fe/full.hpp) of eight elements that are cut.
template <class Formulation>
struct Cut {
  static constexpr bool uses_velocity = Formulation::uses_velocity;
  Formulation whole;
  const BlockCut& left;

  GEIST_INLINE Pack forces(const Corners<Pack>& X, const Corners<Pack>& u, const Corners<Pack>& v,
                           Corners<Pack>& f) const {
    const Pack power = whole.forces(X, u, v, f);
    const MeanGradient<Pack> m = mean_gradient(to_modes(X));
    const Pack share = left.volume * m.inverse_volume;
    Pack L[3][3], mean[3][3], sigma[3][3];
    mean_of_gradient(m, to_modes(u), L);
    hooke(whole.lambda, whole.mu, L, mean);
    gradient_left(u, L);
    hooke(whole.lambda, whole.mu, L, sigma);
    Modes<Pack> F{};  // of σ̄ over the whole element
    for (int k = 1; k < 7; ++k)
      for (int i = 0; i < 3; ++i) F[k][i] = dot(mean[i], m.g[k]);
    Corners<Pack> constant_part;
    to_corners(F, constant_part);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i)
        f[a][i] = fma(share, f[a][i] + constant_part[a][i], -dot(sigma[i], left.gradient[a]));
    return share * power;
  }

  GEIST_INLINE Stored<Pack> energy(const Corners<Pack>& X, const Corners<Pack>& u) const {
    const Stored<Pack> all = whole.energy(X, u);
    const MeanGradient<Pack> m = mean_gradient(to_modes(X));
    const Pack share = left.volume * m.inverse_volume;
    Pack L[3][3];
    mean_of_gradient(m, to_modes(u), L);
    const Pack rest = all.strain - m.volume * energy_density(whole.lambda, whole.mu, L);
    gradient_left(u, L);
    const Pack constant_part = left.volume * energy_density(whole.lambda, whole.mu, L);
    return {fma(share, rest, constant_part), share * all.hourglass};
  }

 private:
  GEIST_INLINE void gradient_left(const Corners<Pack>& u, Pack (&L)[3][3]) const {
    const Pack per_volume = 1.0 / left.volume;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Pack s = u[0][i] * left.gradient[0][j];
        for (int a = 1; a < 8; ++a) s = fma(u[a][i], left.gradient[a][j], s);
        L[i][j] = s * per_volume;
      }
  }
};

}  // namespace geist::fe
