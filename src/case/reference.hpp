// The reference of the case file and its JSON Schema, made from the key table.
#pragma once
#include <string>

namespace geist {

/// docs/case-file.md.
std::string case_reference_markdown();

/// docs/case.schema.json: JSON Schema (draft 2020-12), for editors that check TOML while one types.
std::string case_schema_json();

}  // namespace geist
