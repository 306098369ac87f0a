// A case as TOML text.
#pragma once
#include <string>

#include "case/document.hpp"

namespace geist {

/// The document in the key table's order, with all that has been set and filled in; it reads back to the same
/// case.
std::string write_toml(const Document& document);

}  // namespace geist
