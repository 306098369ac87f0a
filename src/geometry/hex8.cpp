#include "geometry/hex8.hpp"

#include <algorithm>
#include <cmath>

namespace geist::hex8 {
namespace {

double longest_diagonal(const Corners& x) {
  const std::array<std::array<int, 2>, 4> ends{{{0, 6}, {1, 7}, {2, 4}, {3, 5}}};
  double longest = 0;
  for (const auto& [a, b] : ends) longest = std::max(longest, norm(x[b] - x[a]));
  return longest;
}

void copy(const Corners& x, double (&to)[8][3]) {
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t i = 0; i < 3; ++i) to[a][i] = x[a][i];
}

/// One Newton step from ξ, or nothing where the map is singular.
bool newton_step(const Corners& x, Vec3 residual, Vec3 xi, double scale, Vec3& step) {
  const Mat3 J = jacobian(x, xi);
  if (!(std::abs(det(J)) > 1e-12 * scale * scale * scale)) return false;
  step = inverse(J) * residual;
  return true;
}

/// Whether parallel edges are so nearly equal, and those that meet so far from one plane, that det J > 0
/// follows everywhere: the columns of J are means of parallel edges. Most elements are, and this is quickly
/// seen.
bool is_parallelepiped(const Corners& x) {
  const Vec3 a = x[1] - x[0], b = x[3] - x[0], c = x[4] - x[0];
  const auto equal = [](Vec3 edge, Vec3 other) {
    return dot(other - edge, other - edge) <= 1e-12 * dot(edge, edge);
  };
  return equal(a, x[2] - x[3]) && equal(a, x[5] - x[4]) && equal(a, x[6] - x[7]) &&  //
         equal(b, x[2] - x[1]) && equal(b, x[7] - x[4]) && equal(b, x[6] - x[5]) &&  //
         equal(c, x[5] - x[1]) && equal(c, x[6] - x[2]) && equal(c, x[7] - x[3]) &&
         dot(a, cross(b, c)) > 1e-3 * norm(a) * norm(b) * norm(c);
}

}  // namespace

Corners corners(const Mesh& mesh, std::size_t e) {
  Corners x;
  for (int a = 0; a < 8; ++a) x[a] = mesh.points[mesh.elements[e][a]];
  return x;
}

Vec3 map(const Corners& x, Vec3 xi) {
  const auto N = shape(xi);
  Vec3 p;
  for (int a = 0; a < 8; ++a) p += N[a] * x[a];
  return p;
}

Mat3 jacobian(const Corners& x, Vec3 xi) {
  const auto g = shape_gradient(xi);
  Mat3 J{};
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) J[i] += x[a][i] * g[a];
  return J;
}

std::array<Vec3, 8> position_gradient(const Corners& x, Vec3 xi) {
  const Mat3 inv = inverse(jacobian(x, xi));
  auto g = shape_gradient(xi);
  for (Vec3& a : g) a = a.x * inv[0] + a.y * inv[1] + a.z * inv[2];
  return g;
}

Inverse inverse_map(const Corners& x, Vec3 p, double tolerance) {
  constexpr int most_steps = 50, most_halvings = 12;
  const double scale = longest_diagonal(x);
  Vec3 xi, step;
  Vec3 residual = p - map(x, xi);
  for (int k = 0; k < most_steps; ++k) {
    const bool close = norm(residual) < tolerance * scale;
    if (!newton_step(x, residual, xi, scale, step)) return {xi, close};
    if (close) return {xi + step, true};
    double share = 1;  // of the step; less where a full one leads away from p
    Vec3 next = p - map(x, xi + step);
    for (int h = 0; h < most_halvings && !(norm(next) < norm(residual)); ++h) {
      share /= 2;
      next = p - map(x, xi + share * step);
    }
    if (!(norm(next) < norm(residual))) return {xi, false};
    xi += share * step;
    residual = next;
  }
  return {xi, false};
}

double smallest_determinant(const Corners& x) {
  double smallest = det(jacobian(x, corner_xi[0]));
  for (Vec3 s : corner_xi) smallest = std::min({smallest, det(jacobian(x, s)), det(jacobian(x, gauss * s))});
  return smallest;
}

bool valid(const Corners& x) { return is_parallelepiped(x) || smallest_determinant(x) > 0; }

std::array<double, 8> corner_volumes(const Corners& x) {
  double corner[8][3], volumes[8];
  copy(x, corner);
  corner_volumes(corner, volumes);
  return std::to_array(volumes);
}

double volume(const Corners& x) {
  double corner[8][3], v = 0;
  copy(x, corner);
  for (const GaussPoint& at : gauss_points) v += determinant(corner, at);
  return v;
}

}  // namespace geist::hex8
