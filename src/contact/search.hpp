// Search: which contactors are near enough to something that they may touch it before the next search.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "contact/contactors.hpp"
#include "contact/law.hpp"
#include "contact/surface.hpp"

namespace geist::contact {

/// How far two clusters may move relative to each other before something may be missed.
struct Clearance {
  std::int32_t a, b;
  double distance;
};

/// A contactor and a body of hexahedra (other = −1 − body; facets first .. first + count of Candidates), or
/// another contactor with a larger number (other ≥ 0).
struct Pair {
  std::int32_t contactor, other;
  std::int32_t first = 0, count = 0;
  bool is_body() const { return other < 0; }
};

struct Candidates {
  std::vector<Clearance> clearances;
  std::vector<Pair> pairs;           ///< by contactor, then by other
  std::vector<std::int32_t> facets;  ///< of the pairs with bodies, ascending within a pair
};

/// All pairs that a law allows and whose distance is less than `skin` more than touching. Places keep their
/// positions as x_searched. Any number of threads gives the same lists. A node is not paired with facets that
/// look its own way (cosine > ½): before they face it, their normals would have to turn further than motion
/// within the skin lets them.
Candidates search(const Model& model, const Surface& surface, const std::vector<Contactor>& contactors,
                  const LawTable& laws, Places& places, double skin);

/// Whether clusters have moved further since the search than their clearances.
bool outdated(const Candidates& candidates, const Places& places);

/// How far behind a surface a contactor is still taken to have come through it: a particle's radius, the
/// whole thickness of the elements behind a node.
double reach(const Contactor& contactor);

}  // namespace geist::contact
