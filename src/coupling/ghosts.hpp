// Ghost particles: where they are, how they follow their hexahedra, and how they react on the nodes.
//
// A ghost is an empty lattice site within a bond's reach of a particle that lies inside a hexahedron; on a
// flat interface these are the mirror images (6) of the boundary particles, one more layer of the same
// packing. It keeps the natural coordinates ξ that it has in its hexahedron (7)–(12).
//
//   u_g = Σ N_I(ξ) u_I   (21, integrated)        f_I += N_I(ξ) f_g   (14)
//
// Its rotation is half the curl of the hexahedron's displacement, and its moment goes back by the transpose:
//
//   θ_g = ½ Σ ∇N_I × u_I        f_I += ½ m_g × ∇N_I
//
// which adds no force, Σ ∇N_I = 0, and exactly the moment m_g, ½ Σ x_I × (m_g × ∇N_I) = ½ (3 m_g − m_g), as
// Σ x_I ⊗ ∇N_I = 1. With finite rotations R_g is that of the hexahedron's deformation gradient F = R U at the
// ghost, and the moment goes back by the derivative of R_g.  Or it spins by itself ("one-step back",
// (15)(24)): a degree of freedom of the lattice, which is advanced there.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/locator.hpp"
#include "model/model.hpp"

namespace geist::coupling {

/// How far from particles there are ghosts: where a bond can reach (published), or at all corners of the
/// cells that a particle is part of (consistent).
enum class Reach { bonds, cells };

/// Make every empty site within reach of a particle that lies inside a hexahedron a ghost of `lattice`, but
/// for those in regions that are loose (by region of the mesh; none if the list is empty). The grid must have
/// a layer of empty sites around the particles.
void place_ghosts(Lattice& lattice, const Mesh& mesh, const Locator& locator,
                  const std::vector<bool>& loose = {}, Reach reach = Reach::bonds);

/// Displacement, and rotation if they turn with the continuum, of all ghosts from the nodes.
void follow(Lattice& lattice, const Mesh& mesh);

/// By node I, the mass that the ghosts would bring to it, at most, if they had mass and inertia of a
/// particle.
std::vector<double> virtual_masses(const Lattice& lattice, const Mesh& mesh);

/// The transpose of follow: which ghost forces act on which nodes, in fixed order.
class Reactions {
 public:
  Reactions() = default;
  explicit Reactions(const Model& model);

  /// mesh.f += Σ N_I f_g (14), and ½ m_g × ∇N_I if they turn with the continuum, over all ghosts.
  void add(Model& model) const;

 private:
  struct Entry {
    std::int32_t lattice, ghost;
    double N;
    Vec3 half_gradient;  ///< ½ ∇N_I, or zero
  };
  std::vector<std::int32_t> nodes_, begin_;
  std::vector<Entry> entries_;
};

}  // namespace geist::coupling
