// The key table is sound, and nothing can be read that it does not know.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "case/check.hpp"
#include "case/everything.hpp"
#include "case/malformed.hpp"
#include "case/suggest.hpp"
#include "case/view.hpp"

namespace geist {

namespace {

bool known(const Table& table, std::string_view key) {
  const std::vector<std::string> names = key_names(table);
  return std::find(names.begin(), names.end(), key) != names.end();
}

TEST(KeyTable, TablesAreNamedOnce) {
  std::set<std::string_view> names;
  for (const Table& table : key_table()) EXPECT_TRUE(names.insert(table.name).second) << table.name;
  EXPECT_THROW(table_of("windmill"), std::logic_error);
}

TEST(KeyTable, EverythingReferredToExists) {
  for (const Table& table : key_table()) {
    for (const Key& key : table.keys) {
      for (const Condition& condition : {key.only, key.needed_if})
        EXPECT_TRUE(condition.always() || known(table, condition.key)) << key.name;
      if (key.type == Type::table || key.type == Type::tables || key.type == Type::named) table_of(key.of);
      if (key.type != Type::reference && key.type != Type::pair) continue;
      EXPECT_EQ(keys_named(key_table().front(), key.of).front()->type, Type::named) << key.name;
    }
    for (const Group& group : table.groups)
      for (const std::string_view name : group.keys) EXPECT_TRUE(known(table, name)) << name;
  }
}

TEST(KeyTable, EveryKeyIsExplainedInASentence) {
  for (const Table& table : key_table()) {
    EXPECT_FALSE(table.text.empty());
    for (const Key& key : table.keys) {
      EXPECT_EQ(key.text.back(), '.') << key.name;
      EXPECT_FALSE(key.unit.empty()) << key.name;
      EXPECT_FALSE(key.describe().empty()) << key.name;
    }
  }
}

TEST(KeyTable, DefaultsAreAcceptable) {
  for (const Table& table : key_table()) {
    for (const Key& key : table.keys) {
      if (key.fallback.empty()) continue;
      const toml::table parsed = toml::parse("value = " + std::string(key.fallback));
      EXPECT_TRUE(acceptable(key, *parsed.get("value"))) << key.name;
      EXPECT_FALSE(key.needed) << key.name << " is required and has a default";
    }
  }
}

TEST(KeyTable, OtherKeysCannotBeRead) {
  const Document document = parse_document(good_case, "case.toml");
  const View root(document);
  EXPECT_THROW(root.get<double>("windmill"), std::logic_error);
  EXPECT_THROW(root.has("windmill"), std::logic_error);
  EXPECT_THROW(root.table("windmill"), std::logic_error);
  EXPECT_THROW(root.table("analysis")->get<double>("radius"), std::logic_error);
}

/// Names of the keys used in a table and below, as "table.key".
void collect(const toml::table& table, const Table& kind, std::set<std::string>& used) {
  for (const auto& [name, node] : table) {
    const Key* key = applicable(table, kind, name.str());
    ASSERT_NE(key, nullptr) << name.str();
    used.insert(std::string(kind.name) + "." + std::string(key->name));
    if (key->type == Type::table) collect(*node.as_table(), table_of(key->of), used);
    if (key->type == Type::tables)
      for (const toml::node& element : *node.as_array())
        collect(*element.as_table(), table_of(key->of), used);
    if (key->type == Type::named)
      for (const auto& entry : *node.as_table()) collect(*entry.second.as_table(), table_of(key->of), used);
  }
}

TEST(KeyTable, TestCasesUseEveryKey) {
  std::set<std::string> used;
  for (const char* text : {everything, good_case})
    collect(parse_document(text, "case.toml").root, key_table().front(), used);
  const std::set<std::string> beside{"displacement.y",  "displacement.z", "displacement.rx",
                                     "displacement.rz", "velocity.x",     "velocity.z",
                                     "velocity.rx",     "velocity.ry",    "analysis.max_iterations"};
  for (const Table& table : key_table())
    for (const Key& key : table.keys) {
      const std::string path = std::string(table.name) + "." + std::string(key.name);
      EXPECT_TRUE(used.count(path) || beside.count(path)) << path << " is in no test case";
    }
}

TEST(Suggest, Distance) {
  EXPECT_EQ(edit_distance("radius", "radius"), 0);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(Suggest, OnlyWhatIsNear) {
  EXPECT_EQ(nearest("Raduis", {"box", "radius"}), "radius");
  EXPECT_EQ(nearest("windmill", {"box", "radius"}), "");
  EXPECT_EQ(did_you_mean("boxx", {"box", "radius"}), "; did you mean 'box'?");
  EXPECT_EQ(did_you_mean("windmill", {"box", "radius"}), "; known: box, radius");
  EXPECT_EQ(did_you_mean("windmill", {}), "");
  EXPECT_EQ(nearest("w", {"x", "y"}), "");
}

TEST(Diagnostic, MarksWideCharactersAndTabsAtTheirPlace) {
  const Diagnostic diagnostic{"a.toml", 3, 5, "µm", "wrong", "\té = \"µm\""};
  EXPECT_EQ(diagnostic.describe(), "a.toml:3:5: error: wrong\n     3 | \té = \"µm\"\n       | \t   ^~");
}

TEST(Diagnostic, PrintableTextHasNoControlCharacters) {
  EXPECT_EQ(printable("a\x1B[2Jb", 20), "a?[2Jb");
  EXPECT_EQ(printable("abcdef", 3), "abc…");
  EXPECT_EQ(printable("ab\ncd", 10), "ab…");
  EXPECT_EQ(printable("\xFFz", 10), "?z");
}

}  // namespace

}  // namespace geist
