// Fields for viewing: one VTU file for each part of the model and step, and one PVD file that shows all parts
// over time.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "output/units.hpp"
#include "solver/simulation.hpp"

namespace geist::output {

/// Writes DIRECTORY/fields/hexahedra_000120.vtu (and particles_…, ghosts_…, as far as the model has them) and
/// DIRECTORY/fields.pvd, the file to open. Points are the reference positions; warp by `displacement` to see
/// the motion.
class FieldWriter {
 public:
  FieldWriter(std::filesystem::path directory, UnitSystem units, bool compress = true);

  /// Write the simulation as it is now (an observed step). A step that was the last one written is replaced.
  /// Throws std::runtime_error naming the file and the reason; files written before stay valid.
  void write(const Simulation& sim);

 private:
  struct Entry {
    long step;
    double time;
    int part;
    std::string name, file;
  };
  void write_collection() const;

  std::filesystem::path directory_;
  UnitSystem units_;
  bool compress_;
  std::vector<Entry> entries_;
};

}  // namespace geist::output
