// Checking a document against the key table: unknown, missing and misplaced keys, wrong types, values out of
// range, names of things that do not exist. What needs several values together is in rules.hpp.
#pragma once
#include "case/document.hpp"
#include "case/keys.hpp"

namespace geist {

/// Does the condition hold in this table? Unknown where the key that it depends on is itself missing or
/// wrong.
enum class Holds { no, yes, unknown };
Holds holds(const toml::table& table, const Table& kind, const Condition& condition);

/// The entry of the key table that applies to a key here; null if the key has none here (any, where it is
/// unknown).
const Key* applicable(const toml::table& table, const Table& kind, std::string_view name);

/// Is the value one that the key may have? References are checked for their type only.
bool acceptable(const Key& key, const toml::node& node);

/// Report everything that contradicts the key table.
void check(Document& document);

/// Leave out the file's keys that a --set option has made pointless: those that belong to another choice than
/// the one set (radius, after --set regions.a.type=hexahedra), or that exclude a key set (box, after boxes).
void drop_outvoted(Document& document);

/// Fill in the defaults of everything that is absent.
void fill_defaults(toml::table& table, const Table& kind);

}  // namespace geist
