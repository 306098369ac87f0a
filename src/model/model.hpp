// Model: everything that exists, and when.
#pragma once
#include <vector>

#include "model/lattice.hpp"
#include "model/mesh.hpp"

namespace geist {

struct Model {
  Mesh mesh;
  std::vector<Lattice> lattices;
  double time = 0;  ///< t^n, the time of displacements and forces
  long step = 0;    ///< n
};

}  // namespace geist
