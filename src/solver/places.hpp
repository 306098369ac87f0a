// Places: whatever has degrees of freedom, in one list, for the statics: nodes, particles, ghosts (their
// spins).
#pragma once
#include <cstdint>
#include <vector>

#include "model/model.hpp"

namespace geist {

/// A node (lattice < 0), or a particle or ghost.
struct Place {
  Vec3 X;
  std::size_t index;           ///< node, or site
  std::int32_t lattice, slot;  ///< slot of the site in its lattice's list, < 0 if it is not listed
  std::uint8_t free;  ///< bit c is set if component c (0–2 displacement, 3–5 rotation) is unknown
  std::uint8_t held;  ///< … if a support prescribes it
};

/// Six numbers a place: of displacement and rotation, or of force and moment.
using PlaceVector = std::vector<double>;

/// All places of a model, block after block; the places of a block lie close together in one region.
class Places {
 public:
  /// Blocks of at most `block_size` places.
  Places(const Model& model, std::size_t block_size);

  std::size_t size() const { return all_.size(); }
  const Place& operator[](std::size_t k) const { return all_[k]; }
  std::size_t blocks() const { return begin_.size() - 1; }
  std::size_t begin(std::size_t block) const { return begin_[block]; }  ///< its first place
  std::int32_t block_of(std::size_t k) const { return block_of_[k]; }

  std::int32_t of_node(std::size_t i) const { return of_node_[i]; }
  std::int32_t of_site(std::size_t lattice, std::size_t s) const { return of_site_[lattice][s]; }

  /// Free and prescribed components of x become the model's displacement, and rotation where rotations are
  /// small; ghosts follow their nodes.
  void put(const PlaceVector& x, Model& model) const;

  /// Forces of elements and bonds as the kernels leave them (mesh.f, the listed forces, and of free particles
  /// what a kick of unit mass made of their velocity).
  void take(const Model& model, PlaceVector& f) const;

 private:
  void add_nodes(const Model& model);
  void add_sites(const Model& model, std::size_t l);
  void divide(std::size_t first, std::size_t last, std::size_t block_size);
  void number(const Model& model);

  std::vector<Place> all_;
  std::vector<std::size_t> begin_{0};
  std::vector<std::int32_t> block_of_, of_node_;
  std::vector<std::vector<std::int32_t>> of_site_;
};

}  // namespace geist
