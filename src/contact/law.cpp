#include "contact/law.hpp"

#include <cmath>

namespace geist::contact {
namespace {

/// Restitution of ẍ = −F(x) − 2ζ √F'(x) ẋ, F = x or x^{3/2}, from ẋ = 1 at x = 0 until the force is zero
/// again; by Heun's method. Both laws are free of scales, so one unit collision stands for all.
double restitution_of(bool hertz, double zeta) {
  constexpr double dt = 2e-4;
  const NormalStiffness spring{1, hertz};
  const auto pull = [&](double x, double v) {
    return x > 0 ? spring.force(x) + 2 * zeta * std::sqrt(spring.tangent(x)) * v : 0.0;
  };
  double x = 0, v = 1;
  for (;;) {
    const double a = -pull(x, v), x1 = x + dt * v, v1 = v + dt * a, b = -pull(x1, v1);
    x += 0.5 * dt * (v + v1), v += 0.5 * dt * (a + b);
    if (v < 0 && (x <= 0 || pull(x, v) <= 0)) return -v;
  }
}

}  // namespace

void LawTable::set(std::int32_t a, std::int32_t b, const Law& law) {
  index_[a * regions_ + b] = index_[b * regions_ + a] = static_cast<std::int32_t>(laws_.size());
  laws_.push_back(law), pairs_.push_back({a, b});
}

std::vector<std::uint8_t> LawTable::touching() const {
  std::vector<std::uint8_t> touching(regions_, 0);
  for (const auto [a, b] : pairs_) touching[a] = touching[b] = 1;
  return touching;
}

PairModuli::PairModuli(const Material& a, const Material& b) {
  const auto normal = [](const Material& m) { return (1 - m.poisson * m.poisson) / m.young; };
  const auto shear = [](const Material& m) { return (2 - m.poisson) / m.mu(); };
  E = 1 / (normal(a) + normal(b)), G = 1 / (shear(a) + shear(b));
}

double layer_modulus(const Material& material) { return material.lambda() + 2 * material.mu(); }

double NormalStiffness::force(double d) const { return hertz ? k * d * std::sqrt(d) : k * d; }
double NormalStiffness::tangent(double d) const { return hertz ? 1.5 * k * std::sqrt(d) : k; }
double NormalStiffness::energy(double d) const {
  return hertz ? 0.4 * k * d * d * std::sqrt(d) : 0.5 * k * d * d;
}

double damping_ratio(Law::Normal normal, double restitution) {
  if (restitution >= 1) return 0;
  double low = 0, high = 1;
  const bool hertz = normal == Law::Normal::hertz;
  while (restitution_of(hertz, high) > restitution) high *= 2;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (restitution_of(hertz, middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace geist::contact
