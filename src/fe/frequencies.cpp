// Frequencies of elements, for the time step.
//
// Central differences with forces −K u^n − C v^{n−1/2} are stable if 4 M − 2 Δt C − Δt² K is positive
// definite: C is applied to the velocity of half a step before, v^{n−1/2} = (v^{n−1/2} + v^{n+1/2})/2 − ½ Δt
// v̇, so that the scheme is the one with centred damping and the mass M − ½ Δt C in place of M. (One mass: ω²
// Δt² + 2 c Δt < 4, as from its roots.) These matrices are sums over elements, lumped mass included, so it is
// enough that every element has it: for each,
//
//   Δt ≤ 2/ω_e,   ω_e = the y with y² = λmax(M_e⁻¹ (K_e + y C_e)) (*)
//
// which without damping is the largest frequency of K_e φ = ω² M_e φ. The right-hand side grows with y, so
// that iterating (*) from y = c/2 + √(c²/4 + k), k and c the largest eigenvalues (or bounds) of M⁻¹K and
// M⁻¹C, falls to the solution from above: every iterate is safe. What is returned is ω_e².
//
// An element that shares its nodes with others' stiffness must keep this in mind: with C ≠ 0, 2 Δt C + Δt² K
// ≤ 4 M falls with Δt, not with Δt², so (Δt ω_e/2)² of M_e is not enough for it; Δt ω_e/2 of M_e is.
//
// Elements of one region that are equal up to a translation (to 10⁻¹⁰ of their size) share a result. If a
// region has very many shapes, the eigenproblem is solved for those with the largest bounds by Gershgorin's
// circles, which is where the time step is decided, and the others keep that bound: the largest sum of |row|
// of M⁻¹K, M⁻¹C.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "core/parallel.hpp"
#include "fe/elements.hpp"
#include "fe/formulations.hpp"
#include "fe/parameters.hpp"
#include "fe/stiffness.hpp"
#include "geometry/hex8.hpp"

#include <Eigen/Eigenvalues>  // after stiffness.hpp, which sets how Eigen computes

