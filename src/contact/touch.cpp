#include "contact/touch.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/triangle.hpp"

namespace geist::contact {
namespace {

/// The nearest point of one triangle.
struct Nearest {
  NearestPoint point;
  double distance;
  std::int32_t facet;
  int k;      ///< triangle
  Vec3 n;     ///< its unit normal
  Vec3 away;  ///< from the point to the contactor
};

bool nearer(const Nearest& a, const Nearest& b) { return a.distance < b.distance; }

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
    const Nearest& nearest = *std::min_element(found_.begin(), found_.begin() + count_, nearer);
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
    const NearestPoint point = nearest_point(probe_.x, at.corner[k], at.corner[(k + 1) % 4], at.centre);
    const Vec3 away = probe_.x - point.p;
    const Nearest found{point, norm(away), f, k, n, away};
    if (found.distance >= std::max(probe_.radius, probe_.reach)) return;
    if (count_ == static_cast<int>(most_half_spaces) && probe_.radius > 0) keep_minima();
    if (count_ < static_cast<int>(most_half_spaces)) {
      found_[count_++] = found;
      return;
    }
    Nearest& farthest = *std::max_element(found_.begin(), found_.end(), nearer);
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
        return !falls(a.away, across_edge(corner(k), other, corner(k + 1) - corner(k)));
      }
      case Feature::edge_bc:
        return !falls(a.away, across_edge(at.centre, corner(k + 2), corner(k + 1) - at.centre));
      case Feature::edge_ca:
        return !falls(a.away, across_edge(at.centre, corner(k - 1), corner(k) - at.centre));
      case Feature::corner_c:
        return std::none_of(at.corner.begin(), at.corner.end(),
                            [&](Vec3 p) { return falls(a.away, p - at.centre); });
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
        if (falls(a.away, q - p)) return false;
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

  bool inside(const Nearest& a) const { return dot(a.away, normal_at(a)) < 0; }

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
    std::array<TouchPoint, most_half_spaces> points;
    std::size_t n = 0;
    for (int i = 0; i < count_; ++i)
      if (const Nearest& a = found_[i]; a.distance < probe_.radius && local_minimum(a)) {
        const Vec3 normal = a.distance > 1e-12 * probe_.radius ? (1 / a.distance) * a.away : a.n;
        points[n++] = make_point(a, normal, probe_.radius - a.distance);
      }
    return shortest_way_out({points.data(), n});
  }

  /// A sphere whose centre has passed the surface: back to the nearest point of it.
  Touch deep_touch(const Nearest& a) const {
    const Vec3 normal = a.distance > 1e-12 * probe_.radius ? (-1 / a.distance) * a.away : a.n;
    return single(make_point(a, normal, probe_.radius + a.distance));
  }

  /// A node behind the surface that faces it.
  Touch node_touch(const Nearest& a) const {
    const double depth = -dot(a.away, a.n);
    if (depth <= 0) return {};
    const Vec3 sideways = a.away + depth * a.n;
    if (a.point.feature == Feature::face) return single(make_point(a, a.n, depth));
    if (local_minimum(a) && inside(a) && !on_border(a))
      return single(make_point(a, (-1 / a.distance) * a.away, a.distance));
    const bool on_plane = norm(sideways) <= beside * std::sqrt(surface_.facets[a.facet].area);
    return on_plane ? single(make_point(a, a.n, depth)) : Touch{};
  }

  const Surface& surface_;
  const Field<3>& x_;
  const Probing& probe_;
  std::array<Nearest, most_half_spaces> found_;
  int count_ = 0;
};

}  // namespace

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
