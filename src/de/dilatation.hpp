// Energy of dilatation: what the bonds of a consistent lattice cannot carry where ν > ¼. docs/theory.md,
// "Poisson's ratios above ¼".
//
// Bonds carry μ and λ_b = λ(μ, ν_b), the rest λ_v = λ − λ_b is an energy of the mean dilatation θ_c of every
// cell, that of its eight corners' motion (Flanagan and Belytschko 1981, for a cube):
//
//   E_c = ½ λ_v (2r)³ θ_c²,   θ_c = q/8r,   q = Σ_a s_a·u_a,   s_a = (±1, ±1, ±1) from the centre to corner a
//
// so E_c = ½ k q² with k = λ_v r/8, and the force on corner a is −k q s_a: −λ_v θ_c on the three squares r ×
// r that the corner has of the cell's faces. A skin, r thick in plane stress, has λ* = Eν/(1 − ν²) in place
// of λ, four corners and two components: θ = q/4r, k = λ*_v r/4. Nothing turns a corner: moments are zero.
#pragma once
#include <array>
#include <utility>
#include <vector>

#include "core/pack.hpp"
#include "de/bonds.hpp"
#include "model/lattice.hpp"
#include "model/material.hpp"

namespace geist::de {

/// The material of bonds: the same μ, and ν_b for ν where that is above ¼.
Material material_of_bonds(const Material& material);

/// k of a cell and of a skin; zero for ν ≤ ¼.
struct Dilatation {
  double cell = 0, skin = 0;
  static Dilatation from(const Material& material, double r);
};

/// Component of Lattice::pressure of the cells; 0, 1, 2 are those of skins across x, y, z.
inline constexpr int of_cell = 3;

constexpr bool has_corner(int kind, int corner) { return kind == of_cell || !(corner >> kind & 1); }

/// From the lowest corner of a cube to corner a; bit c of a says whether it is the higher one along axis c.
inline std::ptrdiff_t to_corner(const Grid& grid, int a) {
  const auto stride = static_cast<std::ptrdiff_t>(grid.stride());
  return (a & 1) + (a >> 1 & 1) * stride + (a >> 2) * stride * grid.ny;
}

/// A cell, or one or two skins on each other: ½ k q² with its corners' sites and s_a.
struct Swelling {
  double k = 0;
  int corners = 0;
  std::array<std::size_t, 8> site{};
  std::array<Vec3, 8> s{};
};

/// Call visit(swelling) for those whose lowest corner is at site `lowest`.
template <class Visit>
void visit_swellings(const Lattice& lattice, const Dilatation& stiffness, std::size_t lowest, Visit visit) {
  for (int kind = 0; kind <= of_cell; ++kind) {
    const int count = dilating::count(lattice.dilating[lowest], kind);
    if (count == 0) continue;
    Swelling found{count * (kind == of_cell ? stiffness.cell : stiffness.skin)};
    for (int a = 0; a < 8; ++a) {
      if (!has_corner(kind, a)) continue;
      Vec3 s;
      for (int c = 0; c < 3; ++c) s[c] = c == kind ? 0 : a >> c & 1 ? 1 : -1;
      found.s[found.corners] = s;
      found.site[found.corners++] = lowest + to_corner(lattice.grid, a);
    }
    visit(found);
  }
}

/// Lattice::pressure at the present motion.
void find_pressures(Lattice& lattice);

/// Energy of all cells and skins; of those with a ghost at a corner as `coupling`.
BondEnergies dilatation_energies(const Lattice& lattice);

/// Add to each site its share of the energies around: an equal one for each corner.
void add_dilatation_energies(const Lattice& lattice, std::vector<double>& by_site);

/// Where the kernel reads pressures.
struct Pressures {
  const double* p[4];
  std::ptrdiff_t to_corner[8];

  explicit Pressures(const Lattice& lattice) {
    for (int kind = 0; kind <= of_cell; ++kind) p[kind] = lattice.pressure[kind];
    for (int a = 0; a < 8; ++a) to_corner[a] = de::to_corner(lattice.grid, a);
  }

  /// The push of the eight cells, or four skins of one kind, around the eight sites at s: Σ p s_a.
  template <int kind>
  GEIST_INLINE void add(std::size_t s, Pack (&f)[6]) const {
    const double* const from = p[kind] + s;
    const auto add_corner = [&]<int a>() __attribute__((always_inline)) {
      if constexpr (has_corner(kind, a)) {
        const Pack push = load(from - to_corner[a]);
        if constexpr (kind != 0) f[0] = a & 1 ? f[0] + push : f[0] - push;
        if constexpr (kind != 1) f[1] = a & 2 ? f[1] + push : f[1] - push;
        if constexpr (kind != 2) f[2] = a & 4 ? f[2] + push : f[2] - push;
      }
    };
    [&]<int... a>(std::integer_sequence<int, a...>) __attribute__((always_inline)) {
      (add_corner.template operator()<a>(), ...);
    }
    (std::make_integer_sequence<int, 8>{});
  }
};

}  // namespace geist::de
