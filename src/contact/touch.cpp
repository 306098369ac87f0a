#include "contact/touch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/triangle.hpp"

namespace geist::contact {
namespace {

constexpr int most_points = 12;

/// The nearest point of one triangle.
struct Nearest {
  NearestPoint point;
  double distance;
  std::int32_t facet;
  int k;   ///< triangle
  Vec3 n;  ///< its unit normal
  Vec3 away() const { return away_; }
  Vec3 away_;  ///< from the point to the contactor
};

/// Nodes lie on a facet's plane beside it by round-off where bodies lie flush; this share of the facet's size
/// is let pass.
constexpr double beside = 0.02;

/// Directions that are not descents to within rounding.
constexpr double level = 1e-10;

/// Whether the distance falls in direction t from where `away` was measured.
bool falls(Vec3 away, Vec3 t) { return dot(away, t) > level * norm(away) * norm(t); }

/// The part of b − a that is orthogonal to edge e.
Vec3 across_edge(Vec3 a, Vec3 b, Vec3 e) { return (b - a) - (dot(b - a, e) / dot(e, e)) * e; }

/// Whether a contactor is as near to the plane of triangle k as it must be to touch it.
bool near_plane(const FacetPoints& at, int k, const Probing& probe, double reach) {
  const Vec3 normal = triangle_normal(at, k);
  const double height = dot(probe.x - at.centre, normal);  // times twice the area
  const double most = height > 0 ? probe.radius : reach;
  return most > 0 && height * height < most * most * dot(normal, normal);
}

/// Examines the triangles of one body around one contactor.
class Examiner {
 public:
  Examiner(const Surface& surface, const Field<3>& x, const Probing& probe)
      : surface_(surface), x_(x), probe_(probe) {}

  Touch examine(std::span<const std::int32_t> facets) {
    for (const std::int32_t f : facets) visit(f);
    if (count_ == 0) return {};
    const Nearest& nearest =
        *std::min_element(found_.begin(), found_.begin() + count_,
                          [](const Nearest& a, const Nearest& b) { return a.distance < b.distance; });
    if (probe_.radius == 0) return node_touch(nearest);
    return inside(nearest) ? deep_touch(nearest) : outside_touch();
  }

 private:
  void visit(std::int32_t f) {
    const SurfaceFacet& facet = surface_.facets[f];
    for (const std::int32_t corner : facet.corner)
      if (corner == probe_.node) return;
    const double reach = own_body(facet) ? std::min(probe_.reach, facet.depth) : probe_.reach;
    const FacetPoints at = points_of(facet, x_);
    for (int k = 0; k < 4; ++k) {
      if (!near_plane(at, k, probe_, reach)) continue;
      const Vec3 normal = triangle_normal(at, k);
      const double twice_area = norm(normal);
      const double towards = dot(normal, probe_.outward);
      if (probe_.radius == 0 && towards >= facing * twice_area * norm(probe_.outward)) continue;
      keep(f, k, (1 / twice_area) * normal, at);
    }
  }

  /// A node lies behind the far side of its own body, by all of an element where that is one element thick.
  bool own_body(const SurfaceFacet& facet) const {
    if (probe_.node < 0) return false;
    return surface_.facets[surface_.around[surface_.around_begin[probe_.node]] / 4].body == facet.body;
  }

  void keep(std::int32_t f, int k, Vec3 n, const FacetPoints& at) {
    Nearest found{nearest_point(probe_.x, at.corner[k], at.corner[(k + 1) % 4], at.centre), 0, f, k, n, {}};
    found.away_ = probe_.x - found.point.p;
    found.distance = norm(found.away());
    if (found.distance >= std::max(probe_.radius, probe_.reach)) return;
    if (count_ == most_points && probe_.radius > 0) keep_minima();
    if (count_ < most_points) {
      found_[count_++] = found;
      return;
    }
    Nearest& farthest =
        *std::max_element(found_.begin(), found_.end(),
                          [](const Nearest& a, const Nearest& b) { return a.distance < b.distance; });
    if (found.distance < farthest.distance) farthest = found;
  }

