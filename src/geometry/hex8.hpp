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

/// Reference positions of element e's corners.
Corners corners(const Mesh& mesh, std::size_t e);

/// Shape functions N_I at ξ (8).
std::array<double, 8> shape(Vec3 xi);

/// Their derivatives ∂N_I/∂ξ at ξ.
std::array<Vec3, 8> shape_gradient(Vec3 xi);

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

/// ∫ N_I dV over the element, exact: the corners' shares of the volume.
std::array<double, 8> corner_volumes(const Corners& x);

/// ∫ dV over the element, exact.
double volume(const Corners& x);

}  // namespace geist::hex8
