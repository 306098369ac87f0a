#include "de/bonds.hpp"

#include <algorithm>
#include <bit>
#include <type_traits>

#include "core/parallel.hpp"
#include "de/drift.hpp"
#include "de/finite_stencil.hpp"
#include "de/stencil.hpp"

namespace geist::de {
namespace {

/// The bonds of published lattices: the same everywhere.
struct Published {
  ElasticBond inner;

  explicit Published(const Lattice& lattice) : inner(ElasticBond::from(lattice.material, lattice.radius())) {}
  template <class T = Pack>
  GEIST_INLINE const ElasticBond& at(std::size_t) const {
    return inner;
  }
  /// visit(law) with the bonds of eight sites.
  template <class Visit>
  GEIST_INLINE void visit(std::size_t, Visit visit_law) const {
    visit_law(inner);
  }
};

/// The bonds of consistent lattices: those of the endless lattice, or by the sites' classes.
struct Consistent {
  static constexpr std::uint32_t none = ~0u;
  EndlessBond inner;
  const BondClass* classes;
  const std::uint32_t *class_of, *word;

  explicit Consistent(const Lattice& lattice)
      : inner(EndlessBond::from(lattice.material, lattice.radius())),
        classes(lattice.classes.data()),
        class_of(lattice.class_of.data()),
        word(lattice.word.data()) {}
  template <class T = Pack>
  GEIST_INLINE ClassBonds<T> at(std::size_t s) const {
    return {inner, classes, class_of + s};
  }
  /// Most packs have one class, at ends of rows two: those of their first and last sites.
  template <class Visit>
  GEIST_INLINE void visit(std::size_t s, Visit visit_law) const {
    std::uint32_t first = none, last = none;
    bool others = false;
    for (std::size_t l = s; l < s + lanes; ++l)
      if (word[l]) last = class_of[l], first = first == none ? last : first;
    for (std::size_t l = s; l < s + lanes; ++l)
      others |= word[l] != 0 && class_of[l] != first && class_of[l] != last;
    if (others)
      visit_law(at(s));
    else if (first == last)
      visit_law(ClassBonds<double>(inner, classes, &first));
    else
      visit_law(TwoClassBonds{inner, classes + first, classes + last, load(class_of + s) == last});
  }
};

/// And with pressures of cells and skins; skins are at the surface only.
struct Dilating : Consistent, Pressures {
  explicit Dilating(const Lattice& lattice) : Consistent(lattice), Pressures(lattice) {}
  GEIST_INLINE void add_inner(std::size_t s, Pack (&f)[6]) const { add<of_cell>(s, f); }
  GEIST_INLINE void add_all(std::size_t s, Pack (&f)[6]) const {
    add<0>(s, f), add<1>(s, f), add<2>(s, f), add<of_cell>(s, f);
  }
};

/// What the row kernel reads and writes, as plain pointers and numbers. View is that of small or of finite
/// rotations.
template <class Method, class View>
struct RowKernel {
  View motion;
  double* velocity[6];
  double* listed_force[6];
  const std::uint32_t* word;
  const std::int32_t* listed_begin;
  std::ptrdiff_t offset[18];
  std::size_t stride;
  Method method;
  double r;
  Kick kick;

  RowKernel(const Method& bonds, const View& view) : motion(view), method(bonds) {}

  struct Accumulated {
    Pack across = {}, after = {}, spin_across = {}, spin_after = {};
  };

  /// Eight inner particles: every bond exists, all are advanced.
  GEIST_INLINE void inner(std::size_t s, Accumulated& sums) const {
    Pack f[6];
    site_force(motion, s, offset, method.inner, r, AllBonds{}, f);
    if constexpr (std::is_same_v<Method, Dilating>) method.add_inner(s, f);
    advance(
        s, f, sums, [](Pack, Pack v) __attribute__((always_inline)) { return v; });
  }

