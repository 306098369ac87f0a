// The elastica: a cantilever that bends and does nothing else, under a dead load across its first direction.
#pragma once
#include <array>
#include <cmath>
#include <utility>

namespace geist::verification {

/// Slope and place of the tip of a beam of length 1, clamped along x.
struct Elastica {
  double slope, along, across;
};

/// From the clamp on, θ'' = −a cos θ, θ(0) = 0, with θ'(0) = curvature: Runge and Kutta's 4th order. Returns
/// θ'(1) beside the tip.
inline std::pair<double, Elastica> shoot(double a, double curvature) {
  using State = std::array<double, 4>;  // θ, θ', x, z
  const auto rate = [a](const State& y) {
    return State{y[1], -a * std::cos(y[0]), std::cos(y[0]), std::sin(y[0])};
  };
  const auto plus = [](State y, double h, const State& k) {
    for (std::size_t c = 0; c < 4; ++c) y[c] += h * k[c];
    return y;
  };
  State y{0, curvature, 0, 0};
  constexpr int n = 1000;
  for (int i = 0; i < n; ++i) {
    const double h = 1.0 / n;
    const State k1 = rate(y), k2 = rate(plus(y, h / 2, k1)), k3 = rate(plus(y, h / 2, k2)),
                k4 = rate(plus(y, h, k3));
    y = plus(plus(plus(plus(y, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
  }
  return {y[1], {y[0], y[2], y[3]}};
}

/// Under a load of a times EI / length²: no moment at the tip.
inline Elastica elastica(double a) {
  double low = 0, high = a;
  for (int n = 0; n < 60; ++n) {
    const double middle = (low + high) / 2;
    (shoot(a, middle).first > 0 ? high : low) = middle;
  }
  return shoot(a, low).second;
}

/// The load that bends it to that slope.
inline double load_to(double slope) {
  double low = 0, high = 10;
  for (int n = 0; n < 60; ++n) (elastica((low + high) / 2).slope > slope ? high : low) = (low + high) / 2;
  return low;
}

}  // namespace geist::verification
