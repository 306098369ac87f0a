#include "work.hpp"

#include "de/finite_stencil.hpp"
#include "de/stencil.hpp"
#include "fe/corotational.hpp"
#include "fe/formulations.hpp"

namespace geist::bench {
namespace {

/// A number that counts what is done with it: the kernels are templates, so they count their own flops.
struct Counted {
  double value = 0;
  static inline long flops = 0;
  Counted() = default;
  Counted(double a) : value(a) {}
  Counted operator-() const { return -value; }
  friend Counted operator+(Counted a, Counted b) { return ++flops, a.value + b.value; }
  friend Counted operator-(Counted a, Counted b) { return ++flops, a.value - b.value; }
  friend Counted operator*(Counted a, Counted b) { return ++flops, a.value * b.value; }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend Counted operator/(Counted a, Counted b) { return ++flops, a.value / b.value; }
  friend Counted fma(Counted a, Counted b, Counted c) { return flops += 2, a.value * b.value + c.value; }
};

template <class Law>
double count(const Law& law, bool finite) {
  double zeros[2] = {0, 0};
  double* const z = zeros;
  const std::ptrdiff_t offset[18] = {};
  Counted f[6];
  Counted::flops = 0;
  if (finite)
    de::site_force(de::FiniteView{{z, z, z}, {z, z, z, z, z, z, z, z, z}}, 0, offset, law, 1.0,
                   de::AllBonds{}, f);
  else
    de::site_force(de::MotionView{{z, z, z, z, z, z}}, 0, offset, law, 1.0, de::AllBonds{}, f);
  return static_cast<double>(Counted::flops);
}

/// Small rotations, published: 441, and by hand
///   group 1 (6 bonds): 2 sums of spins, d 2 × 3 + 1, f 5, sums of force and moment 5: 19
///   group 2 (12 bonds): 3 + 1 sums of spins, d 3 × 3, f 7, moment 1, sums 6: 27;   r × moment: 3
/// consistent: 303
///   group 1: 19, and bending 3 × 3: 28;   group 2: 1 sum of spins, d 2 × 3, f 2, sums 2: 11
/// The template does more, with results that nobody uses or that are zero, and the compiler knows it. Group
/// 1: the third sum of spins, the d along the bond that is replaced (3), the moment about it. Diagonals that
/// do not shear: three sums of spins, the d across (3), the moment.
///
/// Finite rotations, published: 933, and by hand
///   group 1: h 3, d 9, p 1, d·p 5, pull 1, force 9, g 9, sums 6: 43
///   group 2: h 9, d 9, p 2, d·p 5, pull 1, force 9, g 9, sums 9: 53
///   three cross products: 3 × (1 + 12)
/// consistent, 1023: bending 27 more in group 1, force 3 in group 2.
double stencil_flops(LatticeKind kind) {
  const double idle = kind.finite ? 0 : kind.consistent ? 6 * 5 + 12 * 7 : 6 * 5;
  return (kind.consistent ? count(de::EndlessBond{}, kind.finite)
                          : count(de::ElasticBond{1, 1}, kind.finite)) -
         idle;
}

fe::Corners<Counted> unit_cube() {
  fe::Corners<Counted> x;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) {
      const int bits[8] = {0, 1, 3, 2, 4, 5, 7, 6};
      x[a][i] = bits[a] >> i & 1;
    }
  return x;
}

/// The modes k = 0 of X and u, which nobody uses: 3 + 3 flops that the compiler leaves out.
constexpr double unused_modes = 6;

}  // namespace

// Kick with sums, by hand: displacements 3 × (keep 2, force 2, sums 2 + 2) = 24; spins 3 × (1 + 2 + 2 + 2)
// = 21. Bytes: motion 6 × 8 (finite: u and H 12 × 8), velocity read and written 12 × 8, word 4.
Work bonds_and_kick(LatticeKind kind) { return {stencil_flops(kind) + 24 + 21, kind.finite ? 196. : 148.}; }

// Small: six multiply-adds. Finite: u 6; ψ 3, ψ² 5, series 6, τ 3, scale 4, columns 3 × 28, A 6 × 8, columns
// again 9 × 7: 222. Bytes: motion (u and H) read and written, velocity read.
Work lattice_drift(LatticeKind kind) { return kind.finite ? Work{222, 240} : Work{12, 144}; }

// Bytes: motion and velocity read and written, word.
Work drift_bonds_and_kick(LatticeKind kind) {
  return {lattice_drift(kind).flops + bonds_and_kick(kind).flops, kind.finite ? 292. : 196.};
}

// X and u 6 × 8; forces cleared (their lines read before), read and written, 4 × 24; by element 24 flops to
// add its forces, and of every eighth the nodes 8 × 4. With a strain of 10⁻³ the rotation takes three
// iterations.
Work internal_forces(const std::string& formulation, bool finite) {
  const auto X = unit_cube();
  auto u = X, f = X;
  for (auto& corner : u.at)
    for (Counted& i : corner) i = 1e-3 * i;
  Counted::flops = 0;
  fe::visit_formulation(formulation, {1, 1, 1, 0.05}, [&](auto kernel) {
    if constexpr (!decltype(kernel)::uses_velocity) {
      if (finite)
        fe::Corotational<decltype(kernel)>{kernel}.forces(X, u, u, f);
      else
        kernel.forces(X, u, u, f);
    }
  });
  return {static_cast<double>(Counted::flops) - unused_modes + 36, 48 + 96 + 4};
}

// Division 1, 3 × (keep 2, force 2, m v⁺ 1, sums 2 + 2). Force 24, velocity read and written 48, mass 8,
// supports 1.
Work node_kick() { return {28, 24 + 48 + 9}; }

// Three multiply-adds; displacement read and written, velocity read.
Work node_drift() { return {6, 72}; }

}  // namespace geist::bench
