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

/// 459, and by hand:
///   group 1 (6 bonds): 2 sums of spins, d 2 × 3 + 1, f 6 (one of them 0 + d), sums of force and moment 5: 20
///   group 2 (12 bonds): 3 + 1 sums of spins, d 3 × 3, f 8 (one 0 + d), moment 1, sums 6: 28 r × moment: 3
///   6·20 + 12·28 + 3 = 459
/// The template does five more in each bond of group 1 with results that nobody uses or that are zero, and
/// the compiler knows it: the third sum of spins, the d along the bond that is replaced (3), the moment about
/// it.
double stencil_flops() {
  constexpr double idle = 6 * 5;
  double zeros[2] = {0, 0};
  const de::MotionView motion{{zeros, zeros, zeros, zeros, zeros, zeros}};
  const std::ptrdiff_t offset[18] = {};
  Counted f[6];
  Counted::flops = 0;
  de::site_force(motion, 0, offset, de::ElasticBond{1, 1}, 1.0, de::AllBonds{}, f);
  return static_cast<double>(Counted::flops) - idle;
}

/// 933, and by hand:
///   group 1 (6 bonds): h 3, d 9, p 1, d·p 5, pull 1, force 9, g 9, sums 6: 43
///   group 2 (12 bonds): h 9, d 9, p 2, d·p 5, pull 1, force 9, g 9, sums 9: 53
///   three cross products: 3 × (1 + 12)
double finite_stencil_flops() {
  double zeros[2] = {0, 0};
  double* const z = zeros;
  const de::FiniteView motion{{z, z, z}, {z, z, z, z, z, z, z, z, z}};
  const std::ptrdiff_t offset[18] = {};
  Counted f[6];
  Counted::flops = 0;
  de::site_force(motion, 0, offset, de::ElasticBond{1, 1}, 1.0, de::AllBonds{}, f);
  return static_cast<double>(Counted::flops);
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
// = 21. Bytes: motion 6 × 8, velocity read and written 12 × 8, word 4.
Work bonds_and_kick() { return {stencil_flops() + 24 + 21, 148}; }

// Six multiply-adds; motion read and written, velocity read: 18 × 8.
Work lattice_drift() { return {12, 144}; }

// Bytes: u and H 12 × 8, velocity read and written 12 × 8, word 4.
Work finite_bonds_and_kick() { return {finite_stencil_flops() + 24 + 21, 196}; }

// u 6; ψ 3, ψ² 5, series 6, τ 3, scale 4, columns 3 × 28, A 6 × 8, columns again 9 × 7: 216. Bytes: u and H
// read and written, v and ω read: 30 × 8.
Work finite_drift() { return {6 + 216, 240}; }

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
