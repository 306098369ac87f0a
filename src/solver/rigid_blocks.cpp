#include "solver/rigid_blocks.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/parallel.hpp"
#include "de/stiffness.hpp"
#include "fe/stiffness.hpp"
#include "solver/axes.hpp"

namespace geist {
namespace {

using de::Matrix6;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

/// Pᵀ K P, lower triangle, in blocks of 6 × 6.
class BlockMatrix {
 public:
  explicit BlockMatrix(std::size_t blocks) : columns_(blocks) {}

  template <class Derived>
  void add(std::int32_t row, std::int32_t column, const Eigen::MatrixBase<Derived>& A) {
    if (row >= column) entry(row, column) += A;
  }

  Eigen::SparseMatrix<double> lower() const {
    std::vector<Eigen::Triplet<double>> triplets;
    for (std::size_t column = 0; column < columns_.size(); ++column)
      for (const auto& [row, A] : columns_[column])
        for (int d = 0; d < 6; ++d)
          for (int c = 0; c < 6; ++c)
            if (const int i = 6 * row + c, j = 6 * static_cast<int>(column) + d; i >= j)
              triplets.emplace_back(i, j, A(c, d));
    const auto n = static_cast<Eigen::Index>(6 * columns_.size());
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
  }

 private:
  /// A column has few rows: they are searched in turn.
  Matrix6& entry(std::int32_t row, std::int32_t column) {
    auto& entries = columns_[column];
    for (auto& [i, A] : entries)
      if (i == row) return A;
    return entries.emplace_back(row, Matrix6::Zero()).second;
  }

  std::vector<std::vector<std::pair<std::int32_t, Matrix6>>> columns_;
};

/// Assembles what resists when blocks move rigidly.
class Assembly {
 public:
  Assembly(const Model& model, const Places& places, const std::vector<Vec3>& arm)
      : model_(model), places_(places), arm_(arm), sum_(places.blocks()) {}

  Eigen::SparseMatrix<double> matrix() {
    add_elements();
    for (std::size_t l = 0; l < model_.lattices.size(); ++l) {
      const de::BondMatrices bonds(model_.lattices[l]);
      const std::vector<const Ghost*> ghosts = ghost_at(model_.lattices[l]);
      add_bonds(model_.lattices[l], l, bonds, ghosts);
      add_swellings(model_.lattices[l], l, bonds, ghosts);
    }
    return sum_.lower();
  }

 private:
  /// Of a place, (u, θ) from its block's motion (translation, rotation); rows that are not free are zero.
  Matrix6 motion(std::size_t k) const {
    const Place& place = places_[k];
    const Vec3 x = arm_[k];
    Matrix6 S = Matrix6::Identity();
    S.topRightCorner<3, 3>() << 0, x.z, -x.y, -x.z, 0, x.x, x.y, -x.x, 0;
    for (int c = 0; c < 6; ++c)
      if (!(place.free >> c & 1)) S.row(c).setZero();
    return S;
  }

  /// θ_g = ½ ∇N_I × u_I as a matrix.
  static Eigen::Matrix3d half_cross(Vec3 g) {
    return 0.5 * (Eigen::Matrix3d() << 0, -g.z, g.y, g.z, 0, -g.x, -g.y, g.x, 0).finished();
  }

  bool moves_rigidly(std::size_t k, int all) const { return places_[k].free == all; }

  void add_elements() {
    const auto& elements = model_.mesh.elements;
    const auto is_deformed = [&](std::size_t e) {
      const std::int32_t first = places_.block_of(places_.of_node(elements[e][0]));
      return std::any_of(elements[e].begin(), elements[e].end(), [&](std::int32_t i) {
        const std::int32_t k = places_.of_node(i);
        return places_.block_of(k) != first || !moves_rigidly(k, 0b111);
      });
    };
    fe::visit_stiffness(model_.mesh, is_deformed, [this, &elements](std::size_t e, const fe::Matrix24& K) {
      add_element(elements[e], K, element_axes(model_.mesh, e));
    });
  }

