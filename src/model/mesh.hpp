// Mesh: the nodes and hexahedra of all continuum regions. Arrays, no physics.
//
// Hexahedra are computed with in blocks of eight (the lanes of a Pack); every region begins a new block. A
// block that is not full repeats its last element in the lanes left over, and nobody reads what is computed
// there.
//
// Corners are numbered as in (8), Table 1 of the journal paper and VTK_HEXAHEDRON:
//
//        7-------6        ζ
//       /|      /|        |  η
//      4-------5 |        | /
//      | 3-----|-2        |/
//      |/      |/         +---- ξ
//      0-------1
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "core/pack.hpp"
#include "model/kinematics.hpp"
#include "model/material.hpp"

namespace geist {

/// Consecutive hexahedra side by side, those in the lanes of a Pack.
///
/// Eight neighbours along ξ in a structured body have consecutive nodes: corner a of lane l is node
/// elements[first][a] + l, and corners 1, 2, 6, 5 are the nodes after corners 0, 3, 7, 4. Where they go
/// around the end of a row, one number is left out: lanes `in_row` and up have the node after that one.
struct HexBlock {
  std::int32_t first;  ///< element
  std::int8_t count;   ///< 1 … 8
  std::int8_t in_row;  ///< 8: a whole row; 1 … 7: around its end; 0: any nodes, or fewer than eight elements
};

/// An order in which blocks may add to the nodes: in slabs, one after the other within a slab, slabs of one
/// colour at the same time since they share no node, and colour after colour. It depends on the mesh and the
/// set of blocks alone, so sums have the same bits for any number of threads.
struct Sweep {
  std::vector<std::int32_t> blocks;       ///< slab after slab
  std::vector<std::size_t> slab_begin;    ///< slab s is blocks[slab_begin[s]] …; one more at the end
  std::vector<std::size_t> colour_begin;  ///< colour c has slabs colour_begin[c] …; one more at the end
  std::size_t slabs() const { return slab_begin.empty() ? 0 : slab_begin.size() - 1; }
  std::size_t colours() const { return colour_begin.empty() ? 0 : colour_begin.size() - 1; }
};

/// A region of hexahedra: elements [first, first + count), blocks [first_block, first_block + blocks()).
struct HexRegion {
  std::string name;
  Material material;
  std::string formulation;           ///< name in the list of fe/formulations.hpp
  double hourglass_coefficient = 0;  ///< dimensionless, for formulations with hourglass control
  std::size_t first = 0, count = 0;  ///< elements
  std::size_t first_block = 0;
  std::size_t blocks() const { return (count + lanes - 1) / lanes; }
};

/// What the cells of a lattice leave of a hexahedron at an interface: docs/theory.md, "Every point counted
/// once".
struct HexCut {
  std::int32_t element;
  double volume;                 ///< ∫ dV over what is left
  std::array<Vec3, 8> gradient;  ///< ∫ ∂N_a/∂x dV over what is left
  std::array<double, 8> mass;    ///< of the corners: what the cells took rides on the ghosts in there
};

/// The same for a block; lanes that are whole have their whole volume and gradient.
struct BlockCut {
  Pack volume;
  Pack gradient[8][3];
};

struct Mesh {
  // What it is made of
  Kinematics kinematics = Kinematics::small;
  std::vector<Vec3> points;                           ///< reference positions X_I, by node
  std::vector<std::array<std::int32_t, 8>> elements;  ///< corner nodes, by element, region after region
  std::vector<HexRegion> regions;
  std::vector<HexBlock> blocks;
  Sweep sweep;  ///< of all blocks

  // Consistent method only: elements that are cut, in order, and by block; −1: no element of it is
  std::vector<HexCut> cuts;
  std::vector<BlockCut> block_cuts;
  std::vector<std::int32_t> cut_of_block;  ///< empty if there are no cuts

  // State (n = node): displacement u^n, velocity v^{n+1/2}, and what is computed from them
  Field<3> X;                      ///< reference positions again, by component, for kernels
  Field<3> u, v;                   ///< displacement, velocity (at the half step)
  Field<3> v_before;               ///< velocity half a step before u's time; valid on observed steps only
  Field<3> f;                      ///< total force: internal, coupling and applied
  std::vector<double> mass;        ///< lumped, by node
  std::vector<std::uint8_t> held;  ///< by node: bit c is set if a support prescribes component c

  std::size_t nodes() const { return points.size(); }
};

/// The cut of an element, if it is cut.
const HexCut* cut_of(const Mesh& mesh, std::size_t element);

/// visit(node) for every corner of a block's elements.
template <class F>
void visit_nodes(const Mesh& mesh, const HexBlock& block, F visit) {
  for (int l = 0; l < block.count; ++l)
    for (const std::int32_t node : mesh.elements[static_cast<std::size_t>(block.first + l)]) visit(node);
}

/// Number of the region that an element belongs to.
std::int32_t region_of(const Mesh& mesh, std::int32_t element);

/// By node, a number of the body that elements join it to.
std::vector<std::int32_t> bodies_of(const Mesh& mesh);

/// A sweep over blocks given by number in ascending order.
Sweep make_sweep(const Mesh& mesh, const std::vector<std::int32_t>& blocks);

/// Make the blocks, their sweep and the (zero) state of a mesh whose points, elements and regions are set.
void finish(Mesh& mesh);

}  // namespace geist
