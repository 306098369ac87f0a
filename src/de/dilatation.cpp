#include "de/dilatation.hpp"

#include <algorithm>
#include <cstring>

#include "core/parallel.hpp"

namespace geist::de {
namespace {

constexpr double largest_bond_poisson = 0.25, chosen_bond_poisson = 0.15;

/// λ of plane stress, Eν/(1 − ν²).
double plane_lambda(const Material& m) { return m.young * m.poisson / (1 - m.poisson * m.poisson); }

/// First pass of a step: −k q of every cell and skin, row by row.
struct PressureKernel {
  const double* u[3];
  double* p[4];
  const std::uint8_t* dilating;
  std::ptrdiff_t to_corner[8];
  std::size_t stride;
  Dilatation stiffness;

  /// q at the eight sites at s: differences first, so that a shift stirs nothing.
  template <int kind>
  GEIST_INLINE Pack q(std::size_t s) const {
    Pack sum = {};
    const auto add_edge = [&]<int n>() __attribute__((always_inline)) {
      constexpr int c = n / 8, a = n % 8;
      if constexpr (c != kind && has_corner(kind, a) && !(a >> c & 1))
        sum = sum + (load(u[c] + s + to_corner[a | 1 << c]) - load(u[c] + s + to_corner[a]));
    };
    [&]<int... n>(std::integer_sequence<int, n...>) __attribute__((always_inline)) {
      (add_edge.template operator()<n>(), ...);
    }
    (std::make_integer_sequence<int, 24>{});
    return sum;
  }

  /// Where there are none, whatever q is, the pressure is zero.
  template <int kind>
  GEIST_INLINE void put(std::size_t s, PackInt eight) const {
    const PackInt count = (eight >> 2 * kind) & 3;
    const Pack k =
        __builtin_convertvector(count, Pack) * -(kind == of_cell ? stiffness.cell : stiffness.skin);
    store(p[kind] + s, (Pack)((PackInt)(k * q<kind>(s)) & (count != 0)));
  }

  void put_all(std::size_t s) const {
    using Bytes = std::uint8_t __attribute__((vector_size(lanes)));
    Bytes bytes;
    std::memcpy(&bytes, dilating + s, sizeof bytes);
    const PackInt here = __builtin_convertvector(bytes, PackInt);
    put<0>(s, here), put<1>(s, here), put<2>(s, here), put<of_cell>(s, here);
  }

  void row(std::size_t row) const {
    for (std::size_t s = row * stride; s < (row + 1) * stride; s += lanes) {
      std::uint64_t eight;
      std::memcpy(&eight, dilating + s, sizeof eight);
      if (eight == dilating::eight_cells)
        store(p[of_cell] + s, -stiffness.cell * q<of_cell>(s));
      else if (eight != 0)
        put_all(s);
    }
  }
};

double energy(const Lattice& lattice, const Swelling& w) {
  double q = 0;
  for (int a = 0; a < w.corners; ++a) q += dot(w.s[a], lattice.motion.vector(w.site[a]));
  return 0.5 * w.k * q * q;
}

}  // namespace

Material material_of_bonds(const Material& m) {
  if (m.poisson <= largest_bond_poisson) return m;
  return {m.name, m.density, 2 * m.mu() * (1 + chosen_bond_poisson), chosen_bond_poisson};
}

Dilatation Dilatation::from(const Material& m, double r) {
  const Material bonds = material_of_bonds(m);
  return {(m.lambda() - bonds.lambda()) * r / 8, (plane_lambda(m) - plane_lambda(bonds)) * r / 4};
}

void find_pressures(Lattice& lattice) {
  PressureKernel kernel;
  for (int c = 0; c < 3; ++c) kernel.u[c] = lattice.motion[c];
  for (int kind = 0; kind <= of_cell; ++kind) kernel.p[kind] = lattice.pressure[kind];
  kernel.dilating = lattice.dilating.data();
  for (int a = 0; a < 8; ++a) kernel.to_corner[a] = to_corner(lattice.grid, a);
  kernel.stride = lattice.grid.stride();
  kernel.stiffness = Dilatation::from(lattice.material, lattice.radius());
  for_each(
      lattice.grid.rows(), [kernel](std::size_t row) { kernel.row(row); }, 8);
}

BondEnergies dilatation_energies(const Lattice& lattice) {
  const Dilatation stiffness = Dilatation::from(lattice.material, lattice.radius());
  return sum<BondEnergies>(lattice.dilating.size(), [&lattice, stiffness](std::size_t s) {
    BondEnergies all;
    visit_swellings(lattice, stiffness, s, [&](const Swelling& w) {
      const bool coupling = std::any_of(w.site.begin(), w.site.begin() + w.corners,
                                        [&](std::size_t site) { return lattice.is(site, site::ghost); });
      (coupling ? all.coupling : all.bonds) += energy(lattice, w);
    });
    return all;
  });
}

void add_dilatation_energies(const Lattice& lattice, std::vector<double>& by_site) {
  const Dilatation stiffness = Dilatation::from(lattice.material, lattice.radius());
  for (std::size_t s = 0; s < lattice.dilating.size(); ++s)
    visit_swellings(lattice, stiffness, s, [&](const Swelling& w) {
      const double share = energy(lattice, w) / w.corners;
      for (int a = 0; a < w.corners; ++a) by_site[w.site[a]] += share;
    });
}

}  // namespace geist::de
