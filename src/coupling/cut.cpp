#include "coupling/cut.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/hex8.hpp"
#include "geometry/polyhedron.hpp"

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>

namespace geist::coupling {
namespace {

constexpr double least_share = 1e-6;

/// The half-spaces of an element's six faces.
std::array<HalfSpace, 6> half_spaces(const hex8::Corners& x) {
  constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 4, 7, 3}, {1, 2, 6, 5}}};
  std::array<HalfSpace, 6> halves;
  for (int k = 0; k < 6; ++k) {
    const auto& [a, b, c, d] = faces[k];
    const Vec3 normal = cross(x[c] - x[a], x[d] - x[b]), n = normal * (1 / norm(normal));
    halves[k] = {n, dot(n, 0.25 * (x[a] + x[b] + x[c] + x[d]))};
  }
  return halves;
}

/// The square of an octant that contains the ghost, across an axis.
std::vector<Vec3> near_square(const Box& box, Vec3 ghost, int axis) {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  std::vector<Vec3> square(4, ghost);
  square[1][b] = square[2][b] = ghost[b] == box.low[b] ? box.high[b] : box.low[b];
  square[2][c] = square[3][c] = ghost[c] == box.low[c] ? box.high[c] : box.low[c];
  return square;
}

/// Collects what is taken from and given to each element.
class Cutter {
 public:
  Cutter(const Model& model, const Locator& locator) : model_(model), locator_(locator) {}

  void take_octants(const Lattice& lattice) {
    for (const Ghost& ghost : lattice.ghosts)
      for (int octant = 0; octant < 8; ++octant) {
        const std::array<int, 3> sign{octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1};
        if (!has_particle(lattice, ghost.site, sign)) continue;
        const Box box = octant_box(lattice, ghost.site, sign);
        take(box, ghost);
        for (int axis = 0; axis < 3; ++axis) {
          std::array<int, 3> beside = sign;
          beside[axis] = -sign[axis];
          if (!has_particle(lattice, ghost.site, beside)) pull(lattice, ghost, box, axis, sign[axis]);
        }
      }
  }

  std::vector<HexCut> cuts() {
    std::vector<HexCut> all;
    for (auto& [element, left] : left_) keep_attached(left);
    balance();
    for (const auto& [element, left] : left_) all.push_back(left);
    return all;
  }

 private:
  /// Whether the cube between centres that the octant is part of has a particle for a corner.
  static bool has_particle(const Lattice& lattice, std::size_t site, const std::array<int, 3>& sign) {
    const Grid& grid = lattice.grid;
    const auto [i, j, k] = grid.ijk(site);
    for (int corner = 1; corner < 8; ++corner) {
      const int a = i + (corner & 1 ? sign[0] : 0), b = j + (corner & 2 ? sign[1] : 0),
                c = k + (corner & 4 ? sign[2] : 0);
      if (grid.contains(a, b, c) && lattice.is(grid.index(a, b, c), site::particle)) return true;
    }
    return false;
  }

  static Box octant_box(const Lattice& lattice, std::size_t site, const std::array<int, 3>& sign) {
    const double r = lattice.radius();
    const Vec3 from = lattice.grid.centre(site),
               to = from + r * Vec3{1.0 * sign[0], 1.0 * sign[1], 1.0 * sign[2]};
    Box box = nowhere();
    widen(box, from), widen(box, to);
    return box;
  }

  void take(const Box& box, const Ghost& ghost) {
    for (const std::int32_t e : locator_.near(box)) {
      const hex8::Corners x = hex8::corners(model_.mesh, static_cast<std::size_t>(e));
      const double tolerance = 1e-9 * norm(box.high - box.low);
      ConvexPolyhedron part(box);
      bool whole = true;
      for (const HalfSpace& half : half_spaces(x)) {
        whole = whole && is_inside(box, half, tolerance);
        if (!whole) part.cut(half, tolerance);
      }
      if (whole)
        take_points(e, x, quadrature(box), ghost);
      else
        take_points(e, x, part.quadrature(), ghost);
      if (whole) return;
    }
  }

