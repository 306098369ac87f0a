#include <bit>

#include "core/parallel.hpp"
#include "de/bonds.hpp"
#include "de/methods.hpp"

namespace geist::de {
namespace {

/// Half the energy of every bond of the eight sites at s.
template <class Method, class View>
struct SiteEnergies {
  View motion;
  const std::uint32_t* word;
  std::ptrdiff_t offset[18];
  Method method;
  double r;

  SiteEnergies(const Method& bonds, const View& view, const Lattice& lattice)
      : motion(view), word(lattice.word.data()), method(bonds), r(lattice.radius()) {
    for (int d = 0; d < 18; ++d) offset[d] = lattice.grid.offset(d);
  }

  Pack at(std::size_t s) const {
    const SomeBonds bonds{load(word + s)};
    const auto& law = method.at(s);
    Pack energy = {};
    [&]<int... D>(std::integer_sequence<int, D...>) {
      ((energy = energy + bonds.keep<D>(bond_energy<D, Pack>(motion, s, offset[D], law, r))), ...);
    }
    (std::make_integer_sequence<int, 18>{});
    return 0.5 * energy;
  }

  /// Energy of a ghost's bond in direction D if there is a ghost at its end too.
  template <int D>
  double between_ghosts(const Lattice& lattice, std::size_t s) const {
    const std::size_t other = s + offset[D];
    if (!(word[s] >> D & 1) || !lattice.is(other, site::ghost)) return 0;
    return bond_energy<D, double>(motion, s, offset[D], method.template at<double>(s), r);
  }
};

/// Energy of the bonds between two ghosts.
template <class Energy>
double energy_between_ghosts(const Energy& energy, const Lattice& lattice) {
  double twice = 0;
  for (const Ghost& ghost : lattice.ghosts) [&]<int... D>(std::integer_sequence<int, D...>) {
      ((twice += energy.template between_ghosts<D>(lattice, ghost.site)), ...);
    }
  (std::make_integer_sequence<int, 18>{});
  return 0.5 * twice;
}

template <class Energy>
BondEnergies add_up(const Energy& energy, const Lattice& lattice) {
  // A bond of a particle and a ghost has half of its energy at either; between two ghosts all of it is at
  // ghosts, any other's is at particles.
  BondEnergies total = sum<BondEnergies>(lattice.grid.size() / lanes, [energy](std::size_t pack) {
    const Pack e = energy.at(lanes * pack);
    BondEnergies sums;
    for (int l = 0; l < lanes; ++l) {
      const bool ghost = energy.word[lanes * pack + l] & site::ghost;
      sums.bonds += ghost ? -e[l] : e[l];
      sums.coupling += ghost ? 2 * e[l] : 0;
    }
    return sums;
  });
  const double between_ghosts = energy_between_ghosts(energy, lattice);
  return total += {between_ghosts, -between_ghosts};
}

}  // namespace

BondEnergies energies(const Lattice& lattice) {
  const BondEnergies bonds = with_kinematics(lattice, [&](const auto& method, const auto& motion) {
    return add_up(SiteEnergies(method, motion, lattice), lattice);
  });
  return lattice.dilates() ? dilatation_energies(lattice) += bonds : bonds;
}

std::vector<double> site_energies(const Lattice& lattice) {
  return with_kinematics(lattice, [&](const auto& method, const auto& motion) {
    const SiteEnergies energy(method, motion, lattice);
    std::vector<double> energies(lattice.grid.size());
    const auto store_pack = [energy, out = energies.data()](std::size_t pack) {
      store(out + lanes * pack, energy.at(lanes * pack));
    };
    for_each(energies.size() / lanes, store_pack, 128);
    if (lattice.dilates()) add_dilatation_energies(lattice, energies);
    return energies;
  });
}

std::size_t bond_count(const Lattice& lattice) {
  std::size_t twice = 0;
  for (const std::uint32_t w : lattice.word) twice += std::popcount(w & site::bonds);
  return twice / 2;
}

}  // namespace geist::de
