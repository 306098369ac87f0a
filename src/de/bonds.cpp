#include "de/bonds.hpp"

#include <algorithm>
#include <type_traits>

#include "core/parallel.hpp"
#include "de/drift.hpp"
#include "de/methods.hpp"

namespace geist::de {
namespace {

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
      const Pack after = kick(c, before, f[c]);
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
      const double before = lattice.velocity[c][s], after = kick(c, before, lattice.listed_force[c][slot]);
      lattice.velocity[c][s] = after;
      (c < 3 ? sums.across : sums.spin_across) += before * after;
      (c < 3 ? sums.after : sums.spin_after) += after * after;
    }
    return sums;
  });
}

}  // namespace geist::de
