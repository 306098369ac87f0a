#include "geometry/locator.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/hex8.hpp"

namespace geist {
namespace {

std::pair<Vec3, Vec3> bounds_of(const hex8::Corners& corners) {
  Vec3 low = corners[0], high = corners[0];
  for (const Vec3 p : corners)
    for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
  return {low, high};
}

std::uint64_t key(const std::array<long, 3>& c) {
  return (static_cast<std::uint64_t>(c[0] & 0x1FFFFF) << 42) |
         (static_cast<std::uint64_t>(c[1] & 0x1FFFFF) << 21) | static_cast<std::uint64_t>(c[2] & 0x1FFFFF);
}

}  // namespace

Locator::Locator(const Mesh& mesh) : mesh_(mesh) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto [low, high] = bounds_of(hex8::corners(mesh, e));
    sum += std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  }
  if (!mesh.elements.empty()) width_ = sum / static_cast<double>(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto [low, high] = bounds_of(hex8::corners(mesh, e));
    const Vec3 margin{1e-6 * width_, 1e-6 * width_, 1e-6 * width_};
    const auto a = cell(low - margin), b = cell(high + margin);
    for (long i = a[0]; i <= b[0]; ++i)
      for (long j = a[1]; j <= b[1]; ++j)
        for (long k = a[2]; k <= b[2]; ++k) elements_[key({i, j, k})].push_back(static_cast<std::int32_t>(e));
  }
}

std::array<long, 3> Locator::cell(Vec3 p) const {
  return {static_cast<long>(std::floor(p.x / width_)), static_cast<long>(std::floor(p.y / width_)),
          static_cast<long>(std::floor(p.z / width_))};
}

std::optional<Location> Locator::find(Vec3 p, double slack, std::int32_t stranger) const {
  const auto it = elements_.find(key(cell(p)));
  if (it == elements_.end()) return std::nullopt;
  for (const std::int32_t e : it->second) {
    const auto& nodes = mesh_.elements[e];
    if (std::find(nodes.begin(), nodes.end(), stranger) != nodes.end()) continue;
    const auto corners = hex8::corners(mesh_, e);
    const auto [low, high] = bounds_of(corners);
    const double margin = 1e-6 * width_;
    bool near = true;
    for (int c = 0; c < 3; ++c) near = near && p[c] >= low[c] - margin && p[c] <= high[c] + margin;
    if (!near) continue;
    const auto [xi, converged] = hex8::inverse_map(corners, p);
    if (converged && hex8::contains(xi, slack)) return Location{e, xi};
  }
  return std::nullopt;
}

std::vector<std::int32_t> Locator::near(const Box& box) const {
  std::vector<std::int32_t> found;
  const auto a = cell(box.low), b = cell(box.high);
  for (long i = a[0]; i <= b[0]; ++i)
    for (long j = a[1]; j <= b[1]; ++j)
      for (long k = a[2]; k <= b[2]; ++k) {
        const auto it = elements_.find(key({i, j, k}));
        if (it != elements_.end()) found.insert(found.end(), it->second.begin(), it->second.end());
      }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  const auto apart = [&](std::int32_t e) {
    const auto [low, high] = bounds_of(hex8::corners(mesh_, static_cast<std::size_t>(e)));
    for (int c = 0; c < 3; ++c)
      if (low[c] > box.high[c] || high[c] < box.low[c]) return true;
    return false;
  };
  found.erase(std::remove_if(found.begin(), found.end(), apart), found.end());
  return found;
}

}  // namespace geist
