// The list of fields: what is known at nodes, hexahedra, particles and ghosts. Each is declared once, here;
// whoever writes fields walks the list.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/units.hpp"
#include "solver/simulation.hpp"

namespace geist::output {

/// What a field has values for. Particles and ghosts come lattice after lattice, in order of their sites.
enum class Place { nodes, hexahedra, particles, ghosts };

/// How a field is stored for viewing: the state in full, what is derived from it to seven digits.
enum class Storage { full, single, integer };

/// How a field's values are made: most need only the model, those of contacts the whole simulation.
class FieldValues {
 public:
  using Values = std::vector<double>;
  constexpr FieldValues(Values (*of_model)(const Model&)) : of_model_(of_model) {}
  constexpr FieldValues(Values (*of_simulation)(const Simulation&)) : of_simulation_(of_simulation) {}
  Values operator()(const Simulation& sim) const {
    return of_model_ ? of_model_(sim.model) : of_simulation_(sim);
  }

 private:
  Values (*of_model_)(const Model&) = nullptr;
  Values (*of_simulation_)(const Simulation&) = nullptr;
};

struct FieldInfo {
  std::string_view name;
  Place place;
  int components;
  Dimension dimension;
  Storage storage;
  bool shown;          ///< written for viewing
  bool kept;           ///< part of the state: needed in a checkpoint
  FieldValues values;  ///< place after place; on observed steps only
};

/// All fields, in the order in which they are written.
std::span<const FieldInfo> fields();

/// Names of a field's components: of a symmetric tensor in VTK's order; none for others.
std::vector<std::string> component_names(const FieldInfo& field);

/// Von Mises' equivalent of a stress XX YY ZZ XY YZ XZ.
double von_mises(const std::array<double, 6>& stress);

}  // namespace geist::output
