#include "output/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>

namespace geist::output {
namespace {

UnitName find(std::span<const UnitName> known, std::string_view kind, std::string_view name) {
  const auto it = std::find_if(known.begin(), known.end(), [&](UnitName u) { return u.name == name; });
  if (it == known.end()) throw std::invalid_argument(fmt::format("unknown unit of {} \"{}\"", kind, name));
  return *it;
}

/// "N", "Pa" or "J", or nothing.
std::string_view si_name(Dimension d) {
  if (d == dimension::force) return "N";
  if (d == dimension::stress) return "Pa";
  if (d == dimension::energy) return "J";
  return {};
}

/// SI prefix of a power of ten, or nullptr.
const char* si_prefix(int power) {
  constexpr std::array prefixes{"n", "u", "m", "", "k", "M", "G", "T"};
  const bool known = power % 3 == 0 && power >= -9 && power <= 12;
  return known ? prefixes[(power + 9) / 3] : nullptr;
}

/// "mm" or "mm^3", joined with a star to what is there.
void multiply(std::string& product, std::string_view unit, int power) {
  if (power <= 0) return;
  if (!product.empty()) product += '*';
  product += unit;
  if (power > 1) product += fmt::format("^{}", power);
}

}  // namespace

UnitSystem::UnitSystem(std::string_view length, std::string_view mass, std::string_view time)
    : length_(find(lengths, "length", length)),
      mass_(find(masses, "mass", mass)),
      time_(find(times, "time", time)) {}

std::string UnitSystem::label(Dimension d) const {
  const char* prefix = si_prefix(d.length * length_.power + d.mass * mass_.power + d.time * time_.power);
  if (!si_name(d).empty() && prefix) return fmt::format("{}{}", prefix, si_name(d));

  std::string above, below;
  multiply(above, "rad", d.angle), multiply(below, "rad", -d.angle);
  multiply(above, mass_.name, d.mass), multiply(below, mass_.name, -d.mass);
  multiply(above, length_.name, d.length), multiply(below, length_.name, -d.length);
  multiply(above, time_.name, d.time), multiply(below, time_.name, -d.time);
  if (above.empty()) above += '1';
  if (below.empty()) return above;
  const bool product = below.find('*') != below.npos;
  return product ? fmt::format("{}/({})", above, below) : fmt::format("{}/{}", above, below);
}

}  // namespace geist::output
