#include "model/model.hpp"

#include <algorithm>

namespace geist {

const std::string& region_name(const Model& model, std::int32_t region) {
  const auto hexahedral = static_cast<std::int32_t>(model.mesh.regions.size());
  return region < hexahedral ? model.mesh.regions[region].name : model.lattices[region - hexahedral].name;
}

const Material& region_material(const Model& model, std::int32_t region) {
  const auto hexahedral = static_cast<std::int32_t>(model.mesh.regions.size());
  return region < hexahedral ? model.mesh.regions[region].material
                             : model.lattices[region - hexahedral].material;
}

bool turns_finitely(const Model& model) {
  return model.mesh.kinematics == Kinematics::finite ||
         std::any_of(model.lattices.begin(), model.lattices.end(),
                     [](const Lattice& l) { return l.kinematics == Kinematics::finite; });
}

}  // namespace geist
