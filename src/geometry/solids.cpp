#include "geometry/solids.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/hex8.hpp"

namespace geist {
namespace {

/// Of a node, or of the lowest corner of an element, in a block.
using Index = std::array<int, 3>;

/// Corner a of cell (i, j, k) as grid indices, in the order of model/mesh.hpp.
constexpr std::array<Index, 8> corner_step{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

std::size_t product(const Index& n) {
  return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]);
}

/// f({i, j, k}) for all below n, i first.
template <class F>
void for_each_index(const Index& n, F f) {
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) f(Index{i, j, k});
}

/// The nodes and elements of a block of n[0] × n[1] × n[2] elements.
struct Core {
  Index n;

  Index nodes() const { return {n[0] + 1, n[1] + 1, n[2] + 1}; }
  std::int32_t node(const Index& at) const { return (at[2] * (n[1] + 1) + at[1]) * (n[0] + 1) + at[0]; }
  std::array<std::int32_t, 8> element(const Index& at) const {
    std::array<std::int32_t, 8> corners;
    for (int a = 0; a < 8; ++a) {
      const auto [i, j, k] = corner_step[a];
      corners[a] = node({at[0] + i, at[1] + j, at[2] + k});
    }
    return corners;
  }
  /// Whether the node is on one of the faces across the first so many directions.
  bool on_face(const Index& at, int directions) const {
    for (int c = 0; c < directions; ++c)
      if (at[c] == 0 || at[c] == n[c]) return true;
    return false;
  }
  /// The elements' facets on these faces, seen from outside counter-clockwise.
  std::vector<std::array<std::int32_t, 4>> facets(int directions) const {
    std::vector<std::array<std::int32_t, 4>> all;
    for (int c = 0; c < directions; ++c)
      for (const int side : {0, n[c]}) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        for (int v = 0; v < n[e]; ++v)
          for (int u = 0; u < n[d]; ++u) {
            Index p;
            p[c] = side, p[d] = u, p[e] = v;
            Index q = p, r = p, s = p;
            q[d] += 1, r[d] += 1, r[e] += 1, s[e] += 1;
            if (side == 0) std::swap(q, s);
            all.push_back({node(p), node(q), node(r), node(s)});
          }
      }
    return all;
  }
};

/// A core and shells around its faces across the first so many directions. place(at, s) is where the node is
/// that belongs to the core's node `at` in shell s; s = 0 is the core itself.
template <class Place>
Hexahedra grow(const Core& core, int directions, int shells, Place place) {
  Hexahedra made{};
  made.points.reserve(product(core.nodes()));
  made.elements.reserve(product(core.n));
  std::vector<Index> surface;
  for_each_index(core.nodes(), [&](const Index& at) {
    made.points.push_back(place(at, 0));
    if (core.on_face(at, directions)) surface.push_back(at);
  });
  for_each_index(core.n, [&](const Index& at) { made.elements.push_back(core.element(at)); });
  const auto facets = core.facets(directions);
  std::vector<std::int32_t> inner(made.points.size()), outer;
  std::iota(inner.begin(), inner.end(), 0);
  for (int s = 1; s <= shells; ++s, inner = outer) {
    outer.assign(inner.size(), -1);
    for (const Index& at : surface) {
      outer[core.node(at)] = static_cast<std::int32_t>(made.points.size());
      made.points.push_back(place(at, s));
    }
    for (const auto& [p, q, r, t] : facets)
      made.elements.push_back(
          {inner[p], inner[q], inner[r], inner[t], outer[p], outer[q], outer[r], outer[t]});
  }
  return made;
}

/// Half the width of a core relative to the radius, along the axes: with half as many shells as core
/// elements, shells and core elements are of the same length.
constexpr double core_width = 0.5;
/// How far a core's shape is from a cube, 0, to the one that is the ball or disc, 1.
constexpr double bulge = 0.5;

/// tan(π a/4) for |a| ≤ 1, Lambert's continued fraction: equal steps of a are equal angles on the circle. Not
/// std::tan, whose last bits differ from one library to the next.
double tangent(double a) {
  if (std::abs(a) == 1) return a;
  const double x = 0.78539816339744830962 * a;
  double f = 21;
  for (int k = 19; k >= 1; k -= 2) f = k - x * x / f;
  return x / f;
}

/// The core's node at (a, b, c), |a|, |b|, |c| ≤ 1, for radius 1. At bulge 1 it is the well-known map of the
/// cube on the ball, x = a √(1 − b²/2 − c²/2 + b²c²/3); with c = 0, of the square on the disc.
Vec3 in_core(Vec3 p) {
  const auto along = [](double a, double b, double c) {
    const double B = b * b, C = c * c;
    return core_width * a * (1 - bulge + bulge * std::sqrt(1 - (B + C) / 2 + B * C / 3));
  };
  return {along(p.x, p.y, p.z), along(p.y, p.z, p.x), along(p.z, p.x, p.y)};
}

