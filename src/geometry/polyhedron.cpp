#include "geometry/polyhedron.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/hex8.hpp"

namespace geist {
namespace {

Vec3 mean(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (const Vec3 p : points) sum += p;
  return sum * (1 / static_cast<double>(points.size()));
}

/// The part of a polygon in the half-space (Sutherland & Hodgman), and where its outline meets the plane.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const HalfSpace& half, double tolerance,
                          std::vector<Vec3>& on_plane) {
  std::vector<Vec3> kept;
  const auto height = [&](Vec3 p) { return dot(half.n, p) - half.offset; };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    const double h_a = height(a), h_b = height(b);
    if (h_a <= tolerance) kept.push_back(a);
    if (std::abs(h_a) <= tolerance) on_plane.push_back(a);
    if ((h_a < -tolerance && h_b > tolerance) || (h_a > tolerance && h_b < -tolerance)) {
      const Vec3 p = a + (h_a / (h_a - h_b)) * (b - a);
      kept.push_back(p), on_plane.push_back(p);
    }
  }
  return kept;
}

/// The convex polygon with these corners on a plane, in turn, each of them once.
std::vector<Vec3> outline(std::vector<Vec3> points, Vec3 n, double tolerance) {
  std::vector<Vec3> distinct;
  for (const Vec3 p : points)
    if (std::none_of(distinct.begin(), distinct.end(), [&](Vec3 q) { return norm(p - q) <= 2 * tolerance; }))
      distinct.push_back(p);
  if (distinct.size() < 3) return {};
  const Vec3 centre = mean(distinct), along = distinct[0] - centre, across = cross(n, along);
  std::sort(distinct.begin(), distinct.end(), [&](Vec3 a, Vec3 b) {
    const auto angle = [&](Vec3 p) { return std::atan2(dot(p - centre, across), dot(p - centre, along)); };
    return angle(a) < angle(b);
  });
  return distinct;
}

/// Appends the four points of the tetrahedron (a, b, c, d).
void add_tetrahedron(std::array<Vec3, 4> corner, std::vector<WeightedPoint>& points) {
  constexpr double near = 0.58541019662496845446, far = 0.13819660112501051518;  // (5 ± …√5)/20
  const double volume =
      std::abs(dot(corner[1] - corner[0], cross(corner[2] - corner[0], corner[3] - corner[0]))) / 6;
  const Vec3 sum = corner[0] + corner[1] + corner[2] + corner[3];
  for (const Vec3 p : corner) points.push_back({far * sum + (near - far) * p, volume / 4});
}

}  // namespace

ConvexPolyhedron::ConvexPolyhedron(const Box& b) {
  const auto corner = [&](int i, int j, int k) {
    return Vec3{(i ? b.high : b.low).x, (j ? b.high : b.low).y, (k ? b.high : b.low).z};
  };
  for (const int s : {0, 1}) {
    faces_.push_back({corner(s, 0, 0), corner(s, 1, 0), corner(s, 1, 1), corner(s, 0, 1)});
    faces_.push_back({corner(0, s, 0), corner(0, s, 1), corner(1, s, 1), corner(1, s, 0)});
    faces_.push_back({corner(0, 0, s), corner(1, 0, s), corner(1, 1, s), corner(0, 1, s)});
  }
}

void ConvexPolyhedron::cut(const HalfSpace& half, double tolerance) {
  double lowest = 0, highest = 0;
  for (const auto& face : faces_)
    for (const Vec3 p : face) {
      const double height = dot(half.n, p) - half.offset;
      lowest = std::min(lowest, height), highest = std::max(highest, height);
    }
  if (highest <= tolerance) return;
  if (lowest >= -tolerance) return faces_.clear();
  std::vector<std::vector<Vec3>> left;
  std::vector<Vec3> on_plane;
  for (const auto& face : faces_)
    if (auto kept = clipped(face, half, tolerance, on_plane); kept.size() >= 3)
      left.push_back(std::move(kept));
  if (auto lid = outline(on_plane, half.n, tolerance); lid.size() >= 3) left.push_back(std::move(lid));
  faces_ = std::move(left);
}

std::vector<WeightedPoint> ConvexPolyhedron::quadrature() const {
  std::vector<Vec3> corners;
  for (const auto& face : faces_) corners.insert(corners.end(), face.begin(), face.end());
  std::vector<WeightedPoint> points;
  if (corners.empty()) return points;
  const Vec3 inside = mean(corners);
  for (const auto& face : faces_)
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      add_tetrahedron({inside, face[0], face[k], face[k + 1]}, points);
  return points;
}

std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const HalfSpace& half, double tolerance) {
  std::vector<Vec3> on_plane;
  auto kept = clipped(polygon, half, tolerance, on_plane);
  return kept.size() < 3 ? std::vector<Vec3>{} : kept;
}

/// The middles of the sides of every triangle between the first corner and a side.
std::vector<WeightedPoint> quadrature(const std::vector<Vec3>& polygon) {
  std::vector<WeightedPoint> points;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vec3 a = polygon[0], b = polygon[k], c = polygon[k + 1];
    const double area = norm(cross(b - a, c - a)) / 2;
    for (const Vec3 p : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}) points.push_back({p, area / 3});
  }
  return points;
}

std::array<WeightedPoint, 8> quadrature(const Box& box) {
  const Vec3 centre = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  std::array<WeightedPoint, 8> points;
  for (int k = 0; k < 8; ++k) {
    const Vec3 s = hex8::gauss * hex8::corner_xi[k];
    points[k] = {centre + Vec3{s.x * half.x, s.y * half.y, s.z * half.z}, half.x * half.y * half.z};
  }
  return points;
}

}  // namespace geist
