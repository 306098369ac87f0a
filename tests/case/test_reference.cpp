// The reference and the schema in the tree are those of the key table.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "case/generated.hpp"
#include "case/keys.hpp"
#include "case/read.hpp"
#include "case/reference.hpp"

namespace geist {

namespace {

using Json = nlohmann::json;

TEST(Reference, IsUpToDate) { expect_generated("docs/case-file.md", case_reference_markdown()); }

TEST(Schema, IsUpToDate) { expect_generated("docs/case.schema.json", case_schema_json()); }

TEST(Reference, NamesEveryKey) {
  const std::string text = case_reference_markdown();
  for (const Table& table : key_table())
    for (const Key& key : table.keys)
      EXPECT_NE(text.find("| `" + std::string(key.name) + "` | "), std::string::npos) << key.name;
}

TEST(Reference, ExampleIsAGoodCase) {
  const std::string text = case_reference_markdown();
  const std::string fence = "```toml\n";
  const std::size_t begin = text.find(fence) + fence.size();
  const std::string example = text.substr(begin, text.find("```", begin) - begin);
  EXPECT_EQ(read_case_text(example, "example.toml").regions.size(), 3u);
}

/// Every "$ref" leads to a definition, and every object says which keys it has.
void expect_sound(const Json& schema, const Json& definitions) {
  if (schema.is_array())
    for (const Json& element : schema) expect_sound(element, definitions);
  if (!schema.is_object()) return;
  if (schema.contains("$ref") && schema["$ref"].is_string()) {
    const std::string target = schema["$ref"], prefix = "#/$defs/";
    ASSERT_EQ(target.rfind(prefix, 0), 0u);
    EXPECT_TRUE(definitions.contains(target.substr(prefix.size()))) << target;
  }
  const bool object = schema.value("type", Json()) == "object";
  EXPECT_TRUE(!object || schema.at("additionalProperties") == false);
  for (const auto& [name, value] : schema.items()) expect_sound(value, definitions);
}

TEST(Schema, IsSound) {
  const Json schema = Json::parse(case_schema_json());
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  expect_sound(schema, schema.at("$defs"));
}

TEST(Schema, KnowsRangesChoicesAndDefaults) {
  const Json schema = Json::parse(case_schema_json());
  const Json& regions = schema["$defs"]["regions"]["properties"];
  EXPECT_EQ(regions["radius"]["exclusiveMinimum"], 0);
  EXPECT_EQ(regions["hourglass"]["default"], "stiffness");
  EXPECT_FALSE(regions["formulation"].contains("default"));  // it depends on the method
  EXPECT_EQ(regions["type"]["enum"], Json({"hexahedra", "lattice"}));
  EXPECT_EQ(schema["required"], Json({"units", "materials", "regions", "analysis"}));
  for (const Key& key : key_table().front().keys)
    EXPECT_TRUE(schema["properties"].contains(key.name)) << key.name;
}

}  // namespace

}  // namespace geist
