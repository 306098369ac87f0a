// Rules of the geometry of a region of hexahedra that need no mesh.
#include <fmt/format.h>

#include <array>

#include "case/rules.hpp"
#include "geometry/solids.hpp"

namespace geist {

namespace {

/// How `divisions` is to be read for a kind of body.
struct Meaning {
  std::string_view body, words;
  std::size_t size;
  std::array<int, 4> graded;  ///< the entry that x, y, z and radius of `grading` divide, or none

  bool round() const { return graded[3] != none; }
  static constexpr int none = -1;
};

constexpr Meaning block{"block", "three whole numbers [x, y, z]", 3, {0, 1, 2, Meaning::none}};
constexpr Meaning ball{"ball", "two whole numbers [core, shells]", 2, {0, 0, 0, 1}};
constexpr Meaning cylinder{"cylinder", "three whole numbers [core, shells, layers]", 3, {0, 0, 2, 1}};

const Meaning& meaning_for(const View& region) {
  if (region.has("ball")) return ball;
  return region.has("cylinder") ? cylinder : block;
}

double number_of_elements(const Meaning& meaning, const std::vector<long>& divisions) {
  const auto n = [&](std::size_t i) { return static_cast<int>(divisions[i]); };
  if (!meaning.round()) return element_count(BlockBody{{}, {n(0), n(1), n(2)}});
  return meaning.size == 2 ? element_count(BallBody{{}, n(0), n(1)})
                           : element_count(CylinderBody{{}, n(0), n(1), n(2)});
}

/// Whether `divisions` suits the body.
bool check_divisions(Document& document, const View& region, const std::vector<long>& divisions) {
  const Meaning& meaning = meaning_for(region);
  const auto refuse = [&](const std::string& why) {
    document.report(region.place("divisions"), why);
    return false;
  };
  if (divisions.size() != meaning.size)
    return refuse(fmt::format("'divisions' of a {} must be {}", meaning.body, meaning.words));
  if (meaning.round() && divisions[0] < 2)
    return refuse(fmt::format("too coarse for a {}: the core needs at least 2 divisions", meaning.body));
  const double number = number_of_elements(meaning, divisions);
  if (number > most_places_in_region)
    return refuse(fmt::format("about {:.2g} hexahedra; a region may have {:.0e} at most", number,
                              most_places_in_region));
  return true;
}

/// A ratio of lengths can only be had with enough divisions.
void check_ratio(Document& document, const View& graded, std::string_view direction, long divisions) {
  const auto towards = graded.get<std::string>("towards");
  const auto ratio = graded.get<double>("ratio");
  if (!towards || !ratio || *ratio == 1) return;
  const int least = least_divisions(towards_of(*towards));
  if (divisions >= least) return;
  document.report(graded.place("ratio"),
                  fmt::format("too coarse for this ratio of lengths: towards \"{}\" it takes at least {} "
                              "divisions along {}, not {}",
                              *towards, least, direction, divisions));
}

void check_grading(Document& document, const View& region, const std::vector<long>& divisions) {
  const auto grading = region.table("grading");
  if (!grading) return;
  constexpr std::array<std::string_view, 4> directions{"x", "y", "z", "radius"};
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const auto graded = grading->table(directions[d]);
    if (!graded) continue;
    const int which = meaning_for(region).graded[d];
    if (which == Meaning::none)
      document.report(grading->place(directions[d]),
                      "'radius' grades the shells of a ball or cylinder; a block has none");
    else
      check_ratio(document, *graded, directions[d], divisions[static_cast<std::size_t>(which)]);
  }
}

void check_corners(Document& document, const View& region, const std::array<Vec3, 8>& corners) {
  // Each corner and its three neighbours, right-handed.
  constexpr std::array<std::array<std::size_t, 3>, 8> next{
      {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};
  for (std::size_t c = 0; c < 8; ++c) {
    const Vec3 at = corners[c];
    const auto edge = [&](std::size_t n) { return corners[next[c][n]] - at; };
    if (dot(edge(0), cross(edge(1), edge(2))) > 0) continue;
    document.report(region.place("corners"),
                    fmt::format("the block is inside out at corner {} of 8: the order is four corners around "
                                "the bottom, counter-clockwise from above, then the four above them",
                                c + 1));
    return;
  }
}

}  // namespace

void check_hexahedra(Document& document, const View& region) {
  check_length(document, region.table("cylinder"));
  const auto divisions = region.get<std::vector<long>>("divisions");
  if (divisions && check_divisions(document, region, *divisions)) check_grading(document, region, *divisions);
  if (const auto corners = region.get<std::array<Vec3, 8>>("corners"))
    check_corners(document, region, *corners);
}

}  // namespace geist
