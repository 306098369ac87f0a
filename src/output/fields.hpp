// Fields for viewing: one VTU file for each part of the model and step, and one PVD file that shows all parts
// over time.
#pragma once
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "output/units.hpp"
#include "output/vtu.hpp"
#include "solver/simulation.hpp"

namespace geist::output {

/// How exact the state (displacements and rotations) is written; what is derived from it has seven digits
/// anyway.
enum class Precision { full, single };

/// Writes DIRECTORY/fields/hexahedra_000120.vtu (and particles_…, ghosts_…, as far as the model has them) and
/// DIRECTORY/fields.pvd, the file to open. Points are the reference positions; warp by `displacement` to see
/// the motion.
///
/// A thread of its own compresses and writes a copy of the fields while the run goes on. There is one copy at
/// a time: who comes with the next one helps to finish the last. The files are the same whoever made them.
class FieldWriter {
 public:
  FieldWriter(std::filesystem::path directory, UnitSystem units, bool compress = true,
              Precision precision = Precision::full);
  ~FieldWriter();

  /// Write the simulation as it is now (an observed step). A step that was the last one written is replaced.
  /// Throws std::runtime_error naming the file and the reason if the fields of this or an earlier call could
  /// not be written; files written before stay valid.
  void write(const Simulation& sim);

  /// Wait until everything is written. Throws as write() does.
  void finish();

 private:
  struct Entry {
    long step;
    double time;
    int part;
    std::string name, file;
  };
  struct Snapshot;
  std::shared_ptr<Snapshot> snapshot(const Simulation& sim) const;
  void write(Snapshot& taken);
  void write_collection() const;

  std::filesystem::path directory_;
  UnitSystem units_;
  bool compress_;
  Precision precision_;
  // Of the thread, while there is one
  std::vector<Entry> entries_;
  std::vector<std::shared_ptr<const EncodedGeometry>> geometry_;  ///< by part, once it is known
  std::weak_ptr<Snapshot> under_way_;
  std::future<void> written_;
};

}  // namespace geist::output
