// A step turns a particle by ψ = Δt ω: R ← Q R. With τ along ψ and |τ| = tan(|ψ|/2)
//
//   Q = I + 2/(1 + τ²) (τ× + τ× τ×)                                             (Cayley, Rodrigues)
//
// is a rotation about ψ whatever |τ| is; the tangent's series is that of Q = exp(ψ×) to round-off for |ψ| up
// to 0.03, and it needs no function whose bits differ between libraries. Fields hold H = R − I, so the step
// is H ← H + (Q − I)(I + H).
//
// Rounding makes R lose its right angles; one Newton step towards the nearest rotation, R ← R − ½ R A with
// A = RᵀR − I = H + Hᵀ + HᵀH (Björck and Bowie 1971), takes that back and turns nothing.
#include "de/rotation.hpp"

#include <cmath>

#include "core/parallel.hpp"
#include "core/triple.hpp"

namespace geist::de {
namespace {

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

struct TurnKernel {
  const double* omega[3];
  double* H[9];
  double dt;

  void operator()(std::size_t pack) const {
    const std::size_t s = lanes * pack;
    Pack psi[3], h[3][3];
    for (int a = 0; a < 3; ++a) psi[a] = dt * load(omega[a] + s);
    for (int k = 0; k < 9; ++k) h[k / 3][k % 3] = load(H[k] + s);
    turn_by(psi, h), orthonormalise(h);
    for (int k = 0; k < 9; ++k) store(H[k] + s, h[k / 3][k % 3]);
  }
};

/// Where cos α < 0, the axis is better known from R + Rᵀ = 2 cos α I + 2 (1 − cos α) n nᵀ; of its columns the
/// longest, on the side of `about`.
Vec3 axis_of(const Mat3& R, double cosine, Vec3 about) {
  Vec3 longest;
  for (std::size_t c = 0; c < 3; ++c) {
    Vec3 column;
    for (std::size_t a = 0; a < 3; ++a) column[a] = R[a][c] + R[c][a] - (a == c ? 2 * cosine : 0);
    if (dot(column, column) > dot(longest, longest)) longest = column;
  }
  return (dot(longest, about) < 0 ? -1 : 1) / norm(longest) * longest;
}

}  // namespace

void turn(Lattice& lattice, double dt) {
  TurnKernel kernel;
  for (int a = 0; a < 3; ++a) kernel.omega[a] = lattice.velocity[3 + a];
  for (int k = 0; k < 9; ++k) kernel.H[k] = lattice.rotation[k];
  kernel.dt = dt;
  for_each(lattice.grid.size() / lanes, kernel, 512);
}

Mat3 rotation_matrix(const Lattice& lattice, std::size_t s) {
  Mat3 R;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t a = 0; a < 3; ++a)
      R[a][c] = lattice.rotation[static_cast<int>(3 * c + a)][s] + (a == c ? 1 : 0);
  return R;
}

Vec3 rotation_vector(const Lattice& lattice, std::size_t s) {
  if (lattice.kinematics == Kinematics::small) return lattice.motion.vector(s, 3);
  const auto H = [&](int a, int c) { return lattice.rotation[3 * c + a][s]; };
  const Vec3 about = 0.5 * Vec3{H(2, 1) - H(1, 2), H(0, 2) - H(2, 0), H(1, 0) - H(0, 1)};  // n sin α
  const double cosine = 1 + 0.5 * (H(0, 0) + H(1, 1) + H(2, 2)), sine = norm(about);
  const double angle = std::atan2(sine, cosine);
  if (cosine < 0) return angle * axis_of(rotation_matrix(lattice, s), cosine, about);
  return sine > 0 ? angle / sine * about : Vec3{};
}

}  // namespace geist::de
