// The key table's conditions and values, evaluated; and what follows from them without a word to the user.
#include <algorithm>
#include <cmath>
#include <set>

#include "case/check.hpp"
#include "case/convert.hpp"

namespace geist {

namespace {

Holds negated(Holds holds, bool negate) {
  if (!negate || holds == Holds::unknown) return holds;
  return holds == Holds::yes ? Holds::no : Holds::yes;
}

Holds same(std::string_view is, std::string_view wanted) { return is == wanted ? Holds::yes : Holds::no; }

bool is_list_of_tables(const toml::node& node) {
  const toml::array* list = node.as_array();
  return list && std::all_of(list->begin(), list->end(), [](const toml::node& n) { return n.is_table(); });
}

bool is_table_of_tables(const toml::node& node, bool may_be_empty) {
  const toml::table* table = node.as_table();
  return table && (may_be_empty || !table->empty()) &&
         std::all_of(table->begin(), table->end(), [](const auto& entry) { return entry.second.is_table(); });
}

bool is_choice(const Key& key, std::string_view word) {
  return std::find(key.allowed.begin(), key.allowed.end(), word) != key.allowed.end();
}

bool are_choices(const Key& key, const toml::node& node) {
  const auto words = convert_list<std::string>(node);
  if (!words) return false;
  const std::set<std::string> different(words->begin(), words->end());
  return different.size() == words->size() &&
         std::all_of(words->begin(), words->end(),
                     [&](const std::string& word) { return is_choice(key, word); });
}

bool in_range(const Key& key, const std::optional<double>& value) {
  return value && key.range.contains(*value);
}

bool are_numbers(const Key& key, const toml::node& node) {
  const auto list = convert_list<double>(node);
  return list && std::all_of(list->begin(), list->end(), [&](double x) { return in_range(key, x); });
}

bool are_counts(const Key& key, const toml::node& node) {
  const auto counts = convert_list<long>(node);
  return counts && (counts->size() == 2 || counts->size() == 3) &&
         std::all_of(counts->begin(), counts->end(),
                     [&](long count) { return key.range.contains(static_cast<double>(count)); });
}

}  // namespace

Holds holds(const toml::table& table, const Table& kind, const Condition& condition) {
  if (condition.always()) return Holds::yes;
  const toml::node* node = table.get(condition.key);
  if (condition.value.empty()) return negated(node ? Holds::yes : Holds::no, condition.negate);
  const Key* key = applicable(table, kind, condition.key);
  if (!key) return negated(Holds::no, condition.negate);  // that key has no business here
  if (!node) {
    if (key->fallback.empty()) return Holds::unknown;
    return negated(same(key->fallback.substr(1, key->fallback.size() - 2), condition.value),
                   condition.negate);
  }
  if (!acceptable(*key, *node)) return Holds::unknown;
  return negated(same(*convert<std::string>(*node), condition.value), condition.negate);
}

const Key* applicable(const toml::table& table, const Table& kind, std::string_view name) {
  const Key* possible = nullptr;
  for (const Key* key : keys_named(kind, name)) {
    const Holds answer = holds(table, kind, key->only);
    if (answer == Holds::yes) return key;
    if (answer == Holds::unknown && !possible) possible = key;
  }
  return possible;
}

bool acceptable(const Key& key, const toml::node& node) {
  switch (key.type) {
    case Type::text:
    case Type::reference:
      return node.is_string();
    case Type::pair:
      return convert<ContactSpec::Between>(node).has_value();
    case Type::boolean:
      return node.is_boolean();
    case Type::number:
      return in_range(key, convert<double>(node));
    case Type::numbers:
      return are_numbers(key, node);
    case Type::integer:
      return node.is_integer() && in_range(key, convert<double>(node));
    case Type::vector:
      return convert<Vec3>(node).has_value();
    case Type::box:
      return convert<Box>(node).has_value();
    case Type::boxes:
      return convert_list<Box>(node).has_value();
    case Type::corners:
      return convert_array<Vec3, 8>(node).has_value();
    case Type::counts:
      return are_counts(key, node);
    case Type::points:
      return convert<Curve>(node).has_value();
    case Type::interval:
      return convert<Where::Interval>(node).has_value();
    case Type::choice:
      return node.is_string() && is_choice(key, *convert<std::string>(node));
    case Type::choices:
      return are_choices(key, node);
    case Type::table:
      return node.is_table();
    case Type::tables:
      return is_list_of_tables(node);
    case Type::named:
      return is_table_of_tables(node, !key.needed);
  }
  return false;
}

namespace {

/// Call f(table, kind) for a table and all tables in it that look as they should, outer ones first.
template <class F>
void for_each_table(toml::table& table, const Table& kind, F f) {
  f(table, kind);
  for (const Key& key : kind.keys) {
    toml::node* node = table.get(key.name);
    if (!node || applicable(table, kind, key.name) != &key) continue;
    if (key.type == Type::table && node->is_table()) for_each_table(*node->as_table(), table_of(key.of), f);
    if (key.type == Type::tables && node->is_array())
      for (toml::node& element : *node->as_array())
        if (element.is_table()) for_each_table(*element.as_table(), table_of(key.of), f);
    if (key.type == Type::named && node->is_table())
      for (auto&& [name, element] : *node->as_table())
        if (element.is_table()) for_each_table(*element.as_table(), table_of(key.of), f);
  }
}

using Names = std::set<std::string, std::less<>>;

/// Take a key of the file out of a table; one from a --set option stays, and will be complained about.
void drop(const Document& document, toml::table& table, std::string_view name, Names& decided) {
  const toml::node* node = table.get(name);
  if (!node || from_set(document, node->source())) return;
  decided.emplace(name);
  table.erase(name);
}

void drop_outvoted_in(const Document& document, toml::table& table, const Table& kind) {
  Names decided;  // keys that a --set option has given or made pointless
  for (const auto& [key, node] : table)
    if (from_set(document, node.source())) decided.emplace(key.str());
  if (decided.empty()) return;
  for (const Key& key : kind.keys)
    if (decided.count(key.only.key) && table.contains(key.name) && !applicable(table, kind, key.name))
      drop(document, table, key.name, decided);
  for (const Group& group : kind.groups) {
    const auto set = [&](std::string_view name) { return table.contains(name) && decided.count(name) > 0; };
    if (!group.exclusive || std::none_of(group.keys.begin(), group.keys.end(), set)) continue;
    if (holds(table, kind, group.when) != Holds::yes) continue;
    for (const std::string_view name : group.keys) drop(document, table, name, decided);
  }
}

}  // namespace

void drop_outvoted(Document& document) {
  for_each_table(document.root, key_table().front(),
                 [&](toml::table& table, const Table& kind) { drop_outvoted_in(document, table, kind); });
}

void fill_defaults(toml::table& root, const Table& root_kind) {
  const bool published = holds(root, root_kind, {"method", "published"}) == Holds::yes;
  for_each_table(root, root_kind, [published](toml::table& table, const Table& kind) {
    for (const Key& key : kind.keys) {
      if (key.fallback.empty() || table.contains(key.name)) continue;
      if (holds(table, kind, key.only) != Holds::yes) continue;
      const bool own = published && !key.published.empty();
      toml::table parsed = toml::parse("value = " + std::string(own ? key.published : key.fallback));
      parsed.for_each([&](const toml::key&, auto& value) { table.insert(key.name, std::move(value)); });
    }
  });
}

}  // namespace geist
