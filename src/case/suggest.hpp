// Suggestions for a misspelt word.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace geist {

/// Least number of letters to insert, delete, replace or swap with their neighbour to turn a into b.
int edit_distance(std::string_view a, std::string_view b);

/// The known word that is nearest, or empty if none is near enough.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean 'x'?", or "; known: x, y, z", or empty if nothing is known.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace geist
