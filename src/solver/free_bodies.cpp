#include "solver/free_bodies.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <vector>
#include "core/disjoint_sets.hpp"

namespace geist {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Numbers nodes first, then the sites of every lattice, and joins them.
class Pieces {
 public:
  explicit Pieces(const Model& model) {
    std::size_t n = model.mesh.nodes();
    for (const Lattice& lattice : model.lattices) first_.push_back(n), n += lattice.grid.size();
    sets_ = DisjointSets(n);
    for (const auto& element : model.mesh.elements)
      for (const std::int32_t node : element) sets_.join(element[0], node);
    for (std::size_t l = 0; l < model.lattices.size(); ++l) join_lattice(model, l);
  }

  std::size_t first(std::size_t lattice) const { return first_[lattice]; }
  std::size_t of(std::size_t i) { return sets_.of(i); }

 private:
  void join_lattice(const Model& model, std::size_t l) {
    const Lattice& lattice = model.lattices[l];
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      for (int d = 9; d < 18; ++d)
        if (lattice.word[s] >> d & 1) sets_.join(first_[l] + s, first_[l] + s + lattice.grid.offset(d));
    for (const Ghost& ghost : lattice.ghosts)
      sets_.join(first_[l] + ghost.site, model.mesh.elements[ghost.element][0]);
  }

  std::vector<std::size_t> first_;
  DisjointSets sets_;
};

/// One piece: where it begins, and Σ s sᵀ over held components, s the component's share of each rigid motion.
struct Piece {
  std::string region;
  Vec3 X;
  Matrix6 holds = Matrix6::Zero();

  void hold(Vec3 at, int component, double size) {
    Vec3 unit;
    unit[component % 3] = 1;
    const Vec3 x = (1 / size) * (at - X), turn = component < 3 ? cross(x, unit) : unit;
    const Vec3 shift = component < 3 ? unit : Vec3{};
    Eigen::Matrix<double, 6, 1> s;
    s << shift.x, shift.y, shift.z, turn.x, turn.y, turn.z;
    holds += s * s.transpose();
  }
  int held_motions() const {
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(holds, Eigen::EigenvaluesOnly);
    const auto& values = solver.eigenvalues();
    return values(5) > 0 ? static_cast<int>((values.array() > 1e-10 * values(5)).count()) : 0;
  }
};

std::string region_of_node(const Mesh& mesh, std::int32_t node) {
  for (const HexRegion& region : mesh.regions)
    for (std::size_t e = region.first; e < region.first + region.count; ++e)
      for (const std::int32_t i : mesh.elements[e])
        if (i == node) return region.name;
  return {};
}

/// All pieces by their first member, with what holds them.
class Holds {
 public:
  explicit Holds(const Model& model) : model_(model), pieces_(model) {
    for (const Lattice& lattice : model.lattices) length_ = lattice.grid.pitch;
    if (!model.mesh.elements.empty()) {
      const auto& corners = model.mesh.elements[0];
      length_ = norm(model.mesh.points[corners[1]] - model.mesh.points[corners[0]]);
    }
    add_nodes();
    for (std::size_t l = 0; l < model.lattices.size(); ++l) add_sites(l);
  }
  const std::map<std::size_t, Piece>& found() const { return found_; }

 private:
  void add_nodes() {
    const Mesh& mesh = model_.mesh;
    for (std::size_t i = 0; i < mesh.nodes(); ++i) {
      const auto [it, is_new] = found_.try_emplace(pieces_.of(i));
      Piece& piece = it->second;
      if (is_new) piece.region = region_of_node(mesh, static_cast<std::int32_t>(i)), piece.X = mesh.points[i];
      for (int c = 0; c < 3; ++c)
        if (mesh.held[i] >> c & 1) piece.hold(mesh.points[i], c, length_);
    }
  }

  /// A ghost that may not spin holds as well; where it is, its nodes say.
  void add_sites(std::size_t l) {
    const Lattice& lattice = model_.lattices[l];
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (!(lattice.word[s] & (site::particle | site::ghost))) continue;
      const Vec3 X = lattice.grid.centre(s);
      const auto [it, is_new] = found_.try_emplace(pieces_.of(pieces_.first(l) + s));
      if (is_new) it->second.region = lattice.name, it->second.X = X;
      if (lattice.is(s, site::free)) continue;
      const int held = lattice.listed_held[listed_slot(lattice, s)];
      for (int c = lattice.is(s, site::ghost) ? 3 : 0; c < 6; ++c)
        if (held >> c & 1) it->second.hold(X, c, length_);
    }
  }

  const Model& model_;
  Pieces pieces_;
  std::map<std::size_t, Piece> found_;
  double length_ = 1;
};

}  // namespace

std::string find_free_body(const Model& model) {
  const Holds holds(model);
  for (const auto& [first, piece] : holds.found())
    if (const int held = piece.held_motions(); held < 6)
      return fmt::format(
          "region '{}' is free to move: the supports hold {} of the 6 rigid motions of the piece at "
          "({:.6g}, {:.6g}, {:.6g}), so that it has no state of rest",
          piece.region, held, piece.X.x, piece.X.y, piece.X.z);
  return {};
}

}  // namespace geist
