// The laws of a bond. Source: (3)–(5) of the journal paper; docs/theory.md, "Consistent lattice".
//
// Published: one normal and two tangential springs at the mid-point of a pair, the same for all bonds.
//
//   f = K d,  K = diag(k_n, k_s, k_s) in the bond's axes   (3)(4)
//   k_n = 2 E r / (5 (1 − 2ν)),  k_s = 2 E r (1 − 4ν) / (5 (1 − 2ν)(1 + ν)),  groups 1 and 2 alike   (5)
//
// With n the unit vector from i to j: f = k_s d + (k_n − k_s)(d·n) n, and E = ½ f·d. k_s ≥ 0 needs ν ≤ 1/4.
//
// Consistent: springs by the class of the site (de/assembly.hpp); in the endless lattice
//
//   group 1: k_n = 2r (2μ − λ), k_s = 4r (μ − λ);   group 2: k_n = 2rλ, k_s = 0
//
// which is the one isotropic lattice of these bonds whose diagonals do not shear, as free as (5) up to ν =
// 1/4: then the moments on every single corner of a cell vanish in homogeneous strain. Bonds of group 1 also
// resist bending and twisting, m = k (θ_j − θ_i) on i with k_b across the bond and k_t along it.
#pragma once
#include "core/pack.hpp"
#include "de/dilatation.hpp"
#include "model/lattice.hpp"
#include "model/material.hpp"

namespace geist::de {

/// 1 for the nearest neighbours, 2 for the next: the square of the step on the grid.
constexpr int group(int d) {
  const auto [a, b, c] = directions[static_cast<std::size_t>(d)];
  return a * a + b * b + c * c;
}

/// Force on i of a bond in direction D under a law, at relative displacement d = d_j − d_i, into f: shear d +
/// along (d·e) e for the step e; each of e is −1, 0 or 1.
template <int D, class T, class Law>
GEIST_INLINE void bond_force(const Law& law, const T (&d)[3], T (&f)[3]) {
  constexpr int e[3] = {directions[D][0], directions[D][1], directions[D][2]};
  constexpr int first = e[0] ? 0 : e[1] ? 1 : 2;
  T along = e[first] > 0 ? d[first] : -d[first];
  for (int c = first + 1; c < 3; ++c)
    if (e[c]) along = e[c] > 0 ? along + d[c] : along - d[c];
  along = along * law.template along<D>();
  for (int c = 0; c < 3; ++c) {
    const T pull = e[c] == 0 ? constant<T>(0) : e[c] > 0 ? along : -along;
    if constexpr (!Law::template shears<D>)
      f[c] = pull;
    else
      f[c] = e[c] == 0 ? law.template shear<D>() * d[c] : fma(law.template shear<D>(), d[c], pull);
  }
}

/// Stiffnesses (force/length) of every bond of a published lattice.
struct ElasticBond {
  static constexpr bool bends = false;
  template <int D>
  static constexpr bool shears = true;
  double k_n = 0, k_s = 0;

  static ElasticBond from(const Material& m, double r) {
    const double E = m.young, nu = m.poisson, k_n = 2 * E * r / (5 * (1 - 2 * nu));
    return {k_n, k_n * (1 - 4 * nu) / (1 + nu)};
  }

  /// Of a bond in direction D, as BondClass has them.
  template <int D>
  GEIST_INLINE double shear() const {
    return k_s;
  }
  template <int D>
  GEIST_INLINE double along() const {
    return (k_n - k_s) / group(D);
  }
};

/// Stiffness against rotation (moment by angle) of a bond of group 1: that of a bar of the cell's section,
/// (2r)², and length 2r. Twisted, a square bar has 0.1406 of its edge⁴ (Saint-Venant).
struct Bending {
  static constexpr bool bends = true;
  template <int D>
  static constexpr bool shears = group(D) == 1;  ///< diagonals of consistent lattices do not: k_s2 = 0
  double k_b = 0, k_t = 0;
  double bend = 0, twist = 0;  ///< by r, as the stencil adds them to moments

