// For the tests of the writers: a scratch directory, a small coupled model, and a reader of VTU files.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "scratch.hpp"
#include "solver/simulation.hpp"

namespace geist::testing {

/// What action() throws as std::runtime_error, or nothing.
template <class F>
std::string error_of(F action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

/// While it lives, files cannot grow beyond a size: the disk is full.
class FullDisk {
 public:
  explicit FullDisk(std::size_t bytes);
  ~FullDisk();

 private:
  std::uint64_t before_;
};

/// Two unit cubes in one region; beside them a lattice of 3 × 2 × 2 particles of pitch 1/2 with a layer of
/// four ghosts in the second cube. All motion is a different number at every place.
Model small_model();

/// The same in a simulation, nothing acting on it.
Simulation small_simulation();

struct ReadArray {
  std::string type, unit;
  int components = 0;
  std::vector<double> values;
};
struct ReadGrid {
  std::size_t points = 0, cells = 0;
  double time = 0;
  std::map<std::string, ReadArray> arrays;  ///< by section and name: "PointData/displacement"
};
/// Read a VTU file, following the format's description and nothing else.
ReadGrid read_vtu(const std::filesystem::path& path);

}  // namespace geist::testing
