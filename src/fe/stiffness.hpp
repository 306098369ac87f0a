// The matrices of one element, column by column from its formulation: f = −K u − C v. For set-up code and
// tests. Degree of freedom 3 a + i is component i of corner a.
#pragma once
#include <Eigen/Core>

#include "fe/cut.hpp"
#include "fe/formulations.hpp"
#include "fe/hooke.hpp"
#include "fe/modes.hpp"
#include "fe/parameters.hpp"
#include "geometry/hex8.hpp"

namespace geist::fe {

using Matrix24 = Eigen::Matrix<double, 24, 24>;

namespace detail {

/// Minus the forces of unit values of each degree of freedom, eight at a time, as columns of a symmetric
/// matrix; `force_of(unit, f)` computes the forces f.
template <class F>
Matrix24 columns(F force_of) {
  Matrix24 A;
  for (int first = 0; first < 24; first += lanes) {
    Corners<Pack> unit{}, f;
    for (int l = 0; l < lanes; ++l) unit[(first + l) / 3][(first + l) % 3][l] = 1;
    force_of(unit, f);
    for (int l = 0; l < lanes; ++l)
      for (int d = 0; d < 24; ++d) A(d, first + l) = -f[d / 3][d % 3][l];
  }
  return A;
}

inline Corners<Pack> in_all_lanes(const Corners<double>& x) {
  Corners<Pack> p;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) p[a][i] = broadcast(x[a][i]);
  return p;
}

}  // namespace detail

/// K of an element with corners X; symmetric to rounding.
template <class Formulation>
Matrix24 stiffness_matrix(const Formulation& formulation, const Corners<double>& X) {
  const Corners<Pack> x = detail::in_all_lanes(X), rest{};
  return detail::columns(
      [&](const Corners<Pack>& u, Corners<Pack>& f) { formulation.forces(x, u, rest, f); });
}

/// C of an element with corners X; zero for formulations that do not use velocities.
template <class Formulation>
Matrix24 damping_matrix(const Formulation& formulation, const Corners<double>& X) {
  if constexpr (Formulation::uses_velocity) {
    const Corners<Pack> x = detail::in_all_lanes(X), rest{};
    return detail::columns(
        [&](const Corners<Pack>& v, Corners<Pack>& f) { formulation.forces(x, rest, v, f); });
  } else {
    return Matrix24::Zero();
  }
}

/// Positions of an element's corners about its first one.
inline Corners<double> local_corners(const Mesh& mesh, std::size_t e) {
  const hex8::Corners x = hex8::corners(mesh, e);
  Corners<double> X;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) X[a][i] = x[a][i] - x[0][i];
  return X;
}

/// The cut of an element in all lanes.
inline BlockCut in_all_lanes(const HexCut& cut) {
  BlockCut block;
  block.volume = broadcast(cut.volume);
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) block.gradient[a][i] = broadcast(cut.gradient[a][i]);
  return block;
}

/// Call visit(formulation) with that of element e: as it is, or cut.
template <class Formulation, class Visit>
auto visit_element(const Mesh& mesh, std::size_t e, const Formulation& formulation, Visit visit) {
  const HexCut* const cut = cut_of(mesh, e);
  if (!cut) return visit(formulation);
  const BlockCut left = in_all_lanes(*cut);
  return visit(Cut<Formulation>{formulation, left});
}

/// Call visit(e, K) for every element of a mesh that `wanted(e)`, in order.
template <class Wanted, class Visit>
void visit_stiffness(const Mesh& mesh, Wanted wanted, Visit visit) {
  for (const HexRegion& region : mesh.regions)
    visit_formulation(region.formulation, parameters(region), [&](const auto& formulation) {
      for (std::size_t e = region.first; e < region.first + region.count; ++e)
        if (wanted(e))
          visit_element(mesh, e, formulation,
                        [&](const auto& own) { visit(e, stiffness_matrix(own, local_corners(mesh, e))); });
    });
}

}  // namespace geist::fe
