#include "geometry/locator.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.hpp"
#include "geometry/hex8.hpp"

namespace geist {
namespace {

constexpr std::size_t worth_threads = 1000;  ///< elements

Box bounds_of(const Mesh& mesh, std::size_t e) {
  Box box = nowhere();
  for (const std::int32_t node : mesh.elements[e]) widen(box, mesh.points[node]);
  return box;
}

double longest_edge(const Box& box) {
  const Vec3 edge = box.high - box.low;
  return std::max({edge.x, edge.y, edge.z});
}

bool meet(const Box& a, const Box& b) {
  for (int c = 0; c < 3; ++c)
    if (a.low[c] > b.high[c] || a.high[c] < b.low[c]) return false;
  return true;
}

}  // namespace

std::array<int, 3> Locator::Cells::at(Vec3 p) const {
  std::array<int, 3> cell;
  for (int c = 0; c < 3; ++c)
    cell[c] = static_cast<int>(std::clamp((p[c] - around.low[c]) / width, 0.0, n[c] - 1.0));
  return cell;
}

std::size_t Locator::Cells::index(const std::array<int, 3>& cell) const {
  return (static_cast<std::size_t>(cell[2]) * n[1] + cell[1]) * n[0] + cell[0];
}

template <class F>
void Locator::Cells::visit(const Box& box, F f) const {
  if (!meet(box, around)) return;
  const auto a = at(box.low), b = at(box.high);
  for (int k = a[2]; k <= b[2]; ++k)
    for (int j = a[1]; j <= b[1]; ++j)
      for (int i = a[0]; i <= b[0]; ++i) f(index({i, j, k}));
}

Locator::Locator(const Mesh& mesh) : mesh_(mesh), box_(mesh.elements.size()) {
  if (box_.empty()) return;
  for_each(
      box_.size(), [&mesh, box = box_.data()](std::size_t e) { box[e] = bounds_of(mesh, e); }, worth_threads);
  double sum = 0;
  for (const Box& box : box_) sum += longest_edge(box);
  margin_ = 1e-6 * (sum / static_cast<double>(box_.size()));
  for (const HexRegion& region : mesh.regions)
    if (region.count > 0) sort(region.first, region.count);
}

void Locator::sort(std::size_t first, std::size_t count) {
  constexpr double cells_an_element =
      4;  // at most: bodies that leave much of their box empty take wider cells
  Cells& cells = cells_.emplace_back();
  cells.around = nowhere();
  double sum = 0;
  for (std::size_t e = first; e < first + count; ++e) {
    sum += longest_edge(box_[e]);
    for (int c = 0; c < 3; ++c) box_[e].low[c] -= margin_, box_[e].high[c] += margin_;
    widen(cells.around, box_[e]);
  }
  cells.width = sum / static_cast<double>(count);
  const Vec3 half{cells.width / 2, cells.width / 2,
                  cells.width / 2};  // elements of a grid reach into 8 cells
  cells.around.low -= half, cells.around.high += half;
  const Vec3 edge = cells.around.high - cells.around.low;
  const double most = cells_an_element * static_cast<double>(count) + 64,
               cell = cells.width * cells.width * cells.width;
  const double crowd = edge.x * edge.y * edge.z / (cell * most);
  if (crowd > 1) cells.width *= std::cbrt(crowd);
  for (int c = 0; c < 3; ++c) cells.n[c] = static_cast<int>(edge[c] / cells.width) + 1;
  cells.begin.assign(static_cast<std::size_t>(cells.n[0]) * cells.n[1] * cells.n[2] + 2, 0);
  const auto each = [&](auto f) {
    for (std::size_t e = first; e < first + count; ++e) cells.visit(box_[e], [&](std::size_t c) { f(c, e); });
  };
  each([&](std::size_t c, std::size_t) { ++cells.begin[c + 2]; });
  std::partial_sum(cells.begin.begin(), cells.begin.end(), cells.begin.begin());
  cells.element.resize(cells.begin.back());
  each([&](std::size_t c, std::size_t e) {
    cells.element[cells.begin[c + 1]++] = static_cast<std::int32_t>(e);
  });
}

/// wanted(e): whether e counts.
template <class Wanted>
std::optional<Location> Locator::first_of(Vec3 p, double slack, Wanted wanted) const {
  for (const Cells& cells : cells_) {
    if (!contains(cells.around, p)) continue;
    const std::size_t cell = cells.index(cells.at(p));
    for (std::uint32_t i = cells.begin[cell]; i < cells.begin[cell + 1]; ++i) {
      const std::int32_t e = cells.element[i];
      if (!contains(box_[e], p) || !wanted(e)) continue;
      const auto [xi, converged] = hex8::inverse_map(hex8::corners(mesh_, static_cast<std::size_t>(e)), p);
      if (converged && hex8::contains(xi, slack)) return Location{e, xi};
    }
  }
  return std::nullopt;
}

std::optional<Location> Locator::find(Vec3 p, double slack, std::int32_t stranger) const {
  return first_of(p, slack, [&](std::int32_t e) {
    const auto& nodes = mesh_.elements[e];
    return std::find(nodes.begin(), nodes.end(), stranger) == nodes.end();
  });
}

std::optional<Location> Locator::find_before(std::int32_t end, Vec3 p) const {
  return first_of(p, 1e-7, [end](std::int32_t e) { return e < end; });
}

std::vector<std::int32_t> Locator::near(const Box& box) const {
  std::vector<std::int32_t> found;
  const auto apart = [&](std::int32_t e) {
    const Box own = bounds_of(mesh_, static_cast<std::size_t>(e));
    return !meet(own, box);
  };
  for (const Cells& cells : cells_) {
    const std::size_t before = found.size();
    cells.visit(box, [&](std::size_t cell) {
      for (std::uint32_t i = cells.begin[cell]; i < cells.begin[cell + 1]; ++i)
        if (meet(box_[cells.element[i]], box)) found.push_back(cells.element[i]);
    });
    const auto own = found.begin() + static_cast<std::ptrdiff_t>(before);
    std::sort(own, found.end());
    found.erase(std::unique(own, found.end()), found.end());
  }
  found.erase(std::remove_if(found.begin(), found.end(), apart), found.end());
  return found;
}

}  // namespace geist
