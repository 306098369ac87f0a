// Suggestions for a misspelt word.
#include "case/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace geist {

namespace {

constexpr std::size_t longest = 64;      // letters of a word worth correcting
constexpr std::size_t most_listed = 20;  // known words in a message

std::string lower(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<int> table((a.size() + 1) * width);
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      int& best = table[i * width + j];
      if (i == 0 || j == 0) {
        best = static_cast<int>(i + j);
        continue;
      }
      const int replace = table[(i - 1) * width + j - 1] + (a[i - 1] != b[j - 1]);
      best = std::min({table[(i - 1) * width + j] + 1, table[i * width + j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        best = std::min(best, table[(i - 2) * width + j - 2] + 1);
    }
  }
  return table.back();
}

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() > longest) return {};
  std::string best;
  int least = 1000;
  for (const std::string& candidate : known) {
    if (candidate.size() > longest) continue;
    const int distance = edit_distance(lower(word), lower(candidate));
    const int allowed = std::max<int>(1, static_cast<int>(std::max(word.size(), candidate.size())) / 3);
    const bool alike =
        distance <= allowed && distance < static_cast<int>(candidate.size());  // not just as long
    if (alike && distance < least) least = distance, best = candidate;
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string near = nearest(word, known);
  if (!near.empty()) return fmt::format("; did you mean '{}'?", near);
  if (known.empty()) return {};
  const std::size_t listed = std::min(known.size(), most_listed);
  const std::string rest = listed < known.size() ? ", …" : "";
  return fmt::format("; known: {}{}",
                     fmt::join(known.begin(), known.begin() + static_cast<long>(listed), ", "), rest);
}

}  // namespace geist
