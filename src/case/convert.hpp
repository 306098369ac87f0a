// From a TOML value to a C++ one; empty where the value is not of the shape wanted, or a number is not
// finite.
#pragma once
#include <toml++/toml.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"

namespace geist {

template <class T>
std::optional<T> convert(const toml::node& node);

template <>
std::optional<double> convert<double>(const toml::node& node);
template <>
std::optional<long> convert<long>(const toml::node& node);
template <>
std::optional<bool> convert<bool>(const toml::node& node);
template <>
std::optional<std::string> convert<std::string>(const toml::node& node);
template <>
std::optional<Vec3> convert<Vec3>(const toml::node& node);
/// Low corner lower in every direction.
template <>
std::optional<Box> convert<Box>(const toml::node& node);
/// low ≤ high; a number is a plane.
template <>
std::optional<Where::Interval> convert<Where::Interval>(const toml::node& node);
/// [[time, value], …] with times strictly increasing.
template <>
std::optional<Curve> convert<Curve>(const toml::node& node);

/// "all" or two names.
template <>
std::optional<ContactSpec::Between> convert<ContactSpec::Between>(const toml::node& node);

/// A list of exactly N.
template <class T, std::size_t N>
std::optional<std::array<T, N>> convert_array(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (!list || list->size() != N) return {};
  std::array<T, N> result{};
  for (std::size_t i = 0; i < N; ++i) {
    const std::optional<T> element = convert<T>(*list->get(i));
    if (!element) return {};
    result[i] = *element;
  }
  return result;
}

/// A list of at least one.
template <class T>
std::optional<std::vector<T>> convert_list(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (!list || list->empty()) return {};
  std::vector<T> result;
  for (const toml::node& entry : *list) {
    const std::optional<T> element = convert<T>(entry);
    if (!element) return {};
    result.push_back(*element);
  }
  return result;
}

}  // namespace geist