  /// Where facets are small, most triangles that a sphere reaches carry nothing: only a flank that does
  /// counts.
  void keep_minima() {
    const auto end = std::remove_if(found_.begin(), found_.begin() + count_,
                                    [this](const Nearest& a) { return !local_minimum(a); });
    count_ = static_cast<int>(end - found_.begin());
  }

  /// Whether no point of the surface beside this one is nearer, so that it is a contact of its own.
  bool local_minimum(const Nearest& a) const {
    const SurfaceFacet& facet = surface_.facets[a.facet];
    const FacetPoints at = points_of(facet, x_);
    const int k = a.k;
    const auto corner = [&](int i) { return at.corner[(i + 4) % 4]; };
    switch (a.point.feature) {
      case Feature::face:
        return true;
      case Feature::edge_ab: {
        if (facet.across[k] < 0) return true;
        const Vec3 other = points_of(surface_.facets[facet.across[k]], x_).centre;
        return !falls(a.away(), across_edge(corner(k), other, corner(k + 1) - corner(k)));
      }
      case Feature::edge_bc:
        return !falls(a.away(), across_edge(at.centre, corner(k + 2), corner(k + 1) - at.centre));
      case Feature::edge_ca:
        return !falls(a.away(), across_edge(at.centre, corner(k - 1), corner(k) - at.centre));
      case Feature::corner_c:
        return std::none_of(at.corner.begin(), at.corner.end(),
                            [&](Vec3 p) { return falls(a.away(), p - at.centre); });
      case Feature::corner_a:
        return minimum_at_node(a, facet.corner[k]);
      case Feature::corner_b:
        return minimum_at_node(a, facet.corner[(k + 1) % 4]);
    }
    return true;
  }

  bool minimum_at_node(const Nearest& a, std::int32_t node) const {
    const Vec3 p = x_.vector(node);
    for (std::int32_t s = surface_.around_begin[node]; s < surface_.around_begin[node + 1]; ++s) {
      const FacetPoints at = points_of(surface_.facets[surface_.around[s] / 4], x_);
      const int k = surface_.around[s] % 4;
      for (const Vec3 q : {at.corner[(k + 1) % 4], at.corner[(k + 3) % 4], at.centre})
        if (falls(a.away(), q - p)) return false;
    }
    return true;
  }

  /// Whether the surface ends here: what lies beyond is no deeper inside than anything else there.
  bool on_border(const Nearest& a) const {
    const SurfaceFacet& facet = surface_.facets[a.facet];
    if (a.point.feature == Feature::edge_ab) return facet.across[a.k] < 0;
    if (a.point.feature != Feature::corner_a && a.point.feature != Feature::corner_b) return false;
    const std::int32_t node = facet.corner[(a.k + (a.point.feature == Feature::corner_b)) % 4];
    const auto ends = [this](std::int32_t s) {
      const SurfaceFacet& around = surface_.facets[s / 4];
      return around.across[s % 4] < 0 || around.across[(s + 3) % 4] < 0;
    };
    return std::any_of(surface_.around.begin() + surface_.around_begin[node],
                       surface_.around.begin() + surface_.around_begin[node + 1], ends);
  }

  /// The surface's normal at a nearest point, which tells inside from outside.
  Vec3 normal_at(const Nearest& a) const {
    const SurfaceFacet& facet = surface_.facets[a.facet];
    const FacetPoints at = points_of(facet, x_);
    const auto unit = [&](const FacetPoints& points, int k) {
      const Vec3 n = triangle_normal(points, (k + 4) % 4);
      return (1 / norm(n)) * n;
    };
    switch (a.point.feature) {
      case Feature::face:
        return a.n;
      case Feature::edge_ab: {
        if (facet.across[a.k] < 0) return a.n;
        const SurfaceFacet& other = surface_.facets[facet.across[a.k]];
        const auto from = std::find(other.corner.begin(), other.corner.end(), facet.corner[(a.k + 1) % 4]);
        return a.n + unit(points_of(other, x_), static_cast<int>(from - other.corner.begin()));
      }
      case Feature::edge_bc:
        return a.n + unit(at, a.k + 1);
      case Feature::edge_ca:
        return a.n + unit(at, a.k - 1);
      case Feature::corner_c:
        return unit(at, 0) + unit(at, 1) + unit(at, 2) + unit(at, 3);
      case Feature::corner_a:
        return node_normal(surface_, x_, facet.corner[a.k]);
      case Feature::corner_b:
        return node_normal(surface_, x_, facet.corner[(a.k + 1) % 4]);
    }
    return a.n;
  }

