#include "contact/way_out.hpp"

#include <algorithm>
#include <cmath>

namespace geist::contact {
namespace {

/// Displacement Σ λ_i n_i that just meets the half-spaces `active` (one to three of them), if all λ are
/// positive.
class WayOut {
 public:
  explicit WayOut(std::span<const TouchPoint> points) : points_(points) {}

  bool solve(std::initializer_list<std::size_t> active) {
    const std::size_t n = active.size();
    std::copy(active.begin(), active.end(), index_.begin());
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
      t.point[t.count] = point(i), t.point[t.count++].lambda = lambda_[i];
      d += lambda_[i] * point(i).n;
    }
    t.overlap = norm(d), t.normal = (1 / t.overlap) * d;
    return t;
  }

 private:
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
    for (std::size_t i = 0; i < n; ++i) d += lambda_[i] * point(i).n;
    return std::all_of(points_.begin(), points_.end(), [d](const TouchPoint& q) {
      return dot(q.n, d) >= q.overlap - 1e-9 * std::max(q.overlap, norm(d));
    });
  }

  std::span<const TouchPoint> points_;
  std::array<std::size_t, 3> index_{};
  std::array<double, 3> lambda_{};
};

/// The deepest three push by themselves, each direction once. Where they cancel, the overlap stays as much
/// above zero as keeps λ / overlap finite.
Touch pinched(std::span<const TouchPoint> points) {
  std::array<TouchPoint, most_half_spaces> deepest;
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

}  // namespace geist::contact
