// Regions that do not meet as they must: an error at one of the two, before anything runs.
#include <algorithm>

#include "small_case.hpp"

namespace geist {
namespace {

using namespace testing;

/// The small case with a third region at the end.
std::string with_third(const std::string& body) {
  return materials + two_regions + dynamic + "[regions.third]\nmaterial = \"m\"\n" + body;
}

std::string hexahedra(const std::string& box, const std::string& divisions) {
  return "type = \"hexahedra\"\nbox = " + box + "\ndivisions = " + divisions + "\n";
}

TEST(Interfaces, OverlapsAreRefused) {
  expect_build_error(with_third(hexahedra("[[1.9, 0, 0], [3, 1, 1]]", "[2, 2, 2]")), "[regions.right]",
                     {"'right'", "'third'", "overlap at ("});
  expect_build_error(with_third("type = \"lattice\"\nbox = [[1.75, 0, 0], [2.5, 1, 1]]\nradius = 0.125\n"),
                     "[regions.right]", {"'right'", "'third'", "overlap at ("});
  expect_build_error(with_third(hexahedra("[[-1, 0, 0], [0.5, 1, 1]]", "[3, 2, 2]")), "[regions.third]",
                     {"'left'", "'third'", "overlap at ("});
}

TEST(Interfaces, UncoupledOnesMayHaveGapsButNotOverlap) {
  const std::string uncoupled = "[coupling]\ntype = \"none\"\n";
  const std::string overlapping = hexahedra("[[1.9, 0, 0], [3, 1, 1]]", "[2, 2, 2]");
  expect_build_error(with_third(overlapping + uncoupled), "[regions.right]",
                     {"'right'", "'third'", "overlap at ("});
  const std::string gap = hexahedra("[[2.1, 0, 0], [3, 1, 1]]", "[2, 2, 2]");
  EXPECT_NO_THROW(build(read_case_text(with_third(gap + uncoupled), "small.toml")));
}

TEST(Interfaces, ThinGapsAreRefused) {
  expect_build_error(with_third(hexahedra("[[2.1, 0, 0], [3, 1, 1]]", "[2, 2, 2]")), "[regions.right]",
                     {"'right'", "'third'", "gap thinner than a particle (2r = 0.25)"});
}

TEST(Interfaces, ThinHexahedraAreRefused) {
  expect_build_error(with_third(hexahedra("[[2, 0, 0], [2.1, 1, 1]]", "[1, 2, 2]")), "[regions.right]",
                     {"'right'", "'third'", "holds no ghost"});
}

TEST(Interfaces, LatticesThatTouchAreRefused) {
  expect_build_error(with_third("type = \"lattice\"\nbox = [[2, 0, 0], [3, 1, 1]]\nradius = 0.25\n"),
                     "[regions.right]", {"'right'", "'third'", "touch at ("});
}

TEST(Interfaces, DivisionsMustMatchBetweenHexahedra) {
  expect_build_error(with_third(hexahedra("[[-1, 0, 0], [0, 1, 1]]", "[2, 3, 3]")), "[regions.left]",
                     {"'left'", "'third'", "without sharing nodes"});
}

TEST(Interfaces, FlushOnesAreFine) {
  for (const std::string& third :
       {hexahedra("[[2, 0, 0], [3, 1, 1]]", "[2, 3, 3]"), hexahedra("[[1, -1, 0], [2, 0, 1]]", "[1, 1, 2]"),
        hexahedra("[[3, 0, 0], [4, 1, 1]]", "[2, 3, 3]"), hexahedra("[[-1, 0, 0], [0, 1, 1]]", "[5, 2, 2]")})
    EXPECT_NO_THROW(build(read_case_text(with_third(third), "small.toml"))) << third;
}

TEST(Interfaces, SharesAllNodesAndYetOverlaps) {
  expect_build_error(with_third(hexahedra("[[0, 0, 0], [1, 1, 1]]", "[2, 2, 2]")), "[regions.third]",
                     {"'left'", "'third'", "overlap at ("});
}

}  // namespace
}  // namespace geist
