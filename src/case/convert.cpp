// From a TOML value to a C++ one.
#include "case/convert.hpp"

#include <cmath>

namespace geist {

template <>
std::optional<double> convert<double>(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  const auto* number = node.as_floating_point();
  if (!number || !std::isfinite(number->get())) return {};
  return number->get();
}

template <>
std::optional<long> convert<long>(const toml::node& node) {
  const auto* integer = node.as_integer();
  if (!integer) return {};
  return static_cast<long>(integer->get());
}

template <>
std::optional<bool> convert<bool>(const toml::node& node) {
  const auto* boolean = node.as_boolean();
  if (!boolean) return {};
  return boolean->get();
}

template <>
std::optional<std::string> convert<std::string>(const toml::node& node) {
  const auto* text = node.as_string();
  if (!text) return {};
  return text->get();
}

template <>
std::optional<Vec3> convert<Vec3>(const toml::node& node) {
  const auto a = convert_array<double, 3>(node);
  if (!a) return {};
  return Vec3{(*a)[0], (*a)[1], (*a)[2]};
}

template <>
std::optional<Box> convert<Box>(const toml::node& node) {
  const auto ends = convert_array<Vec3, 2>(node);
  if (!ends) return {};
  const auto& [low, high] = *ends;
  if (!(low.x < high.x && low.y < high.y && low.z < high.z)) return {};
  return Box{low, high};
}

template <>
std::optional<Where::Interval> convert<Where::Interval>(const toml::node& node) {
  if (const auto plane = convert<double>(node)) return Where::Interval{*plane, *plane};
  const auto ends = convert_array<double, 2>(node);
  if (!ends || (*ends)[0] > (*ends)[1]) return {};
  return Where::Interval{(*ends)[0], (*ends)[1]};
}

template <>
std::optional<Curve> convert<Curve>(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (!list || list->empty()) return {};
  Curve curve;
  for (const toml::node& entry : *list) {
    const auto point = convert_array<double, 2>(entry);
    if (!point || (!curve.points.empty() && (*point)[0] <= curve.points.back()[0])) return {};
    curve.points.push_back(*point);
  }
  return curve;
}

template <>
std::optional<ContactSpec::Between> convert<ContactSpec::Between>(const toml::node& node) {
  if (convert<std::string>(node) == "all") return ContactSpec::Between{};
  const auto names = convert_array<std::string, 2>(node);
  if (!names) return {};
  return ContactSpec::Between{names};
}

}  // namespace geist
