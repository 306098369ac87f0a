// A small coupled case for tests of what a case is turned into: a block of 2 × 2 × 2 hexahedra in [0, 1]³,
// and beside it, in x from 1 to 2, a lattice of 4 × 4 × 4 particles. Density 0.001, so either half weighs
// 0.001.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "case/build.hpp"
#include "case/diagnostic.hpp"
#include "case/read.hpp"

namespace geist::testing {

inline const std::string materials = R"(title = "small"
units = { length = "mm", mass = "g", time = "ms" }
[materials.m]
density = 0.001
young = 1000
poisson = 0.2
)";

inline const std::string two_regions = R"([regions.left]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [1, 1, 1]]
divisions = [2, 2, 2]
[regions.right]
type = "lattice"
material = "m"
box = [[1, 0, 0], [2, 1, 1]]
radius = 0.125
)";

inline const std::string dynamic = "[analysis]\ntype = \"dynamic\"\nduration = 1\n";

/// The small case, and what else it shall hold.
inline Case small_case(const std::string& more = "", const std::vector<std::string>& set = {}) {
  return read_case_text(materials + two_regions + dynamic + more, "small.toml", set);
}

/// Line (from 1) of the first line in the small case with `more` that holds `text`.
inline int line_with(const std::string& text, const std::string& whole) {
  const std::size_t at = whole.find(text);
  return at == std::string::npos ? -1
                                 : 1 + static_cast<int>(std::count(whole.begin(), whole.begin() + at, '\n'));
}

/// Building `text` fails with one error whose message holds all of `words`, at the line that holds `place`.
inline void expect_build_error(const std::string& text, const std::string& place,
                               const std::vector<std::string>& words) {
  const Case input = read_case_text(text, "small.toml");
  try {
    build(input);
    FAIL() << "builds: " << place;
  } catch (const CaseError& e) {
    ASSERT_EQ(e.diagnostics().size(), 1u);
    const Diagnostic& d = e.diagnostics()[0];
    EXPECT_EQ(d.file, "small.toml");
    EXPECT_EQ(d.line, line_with(place, text)) << d.message;
    EXPECT_GT(d.column, 0);
    for (const std::string& word : words) EXPECT_NE(d.message.find(word), std::string::npos) << d.message;
  }
}

}  // namespace geist::testing
