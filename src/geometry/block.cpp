#include "geometry/block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

#include "core/parallel.hpp"
#include "geometry/hex8.hpp"

namespace geist {
namespace {

Box box_around(const std::vector<Vec3>& points) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Box box{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (const Vec3 p : points)
    for (int c = 0; c < 3; ++c)
      box.low[c] = std::min(box.low[c], p[c]), box.high[c] = std::max(box.high[c], p[c]);
  return box;
}

/// Finds a mesh's nodes by position, those within `distance`, among the ones that lie in the box around
/// `points`: cells of a fine grid.
class NodeFinder {
 public:
  NodeFinder(const Mesh& mesh, const std::vector<Vec3>& points, double distance)
      : mesh_(mesh), distance_(distance) {
    if (mesh.points.empty()) return;
    const Box around = box_around(points);
    std::vector<Vec3> near;
    for (std::size_t i = 0; i < mesh.nodes(); ++i) {
      const Vec3 p = mesh.points[i];
      if (!contains(around, p, distance)) continue;
      cells_.emplace(key({cell(p.x), cell(p.y), cell(p.z)}), static_cast<std::int32_t>(i));
      near.push_back(p);
    }
    box_ = box_around(near);
  }
  std::int32_t find(Vec3 p) const {
    if (!contains(box_, p, distance_)) return -1;  // most points, as bodies share a face
    const Vec3 d{distance_, distance_, distance_}, low = p - d, high = p + d;
    for (long i = cell(low.x); i <= cell(high.x); ++i)
      for (long j = cell(low.y); j <= cell(high.y); ++j)
        for (long k = cell(low.z); k <= cell(high.z); ++k) {
          const auto [first, last] = cells_.equal_range(key({i, j, k}));
          for (auto it = first; it != last; ++it)
            if (norm(mesh_.points[it->second] - p) <= distance_) return it->second;
        }
    return -1;
  }

 private:
  long cell(double x) const { return std::lround(x / (4 * distance_)); }
  static std::uint64_t key(const std::array<long, 3>& c) {
    std::uint64_t h = 0;
    for (long x : c) h = (h ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ull, h ^= h >> 29;
    return h;
  }
  const Mesh& mesh_;
  double distance_;
  Box box_ = box_around({});
  std::unordered_multimap<std::uint64_t, std::int32_t> cells_;
};

/// Whether a plane across one of the axes separates the element from the box; touching is allowed.
bool apart(const std::array<Vec3, 8>& corners, const Box& box, double slack) {
  for (int c = 0; c < 3; ++c) {
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end(),
                                                 [c](const Vec3& p, const Vec3& q) { return p[c] < q[c]; });
    if ((*high)[c] <= box.low[c] + slack || (*low)[c] >= box.high[c] - slack) return true;
  }
  return false;
}

/// What becomes of an element.
enum class Fate : std::uint8_t { kept, cut_out, cut_through, invalid };

Fate fate_of(const std::array<Vec3, 8>& corners, const std::vector<Box>& minus, double slack) {
  if (!hex8::valid(corners)) return Fate::invalid;
  for (const Box& box : minus) {
    if (apart(corners, box, slack)) continue;
    const auto in = [&](const Vec3& p) { return contains(box, p, slack); };
    return std::all_of(corners.begin(), corners.end(), in) ? Fate::cut_out : Fate::cut_through;
  }
  return Fate::kept;
}

std::array<Vec3, 8> corners_of(const Hexahedra& body, std::size_t e) {
  std::array<Vec3, 8> corners;
  for (int a = 0; a < 8; ++a) corners[a] = body.points[body.elements[e][a]];
  return corners;
}

/// What becomes of every element; throws if that cannot be.
std::vector<Fate> fates(const Hexahedra& body, const std::vector<Box>& minus, double slack) {
  std::vector<Fate> all(body.elements.size());
  Fate* const fate = all.data();
  const auto decide = [=, &body, &minus](std::size_t e) {
    fate[e] = fate_of(corners_of(body, e), minus, slack);
  };
  for_each(all.size(), decide, 1000);
  const auto bad = std::find_if(all.begin(), all.end(), [](Fate f) { return f >= Fate::cut_through; });
  if (bad == all.end()) return all;
  const Vec3 c = hex8::map(corners_of(body, static_cast<std::size_t>(bad - all.begin())), {0, 0, 0});
  const std::string place = fmt::format("the element at ({:.6g}, {:.6g}, {:.6g})", c.x, c.y, c.z);
  throw std::invalid_argument(*bad == Fate::invalid ? fmt::format("{} is turned inside out or flat", place)
                                                    : fmt::format("a box of 'minus' cuts through {}", place));
}

}  // namespace

void append(Mesh& mesh, HexRegion region, const Hexahedra& body, const std::vector<Box>& minus) {
  const double slack = 1e-7 * body.spacing;
  const std::vector<Fate> fate = fates(body, minus, slack);
  const NodeFinder earlier(mesh, body.points, slack);
  constexpr std::int32_t unused = -2;
  std::vector<std::int32_t> own(body.points.size(), unused);  // nodes of the mesh, by the body's own
  region.first = mesh.elements.size();
  for (std::size_t e = 0; e < body.elements.size(); ++e) {
    if (fate[e] == Fate::cut_out) continue;
    mesh.elements.push_back(body.elements[e]);
    for (const std::int32_t i : body.elements[e]) own[i] = -1;
  }
  for (std::size_t i = 0; i < own.size(); ++i) {  // in the body's order, so that rows stay rows
    if (own[i] == unused) continue;
    own[i] = earlier.find(body.points[i]);
    if (own[i] < 0) own[i] = static_cast<std::int32_t>(mesh.nodes()), mesh.points.push_back(body.points[i]);
  }
  for (std::size_t e = region.first; e < mesh.elements.size(); ++e)
    for (std::int32_t& node : mesh.elements[e]) node = own[node];
  region.count = mesh.elements.size() - region.first;
  if (region.count == 0) throw std::invalid_argument("no element is left");
  mesh.regions.push_back(std::move(region));
}

void append_block(Mesh& mesh, HexRegion region, const std::array<Vec3, 8>& corners,
                  const std::array<int, 3>& divisions, const std::vector<Box>& minus) {
  append(mesh, std::move(region), mesh_of(BlockBody{corners, divisions}), minus);
}

}  // namespace geist
