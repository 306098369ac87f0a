// Reading a case: from a TOML file and --set options to a validated Case. No other part of the program sees
// TOML.
#pragma once
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/diagnostic.hpp"

namespace geist {

/// Read the file, apply the options ("PATH=VALUE"), validate; CaseError with everything that is wrong.
Case read_case(const std::string& path, const std::vector<std::string>& set = {});

/// The same from text; `file` is its name in messages.
Case read_case_text(const std::string& text, const std::string& file,
                    const std::vector<std::string>& set = {});

}  // namespace geist
