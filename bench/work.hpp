// What a kernel has to do for one particle or element and step: flops, bytes.
//
// Flops are additions, subtractions, multiplications and divisions, a multiply-add being two. Bytes are what
// must pass between the processor and a memory that no cache stands before, if a pass touches every value
// once: the neighbours of a stencil and the nodes shared by elements come for nothing. A line that is written
// without having been read is counted twice, as it is read first.
#pragma once
#include <string>

namespace geist::bench {

struct Work {
  double flops = 0, bytes = 0;
  friend Work operator+(Work a, Work b) { return {a.flops + b.flops, a.bytes + b.bytes}; }
};

/// By particle, of lattices that are consistent or published, with finite rotations or small ones.
struct LatticeKind {
  bool consistent = false, finite = false;
};
Work bonds_and_kick(LatticeKind kind);
Work lattice_drift(LatticeKind kind);
Work drift_bonds_and_kick(LatticeKind kind);  ///< in one pass

/// By element; a large block has as many nodes as elements.
Work internal_forces(const std::string& formulation, bool finite);
Work node_kick();
Work node_drift();

}  // namespace geist::bench
