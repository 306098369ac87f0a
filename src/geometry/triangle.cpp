#include "geometry/triangle.hpp"

namespace geist {
namespace {

NearestPoint at(Vec3 a, Vec3 b, Vec3 c, std::array<double, 3> weight, Feature feature) {
  return {weight[0] * a + weight[1] * b + weight[2] * c, weight, feature};
}

}  // namespace

NearestPoint nearest_point(Vec3 x, Vec3 a, Vec3 b, Vec3 c) {
  using enum Feature;
  const Vec3 ab = b - a, ac = c - a;
  const double d1 = dot(ab, x - a), d2 = dot(ac, x - a);
  if (d1 <= 0 && d2 <= 0) return {a, {1, 0, 0}, corner_a};
  const double d3 = dot(ab, x - b), d4 = dot(ac, x - b);
  if (d3 >= 0 && d4 <= d3) return {b, {0, 1, 0}, corner_b};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return at(a, b, c, {1 - v, v, 0}, edge_ab);
  }
  const double d5 = dot(ab, x - c), d6 = dot(ac, x - c);
  if (d6 >= 0 && d5 <= d6) return {c, {0, 0, 1}, corner_c};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return at(a, b, c, {1 - w, 0, w}, edge_ca);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return at(a, b, c, {0, 1 - w, w}, edge_bc);
  }
  const double v = vb / (va + vb + vc), w = vc / (va + vb + vc);
  return at(a, b, c, {1 - v - w, v, w}, face);
}

}  // namespace geist
