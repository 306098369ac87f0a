// Eight-node hexahedron: shape functions, the isoparametric map and its inverse, volumes. Equations (7)–(12).
//
//   x(ξ) = Σ_I N_I(ξ) x_I                                       (7)
//   N_I(ξ) = ⅛ (1 + ξ_I ξ)(1 + η_I η)(1 + ζ_I ζ)                (8), corners numbered as in model/mesh.hpp
//   J_ij = ∂x_i/∂ξ_j
//   ξ ← ξ + J⁻¹ (x − x(ξ))   until ‖x(ξ) − x‖ is small          (9)–(12), Newton
//
// Natural coordinates ξ = (ξ, η, ζ) lie in [−1, 1]³ inside the element; lengths are in the case's unit.
#pragma once
#include <array>
#include <cstddef>

#include "core/pack.hpp"
#include "core/vec.hpp"
#include "model/mesh.hpp"

namespace geist::hex8 {

/// Positions of the eight corners.
using Corners = std::array<Vec3, 8>;

/// Natural coordinates of the corners, each ±1.
inline constexpr Corners corner_xi{{{-1, -1, -1},
                                    {1, -1, -1},
                                    {1, 1, -1},
                                    {-1, 1, -1},  //
                                    {-1, -1, 1},
                                    {1, -1, 1},
                                    {1, 1, 1},
                                    {-1, 1, 1}}};

/// The 2 × 2 × 2 Gauss points (each of weight 1) are corner_xi times this, 1/√3.
inline constexpr double gauss = 0.57735026918962576451;

/// N_I and ∂N_I/∂ξ at a Gauss point.
struct GaussPoint {
  std::array<double, 8> N;
  std::array<Vec3, 8> gradient;
};

/// Reference positions of element e's corners.
Corners corners(const Mesh& mesh, std::size_t e);

/// Shape functions N_I at ξ (8).
constexpr std::array<double, 8> shape(Vec3 xi) {
  std::array<double, 8> N{};
  for (std::size_t a = 0; a < 8; ++a) {
    const Vec3 s = corner_xi[a];
    N[a] = (1 + s.x * xi.x) * (1 + s.y * xi.y) * (1 + s.z * xi.z) / 8;
  }
  return N;
}

/// Their derivatives ∂N_I/∂ξ at ξ.
constexpr std::array<Vec3, 8> shape_gradient(Vec3 xi) {
  std::array<Vec3, 8> g{};
  for (std::size_t a = 0; a < 8; ++a) {
    const Vec3 s = corner_xi[a];
    const double p = 1 + s.x * xi.x, q = 1 + s.y * xi.y, r = 1 + s.z * xi.z;
    g[a] = {s.x * q * r / 8, p * s.y * r / 8, p * q * s.z / 8};
  }
  return g;
}

/// Position x(ξ) (7).
Vec3 map(const Corners& x, Vec3 xi);

/// J_ij = ∂x_i/∂ξ_j at ξ.
Mat3 jacobian(const Corners& x, Vec3 xi);

/// Derivatives with respect to position, ∂N_I/∂x at ξ; the element must be valid there.
std::array<Vec3, 8> position_gradient(const Corners& x, Vec3 xi);

/// What the inverse map found: natural coordinates, meaningful only if converged.
struct Inverse {
  Vec3 xi;
  bool converged = false;
};

/// Natural coordinates of position p by Newton's method (9)–(12), from the centre of the element. Converged
/// means ‖x(ξ) − p‖ < tolerance × the element's longest diagonal, followed by one more step, so that in
/// effect ξ is exact to rounding; the paper divides by ‖x‖, which depends on where the origin is. Points
/// outside are found too, as long as the map is regular out to them; far ones may be reported as not
/// converged.
Inverse inverse_map(const Corners& x, Vec3 p, double tolerance = 1e-7);

/// Whether natural coordinates lie in the element, or outside it by no more than `tolerance`.
constexpr bool contains(Vec3 xi, double tolerance = 1e-9) {
  const auto inside = [tolerance](double a) { return a >= -1 - tolerance && a <= 1 + tolerance; };
  return inside(xi.x) && inside(xi.y) && inside(xi.z);
}

/// Smallest det J over the corners and the Gauss points.
double smallest_determinant(const Corners& x);

/// Whether the element can be computed with: det J > 0 at all corners and Gauss points.
bool valid(const Corners& x);

/// The eight Gauss points, in the order of corner_xi.
inline constexpr std::array<GaussPoint, 8> gauss_points = [] {
  std::array<GaussPoint, 8> points{};
  for (std::size_t g = 0; g < 8; ++g)
    points[g] = {shape(gauss * corner_xi[g]), shape_gradient(gauss * corner_xi[g])};
  return points;
}();

/// det J at a Gauss point of an element, or of eight (T = Pack), with corners x[a][i].
template <class T>
GEIST_INLINE T determinant(const T (&x)[8][3], const GaussPoint& at) {
  T J[3][3];
  for (int i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) J[i][j] = x[0][i] * at.gradient[0][j];
  for (std::size_t a = 1; a < 8; ++a)
    for (int i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) J[i][j] += x[a][i] * at.gradient[a][j];
  return J[0][0] * (J[1][1] * J[2][2] - J[1][2] * J[2][1]) +
         J[0][1] * (J[1][2] * J[2][0] - J[1][0] * J[2][2]) +
         J[0][2] * (J[1][0] * J[2][1] - J[1][1] * J[2][0]);
}

/// ∫ N_I dV over the element, or eight of them, exact: the corners' shares of the volume.
template <class T>
GEIST_INLINE void corner_volumes(const T (&x)[8][3], T (&volumes)[8]) {
  for (T& v : volumes) v = T{};
  for (const GaussPoint& at : gauss_points) {
    const T dV = determinant(x, at);
    for (std::size_t a = 0; a < 8; ++a) volumes[a] += at.N[a] * dV;
  }
}
std::array<double, 8> corner_volumes(const Corners& x);

/// ∫ dV over the element, exact.
double volume(const Corners& x);

}  // namespace geist::hex8