  static bool is_inside(const Box& box, const HalfSpace& half, double tolerance) {
    const Vec3 farthest{(half.n.x > 0 ? box.high : box.low).x, (half.n.y > 0 ? box.high : box.low).y,
                        (half.n.z > 0 ? box.high : box.low).z};
    return dot(half.n, farthest) <= half.offset + tolerance;
  }

  template <class Points>
  void take_points(std::int32_t e, const hex8::Corners& x, const Points& points, const Ghost& ghost) {
    const double density = model_.mesh.regions[region_of(model_.mesh, e)].material.density;
    double mass = 0;
    for (const auto& [p, weight] : points) {
      const auto [xi, converged] = hex8::inverse_map(x, p);
      if (!converged) continue;
      HexCut& cut = left(e);
      const auto N = hex8::shape(xi);
      const auto gradient = hex8::position_gradient(x, xi);
      cut.volume -= weight;
      mass += density * weight;
      for (int a = 0; a < 8; ++a) {
        cut.gradient[a] -= weight * gradient[a];
        cut.mass[a] -= density * weight * N[a];
      }
    }
    if (mass == 0) return;
    HexCut& host = left(ghost.element);
    for (int a = 0; a < 8; ++a) host.mass[a] += mass * ghost.N[a];
  }

  /// A square of the surface that the hexahedra end at, r × r with the ghost at a corner, under unit stress:
  /// the lattice pulls at the ghost, and the hexahedra, integrated, at where they are.
  void pull(const Lattice& lattice, const Ghost& ghost, const Box& box, int axis, int sign) {
    const Vec3 x_g = lattice.grid.centre(ghost.site);
    const double r = lattice.radius(), tolerance = 1e-9 * r;
    Vec3 n, behind;
    n[axis] = sign, behind[axis] = -1e-6 * r * sign;
    std::vector<Vec3> square = near_square(box, x_g, axis);
    for (Vec3& p : square) p += behind;  // into the hexahedra that are left
    double met = 0;
    for (const std::int32_t e : locator_.near(box_of(square))) {
      const hex8::Corners x = hex8::corners(model_.mesh, static_cast<std::size_t>(e));
      std::vector<Vec3> part = square;
      for (const HalfSpace& half : half_spaces(x))
        if (!part.empty()) part = clipped(part, half, tolerance);
      for (const auto& [p, area] : quadrature(part)) {
        const auto [xi, converged] = hex8::inverse_map(x, p - behind);
        if (!converged) continue;
        met += area;
        const auto N = hex8::shape(xi);
        for (int a = 0; a < 8; ++a) defect_[model_.mesh.elements[e][a]] -= (area * N[a]) * n;
      }
    }
    for (int a = 0; a < 8; ++a) defect_[model_.mesh.elements[ghost.element][a]] += (met * ghost.N[a]) * n;
  }

  static Box box_of(const std::vector<Vec3>& points) {
    Box box = nowhere();
    for (const Vec3 p : points) widen(box, p);
    return box;
  }

  /// Elements with a node at which the pulls differ.
  std::vector<std::int32_t> elements_at_defects() const {
    double largest = 0;
    for (const auto& [element, cut] : left_) largest = std::max(largest, std::cbrt(cut.volume * cut.volume));
    std::vector<std::int32_t> found;
    for (std::size_t e = 0; e < model_.mesh.elements.size(); ++e)
      for (const std::int32_t node : model_.mesh.elements[e])
        if (const auto it = defect_.find(node); it != defect_.end() && norm(it->second) > 1e-10 * largest) {
          found.push_back(static_cast<std::int32_t>(e));
          break;
        }
    return found;
  }

  /// Correct the gradients so that both pulls agree at every node.
  void balance();

  /// What is left of an element; the whole of it at first.
  HexCut& left(std::int32_t e) {
    const auto [it, is_new] = left_.try_emplace(e);
    if (is_new) it->second = whole(e);
    return it->second;
  }

