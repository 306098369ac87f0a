// docs/case.schema.json.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "case/keys.hpp"
#include "case/reference.hpp"

namespace geist {

namespace {

using Json = nlohmann::ordered_json;

Json limited(const char* type, const Range& range) {
  Json json{{"type", type}};
  if (range.low) json[range.low_open ? "exclusiveMinimum" : "minimum"] = *range.low;
  if (range.high) json[range.high_open ? "exclusiveMaximum" : "maximum"] = *range.high;
  return json;
}

Json list(const Json& items, int least, int most) {
  Json json{{"type", "array"}, {"items", items}, {"minItems", least}};
  if (most > 0) json["maxItems"] = most;
  return json;
}

Json vector() { return list({{"type", "number"}}, 3, 3); }

std::string definition(const Table& table) {
  std::string name(table.name);
  for (const char* ending : {".*", "[]"})
    if (name.size() > 2 && name.substr(name.size() - 2) == ending) name.resize(name.size() - 2);
  return name;
}

Json reference(const Key& key) { return {{"$ref", "#/$defs/" + definition(table_of(key.of))}}; }

Json named(const Key& key) {
  Json json{{"type", "object"},
            {"patternProperties", {{"^[A-Za-z0-9_-]+$", reference(key)}}},
            {"additionalProperties", false}};
  if (key.needed) json["minProperties"] = 1;
  return json;
}

Json choices(const Key& key) {
  Json json = list({{"type", "string"}, {"enum", key.allowed}}, 1, 0);
  json["uniqueItems"] = true;
  return json;
}

Json shape_of(const Key& key) {
  switch (key.type) {
    case Type::text:
    case Type::reference:
      return {{"type", "string"}};
    case Type::pair:
      return {{"anyOf", {Json{{"const", "all"}}, list({{"type", "string"}}, 2, 2)}}};
    case Type::boolean:
      return {{"type", "boolean"}};
    case Type::number:
      return limited("number", key.range);
    case Type::numbers:
      return list(limited("number", key.range), 1, 0);
    case Type::integer:
      return limited("integer", key.range);
    case Type::vector:
      return vector();
    case Type::box:
      return list(vector(), 2, 2);
    case Type::boxes:
      return list(list(vector(), 2, 2), 1, 0);
    case Type::corners:
      return list(vector(), 8, 8);
    case Type::counts:
      return list(limited("integer", key.range), 2, 3);
    case Type::points:
      return list(list({{"type", "number"}}, 2, 2), 1, 0);
    case Type::interval:
      return {{"anyOf", {Json{{"type", "number"}}, list({{"type", "number"}}, 2, 2)}}};
    case Type::choice:
      return {{"type", "string"}, {"enum", key.allowed}};
    case Type::choices:
      return choices(key);
    case Type::table:
      return reference(key);
    case Type::tables:
      return list(reference(key), 0, 0);
    case Type::named:
      return named(key);
  }
  return {};
}

/// The default is TOML; those that JSON writes in another way are left out.
Json schema_of(const Key& key) {
  Json json = shape_of(key);
  const std::string unit = key.unit == "-" ? "" : fmt::format(" Unit: {}.", key.unit);
  json["description"] = fmt::format("{}{}", key.text, unit);
  const Json fallback = Json::parse(key.fallback, nullptr, false);
  if (!fallback.is_discarded() && key.published.empty()) json["default"] = fallback;
  return json;
}

/// Every key of a table; one whose meaning depends on others may be any of its entries.
Json properties(const Table& table) {
  Json json = Json::object();
  for (const std::string& name : key_names(table)) {
    const auto entries = keys_named(table, name);
    if (entries.size() == 1) {
      json[name] = schema_of(*entries[0]);
    } else {
      for (const Key* key : entries) json[name]["anyOf"].push_back(schema_of(*key));
    }
  }
  return json;
}

/// A condition as a schema that the table fulfils where it holds. Without the key, its default counts.
Json when(const Table& table, const Condition& condition) {
  Json given{{"required", {condition.key}}};
  if (!condition.value.empty()) {
    const Key& key = *keys_named(table, condition.key).front();
    const bool by_default = key.fallback == fmt::format("\"{}\"", condition.value);
    given = {{"properties", {{condition.key, {{"const", condition.value}}}}}};
    if (!by_default) given["required"] = {condition.key};
  }
  return condition.negate ? Json{{"not", given}} : given;
}

Json one_of(const Table& table, const Group& group) {
  Json alternatives = Json::array();
  for (const std::string_view key : group.keys) alternatives.push_back({{"required", {key}}});
  const Json rule{{group.exclusive ? "oneOf" : "anyOf", alternatives}};
  return group.when.always() ? rule : Json{{"if", when(table, group.when)}, {"then", rule}};
}

/// What depends on conditions: where they hold a key has its own shape and may be required, elsewhere it is
/// refused.
Json conditions(const Table& table) {
  Json all = Json::array();
  for (const Key& key : table.keys) {
    if (!key.needed_if.always())
      all.push_back({{"if", when(table, key.needed_if)}, {"then", {{"required", {key.name}}}}});
    if (key.only.always()) continue;
    const bool unique = keys_named(table, key.name).size() == 1;
    Json rule{{"if", when(table, key.only)}};
    rule["then"] = unique ? Json::object() : Json{{"properties", {{key.name, shape_of(key)}}}};
    if (key.needed) rule["then"]["required"] = {key.name};
    if (unique) rule["else"] = {{"properties", {{key.name, false}}}};
    all.push_back(rule);
  }
  for (const Group& group : table.groups) all.push_back(one_of(table, group));
  return all;
}

Json object(const Table& table) {
  Json json{{"description", table.text}, {"type", "object"}, {"properties", properties(table)}};
  for (const Key& key : table.keys)
    if (key.needed && key.only.always()) json["required"].push_back(key.name);
  json["additionalProperties"] = false;
  const Json rules = conditions(table);
  if (!rules.empty()) json["allOf"] = rules;
  return json;
}

}  // namespace

std::string case_schema_json() {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Geist case file"}};
  for (const Table& table : key_table()) {
    if (table.name.empty())
      schema.update(object(table));
    else
      schema["$defs"][definition(table)] = object(table);
  }
  return schema.dump(2) + "\n";
}

}  // namespace geist
