// Contact laws: the force between two bodies that overlap, from the overlap and its rate.
//
// A law is a value that sees an overlap, never arrays or neighbours. All stiffnesses come from the materials.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/material.hpp"

namespace geist::contact {

/// What a case says about a pair of regions.
struct Law {
  enum class Normal { penalty, hertz };
  Normal normal = Normal::penalty;
  double factor = 1;       ///< multiplies the stiffness that the materials give
  double restitution = 1;  ///< speed after / speed before of a central collision of two masses, in (0, 1]
  double friction = 0;     ///< Coulomb's coefficient μ
};

/// The law of every pair of regions that may touch. Regions are numbered hexahedra first, then lattices.
class LawTable {
 public:
  LawTable() = default;
  explicit LawTable(std::size_t regions) : regions_(regions), index_(regions * regions, -1) {}

  /// From now on a and b (which may be the same) act on each other by this law.
  void set(std::int32_t a, std::int32_t b, const Law& law);

  /// The number of the pair's law, or −1.
  std::int32_t at(std::int32_t a, std::int32_t b) const { return index_[a * regions_ + b]; }
  const Law& law(std::int32_t number) const { return laws_[number]; }
  std::array<std::int32_t, 2> regions_of(std::int32_t number) const { return pairs_[number]; }
  std::int32_t count() const { return static_cast<std::int32_t>(laws_.size()); }
  std::size_t regions() const { return regions_; }
  /// By region: whether it may touch anything.
  std::vector<std::uint8_t> touching() const;
  bool empty() const { return laws_.empty(); }

 private:
  std::size_t regions_ = 0;
  std::vector<std::int32_t> index_;
  std::vector<Law> laws_;                           ///< by number
  std::vector<std::array<std::int32_t, 2>> pairs_;  ///< the regions of each
};

/// Elastic constants of a pair of materials, Hertz' and Mindlin's: 1/E* = Σ (1 − ν²)/E, 1/G* = Σ (2 − ν)/G.
struct PairModuli {
  double E = 0, G = 0;
  PairModuli(const Material& a, const Material& b);
  /// Tangential stiffness / normal stiffness, 4 G*/E* (Mindlin 1949).
  double tangential_ratio() const { return 4 * G / E; }
};

/// Modulus of a layer that is pressed and cannot widen, λ + 2μ.
double layer_modulus(const Material& material);

/// Normal stiffness of a pair: the force is k δ (penalty, p = 1) or k δ^{3/2} (Hertz, p = 3/2).
struct NormalStiffness {
  double k = 0;
  bool hertz = false;

  double force(double overlap) const;
  double tangent(double overlap) const;  ///< dF/dδ
  double energy(double overlap) const;   ///< ∫ F dδ
};

/// Share of critical damping ζ in F = F_el(δ) + 2 ζ √(m* dF/dδ) δ̇ ≥ 0 that makes a central collision of the
/// reduced mass m* end with the given restitution. The law's own collision is integrated: with forces that
/// never pull, no closed form exists for Hertz' law (for the linear one see Schwager and Pöschel 2007).
double damping_ratio(Law::Normal normal, double restitution);

}  // namespace geist::contact