  HexCut whole(std::int32_t e) const {
    const hex8::Corners x = hex8::corners(model_.mesh, static_cast<std::size_t>(e));
    HexCut cut{e, hex8::volume(x), {}, hex8::corner_volumes(x)};
    for (const Vec3 s : hex8::corner_xi) {
      const Vec3 xi = hex8::gauss * s;
      const double dV = det(hex8::jacobian(x, xi));
      const auto gradient = hex8::position_gradient(x, xi);
      for (int a = 0; a < 8; ++a) cut.gradient[a] += dV * gradient[a];
    }
    for (double& m : cut.mass) m *= model_.mesh.regions[region_of(model_.mesh, e)].material.density;
    return cut;
  }

  void keep_attached(HexCut& cut) const {
    const HexCut all = whole(cut.element);
    for (int a = 0; a < 8; ++a) cut.mass[a] = std::max(cut.mass[a], least_share * all.mass[a]);
    if (cut.volume >= least_share * all.volume) return;
    cut.volume = least_share * all.volume;
    for (int a = 0; a < 8; ++a) cut.gradient[a] = least_share * all.gradient[a];
  }

  const Model& model_;
  const Locator& locator_;
  std::map<std::int32_t, HexCut> left_;
  std::map<std::int32_t, Vec3> defect_;  ///< by node: Σ_g N_a(x_g) A_g − ∫ N_a n dA
};

/// Four orthonormal patterns on an element's corners that no linear field stirs.
Eigen::Matrix<double, 8, 4> patterns(const hex8::Corners& x) {
  const hex8::Corners& s = hex8::corner_xi;
  Eigen::Matrix<double, 8, 8> basis;
  for (int a = 0; a < 8; ++a)
    basis.row(a) << 1, x[a].x - x[0].x, x[a].y - x[0].y, x[a].z - x[0].z, s[a].y * s[a].z, s[a].z * s[a].x,
        s[a].x * s[a].y, s[a].x * s[a].y * s[a].z;
  for (int k = 0; k < 8; ++k) {
    for (int pass = 0; pass < 2; ++pass)
      for (int m = 0; m < k; ++m) basis.col(k) -= basis.col(m).dot(basis.col(k)) * basis.col(m);
    basis.col(k) /= basis.col(k).norm();
  }
  return basis.rightCols<4>();
}

/// G_ea += Σ_k γ_ka q_ek with the smallest Σ |q_ek|²/V_e such that Σ_e Σ_k γ_ka q_ek = defect_a:
/// q = V γᵀ λ, Σ_e γ V γᵀ λ = defect.
void Cutter::balance() {
  std::map<std::int32_t, Eigen::Index> number;  // of nodes
  std::vector<std::int32_t> carriers = elements_at_defects();
  for (const std::int32_t e : carriers)
    for (const std::int32_t node : model_.mesh.elements[e])
      number.try_emplace(node, static_cast<Eigen::Index>(number.size()));
  if (carriers.empty()) return;
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Eigen::Matrix<double, 8, 8>> carried;
  for (const std::int32_t e : carriers) {
    const auto gamma = patterns(hex8::corners(model_.mesh, static_cast<std::size_t>(e)));
    carried.push_back(left(e).volume * gamma * gamma.transpose());
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b)
        entries.emplace_back(number[model_.mesh.elements[e][a]], number[model_.mesh.elements[e][b]],
                             carried.back()(a, b));
  }
  const auto n = static_cast<Eigen::Index>(number.size());
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixX3d defect = Eigen::MatrixX3d::Zero(n, 3);
  for (const auto& [node, d] : defect_)
    if (const auto it = number.find(node); it != number.end()) defect.row(it->second) << d.x, d.y, d.z;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(1e-12);
  solver.setMaxIterations(1000);
  solver.compute(A);
  const Eigen::MatrixX3d lambda = solver.solve(defect);
  for (std::size_t k = 0; k < carriers.size(); ++k) {
    HexCut& cut = left(carriers[k]);
    const auto& nodes = model_.mesh.elements[carriers[k]];
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b)
        for (int i = 0; i < 3; ++i) cut.gradient[a][i] += carried[k](a, b) * lambda(number[nodes[b]], i);
  }
}

}  // namespace

std::vector<HexCut> cut_hexahedra(const Model& model, const Locator& locator) {
  Cutter cutter(model, locator);
  for (const Lattice& lattice : model.lattices) cutter.take_octants(lattice);
  return cutter.cuts();
}

}  // namespace geist::coupling