  /// Eight sites of any kind; returns the next place in listed_force.
  GEIST_INLINE std::int32_t mixed(std::size_t s, std::int32_t slot, Accumulated& sums) const {
    const PackInt w = load(word + s);
    Pack f[6];
    method.visit(
        s, [&](const auto& law)
               __attribute__((always_inline)) { site_force(motion, s, offset, law, r, SomeBonds{w}, f); });
    if constexpr (std::is_same_v<Method, Dilating>) method.add_all(s, f);
    const PackInt free = -((w / site::free) & 1);
    advance(
        s, f, sums, [=](Pack before, Pack after) __attribute__((always_inline)) {
          return (Pack)(((PackInt)after & free) | ((PackInt)before & ~free));
        });
    for (int l = 0; l < lanes; ++l) {
      const bool occupied = word[s + l] & (site::particle | site::ghost);
      if (!occupied || word[s + l] & site::free) continue;
      for (int c = 0; c < 6; ++c) listed_force[c][slot] = f[c][l];
      ++slot;
    }
    return slot;
  }

  /// Kick, select(v⁻, v⁺) being what is kept. Sites that are not advanced add nothing to the sums.
  template <class Select>
  GEIST_INLINE void advance(std::size_t s, const Pack (&f)[6], Accumulated& sums, Select select) const {
    const Pack zero = {};
    for (int c = 0; c < 6; ++c) {
      const Pack before = load(velocity[c] + s);
      const Pack kept = c < 3 ? fma(kick.keep, before, broadcast(kick.gravity[c])) : kick.keep * before;
      const Pack after = fma(c < 3 ? kick.per_mass : kick.per_inertia, f[c], kept);
      store(velocity[c] + s, select(before, after));
      const Pack counted = select(zero, after);
      Pack& across = c < 3 ? sums.across : sums.spin_across;
      Pack& square = c < 3 ? sums.after : sums.spin_after;
      across = fma(before, counted, across);
      square = fma(counted, counted, square);
    }
  }

  KickSums row(std::size_t row) const {
    Accumulated sums;
    std::int32_t slot = listed_begin[row];
    for (std::size_t s = row * stride; s < (row + 1) * stride; s += lanes) {
      std::uint32_t all = site::inner, any = 0;
      for (int l = 0; l < lanes; ++l) all &= word[s + l], any |= word[s + l];
      if (any == 0) continue;
      if (all == site::inner && any == site::inner)
        inner(s, sums);
      else
        slot = mixed(s, slot, sums);
    }
    return {sum_lanes(sums.across), sum_lanes(sums.after), sum_lanes(sums.spin_across),
            sum_lanes(sums.spin_after)};
  }
};

template <class Method, class View>
RowKernel<Method, View> row_kernel(const Method& method, const View& motion, Lattice& lattice,
                                   const Kick& kick) {
  RowKernel<Method, View> k(method, motion);
  for (int c = 0; c < 6; ++c) {
    k.velocity[c] = lattice.velocity[c];
    k.listed_force[c] = lattice.listed_force[c];
  }
  k.word = lattice.word.data();
  k.listed_begin = lattice.listed_begin.data();
  for (int d = 0; d < 18; ++d) k.offset[d] = lattice.grid.offset(d);
  k.stride = lattice.grid.stride();
  k.r = lattice.radius();
  k.kick = kick;
  return k;
}

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

struct NoDrift {
  GEIST_INLINE void operator()(std::size_t) const {}
};

/// Drift, forces and kick in one pass over the rows: each row drifts just before the first forces that depend
/// on it. Those that forces of several shares depend on have drifted before.
template <class Kernel, class Drift>
struct Sweep {
  Kernel kernel;
  Drift drift;
  std::size_t rows, reach;  ///< forces on a row depend on rows up to `reach` away
  double* sums;

