// Flush cubic packing: spheres of radius r, one in each cube of edge 2r, so that faces of the region are
// flat.
#pragma once
#include <vector>

#include "geometry/shapes.hpp"
#include "model/lattice.hpp"

namespace geist {

/// Is the length a whole number of pitches, to 1e-6 of the longer of the two?
bool is_whole(double length, double pitch);

/// Fill the union of `boxes` minus `minus` with particles: set the grid and the words of `lattice`. A cell
/// belongs to the region if its centre does. Around the particles the grid has one layer of empty sites, for
/// ghosts; trim() takes away what is not needed in the end. Throws std::invalid_argument if a box is no whole
/// number of diameters long or the boxes lie on different grids.
void pack(Lattice& lattice, const std::vector<Box>& boxes, const std::vector<Shape>& minus, double radius);

/// Shrink the grid to the sites that are not empty; ghosts keep theirs.
void trim(Lattice& lattice);

}  // namespace geist