  bool inside(const Nearest& a) const { return dot(a.away(), normal_at(a)) < 0; }

  TouchPoint make_point(const Nearest& a, Vec3 n, double overlap) const {
    const auto& w = a.point.weight;
    TouchPoint t{a.facet, {}, a.point.p, n, overlap, overlap};
    t.weight.fill(0.25 * w[2]);
    t.weight[a.k] += w[0], t.weight[(a.k + 1) % 4] += w[1];
    return t;
  }

  static Touch single(const TouchPoint& point) { return {1, {point}, point.overlap, point.n}; }

  /// A sphere whose centre has not passed the surface: every local minimum of the distance pushes.
  Touch outside_touch() const {
    std::array<TouchPoint, most_points> points;
    std::size_t n = 0;
    for (int i = 0; i < count_; ++i)
      if (const Nearest& a = found_[i]; a.distance < probe_.radius && local_minimum(a)) {
        const Vec3 normal = a.distance > 1e-12 * probe_.radius ? (1 / a.distance) * a.away() : a.n;
        points[n++] = make_point(a, normal, probe_.radius - a.distance);
      }
    return shortest_way_out({points.data(), n});
  }

  /// A sphere whose centre has passed the surface: back to the nearest point of it.
  Touch deep_touch(const Nearest& a) const {
    const Vec3 normal = a.distance > 1e-12 * probe_.radius ? (-1 / a.distance) * a.away() : a.n;
    return single(make_point(a, normal, probe_.radius + a.distance));
  }

  /// A node behind the surface that faces it.
  Touch node_touch(const Nearest& a) const {
    const double depth = -dot(a.away(), a.n);
    if (depth <= 0) return {};
    const Vec3 sideways = a.away() + depth * a.n;
    if (a.point.feature == Feature::face) return single(make_point(a, a.n, depth));
    if (local_minimum(a) && inside(a) && !on_border(a))
      return single(make_point(a, (-1 / a.distance) * a.away(), a.distance));
    const bool on_plane = norm(sideways) <= beside * std::sqrt(surface_.facets[a.facet].area);
    return on_plane ? single(make_point(a, a.n, depth)) : Touch{};
  }

  const Surface& surface_;
  const Field<3>& x_;
  const Probing& probe_;
  std::array<Nearest, most_points> found_;
  int count_ = 0;
};

/// Displacement Σ λ_i n_i that just meets the half-spaces `active` (one to three of them), if all λ are
/// positive.
class WayOut {
 public:
  explicit WayOut(std::span<const TouchPoint> points) : points_(points) {}

  bool solve(std::initializer_list<std::size_t> active) {
    const std::size_t n = active.size();
    index_.assign(active);
    if (n == 1) lambda_ = {point(0).overlap, 0, 0};
    if (n == 2 && !solve_two()) return false;
    if (n == 3 && !solve_three()) return false;
    for (std::size_t i = 0; i < n; ++i)
      if (!(lambda_[i] > 0)) return false;
    return leads_out(n);
  }

  Touch result(std::size_t n) const {
    Touch t;
    Vec3 d;
    for (std::size_t i = 0; i < n; ++i) {
      t.point[t.count] = points_[index_[i]], t.point[t.count++].lambda = lambda_[i];
      d += lambda_[i] * points_[index_[i]].n;
    }
    t.overlap = norm(d), t.normal = (1 / t.overlap) * d;
    return t;
  }

 private:
  struct Indices {
    std::array<std::size_t, 3> i{};
    void assign(std::initializer_list<std::size_t> list) { std::copy(list.begin(), list.end(), i.begin()); }
    std::size_t operator[](std::size_t k) const { return i[k]; }
  };

  const TouchPoint& point(std::size_t i) const { return points_[index_[i]]; }

