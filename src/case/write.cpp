// A case as TOML text. Numbers are written with as many digits as give the same number back.
#include "case/write.hpp"

#include <fmt/format.h>

#include <cmath>

#include "case/keys.hpp"

namespace geist {

namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (byte < 0x20 || byte == 0x7F)
      result += fmt::format("\\u{:04X}", byte);
    else
      result += c;
  }
  return result + "\"";
}

std::string number(double value) {
  if (value == 0) return std::signbit(value) ? "-0.0" : "0.0";
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string value_text(const toml::node& node);

/// A table in braces, its keys in the order of the alphabet.
std::string inline_table(const toml::table& table) {
  std::string text;
  for (const auto& [key, node] : table)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key.str(), value_text(node));
  return text.empty() ? "{}" : fmt::format("{{ {} }}", text);
}

std::string value_text(const toml::node& node) {
  if (const toml::table* table = node.as_table()) return inline_table(*table);
  if (const auto* text = node.as_string()) return quoted(text->get());
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* real = node.as_floating_point()) return number(real->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  std::string text;
  for (const toml::node& element : *node.as_array())
    text += fmt::format("{}{}", text.empty() ? "" : ", ", value_text(element));
  return fmt::format("[{}]", text);
}

/// The lines "key = value" of a table, in the key table's order.
std::string lines(const toml::table& table, const Table& kind) {
  std::string text;
  for (const std::string& name : key_names(kind))
    if (const toml::node* node = table.get(name)) text += fmt::format("{} = {}\n", name, value_text(*node));
  return text;
}

std::string section(const Document& document, const Key& key, const toml::node& node) {
  const Table& kind = table_of(key.of);
  std::string text;
  if (key.type == Type::table) text += fmt::format("\n[{}]\n{}", key.name, lines(*node.as_table(), kind));
  if (key.type == Type::tables)
    for (const toml::node& element : *node.as_array())
      text += fmt::format("\n[[{}]]\n{}", key.name, lines(*element.as_table(), kind));
  if (key.type == Type::named)
    for (const auto& [name, element] : in_order(document, *node.as_table()))
      text += fmt::format("\n[{}.{}]\n{}", key.name, name, lines(*element->as_table(), kind));
  return text;
}

}  // namespace

std::string write_toml(const Document& document) {
  std::string text;
  for (const Key& key : key_table().front().keys) {
    const toml::node* node = document.root.get(key.name);
    if (!node) continue;
    const bool has_section = key.type == Type::table || key.type == Type::tables || key.type == Type::named;
    text +=
        has_section ? section(document, key, *node) : fmt::format("{} = {}\n", key.name, value_text(*node));
  }
  return text;
}

}  // namespace geist