  static Bending from(const Material& m, double r) {
    constexpr double saint_venant = 0.14057701495515552;
    const double cube = 8 * r * r * r, G = m.young / (2 * (1 + m.poisson));
    const double k_b = m.young * cube / 12, k_t = saint_venant * G * cube;
    return {k_b, k_t, k_b / r, k_t / r};
  }

  /// For component c of the relative rotation of a bond in direction D.
  template <int D>
  GEIST_INLINE double turn(int c) const {
    return directions[D][static_cast<std::size_t>(c)] != 0 ? twist : bend;
  }

  /// w_c of the energy ½ Σ w_c |(R_j − R_i) e_c|² of finite rotations, by column c of R. A small rotation φ
  /// moves the columns by φ × e_c, so that this is ½ k_b |φ across|² + ½ k_t |φ along|².
  template <int D>
  GEIST_INLINE double column(int c) const {
    return directions[D][static_cast<std::size_t>(c)] != 0 ? k_b - 0.5 * k_t : 0.5 * k_t;
  }
};

/// Bonds of the endless consistent lattice.
struct EndlessBond : Bending {
  ElasticBond near, far;  ///< of groups 1 and 2

  static EndlessBond from(const Material& m, double r) {
    const Material bonds = material_of_bonds(m);
    const double lambda = bonds.lambda(), mu = bonds.mu();
    return {Bending::from(m, r), {2 * r * (2 * mu - lambda), 4 * r * (mu - lambda)}, {2 * r * lambda, 0}};
  }
  const ElasticBond& of(int group) const { return group == 1 ? near : far; }
  template <int D>
  GEIST_INLINE double shear() const {
    return of(group(D)).template shear<D>();
  }
  template <int D>
  GEIST_INLINE double along() const {
    return of(group(D)).template along<D>();
  }
};

/// Bonds by classes: Self::pick<D>(member) is what the classes of one site, or eight sites, have there.
template <class Self, class T>
struct PickedBonds : Bending {
  explicit PickedBonds(const Bending& bending) : Bending(bending) {}
  template <int D>
  GEIST_INLINE T shear() const {
    return of_class<D>(&BondClass::shear);
  }
  template <int D>
  GEIST_INLINE T along() const {
    return of_class<D>(&BondClass::along);
  }
  /// Ghosts at the edge of what is counted have bonds that do not bend.
  template <int D>
  GEIST_INLINE T turn(int c) const {
    return Bending::turn<D>(c) * of_class<D>(&BondClass::bends);
  }
  template <int D>
  GEIST_INLINE T column(int c) const {
    return Bending::column<D>(c) * of_class<D>(&BondClass::bends);
  }

 private:
  template <int D>
  GEIST_INLINE T of_class(const std::array<double, 18> BondClass::*member) const {
    return static_cast<const Self&>(*this).template pick<D>(member);
  }
};

/// Bonds of the one site, or eight sites, whose classes these are.
template <class T>
struct ClassBonds : PickedBonds<ClassBonds<T>, T> {
  static constexpr int count = sizeof(T) / sizeof(double);
  const BondClass* of[count];

  ClassBonds(const Bending& bending, const BondClass* classes, const std::uint32_t* class_of)
      : PickedBonds<ClassBonds, T>(bending) {
    for (int l = 0; l < count; ++l) of[l] = classes + class_of[l];
  }
  template <int D>
  GEIST_INLINE T pick(const std::array<double, 18> BondClass::*member) const {
    if constexpr (std::is_same_v<T, double>) {
      return (of[0]->*member)[D];
    } else {
      T k;
      for (int l = 0; l < count; ++l) k[l] = (of[l]->*member)[D];
      return k;
    }
  }
};

/// Bonds of eight sites that are of two classes, which are read once for all.
struct TwoClassBonds : PickedBonds<TwoClassBonds, Pack> {
  const BondClass *first, *second;
  PackInt is_second;  ///< −1 or 0

  TwoClassBonds(const Bending& bending, const BondClass* a, const BondClass* b, PackInt is_b)
      : PickedBonds(bending), first(a), second(b), is_second(is_b) {}

  template <int D>
  GEIST_INLINE Pack pick(const std::array<double, 18> BondClass::*member) const {
    return select(is_second, broadcast((second->*member)[D]), broadcast((first->*member)[D]));
  }
};

}  // namespace geist::de
