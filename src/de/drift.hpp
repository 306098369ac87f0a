// The drift: how a step moves and turns particles, eight sites at a time.
//
//   u ← u + Δt v,   θ ← θ + Δt ω,   or with finite rotations  R ← Q R,  Q about ψ = Δt ω
//
// With τ along ψ and |τ| = tan(|ψ|/2)
//
//   Q = I + 2/(1 + τ²) (τ× + τ× τ×)                                             (Cayley, Rodrigues)
//
// is a rotation about ψ whatever |τ| is; the tangent's series is that of Q = exp(ψ×) to round-off for |ψ| up
// to 0.03, and it needs no function whose bits differ between libraries. Fields hold H = R − I, so the step
// is H ← H + (Q − I)(I + H).
//
// Rounding makes R lose its right angles; one Newton step towards the nearest rotation, R ← R − ½ R A with
// A = RᵀR − I = H + Hᵀ + HᵀH (Björck and Bowie 1971), takes that back and turns nothing.
#pragma once
#include <cstddef>
#include <cstdint>

#include "core/pack.hpp"
#include "core/triple.hpp"
#include "model/lattice.hpp"

namespace geist::de {

/// H ← H + (exp(ψ×) − I)(I + H)
template <class T>
GEIST_INLINE void turn_by(const T (&psi)[3], T (&H)[3][3]) {
  const T x = fma(psi[2], psi[2], fma(psi[1], psi[1], psi[0] * psi[0]));
  const T series =
      fma(x, fma(x, fma(x, constant<T>(17.0 / 40320), constant<T>(1.0 / 240)), constant<T>(1.0 / 24)),
          constant<T>(0.5));  // tan(|ψ|/2) / |ψ|
  const T tau[3] = {series * psi[0], series * psi[1], series * psi[2]};
  const T scale = 2.0 / fma(series * series, x, constant<T>(1));
  for (int c = 0; c < 3; ++c) {
    T column[3] = {H[c][0], H[c][1], H[c][2]}, once[3], twice[3];
    column[c] = column[c] + 1.0;
    cross(tau, column, once), cross(tau, once, twice);
    for (int a = 0; a < 3; ++a) H[c][a] = fma(scale, once[a] + twice[a], H[c][a]);
  }
}

/// H ← H − ½ (I + H) A
template <class T>
GEIST_INLINE void orthonormalise(T (&H)[3][3]) {
  T A[3][3];
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b <= c; ++b) {
      A[c][b] = fma(H[c][2], H[b][2], fma(H[c][1], H[b][1], fma(H[c][0], H[b][0], H[c][b] + H[b][c])));
      A[c][b] = A[b][c] = -0.5 * A[c][b];
    }
  for (int a = 0; a < 3; ++a) {
    const T row[3] = {H[0][a], H[1][a], H[2][a]};
    for (int c = 0; c < 3; ++c)
      H[c][a] = row[c] + fma(row[2], A[2][c], fma(row[1], A[1][c], fma(row[0], A[0][c], A[a][c])));
  }
}

/// The first n components of motion of the eight sites at s.
template <int n>
struct Shift {
  double* x[n];
  const double* v[n];
  double dt;

  Shift(Lattice& lattice, double dt_) : dt(dt_) {
    for (int c = 0; c < n; ++c) x[c] = lattice.motion[c], v[c] = lattice.velocity[c];
  }
  GEIST_INLINE void operator()(std::size_t s) const {
    for (int c = 0; c < n; ++c) store(x[c] + s, fma(dt, load(v[c] + s), load(x[c] + s)));
  }
};

/// Their rotations, but for those of ghosts that turn with the continuum: these keep what they have been
/// given, as the Newton step would change its last digits.
struct Turn {
  const double* omega[3];
  double* H[9];
  const std::uint32_t* word;
  std::uint32_t led;
  double dt;

  Turn(Lattice& lattice, double dt_)
      : word(lattice.word.data()),
        led(lattice.ghost_rotation == GhostRotation::continuum ? site::ghost : 0),
        dt(dt_) {
    for (int a = 0; a < 3; ++a) omega[a] = lattice.velocity[3 + a];
    for (int k = 0; k < 9; ++k) H[k] = lattice.rotation[k];
  }
  GEIST_INLINE void operator()(std::size_t s) const {
    Pack psi[3], h[3][3];
    for (int a = 0; a < 3; ++a) psi[a] = dt * load(omega[a] + s);
    for (int k = 0; k < 9; ++k) h[k / 3][k % 3] = load(H[k] + s);
    turn_by(psi, h), orthonormalise(h);
    const PackInt keep = (load(word + s) & led) != 0;
    for (int k = 0; k < 9; ++k) store(H[k] + s, select(keep, load(H[k] + s), h[k / 3][k % 3]));
  }
};

using SmallDrift = Shift<6>;

struct FiniteDrift {
  Shift<3> shift;
  Turn turn;

  FiniteDrift(Lattice& lattice, double dt) : shift(lattice, dt), turn(lattice, dt) {}
  GEIST_INLINE void operator()(std::size_t s) const { shift(s), turn(s); }
};

}  // namespace geist::de