namespace geist::fe {
namespace {

/// A little more than a, which covers the rounding of shapes and eigenvalues; rounded up to 30 bits, so that
/// the last bits of the eigenvalue solver, which change with the compiler, do not reach the time step.
double rounded_up(double a) {
  int exponent;
  const double fraction = std::frexp(a * (1 + 1e-8), &exponent);
  return std::ldexp(std::ceil(std::ldexp(fraction, 30)), exponent - 30);
}

/// Edges from corner 0 in units of about 10⁻¹⁰ of the element's size (a power of two), that unit's exponent,
/// and the number of the cut, 1 and up, where the element is cut.
using ShapeKey = std::array<std::int64_t, 23>;

ShapeKey shape_key(const hex8::Corners& x, std::int64_t cut) {
  double size = 0;
  for (int a = 1; a < 8; ++a) size = std::max(size, norm(x[a] - x[0]));
  ShapeKey key;
  key[21] = std::ilogb(size) - 33, key[22] = cut;
  const double units = std::ldexp(1, -static_cast<int>(key[21]));
  for (int a = 1; a < 8; ++a)
    for (int i = 0; i < 3; ++i) key[3 * (a - 1) + i] = std::llround((x[a][i] - x[0][i]) * units);
  return key;
}

std::uint64_t hash_of(const ShapeKey& key) {
  std::uint64_t h = 0;
  for (const std::int64_t part : key)
    h = (h ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15ull, h ^= h >> 29;
  return h;
}

/// Masses and gradients of a cut, to about 10⁻¹⁰ of their size.
using CutKey = std::array<std::int64_t, 33>;

CutKey cut_key(const HexCut& cut) {
  const double mass = *std::max_element(cut.mass.begin(), cut.mass.end());
  double area = 0;
  for (const Vec3 g : cut.gradient) area = std::max(area, norm(g));
  const int of_mass = 33 - std::ilogb(mass), of_area = 33 - std::ilogb(area),
            of_volume = 33 - std::ilogb(cut.volume);
  CutKey key;
  key[32] = std::llround(std::ldexp(cut.volume, of_volume));
  for (int a = 0; a < 8; ++a) {
    key[a] = std::llround(std::ldexp(cut.mass[a], of_mass));
    for (int i = 0; i < 3; ++i) key[8 + 3 * a + i] = std::llround(std::ldexp(cut.gradient[a][i], of_area));
  }
  return key;
}

/// The different shapes of a region: an element of each, and every element's shape.
struct Shapes {
  std::vector<std::size_t> example, of_element;
};

/// Numbers the shapes of a region as they come. Of shapes seen before only a hash is kept: they are many.
class ShapeFinder {
 public:
  ShapeFinder(const Mesh& mesh, const HexRegion& region) : mesh_(mesh) {
    for (std::size_t e = region.first; e < region.first + region.count; ++e)
      shapes_.of_element.push_back(shape_of(e));
  }
  Shapes take() { return std::move(shapes_); }

 private:
  ShapeKey key_of(std::size_t e) {
    const HexCut* const cut = cut_of(mesh_, e);
    const std::int64_t number =
        cut ? cuts_.try_emplace(cut_key(*cut), static_cast<std::int64_t>(cuts_.size()) + 1).first->second : 0;
    return shape_key(hex8::corners(mesh_, e), number);
  }
  std::size_t shape_of(std::size_t e) {
    const ShapeKey key = key_of(e);
    if (!shapes_.example.empty() && key == last_key_) return last_;  // as most are, next to each other
    last_key_ = key;
    const std::uint64_t hash = hash_of(key);
    const auto [first, end] = known_.equal_range(hash);
    for (auto it = first; it != end; ++it)
      if (key_of(shapes_.example[it->second]) == key) return last_ = it->second;
    last_ = shapes_.example.size();
    known_.emplace(hash, last_);
    shapes_.example.push_back(e);
    return last_;
  }
  const Mesh& mesh_;
  Shapes shapes_;
  std::unordered_multimap<std::uint64_t, std::size_t> known_;  ///< shapes by hash
  std::map<CutKey, std::int64_t> cuts_;
  ShapeKey last_key_{};
  std::size_t last_ = 0;
};

/// M^{-1/2} A M^{-1/2} of an element's matrices, which has the eigenvalues of M⁻¹A.
struct Scaled {
  Matrix24 stiffness, damping;
  Eigen::Matrix<double, 24, 1> root_mass;
};

template <class Formulation>
Scaled scaled_matrices(const Mesh& mesh, std::size_t e, const Formulation& formulation) {
  const auto mass = corner_masses(mesh, e);
  const Corners<double> X = local_corners(mesh, e);
  Eigen::Matrix<double, 24, 1> root_mass;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) root_mass(3 * a + i) = std::sqrt(mass[a]);
  const auto scale = root_mass.cwiseInverse().asDiagonal();
  return visit_element(mesh, e, formulation, [&](const auto& own) {
    return Scaled{scale * stiffness_matrix(own, X) * scale, scale * damping_matrix(own, X) * scale,
                  root_mass};
  });
}

double largest_eigenvalue(const Matrix24& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix24> solver(A, Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues()(23));
}

/// Largest sum of |row| of M⁻¹A of eight elements with these corner masses; `force_of(unit, f)` computes the
/// forces f = −A unit.
template <class F>
Pack gershgorin(const Pack (&mass)[8], F force_of) {
  Corners<Pack> sums{};
  for (int d = 0; d < 24; ++d) {
    Corners<Pack> unit{}, f;
    unit[d / 3][d % 3] = broadcast(1);
    force_of(unit, f);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) sums[a][i] += f[a][i] < 0 ? -f[a][i] : f[a][i];
  }
  Pack largest{};
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) {
      const Pack row = sums[a][i] / mass[a];
      largest = row > largest ? row : largest;
    }
  return largest;
}

/// Solution of y² = k + c y.
double start(double k, double c) { return c / 2 + std::sqrt(c * c / 4 + k); }

/// Eight elements.
struct Eight {
  Corners<Pack> X;
  Pack mass[8];

  Eight(const Mesh& mesh, const std::array<std::size_t, lanes>& elements) {
    for (int l = 0; l < lanes; ++l) {
      const Corners<double> x = local_corners(mesh, elements[l]);
      const auto m = corner_masses(mesh, elements[l]);
      for (int a = 0; a < 8; ++a) {
        mass[a][l] = m[a];
        for (int i = 0; i < 3; ++i) X[a][i][l] = x[a][i];
      }
    }
  }
};

