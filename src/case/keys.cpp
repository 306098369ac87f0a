// The key table's helpers: look-up and descriptions.
#include "case/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace geist {

bool Range::contains(double value) const {
  if (low && (low_open ? value <= *low : value < *low)) return false;
  return !(high && (high_open ? value >= *high : value > *high));
}

std::string Range::describe() const {
  if (low && high)
    return fmt::format("in {}{}, {}{}", low_open ? '(' : '[', *low, *high, high_open ? ')' : ']');
  if (low) return fmt::format("{} {}", low_open ? ">" : "≥", *low);
  if (high) return fmt::format("{} {}", high_open ? "<" : "≤", *high);
  return {};
}

std::string Condition::describe() const {
  if (value.empty()) return fmt::format("{} is {}", key, negate ? "absent" : "given");
  return fmt::format("{} {} \"{}\"", key, negate ? "≠" : "=", value);
}

Key Key::above(double low) const { return range_is({low, std::nullopt, true, false}); }
Key Key::at_least(double low) const { return range_is({low, std::nullopt, false, false}); }
Key Key::range_is(Range limits) const {
  Key key = *this;
  key.range = limits;
  return key;
}
Key Key::required() const {
  Key key = *this;
  key.needed = true;
  return key;
}
Key Key::required_when(Condition condition) const {
  Key key = *this;
  key.needed_if = condition;
  return key;
}
Key Key::otherwise(std::string_view toml) const {
  Key key = *this;
  key.fallback = toml;
  return key;
}

Key Key::otherwise(std::string_view toml, std::string_view published_toml) const {
  Key key = otherwise(toml);
  key.published = published_toml;
  return key;
}
Key Key::when(Condition condition) const {
  Key key = *this;
  key.only = condition;
  return key;
}

namespace {

std::vector<std::string> quoted(const std::vector<std::string_view>& words) {
  std::vector<std::string> all;
  for (const std::string_view word : words) all.push_back(fmt::format("\"{}\"", word));
  return all;
}

constexpr std::string_view box_words =
    "two opposite corners [[x, y, z], [x, y, z]], the first one lower in every direction";

std::string words(const Key& key) {
  switch (key.type) {
    case Type::text:
      return "text in quotes";
    case Type::reference:
      return fmt::format("the name of one of [{}] in quotes", key.of);
    case Type::pair:
      return fmt::format("\"all\" or two names of [{}] in a list [\"a\", \"b\"]", key.of);
    case Type::boolean:
      return "true or false";
    case Type::number:
      return "a number";
    case Type::numbers:
      return "a list of numbers, each";
    case Type::integer:
      return "a whole number";
    case Type::vector:
      return "three numbers [x, y, z]";
    case Type::box:
      return std::string(box_words);
    case Type::boxes:
      return fmt::format("a list of boxes, each {}", box_words);
    case Type::corners:
      return "eight points [x, y, z] in VTK's order";
    case Type::counts:
      return "two or three whole numbers, each";
    case Type::points:
      return "a list of pairs [time, value], each later than the one before";
    case Type::interval:
      return "a number (a plane) or an interval [low, high]";
    case Type::choice:
      return join(quoted(key.allowed), "or");
    case Type::choices:
      return fmt::format("a list of different ones of {}", join(quoted(key.allowed), "and"));
    case Type::table:
      return fmt::format("a table {}", table_of(key.of).heading);
    case Type::tables:
      return fmt::format("a list of tables {}", table_of(key.of).heading);
    case Type::named:
      return fmt::format("tables with names of your choice, {}", table_of(key.of).heading);
  }
  return {};
}

}  // namespace

std::string Key::describe() const {
  const std::string limits = range.describe();
  return limits.empty() ? words(*this) : words(*this) + " " + limits;
}

const Table& table_of(std::string_view name) {
  for (const Table& table : key_table())
    if (table.name == name) return table;
  throw std::logic_error(fmt::format("no table '{}' in the key table", name));
}

std::vector<const Key*> keys_named(const Table& table, std::string_view name) {
  std::vector<const Key*> found;
  for (const Key& key : table.keys)
    if (key.name == name) found.push_back(&key);
  if (found.empty()) throw std::logic_error(fmt::format("no key '{}.{}' in the key table", table.name, name));
  return found;
}

std::vector<std::string> key_names(const Table& table) {
  std::vector<std::string> names;
  for (const Key& key : table.keys)
    if (std::find(names.begin(), names.end(), key.name) == names.end()) names.emplace_back(key.name);
  return names;
}

bool sane_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::string join(const std::vector<std::string>& words, std::string_view last) {
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) all += i + 1 == words.size() ? fmt::format(" {} ", last) : ", ";
    all += words[i];
  }
  return all;
}

}  // namespace geist