  void add_element(const std::array<std::int32_t, 8>& nodes, const fe::Matrix24& K,
                   const Eigen::Matrix3d& R) {
    std::array<std::int32_t, 8> block;
    std::array<Matrix36, 8> S;
    for (int a = 0; a < 8; ++a) {
      const std::int32_t k = places_.of_node(nodes[a]);
      block[a] = places_.block_of(k), S[a] = R.transpose().lazyProduct(motion(k).topRows<3>());
    }
    for (int b = 0; b < 8; ++b) {
      if (std::find(block.begin(), block.begin() + b, block[b]) != block.begin() + b) continue;
      Eigen::Matrix<double, 24, 6> force = Eigen::Matrix<double, 24, 6>::Zero();  // of that block's motion
      for (int a = b; a < 8; ++a)
        if (block[a] == block[b]) force.noalias() += K.middleCols<3>(3 * a).lazyProduct(S[a]);
      for (int a = 0; a < 8; ++a)
        if (block[a] >= block[b])
          sum_.add(block[a], block[b], S[a].transpose().lazyProduct(force.middleRows<3>(3 * a)));
    }
  }

  /// The strain of a bond by the motions of blocks.
  struct Strain {
    std::vector<std::pair<std::int32_t, Matrix6>> by_block;
    void add(std::int32_t block, const Matrix6& B) {
      for (auto& [b, sum] : by_block)
        if (b == block) {
          sum += B;
          return;
        }
      by_block.emplace_back(block, B);
    }
  };

  /// The ghost at a site, or none.
  static std::vector<const Ghost*> ghost_at(const Lattice& lattice) {
    std::vector<const Ghost*> ghosts(lattice.grid.size(), nullptr);
    for (const Ghost& ghost : lattice.ghosts) ghosts[ghost.site] = &ghost;
    return ghosts;
  }

  void add_bonds(const Lattice& lattice, std::size_t l, const de::BondMatrices& bonds,
                 const std::vector<const Ghost*>& ghosts) {
    Strain strain;
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      for (int d = 9; d < 18; ++d) {
        if (!(lattice.word[s] >> d & 1)) continue;
        const std::size_t t = s + lattice.grid.offset(d);
        const std::int32_t i = places_.of_site(l, s), j = places_.of_site(l, t);
        if (places_.block_of(i) == places_.block_of(j) && moves_rigidly(i, 0b111111) &&
            moves_rigidly(j, 0b111111))
          continue;
        strain.by_block.clear();
        const Matrix6 axes = in_both(bond_axes(lattice, s, t).transpose());
        add_end(lattice, i, ghosts[s], bonds.strain(d).B_i.lazyProduct(axes), strain);
        add_end(lattice, j, ghosts[t], bonds.strain(d).B_j.lazyProduct(axes), strain);
        add_energy(strain, bonds.stiffness(s, d));
      }
  }

  /// For displacement and rotation.
  static Matrix6 in_both(const Eigen::Matrix3d& R) {
    Matrix6 A = Matrix6::Zero();
    A.topLeftCorner<3, 3>() = R, A.bottomRightCorner<3, 3>() = R;
    return A;
  }

  /// Cells and skins: q is the first component of a strain.
  void add_swellings(const Lattice& lattice, std::size_t l, const de::BondMatrices& bonds,
                     const std::vector<const Ghost*>& ghosts) {
    Strain strain;
    const auto add = [&](const de::Swelling& w) {
      if (moves_as_one(l, w)) return;
      strain.by_block.clear();
      for (int a = 0; a < w.corners; ++a) {
        Matrix6 B = Matrix6::Zero();
        for (int c = 0; c < 3; ++c) B(0, c) = w.s[a][c];
        add_end(lattice, places_.of_site(l, w.site[a]), ghosts[w.site[a]], B, strain);
      }
      add_energy(strain, Eigen::Matrix<double, 6, 1>(w.k, 0, 0, 0, 0, 0).asDiagonal());
    };
    for (std::size_t s = 0; s < lattice.dilating.size(); ++s)
      de::visit_swellings(lattice, bonds.dilatation(), s, add);
  }

  bool moves_as_one(std::size_t l, const de::Swelling& w) const {
    const std::int32_t first = places_.block_of(places_.of_site(l, w.site[0]));
    return std::all_of(w.site.begin(), w.site.begin() + w.corners, [&](std::size_t site) {
      const std::int32_t k = places_.of_site(l, site);
      return places_.block_of(k) == first && moves_rigidly(k, 0b111111);
    });
  }

