// View: a table of a document through the key table. Values are handed out only if the key table knows and
// accepts them; asking for a key that is not in the key table is a mistake of the program and throws
// std::logic_error.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/convert.hpp"
#include "case/document.hpp"
#include "case/keys.hpp"

namespace geist {

class View {
 public:
  /// The whole file.
  explicit View(const Document& document);

  /// Is the key there, acceptable or not?
  bool has(std::string_view key) const;

  /// Is it there, and acceptable?
  bool acceptable(std::string_view key) const { return acceptable_node(key) != nullptr; }

  /// The key's value; empty if it is absent or not acceptable. Vectors are lists of any length, arrays of
  /// just N.
  template <class T>
  std::optional<T> get(std::string_view key) const {
    const toml::node* node = acceptable_node(key);
    return node ? Reader<T>::read(*node) : std::nullopt;
  }
  std::optional<View> table(std::string_view key) const;
  std::vector<View> tables(std::string_view key) const;
  std::vector<View> named(std::string_view key) const;  ///< in the order of the file

  const std::string& name() const { return name_; }  ///< of a named table
  std::vector<std::string> keys() const;             ///< those given, in the key table's order

  toml::source_region place() const { return table_->source(); }
  toml::source_region place(std::string_view key) const;  ///< of a value; of the table if there is none
  bool set(std::string_view key) const;                   ///< is the value from a --set option?
  Source source() const { return source_of(*document_, *table_, place()); }

 private:
  template <class T>
  struct Reader {
    static std::optional<T> read(const toml::node& node) { return convert<T>(node); }
  };
  template <class T, std::size_t N>
  struct Reader<std::array<T, N>> {
    static std::optional<std::array<T, N>> read(const toml::node& node) { return convert_array<T, N>(node); }
  };
  template <class T>
  struct Reader<std::vector<T>> {
    static std::optional<std::vector<T>> read(const toml::node& node) { return convert_list<T>(node); }
  };

  View(const Document& document, const toml::table& table, const Table& kind, std::string name);
  const toml::node* acceptable_node(std::string_view key) const;
  const Table& kind_of(std::string_view key) const;

  const Document* document_;
  const toml::table* table_;
  const Table* kind_;
  std::string name_;
};

}  // namespace geist
