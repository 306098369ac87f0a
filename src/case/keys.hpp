// The key table: every key that a case file may hold, once, with all that is to be known about it.
//
// Validation (check.hpp), defaults (defaults.hpp), reading (view.hpp), docs/case-file.md and the JSON Schema
// (reference.hpp) are all made from it; nothing else lists keys. The data are in key_table.cpp.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace geist {

/// What a value looks like in the file.
enum class Type {
  text,       ///< any string
  reference,  ///< the name of an entry of the root table `of`
  pair,       ///< two of these names, which may be the same; or "all"
  boolean,    ///< true or false
  number,     ///< finite; a whole number is welcome
  numbers,    ///< list of at least one number
  integer,    ///< whole number
  vector,     ///< [x, y, z]
  box,        ///< [[x, y, z], [x, y, z]], low corner first
  boxes,      ///< list of boxes
  corners,    ///< eight points in VTK's order
  counts,     ///< two or three whole numbers
  points,     ///< [[time, value], …], times strictly increasing
  interval,   ///< a number or [low, high]
  choice,     ///< one of the key's choices
  choices,    ///< list of different ones of the key's choices
  table,      ///< one table of kind `of`
  tables,     ///< list of tables of kind `of`
  named       ///< tables of kind `of`, named by the user
};

/// Limits of a number; an open end is excluded itself.
struct Range {
  std::optional<double> low, high;
  bool low_open = false, high_open = false;

  bool contains(double value) const;
  /// "> 0", "in [0, 1]", or empty without limits.
  std::string describe() const;
};

/// Holds where the key beside it has the value (or is there at all, if value is empty); `negate`: where not.
struct Condition {
  std::string_view key, value;
  bool negate = false;

  bool always() const { return key.empty(); }
  /// "type = "lattice"", "gravity is absent".
  std::string describe() const;
};

/// One key of a table.
struct Key {
  std::string_view name;
  Type type;
  std::string_view unit;            ///< dimension, or "-"
  std::string_view text;            ///< one sentence for the reference
  Range range = {};                 ///< of the number, or of each number of a list
  std::string_view fallback = {};   ///< default in TOML; empty: none
  std::string_view published = {};  ///< default of the published method, if it has one of its own
  bool needed = false;
  std::vector<std::string_view> allowed = {};  ///< the choices
  std::string_view of = {};  ///< name of the table's kind, or of the root table that a reference looks in
  Condition only = {};       ///< the key may be given only here
  Condition needed_if = {};  ///< and must be given here

  // Builders, so that the table reads as a table.
  Key above(double low) const;
  Key at_least(double low) const;
  Key range_is(Range limits) const;
  Key required() const;
  Key required_when(Condition condition) const;
  Key otherwise(std::string_view toml) const;
  Key otherwise(std::string_view toml, std::string_view published) const;
  Key when(Condition condition) const;

  /// What is allowed, for messages: "a number > 0".
  std::string describe() const;
};

/// Keys of one table of which exactly one, or at least one, must be given (where the condition holds).
struct Group {
  bool exclusive;
  std::vector<std::string_view> keys;
  Condition when = {};
};

/// One kind of table.
struct Table {
  std::string_view
      name;  ///< path pattern: "materials.*", "supports[]"; no dots for kinds used in several places
  std::string_view heading;  ///< as written in a case file
  std::string_view text;     ///< a paragraph for the reference
  std::vector<Key> keys;
  std::vector<Group> groups = {};
};

/// All tables, in the order of the reference; the first one is the whole file.
const std::vector<Table>& key_table();

/// The table of this name; std::logic_error if there is none.
const Table& table_of(std::string_view name);

/// All entries for a key of a table (several if its meaning depends on another key: the first that may be
/// given counts); std::logic_error if
/// none.
std::vector<const Key*> keys_named(const Table& table, std::string_view name);

/// Names of a table's keys, each once, in the table's order.
std::vector<std::string> key_names(const Table& table);

/// May a material, region, curve or probe be called so? Letters, digits, "_" and "-".
bool sane_name(std::string_view name);

/// "a, b or c" (last: the word before the last one).
std::string join(const std::vector<std::string>& words, std::string_view last);

}  // namespace geist
