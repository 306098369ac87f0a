#include "model/model.hpp"

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

}  // namespace geist
