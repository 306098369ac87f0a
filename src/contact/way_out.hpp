// The shortest way out of several half-spaces.
//
// Every point of a surface whose distance is a local minimum gives a half-space n·d ≥ δ of displacements d
// that lead clear of it; the overlap vector is the smallest d in all of them, d = Σ λ_i n_i with λ_i ≥ 0. It
// is the gradient of half its own square, so a force along d is conservative; it changes continuously when
// points appear, merge on a flat or shallow patch (λ_1 + λ_2 = δ, not 2 δ), or turn around an edge or a
// corner; in a groove both flanks push.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/vec.hpp"

namespace geist::contact {

/// A point of the surface that carries a part of a contact.
struct TouchPoint {
  std::int32_t facet;
  std::array<double, 4> weight;  ///< of the facet's corners; they add up to 1
  Vec3 p;                        ///< on the surface
  Vec3 n;                        ///< unit normal, out of the body
  double overlap;                ///< δ_i
  double lambda;                 ///< λ_i
};

struct Touch {
  int count = 0;  ///< 0: no contact; at most three points carry
  std::array<TouchPoint, 3> point;
  double overlap = 0;  ///< |d|
  Vec3 normal;         ///< d / |d|, from the body to the contactor

  double lambda_sum() const;
};

/// More are not taken in at once.
inline constexpr std::size_t most_half_spaces = 12;

/// Choose the λ of at most most_half_spaces half-spaces; the touch has the points that carry (λ > 0). Opposed
/// half-spaces that leave no way out all push by themselves.
Touch shortest_way_out(std::span<const TouchPoint> points);

}  // namespace geist::contact
