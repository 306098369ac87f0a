// Builders of the key table's entries, and the tables that key_table_run.cpp holds. For key_table*.cpp only.
#pragma once
#include "case/keys.hpp"

namespace geist {

namespace key_builders {

using Words = std::vector<std::string_view>;

inline Key text(std::string_view name, std::string_view say) { return {name, Type::text, "-", say}; }
inline Key boolean(std::string_view name, std::string_view say) { return {name, Type::boolean, "-", say}; }
inline Key number(std::string_view name, std::string_view unit, std::string_view say) {
  return {name, Type::number, unit, say};
}
inline Key value(Type type, std::string_view name, std::string_view unit, std::string_view say) {
  return {name, type, unit, say};
}
inline Key choice(std::string_view name, const Words& allowed, std::string_view say,
                  Type type = Type::choice) {
  Key key{name, type, "-", say};
  key.allowed = allowed;
  return key;
}
inline Key within(Type type, std::string_view name, std::string_view of, std::string_view say) {
  Key key{name, type, "-", say};
  key.of = of;
  return key;
}

}  // namespace key_builders

Table contact_table();
Table where_table();
Table supports_table();
Table displacement_table();
Table velocity_table();
Table loads_table();
Table initial_table();
Table analysis_table();
Table probes_table();
Table output_table();
Table fields_table();
Table every_table();

}  // namespace geist
