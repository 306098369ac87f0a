// Checking a document against the key table.
#include "case/check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "case/convert.hpp"
#include "case/suggest.hpp"

namespace geist {

namespace {

/// Report on one table and all in it; `path` is its name for messages, `place` where it is.
class Checker {
 public:
  explicit Checker(Document& document) : document_(document) {}

  void table(const toml::table& table, const Table& kind, const std::string& path) {
    for (const auto& [key, node] : table) entry(table, kind, path, key, node);
    for (const Key& key : kind.keys) missing(table, kind, path, key);
    for (const Group& group : kind.groups) grouped(table, kind, path, group);
  }

 private:
  void entry(const toml::table& table, const Table& kind, const std::string& path, const toml::key& key,
             const toml::node& node) {
    const std::vector<std::string> known = key_names(kind);
    if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
      const std::string where = path.empty() ? "" : fmt::format(" in '{}'", path);
      document_.report(key.source(),
                       fmt::format("unknown key '{}'{}{}", printable(std::string(key.str()), 60), where,
                                   did_you_mean(key.str(), known)));
      return;
    }
    if (const Key* found = applicable(table, kind, key.str()))
      value(*found, node, path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str()));
    else
      document_.report(key.source(), misplaced(kind, key.str()));
  }

  static std::string misplaced(const Table& kind, std::string_view name) {
    const Condition& only = keys_named(kind, name).front()->only;
    if (only.negate) return fmt::format("'{}' cannot stand beside '{}'", name, only.key);
    if (only.value.empty()) return fmt::format("'{}' needs '{}' beside it", name, only.key);
    return fmt::format("'{}' is only for {} = \"{}\"", name, only.key, only.value);
  }

  void missing(const toml::table& table, const Table& kind, const std::string& path, const Key& key) {
    if (table.contains(key.name) || holds(table, kind, key.only) != Holds::yes) return;
    const bool conditional = !key.needed_if.always() && holds(table, kind, key.needed_if) == Holds::yes;
    if (!key.needed && !conditional) return;
    const std::string why = conditional ? fmt::format(" where {}", key.needed_if.describe()) : "";
    report_missing(table, path, fmt::format("'{}'{}: {}", key.name, why, key.describe()));
  }

  void grouped(const toml::table& table, const Table& kind, const std::string& path, const Group& group) {
    if (holds(table, kind, group.when) != Holds::yes) return;
    std::vector<const toml::key*> given;
    std::vector<std::string> names;
    for (const std::string_view name : group.keys) {
      names.push_back(fmt::format("'{}'", name));
      if (const auto found = table.find(name); found != table.end()) given.push_back(&found->first);
    }
    const std::string how = group.exclusive ? "exactly one" : "at least one";
    if (given.empty()) report_missing(table, path, fmt::format("{} of {}", how, join(names, "and")));
    if (group.exclusive && given.size() > 1)
      document_.report(later(*given[0], *given[1]).source(),
                       fmt::format("'{}' and '{}' exclude each other; give {} of {}", given[0]->str(),
                                   given[1]->str(), how, join(names, "and")));
  }

  static const toml::key& later(const toml::key& a, const toml::key& b) {
    const auto &p = a.source().begin, &q = b.source().begin;
    return p.line > q.line || (p.line == q.line && p.column > q.column) ? a : b;
  }

  void report_missing(const toml::table& table, const std::string& path, const std::string& what) {
    if (path.empty()) {  // the whole file: its place is its beginning
      document_.report({{1, 1}, {1, 1}, nullptr}, fmt::format("the case needs {}", what));
    } else {
      document_.report(table.source(), fmt::format("'{}' needs {}", path, what));
    }
  }

  void value(const Key& key, const toml::node& node, const std::string& path) {
    if (!acceptable(key, node))
      return key.type == Type::named && node.is_table() ? unnamed(key, node) : wrong(key, node);
    if (key.type == Type::table) return table(*node.as_table(), table_of(key.of), path);
    if (key.type == Type::tables) {
      const toml::array& list = *node.as_array();
      for (std::size_t i = 0; i < list.size(); ++i)
        table(*list.get(i)->as_table(), table_of(key.of), fmt::format("{}.{}", path, i));
    }
    if (key.type == Type::named) named(key, *node.as_table(), path);
    if (key.type == Type::reference) reference(key, key.name, node);
    if (key.type == Type::pair && node.is_array())
      for (const toml::node& name : *node.as_array()) reference(key, "region", name);
  }

  void wrong(const Key& key, const toml::node& node) {
    const auto text = convert<std::string>(node);
    const bool choice = key.type == Type::choice && text;
    const std::string near = choice ? nearest(*text, {key.allowed.begin(), key.allowed.end()}) : "";
    const std::string hint = near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
    document_.report(node.source(), fmt::format("'{}' must be {}, not {}{}", key.name, key.describe(),
                                                text_at(document_, node.source()), hint));
  }

  /// A table of named tables that is empty, or holds something else.
  void unnamed(const Key& key, const toml::node& node) {
    const std::string_view heading = table_of(key.of).heading;
    if (node.as_table()->empty())
      document_.report(node.source(), fmt::format("'{}' needs at least one table {}", key.name, heading));
    for (const auto& [name, entry] : *node.as_table())
      if (!entry.is_table())
        document_.report(name.source(), fmt::format("'{}' stands outside of a table {}",
                                                    printable(std::string(name.str()), 60), heading));
  }

  void named(const Key& key, const toml::table& tables, const std::string& path) {
    for (const auto& [name, node] : tables) {
      if (!sane_name(name.str()))
        document_.report(name.source(), "a name may have letters, digits, '_' and '-' only");
      else
        table(*node.as_table(), table_of(key.of), fmt::format("{}.{}", path, name.str()));
    }
  }

  /// The name of a thing of this kind.
  void reference(const Key& key, std::string_view kind, const toml::node& node) {
    const std::string name = *convert<std::string>(node);
    std::vector<std::string> known;
    if (const toml::table* named = document_.root[key.of].as_table())
      for (const auto& entry : *named) known.emplace_back(entry.first.str());
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    const std::string none = known.empty() ? fmt::format("; there are no {}", key.of) : "";
    document_.report(node.source(), fmt::format("unknown {} '{}'{}{}", kind, printable(name, 60),
                                                did_you_mean(name, known), none));
  }

  Document& document_;
};

}  // namespace

void check(Document& document) { Checker(document).table(document.root, key_table().front(), ""); }

}  // namespace geist