/// Bounds of ω_e by Gershgorin's circles.
template <class Formulation>
std::array<double, lanes> bounds(const Eight& e, const Formulation& formulation) {
  const Corners<Pack> rest{};
  const Pack k = gershgorin(
      e.mass, [&](const Corners<Pack>& u, Corners<Pack>& f) { formulation.forces(e.X, u, rest, f); });
  Pack c{};
  if constexpr (Formulation::uses_velocity)
    c = gershgorin(e.mass,
                   [&](const Corners<Pack>& v, Corners<Pack>& f) { formulation.forces(e.X, rest, v, f); });
  std::array<double, lanes> y;
  for (int l = 0; l < lanes; ++l) y[l] = start(k[l], c[l]);
  return y;
}

/// The same of any elements of a region; cut ones are taken one by one.
template <class Formulation>
std::array<double, lanes> bounds(const Mesh& mesh, const std::array<std::size_t, lanes>& elements,
                                 const Formulation& formulation) {
  const auto is_cut = [&mesh](std::size_t e) { return cut_of(mesh, e) != nullptr; };
  if (std::none_of(elements.begin(), elements.end(), is_cut))
    return bounds(Eight(mesh, elements), formulation);
  std::array<double, lanes> y;
  for (int l = 0; l < lanes; ++l) {
    std::array<std::size_t, lanes> same;
    same.fill(elements[l]);
    y[l] = visit_element(mesh, elements[l], formulation,
                         [&](const auto& own) { return bounds(Eight(mesh, same), own)[0]; });
  }
  return y;
}

/// Solution of (*), from above.
double solution(const Scaled& m) {
  const bool damped = !m.damping.isZero(0);
  double y = start(largest_eigenvalue(m.stiffness), damped ? largest_eigenvalue(m.damping) : 0);
  for (int i = 0; damped && i < 30; ++i) {
    const double before = y;
    y = std::sqrt(largest_eigenvalue(m.stiffness + y * m.damping));
    if (y > before * (1 - 1e-6)) break;
  }
  return y;
}

/// ω_e of each shape.
template <class Formulation>
std::vector<double> shape_frequencies(const Mesh& mesh, const Shapes& shapes, Formulation formulation,
                                      std::size_t most_eigenproblems) {
  const std::size_t n = shapes.example.size();
  std::vector<double> omega(n, 0.0);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  const auto matrices = [&mesh, &shapes, formulation](std::size_t s) {
    return scaled_matrices(mesh, shapes.example[s], formulation);
  };
  if (n > most_eigenproblems) {
    for_each((n + lanes - 1) / lanes, [=, &mesh, &shapes, out = omega.data()](std::size_t pack) {
      std::array<std::size_t, lanes> elements;
      for (std::size_t l = 0; l < lanes; ++l) elements[l] = shapes.example[std::min(pack * lanes + l, n - 1)];
      const auto y = bounds(mesh, elements, formulation);
      std::copy_n(y.begin(), std::min<std::size_t>(lanes, n - pack * lanes), out + pack * lanes);
    });
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return omega[a] != omega[b] ? omega[a] > omega[b] : a < b;
    });
  }
  for_each(std::min(n, most_eigenproblems),
           [matrices, out = omega.data(), order = order.data()](std::size_t k) {
             out[order[k]] = solution(matrices(order[k]));
           });
  return omega;
}

}  // namespace

std::vector<double> frequencies_squared(const Mesh& mesh, std::size_t most_eigenproblems) {
  std::vector<double> squares(mesh.elements.size());
  for (const HexRegion& region : mesh.regions)
    visit_formulation(region.formulation, parameters(region), [&](auto formulation) {
      const Shapes shapes = ShapeFinder(mesh, region).take();
      const std::vector<double> omega = shape_frequencies(mesh, shapes, formulation, most_eigenproblems);
      for (std::size_t i = 0; i < region.count; ++i) {
        const double w = omega[shapes.of_element[i]];
        squares[region.first + i] = rounded_up(w * w);
      }
    });
  return squares;
}

}  // namespace geist::fe