  /// Rows of a share that no other share's forces depend on.
  Indices inside(Indices share) const {
    const std::size_t begin = share.begin == 0 ? 0 : std::min(share.begin + reach, share.end);
    return {begin, share.end == rows ? rows : std::max(begin, share.end - std::min(reach, share.end))};
  }
  void drift_row(std::size_t row) const {
    for (std::size_t s = row * kernel.stride; s < (row + 1) * kernel.stride; s += lanes) drift(s);
  }
  void prepare(Indices share) const {
    const Indices later = inside(share);
    for (std::size_t row = share.begin; row < later.begin; ++row) drift_row(row);
    for (std::size_t row = later.end; row < share.end; ++row) drift_row(row);
  }
  void run(Indices share) const {
    Indices later = inside(share);
    for (std::size_t row = share.begin; row < share.end; ++row) {
      for (; later.begin < std::min(later.end, row + reach + 1); ++later.begin) drift_row(later.begin);
      const KickSums s = kernel.row(row);
      sums[4 * row] = s.across, sums[4 * row + 1] = s.after;
      sums[4 * row + 2] = s.spin_across, sums[4 * row + 3] = s.spin_after;
    }
  }
};

SmallDrift drift_of(const MotionView&, Lattice& lattice, double dt) { return {lattice, dt}; }
FiniteDrift drift_of(const FiniteView&, Lattice& lattice, double dt) { return {lattice, dt}; }

/// One pass, or without drift the forces and the kick alone.
template <class Kernel, class Drift>
KickSums run(const Kernel& kernel, const Drift& drift, Lattice& lattice) {
  const std::size_t rows = lattice.grid.rows();
  lattice.row_sums.resize(4 * rows);
  const Sweep<Kernel, Drift> sweep{kernel, drift, rows, static_cast<std::size_t>(lattice.grid.ny) + 1,
                                   lattice.row_sums.data()};
  constexpr std::size_t few = 8;  // rows that are not worth waking the threads
  if constexpr (!std::is_same_v<Drift, NoDrift>)
    for_each_share(
        rows, [sweep](Indices share) { sweep.prepare(share); }, few);
  for_each_share(
      rows, [sweep](Indices share) { sweep.run(share); }, few);
  KickSums total;
  const double* sums = sweep.sums;
  for (std::size_t row = 0; row < rows; ++row, sums += 4) total += {sums[0], sums[1], sums[2], sums[3]};
  return total;
}

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

/// f(method, view) with those of the lattice.
template <class F>
auto with_kinematics(const Lattice& lattice, F f) {
  const auto with_view = [&](const auto& method) {
    return lattice.kinematics == Kinematics::finite ? f(method, finite_view(lattice))
                                                    : f(method, view(lattice.motion));
  };
  return lattice.consistent() ? with_view(Consistent(lattice)) : with_view(Published(lattice));
}

}  // namespace

KickSums bond_forces_and_kick(Lattice& lattice, const Kick& kick) {
  if (lattice.dilates()) {
    find_pressures(lattice);
    return run(row_kernel(Dilating(lattice), view(lattice.motion), lattice, kick), NoDrift(), lattice);
  }
  return with_kinematics(lattice, [&](const auto& method, const auto& motion) {
    return run(row_kernel(method, motion, lattice, kick), NoDrift(), lattice);
  });
}

void drift(Lattice& lattice, double dt) {
  const auto drift_all = [&lattice](const auto& drift) {
    for_each(
        lattice.grid.size() / lanes, [drift](std::size_t pack) { drift(lanes * pack); }, 512);
  };
  lattice.kinematics == Kinematics::finite ? drift_all(FiniteDrift(lattice, dt))
                                           : drift_all(SmallDrift(lattice, dt));
}

KickSums advance(Lattice& lattice, const Kick& kick, double dt) {
  if (lattice.dilates()) {  // pressures have a pass of their own between the two
    drift(lattice, dt);
    return bond_forces_and_kick(lattice, kick);
  }
  return with_kinematics(lattice, [&](const auto& method, const auto& motion) {
    const auto kernel = row_kernel(method, motion, lattice, kick);
    return run(kernel, drift_of(motion, lattice, dt), lattice);
  });
}

KickSums kick_listed(Lattice& lattice, const Kick& kick) {
  return sum<KickSums, 64>(lattice.listed.size(), [&lattice, kick](std::size_t slot) {
    KickSums sums;
    const std::size_t s = lattice.listed[slot];
    for (int c = 0; c < 6; ++c) {
      if (lattice.listed_held[slot] >> c & 1) continue;
      const double before = lattice.velocity[c][s], f = lattice.listed_force[c][slot];
      const double kept = c < 3 ? fma(kick.keep, before, kick.gravity[c]) : kick.keep * before;
      const double after = fma(c < 3 ? kick.per_mass : kick.per_inertia, f, kept);
      lattice.velocity[c][s] = after;
      (c < 3 ? sums.across : sums.spin_across) += before * after;
      (c < 3 ? sums.after : sums.spin_after) += after * after;
    }
    return sums;
  });
}

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
