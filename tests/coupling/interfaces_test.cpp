// Clashes: what is refused between regions, and what must not be.
#include "coupling/interfaces.hpp"

#include <gtest/gtest.h>

#include "coupling/support.hpp"

namespace geist::coupling {
namespace {

using namespace testing;

const Box cube{{0, 0, 0}, {1, 1, 1}};
constexpr double r = 0.125;

/// The clash names both regions, in its message too, and says all of `words`.
void expect_clash(const Builder& builder, const std::string& a, const std::string& b,
                  const std::vector<std::string>& words) {
  const auto clash = builder.clash();
  ASSERT_TRUE(clash) << a << ' ' << b;
  EXPECT_TRUE((clash->first == a && clash->second == b) || (clash->first == b && clash->second == a))
      << clash->message;
  for (const std::string& word : {"'" + a + "'", "'" + b + "'"})
    EXPECT_NE(clash->message.find(word), std::string::npos) << clash->message;
  for (const std::string& word : words)
    EXPECT_NE(clash->message.find(word), std::string::npos) << word << " | " << clash->message;
}

void expect_fine(const Builder& builder) {
  const auto clash = builder.clash();
  EXPECT_FALSE(clash) << clash->message;
}

Builder with_lattice() {
  Builder builder;
  builder.particles("stone", {cube}, r);
  return builder;
}

TEST(Clash, NoneWhereRegionsMeetFlush) {
  expect_fine(with_lattice());
  expect_fine(with_lattice().hexahedra("steel", {{-1, 0, 0}, {0, 1, 1}}, {2, 3, 1}));
  expect_fine(with_lattice().hexahedra("wide", {{-1, -1, -1}, {0, 2, 2}}, {2, 3, 3}));
  expect_fine(with_lattice().hexahedra("narrow", {{-1, 0.25, 0.25}, {0, 0.75, 0.75}}, {2, 1, 1}));
  expect_fine(with_lattice().hexahedra("above", {{0, 0, 1}, {1, 1, 2}}, {1, 1, 1}));
  expect_fine(with_lattice()
                  .hexahedra("left", {{-1, 0, 0}, {0, 1, 1}}, {2, 2, 2})
                  .hexahedra("right", {{1, 0, 0}, {2, 1, 1}}, {3, 3, 3}));
}

TEST(Clash, NoneWhereRoundingLeavesAHair) {
  const double hair = 1e-12;
  expect_fine(with_lattice().hexahedra("steel", {{-1, 0, 0}, {-hair, 1, 1}}, {2, 2, 2}));
  expect_fine(with_lattice().hexahedra("steel", {{-1, 0, 0}, {hair, 1, 1}}, {2, 2, 2}));
  const Vec3 far{7.3, -2.1, 0.7};  // not representable
  Builder builder;
  builder.particles("stone", {{far, far + Vec3{1, 1, 1}}}, 0.05);
  builder.hexahedra("steel", {far - Vec3{0.9, 0, 0}, far + Vec3{0, 1, 1}}, {3, 7, 9});
  expect_fine(builder);
}

TEST(Clash, NoneInFilledHolesAndCorners) {
  const Box hole{{1, 1, 1}, {2, 2, 2}};
  expect_fine(
      Builder().hexahedra("shell", {{0, 0, 0}, {3, 3, 3}}, {3, 3, 3}, {hole}).particles("core", {hole}, r));
  expect_fine(with_lattice()
                  .hexahedra("behind", {{-1, -1, 0}, {0, 1, 1}}, {2, 4, 2})
                  .hexahedra("below", {{0, -1, 0}, {1, 0, 1}}, {2, 2, 2}));
}

TEST(Clash, NoneAtFreeFacesFarEnoughApart) {
  expect_fine(with_lattice().hexahedra("steel", {{-2, 0, 0}, {-0.26, 1, 1}}, {2, 2, 2}));
  expect_fine(with_lattice().particles("slate", {{{1.25, 0, 0}, {2.25, 1, 1}}}, r));
  Builder builder;
  builder.particles("stone", {cube}, r, {Shape{Ball{{0, 0, 0}, 0.6}}});
  expect_fine(builder);
}

TEST(Clash, OfOverlap) {
  expect_clash(with_lattice().hexahedra("steel", {{-1, 0, 0}, {0.125, 1, 1}}, {2, 2, 2}), "stone", "steel",
               {"overlap at ("});
  expect_clash(with_lattice().hexahedra("steel", {{-1, 0, 0}, {0.01, 1, 1}}, {2, 2, 2}), "stone", "steel",
               {"overlap at (0"});
  expect_clash(with_lattice().hexahedra("steel", {{-1, -1, -1}, {2, 2, 2}}, {3, 3, 3}), "stone", "steel",
               {"overlap at ("});
  expect_clash(with_lattice().hexahedra("needle", {{0.49, 0.49, 0.49}, {0.5, 0.5, 0.5}}, {1, 1, 1}), "stone",
               "needle", {"overlap at (0.495, 0.495, 0.495)"});
  expect_clash(with_lattice().particles("slate", {{{0.5, 0, 0}, {1.5, 1, 1}}}, r), "stone", "slate",
               {"overlap"});
  expect_clash(Builder()
                   .hexahedra("one", {{0, 0, 0}, {2, 2, 2}}, {2, 2, 2})
                   .hexahedra("two", {{1.5, 0.5, 0.5}, {3, 1.5, 1.5}}, {2, 2, 2}),
               "one", "two", {"overlap at ("});
}

TEST(Clash, OfHexahedraThatShareNodesAndYetOverlap) {
  Builder one;
  one.hexahedra("one", {{0, 0, 0}, {2, 2, 2}}, {2, 2, 2});
  expect_clash(Builder(one).hexahedra("same", {{0, 0, 0}, {2, 2, 2}}, {2, 2, 2}), "one", "same",
               {"overlap at (0.5, 0.5, 0.5)"});
  expect_clash(Builder(one).hexahedra("shifted", {{1, 0, 0}, {3, 2, 2}}, {2, 2, 2}), "one", "shifted",
               {"overlap at (1.5, 0.5, 0.5)"});
  // Bars that cross, and no node of either within the other
  expect_clash(Builder()
                   .hexahedra("bar", {{0, 1, 1}, {3, 2, 2}}, {1, 1, 1})
                   .hexahedra("beam", {{1, 0, 1.2}, {2, 3, 1.8}}, {1, 1, 1}),
               "bar", "beam", {"overlap at ("});
}

TEST(Clash, OfAThinGap) {
  for (const double gap : {0.002, 0.02, 0.1, 0.2, 0.24}) {
    expect_clash(with_lattice().hexahedra("steel", {{-1, 0, 0}, {-gap, 1, 1}}, {2, 2, 2}), "stone", "steel",
                 {"gap thinner than a particle (2r = 0.25)", "at (0, "});
    expect_clash(with_lattice().particles("slate", {{{1 + gap, 0, 0}, {2 + gap, 1, 1}}}, r), "stone", "slate",
                 {"gap thinner than a particle", "at (1, "});
  }
}

TEST(Clash, OfAThinGapBeforeAThinSheet) {
  expect_clash(with_lattice().hexahedra("foil", {{-0.01, 0, 0}, {-0.004, 1, 1}}, {1, 2, 2}), "stone", "foil",
               {"gap thinner than a particle"});
}

TEST(Clash, OfHexahedraTooThinForAGhost) {
  for (const double thin : {0.02, 0.06, 0.12})
    expect_clash(with_lattice().hexahedra("foil", {{-thin, 0, 0}, {0, 1, 1}}, {1, 1, 1}), "stone", "foil",
                 {"thinner than a particle's radius", "holds no ghost", "at (0, "});
  expect_fine(with_lattice().hexahedra("sheet", {{-0.13, 0, 0}, {0, 1, 1}}, {1, 1, 1}));
}

TEST(Clash, OfLatticesThatTouch) {
  expect_clash(with_lattice().particles("slate", {{{1, 0, 0}, {2, 1, 1}}}, r), "stone", "slate",
               {"touch at (1, ", "not be bonded", "one region of several boxes"});
  expect_clash(with_lattice().particles("slate", {{{0.75, 0.75, 1}, {1.75, 1.75, 2}}}, r / 2), "stone",
               "slate", {"touch at ("});
}

TEST(Clash, OfHexahedraThatTouchWithoutSharingNodes) {
  Builder one;
  one.hexahedra("one", {{0, 0, 0}, {2, 2, 2}}, {2, 2, 2});
  expect_fine(Builder(one).hexahedra("two", {{2, 0, 0}, {4, 2, 2}}, {5, 2, 2}));
  expect_clash(Builder(one).hexahedra("two", {{2, 0, 0}, {4, 2, 2}}, {2, 4, 2}), "one", "two",
               {"touch at (2, ", "without sharing nodes", "divisions"});
  expect_clash(Builder(one).hexahedra("two", {{2, 0.5, 0.5}, {4, 1.5, 1.5}}, {2, 1, 1}), "one", "two",
               {"touch at (2, "});
  expect_fine(Builder(one).hexahedra("two", {{2.001, 0, 0}, {4, 2, 2}}, {2, 3, 3}));  // a gap is no contact
}

}  // namespace
}  // namespace geist::coupling