/// The node of the surface, of radius 1, that belongs to (a, b, c) on the faces of the cube.
Vec3 on_surface(Vec3 p) {
  const Vec3 direction{tangent(p.x), tangent(p.y), tangent(p.z)};
  return (1 / norm(direction)) * direction;
}

std::vector<double> core_stations(int n, const Grading& grading) {
  std::vector<double> t = stations(n, grading);
  return symmetric(grading) ? mirrored(std::move(t)) : t;
}

/// Nodes of the core and the shells for radius 1.
class RoundGrid {
 public:
  RoundGrid(const Index& n, int shells, const Gradings& gradings)
      : shell_(stations(shells, gradings.radius)) {
    for (int c = 0; c < 3; ++c)
      axis_[c] = n[c] > 0 ? core_stations(n[c], gradings.axis[c]) : std::vector<double>{0};
  }
  Vec3 place(const Index& at, int shell) const {
    const Vec3 p{axis_[0][at[0]], axis_[1][at[1]], axis_[2][at[2]]};
    if (shell == 0) return in_core(p);
    const double outwards = (1 + shell_[shell]) / 2;
    return (1 - outwards) * in_core(p) + outwards * on_surface(p);
  }

 private:
  std::array<std::vector<double>, 3> axis_;
  std::vector<double> shell_;
};

Hexahedra mesh_of(const BlockBody& body, const Gradings& gradings) {
  std::array<std::vector<double>, 3> t;
  for (int c = 0; c < 3; ++c) t[c] = stations(body.divisions[c], gradings.axis[c]);
  Hexahedra made = grow({body.divisions}, 0, 0, [&](const Index& at, int) {
    return hex8::map(body.corners, {t[0][at[0]], t[1][at[1]], t[2][at[2]]});
  });
  double size = 0;
  for (const Vec3 p : body.corners) size = std::max(size, norm(p - body.corners[0]));
  made.spacing = size / *std::max_element(body.divisions.begin(), body.divisions.end());
  return made;
}

Hexahedra mesh_of(const BallBody& body, const Gradings& gradings) {
  const auto& [centre, radius] = body.shape;
  const Index n{body.core, body.core, body.core};
  const RoundGrid grid(n, body.shells, gradings);
  Hexahedra made =
      grow({n}, 3, body.shells, [&, centre = centre, radius = radius](const Index& at, int shell) {
        return centre + radius * grid.place(at, shell);
      });
  made.spacing = 2 * radius / (body.core + 2 * body.shells);
  return made;
}

/// Two directions across an axis of length 1; coordinate axes where it is one itself.
std::array<Vec3, 2> across(Vec3 axis) {
  std::size_t main = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (std::abs(axis[c]) > std::abs(axis[main])) main = c;
  Vec3 x;
  x[(main + 1) % 3] = 1;
  x -= dot(x, axis) * axis;
  x *= 1 / norm(x);
  return {x, cross(axis, x)};
}

Hexahedra mesh_of(const CylinderBody& body, const Gradings& gradings) {
  const auto& [from, to, radius] = body.shape;
  const double length = norm(to - from);
  const auto [x, y] = across((1 / length) * (to - from));
  const RoundGrid disc({body.core, body.core, 0}, body.shells, gradings);
  const std::vector<double> along = stations(body.layers, gradings.axis[2]);
  const auto place = [&, from = from, to = to, radius = radius, x = x, y = y](const Index& at, int shell) {
    const Vec3 p = disc.place({at[0], at[1], 0}, shell);
    const double s = (1 + along[at[2]]) / 2;
    return ((1 - s) * from + s * to) + radius * (p.x * x + p.y * y);
  };
  Hexahedra made = grow({{body.core, body.core, body.layers}}, 2, body.shells, place);
  made.spacing = std::min(2 * radius / (body.core + 2 * body.shells), length / body.layers);
  return made;
}

double element_count(const BlockBody& b) { return 1.0 * b.divisions[0] * b.divisions[1] * b.divisions[2]; }
double element_count(const BallBody& b) { return 1.0 * b.core * b.core * (b.core + 6.0 * b.shells); }
double element_count(const CylinderBody& b) { return 1.0 * b.core * (b.core + 4.0 * b.shells) * b.layers; }

}  // namespace

std::array<Vec3, 8> corners_of(const Box& box) {
  std::array<Vec3, 8> corners;
  for (int a = 0; a < 8; ++a)
    for (int c = 0; c < 3; ++c) corners[a][c] = corner_step[a][c] ? box.high[c] : box.low[c];
  return corners;
}

double element_count(const Body& body) {
  return std::visit([](const auto& b) { return element_count(b); }, body);
}

Hexahedra mesh_of(const Body& body, const Gradings& gradings) {
  return std::visit([&](const auto& b) { return mesh_of(b, gradings); }, body);
}

}  // namespace geist
