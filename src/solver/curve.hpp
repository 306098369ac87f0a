// Curve: how a load or a motion varies in time.
#pragma once
#include <algorithm>
#include <array>
#include <vector>

namespace geist {

/// Piecewise linear through (time, value); constant beyond its ends; 1 if it has no points.
struct Curve {
  std::vector<std::array<double, 2>> points;

  double at(double t) const {
    if (points.empty()) return 1;
    const auto after = std::upper_bound(points.begin(), points.end(), t,
                                        [](double time, const auto& p) { return time < p[0]; });
    if (after == points.begin()) return points.front()[1];
    if (after == points.end()) return points.back()[1];
    const auto before = after - 1;
    const double s = (t - (*before)[0]) / ((*after)[0] - (*before)[0]);
    return (*before)[1] + s * ((*after)[1] - (*before)[1]);  // exactly constant where it should be
  }

  /// From when on the value does not change any more.
  double end() const { return points.empty() ? 0 : points.back()[0]; }

  /// Whether the value is one and the same from a to b.
  bool constant_over(double a, double b) const {
    const double value = at(a);
    if (at(b) != value) return false;
    return std::all_of(points.begin(), points.end(),
                       [=](const auto& p) { return p[0] <= a || p[0] >= b || p[1] == value; });
  }
};

}  // namespace geist
