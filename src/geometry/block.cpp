#include "geometry/block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "geometry/hex8.hpp"

namespace geist {
namespace {

/// Finds nodes by position: cells of a fine grid, nodes within `distance` are the same.
class NodeFinder {
 public:
  NodeFinder(const Mesh& mesh, double distance) : mesh_(mesh), distance_(distance) {
    for (std::size_t i = 0; i < mesh.nodes(); ++i) insert(static_cast<std::int32_t>(i));
  }
  void insert(std::int32_t i) { cells_.emplace(key(cell(mesh_.points[i])), i); }
  std::int32_t find(Vec3 p) const {
    const auto [a, b, c] = cell(p);
    for (long i = a - 1; i <= a + 1; ++i)
      for (long j = b - 1; j <= b + 1; ++j)
        for (long k = c - 1; k <= c + 1; ++k) {
          const auto [first, last] = cells_.equal_range(key({i, j, k}));
          for (auto it = first; it != last; ++it)
            if (norm(mesh_.points[it->second] - p) <= distance_) return it->second;
        }
    return -1;
  }

 private:
  using Cell = std::array<long, 3>;
  Cell cell(Vec3 p) const {
    const double h = 4 * distance_;
    return {std::lround(p.x / h), std::lround(p.y / h), std::lround(p.z / h)};
  }
  static std::uint64_t key(const Cell& c) {
    std::uint64_t h = 0;
    for (long x : c) h = (h ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ull, h ^= h >> 29;
    return h;
  }
  const Mesh& mesh_;
  double distance_;
  std::unordered_multimap<std::uint64_t, std::int32_t> cells_;
};

using Divisions = std::array<int, 3>;

Vec3 cell_point(const std::array<Vec3, 8>& corners, const Divisions& n, double i, double j, double k) {
  return hex8::map(corners, {2 * i / n[0] - 1, 2 * j / n[1] - 1, 2 * k / n[2] - 1});
}

/// Corner a of cell (i, j, k) as grid indices, in the order of model/mesh.hpp.
constexpr std::array<std::array<int, 3>, 8> corner_step{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

/// Whether a plane across one of the axes separates the element from the box; touching is allowed.
bool apart(const std::array<Vec3, 8>& corners, const Box& box, double slack) {
  for (int c = 0; c < 3; ++c) {
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end(),
                                                 [c](const Vec3& p, const Vec3& q) { return p[c] < q[c]; });
    if ((*high)[c] <= box.low[c] + slack || (*low)[c] >= box.high[c] - slack) return true;
  }
  return false;
}

/// Whether the element lies in one of the boxes; throws if a box cuts through it.
bool cut_out(const std::array<Vec3, 8>& corners, const std::vector<Box>& minus, double slack) {
  for (const Box& box : minus) {
    if (apart(corners, box, slack)) continue;
    const auto in = [&](const Vec3& p) { return contains(box, p, slack); };
    if (std::all_of(corners.begin(), corners.end(), in)) return true;
    const Vec3 centre = hex8::map(corners, {0, 0, 0});
    throw std::invalid_argument(
        fmt::format("a box of 'minus' cuts through the element at ({:.6g}, {:.6g}, {:.6g})", centre.x,
                    centre.y, centre.z));
  }
  return false;
}

double size_of(const std::array<Vec3, 8>& corners) {
  double size = 0;
  for (const Vec3 p : corners) size = std::max(size, norm(p - corners[0]));
  return size;
}

void check_valid(const std::array<Vec3, 8>& corners) {
  if (hex8::valid(corners)) return;
  const Vec3 c = hex8::map(corners, {0, 0, 0});
  throw std::invalid_argument(
      fmt::format("the element at ({:.6g}, {:.6g}, {:.6g}) is turned inside out or flat", c.x, c.y, c.z));
}

constexpr std::array<std::array<int, 4>, 6> facet_corners{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

}  // namespace

std::array<Vec3, 8> corners_of(const Box& box) {
  std::array<Vec3, 8> corners;
  for (int a = 0; a < 8; ++a)
    for (int c = 0; c < 3; ++c) corners[a][c] = corner_step[a][c] ? box.high[c] : box.low[c];
  return corners;
}

void append_block(Mesh& mesh, HexRegion region, const std::array<Vec3, 8>& corners,
                  const Divisions& divisions, const std::vector<Box>& minus) {
  const double size = size_of(corners),
               slack = 1e-7 * size / *std::max_element(divisions.begin(), divisions.end());
  NodeFinder earlier(mesh, slack);
  const auto [nx, ny, nz] = divisions;
  std::vector<std::int32_t> own(static_cast<std::size_t>(nx + 1) * (ny + 1) * (nz + 1),
                                -1);  // nodes by grid position
  const auto node_at = [&, nx = nx, ny = ny](const std::array<int, 3>& at, Vec3 p) {
    std::int32_t& node = own[(static_cast<std::size_t>(at[2]) * (ny + 1) + at[1]) * (nx + 1) + at[0]];
    if (node < 0) node = earlier.find(p);
    if (node < 0) node = static_cast<std::int32_t>(mesh.nodes()), mesh.points.push_back(p);
    return node;
  };
  region.first = mesh.elements.size();
  for (int k = 0; k < divisions[2]; ++k)
    for (int j = 0; j < divisions[1]; ++j)
      for (int i = 0; i < divisions[0]; ++i) {
        std::array<Vec3, 8> x;
        for (int a = 0; a < 8; ++a) {
          const auto [di, dj, dk] = corner_step[a];
          x[a] = cell_point(corners, divisions, i + di, j + dj, k + dk);
        }
        check_valid(x);
        if (cut_out(x, minus, slack)) continue;
        std::array<std::int32_t, 8> element;
        for (int a = 0; a < 8; ++a) {
          const auto [di, dj, dk] = corner_step[a];
          element[a] = node_at({i + di, j + dj, k + dk}, x[a]);
        }
        mesh.elements.push_back(element);
      }
  region.count = mesh.elements.size() - region.first;
  if (region.count == 0) throw std::invalid_argument("no element is left");
  mesh.regions.push_back(std::move(region));
}

std::vector<Facet> exterior_facets(const Mesh& mesh) {
  std::vector<Facet> all;
  std::vector<std::array<std::int32_t, 4>> key;  // nodes in ascending order
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const auto& corner : facet_corners) {
      Facet& facet = all.emplace_back(Facet{static_cast<std::int32_t>(e), {}});
      for (int a = 0; a < 4; ++a) facet.node[a] = mesh.elements[e][corner[a]];
      auto& nodes = key.emplace_back(facet.node);
      std::sort(nodes.begin(), nodes.end());
    }
  // Facets with the same lowest node are few: those that are equal are among them.
  std::vector<std::size_t> begin(mesh.nodes() + 1, 0), order(all.size());
  for (const auto& k : key) ++begin[k[0] + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t f = 0; f < all.size(); ++f) order[next[key[f][0]]++] = f;
  std::vector<Facet> exterior;
  for (std::size_t f = 0; f < all.size(); ++f) {
    const auto first = order.begin() + begin[key[f][0]], last = order.begin() + begin[key[f][0] + 1];
    if (std::count_if(first, last, [&](std::size_t g) { return key[g] == key[f]; }) == 1)
      exterior.push_back(all[f]);
  }
  return exterior;
}

std::array<double, 4> tributary_areas(const Mesh& mesh, const Facet& facet) {
  const double g = 1 / std::sqrt(3.0);
  std::array<double, 4> area{};
  for (const double s : {-g, g})
    for (const double t : {-g, g}) {
      const std::array<double, 4> N{(1 - s) * (1 - t) / 4, (1 + s) * (1 - t) / 4, (1 + s) * (1 + t) / 4,
                                    (1 - s) * (1 + t) / 4};
      const std::array<double, 4> Ns{-(1 - t) / 4, (1 - t) / 4, (1 + t) / 4, -(1 + t) / 4};
      const std::array<double, 4> Nt{-(1 - s) / 4, -(1 + s) / 4, (1 + s) / 4, (1 - s) / 4};
      Vec3 xs, xt;
      for (int a = 0; a < 4; ++a)
        xs += Ns[a] * mesh.points[facet.node[a]], xt += Nt[a] * mesh.points[facet.node[a]];
      const double dA = norm(cross(xs, xt));
      for (int a = 0; a < 4; ++a) area[a] += N[a] * dA;
    }
  return area;
}

}  // namespace geist
