// Model: everything that exists, and when.
#pragma once
#include <cstdint>
#include <string>
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

/// Regions numbered hexahedra first, then lattices, as everywhere.
const std::string& region_name(const Model& model, std::int32_t region);
const Material& region_material(const Model& model, std::int32_t region);

/// Whether anything in it has finite rotations.
bool turns_finitely(const Model& model);

}  // namespace geist