  /// By differences of the normals, e = n_2 − n_1 (e·n_1 = −|e|²/2), so that nothing cancels where they are
  /// nearly parallel.
  bool solve_two() {
    const Vec3 e = point(1).n - point(0).n;
    const double along = -0.5 * dot(e, e), across = dot(e, e) - along * along;
    if (across < 1e-9) return false;
    const double delta = point(0).overlap;
    const double t = (point(1).overlap - delta - delta * along) / across;
    lambda_ = {delta - t * (1 + along), t, 0};
    return true;
  }

  /// The same for three: d solves n_1·d = δ_1, e_2·d = δ_2 − δ_1, e_3·d = δ_3 − δ_1. Normals in one plane are
  /// left to pairs, however near to each other they are.
  bool solve_three() {
    const Vec3 n = point(0).n, e2 = point(1).n - n, e3 = point(2).n - n;
    const Vec3 a = cross(e2, e3), b = cross(e3, n), c = cross(n, e2);
    const double volume = dot(n, a), pairs = dot(b, b) * dot(c, c) * dot(e3 - e2, e3 - e2);
    if (volume * volume < 1e-9 * std::cbrt(pairs * pairs)) return false;
    const double delta = point(0).overlap;
    const Vec3 d =
        (1 / volume) * (delta * a + (point(1).overlap - delta) * b + (point(2).overlap - delta) * c);
    const double all = dot(d, a) / volume, second = dot(d, b) / volume, third = dot(d, c) / volume;
    lambda_ = {all - second - third, second, third};
    return true;
  }

  bool leads_out(std::size_t n) const {
    Vec3 d;
    for (std::size_t i = 0; i < n; ++i) d += lambda_[i] * points_[index_[i]].n;
    return std::all_of(points_.begin(), points_.end(), [d](const TouchPoint& q) {
      return dot(q.n, d) >= q.overlap - 1e-9 * std::max(q.overlap, norm(d));
    });
  }

  std::span<const TouchPoint> points_;
  Indices index_;
  std::array<double, 3> lambda_{};
};

/// The deepest three push by themselves, each direction once. Where they cancel, the overlap stays as much
/// above zero as keeps λ / overlap finite.
Touch pinched(std::span<const TouchPoint> points) {
  std::array<TouchPoint, most_points> deepest;
  std::copy(points.begin(), points.end(), deepest.begin());
  std::stable_sort(deepest.begin(), deepest.begin() + static_cast<std::ptrdiff_t>(points.size()),
                   [](const TouchPoint& a, const TouchPoint& b) { return a.overlap > b.overlap; });
  Touch t;
  Vec3 d;
  for (std::size_t i = 0; i < points.size() && t.count < 3; ++i) {
    const auto same = [&](const TouchPoint& q) { return norm(q.n - deepest[i].n) < 1e-6; };
    if (std::any_of(t.point.begin(), t.point.begin() + t.count, same)) continue;
    t.point[t.count++] = deepest[i], d += deepest[i].overlap * deepest[i].n;
  }
  const double least = 1e-9 * deepest[0].overlap;
  t.overlap = std::max(norm(d), least);
  t.normal = norm(d) > least ? (1 / norm(d)) * d : deepest[0].n;
  return t;
}

}  // namespace

double Touch::lambda_sum() const {
  double s = 0;
  for (int i = 0; i < count; ++i) s += point[i].lambda;
  return s;
}

Touch shortest_way_out(std::span<const TouchPoint> points) {
  const std::size_t n = points.size();
  if (n == 0) return {};
  WayOut way(points);
  for (std::size_t i = 0; i < n; ++i)
    if (way.solve({i})) return way.result(1);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (way.solve({i, j})) return way.result(2);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k)
        if (way.solve({i, j, k})) return way.result(3);
  return pinched(points);
}

bool may_touch(const Surface& surface, const Field<3>& x, std::span<const std::int32_t> facets,
               const Probing& probe) {
  return std::any_of(facets.begin(), facets.end(), [&](std::int32_t f) {
    const FacetPoints at = points_of(surface.facets[f], x);
    const auto near = [&](int k) { return near_plane(at, k, probe, probe.reach); };
    return near(0) || near(1) || near(2) || near(3);
  });
}

Touch touch(const Surface& surface, const Field<3>& x, std::span<const std::int32_t> facets,
            const Probing& probe) {
  return Examiner(surface, x, probe).examine(facets);
}

}  // namespace geist::contact
