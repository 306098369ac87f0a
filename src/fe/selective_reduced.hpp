// Selective-reduced integration: μ-part of the energy at 2 × 2 × 2 Gauss points, λ-part with the mean
// dilatation,
//
//   E = Σ_points μ |sym ∂u/∂x|² dV + ½ λ θ² V,      θ = mean of div u = (1/V) Σ_k û_k · g_k
//
// On a parallelepiped θ is the dilatation at the centre, and the λ-part that of one-point integration, as in
// the journal paper's beam. On other elements the value at the centre is not the mean, and an element that
// uses it fails the patch test; the mean (exact, by the same 2 × 2 × 2 points or in closed form, modes.hpp)
// passes it always. No volumetric locking for ν → ½.
#pragma once
#include <string_view>

#include "fe/gauss.hpp"

namespace geist::fe {

struct SelectiveReduced {
  static constexpr std::string_view name = "selective-reduced";
  static constexpr bool uses_velocity = false;
  double lambda, mu;

  explicit SelectiveReduced(const Parameters& p) : lambda(p.lambda), mu(p.mu) {}

  template <class T>
  GEIST_INLINE T forces(const Corners<T>& X, const Corners<T>& u, const Corners<T>&, Corners<T>& f) const {
    const Modes<T> x = to_modes(X), w = to_modes(u);
    const MeanGradient<T> m = mean_gradient(x);
    const T pressure = -lambda * m.inverse_volume * dilatation(m, w);
    Modes<T> F;
    for (int i = 0; i < 3; ++i) {
      for (int k = 1; k < 7; ++k) F[k][i] = pressure * m.g[k][i];
      F[7][i] = constant<T>(0);
    }
    add_gauss_forces(0, mu, x, w, F);
    to_corners(F, f);
    return constant<T>(0);
  }

  template <class T>
  GEIST_INLINE Stored<T> energy(const Corners<T>& X, const Corners<T>& u) const {
    const Modes<T> x = to_modes(X), w = to_modes(u);
    const MeanGradient<T> m = mean_gradient(x);
    const T change = dilatation(m, w);
    return {gauss_energy(0, mu, x, w) + 0.5 * lambda * change * change * m.inverse_volume, constant<T>(0)};
  }

 private:
  /// ∫ div u dV = V θ.
  template <class T>
  static GEIST_INLINE T dilatation(const MeanGradient<T>& m, const Modes<T>& u) {
    T change = dot(u[1], m.g[1]);
    for (int k = 2; k < 7; ++k) change = change + dot(u[k], m.g[k]);
    return change;
  }
};

}  // namespace geist::fe
