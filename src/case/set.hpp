// --set PATH=VALUE: changing a case from the command line.
#pragma once
#include <string>
#include <vector>

#include "case/document.hpp"

namespace geist {

/// Put the options' values into the document, in order. PATH is dotted, entries of lists are counted from 0
/// (loads.0.total_force), the number after the last one appends. VALUE is TOML; what is no TOML value and has
/// no brackets or quotes is taken as text. Problems go to document.problems.
void apply_sets(Document& document, const std::vector<std::string>& options);

}  // namespace geist