  /// What a bond's end at place k adds to its strain.
  void add_end(const Lattice& lattice, std::size_t k, const Ghost* ghost, const Matrix6& B,
               Strain& strain) const {
    strain.add(places_.block_of(k), B.lazyProduct(motion(k)));
    if (!ghost) return;
    const bool turn = lattice.ghost_rotation == GhostRotation::continuum;
    const Eigen::Matrix3d R = bond_axes(lattice, ghost->site, ghost->site);
    for (const GhostNode& I : ghost->nodes) {
      const std::int32_t node = places_.of_node(I.node);
      Eigen::Matrix<double, 6, 3> B_I = I.N * B.leftCols<3>();
      if (turn) B_I += B.rightCols<3>().lazyProduct(R * half_cross(I.gradient) * R.transpose());
      strain.add(places_.block_of(node), B_I.lazyProduct(motion(node).topRows<3>()));
    }
  }

  void add_energy(const Strain& strain, const Matrix6& K) {
    for (const auto& [b, B_b] : strain.by_block) {
      const Matrix6 force = K.lazyProduct(B_b);
      for (const auto& [a, B_a] : strain.by_block)
        if (a >= b) sum_.add(a, b, B_a.transpose().lazyProduct(force));
    }
  }

  const Model& model_;
  const Places& places_;
  const std::vector<Vec3>& arm_;
  BlockMatrix sum_;
};

/// From the centre of each place's block to the place.
std::vector<Vec3> arms(const Model& model, const Places& places) {
  std::vector<Vec3> arm(places.size());
  for (std::size_t b = 0; b < places.blocks(); ++b) {
    Vec3 centre;
    for (std::size_t k = places.begin(b); k < places.begin(b + 1); ++k)
      centre += arm[k] = position(model, places[k]);
    centre *= 1 / static_cast<double>(places.begin(b + 1) - places.begin(b));
    for (std::size_t k = places.begin(b); k < places.begin(b + 1); ++k) arm[k] -= centre;
  }
  return arm;
}

/// Blocks of a few places do not resist every rotation: a little stiffness where there is none.
void stiffen(Eigen::SparseMatrix<double>& A) {
  constexpr double little = 1e-12;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    double& diagonal = A.coeffRef(i, i);
    diagonal = diagonal > 0 ? diagonal * (1 + little) : 1;
  }
}

}  // namespace

RigidBlocks::RigidBlocks(const Model& model, const Places& places)
    : places_(places), arm_(arms(model, places)) {
  Eigen::SparseMatrix<double> A = Assembly(model, places, arm_).matrix();
  stiffen(A);
  cholesky_.compute(A);
}

void RigidBlocks::add_solution(const PlaceVector& r, PlaceVector& z) const {
  if (cholesky_.info() != Eigen::Success) return;  // the point blocks alone do it too, if slowly
  Eigen::VectorXd b(static_cast<Eigen::Index>(6 * places_.blocks()));
  restrict_to_blocks(r, b);
  add_motion(cholesky_.solve(b), z);
}

void RigidBlocks::restrict_to_blocks(const PlaceVector& r, Eigen::VectorXd& b) const {
  for_each(
      places_.blocks(),
      [this, from = r.data(), to = b.data()](std::size_t block) {
        Vec3 force, moment;
        for (std::size_t k = places_.begin(block); k < places_.begin(block + 1); ++k) {
          double f[6];
          for (int c = 0; c < 6; ++c) f[c] = places_[k].free >> c & 1 ? from[6 * k + c] : 0;
          const Vec3 F{f[0], f[1], f[2]};
          force += F;
          moment += cross(arm_[k], F) + Vec3{f[3], f[4], f[5]};
        }
        for (int c = 0; c < 3; ++c) to[6 * block + c] = force[c], to[6 * block + 3 + c] = moment[c];
      },
      32);
}

void RigidBlocks::add_motion(const Eigen::VectorXd& motion, PlaceVector& z) const {
  for_each(
      places_.blocks(),
      [this, from = motion.data(), to = z.data()](std::size_t block) {
        const double* m = from + 6 * block;
        const Vec3 translation{m[0], m[1], m[2]}, rotation{m[3], m[4], m[5]};
        for (std::size_t k = places_.begin(block); k < places_.begin(block + 1); ++k) {
          const Vec3 u = translation + cross(rotation, arm_[k]);
          for (int c = 0; c < 3; ++c) {
            if (places_[k].free >> c & 1) to[6 * k + c] += u[c];
            if (places_[k].free >> (3 + c) & 1) to[6 * k + 3 + c] += rotation[c];
          }
        }
      },
      32);
}

}  // namespace geist
