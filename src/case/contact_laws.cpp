#include "case/contact_laws.hpp"

#include <algorithm>

namespace geist {
namespace {

using contact::Law;

std::vector<std::string> region_names(const Model& model) {
  std::vector<std::string> names;
  for (const HexRegion& region : model.mesh.regions) names.push_back(region.name);
  for (const Lattice& lattice : model.lattices) names.push_back(lattice.name);
  return names;
}

/// The entry that holds for regions a and b; null if there is none.
const ContactSpec* entry_for(const Case& input, const std::string& a, const std::string& b) {
  const ContactSpec* found = nullptr;
  for (const ContactSpec& spec : input.contact) {
    const auto& named = spec.between.regions;
    if (named && std::minmax((*named)[0], (*named)[1]) == std::minmax(a, b)) return &spec;
    if (!named && a != b) found = &spec;
  }
  return found;
}

}  // namespace

coupling::LoosePairs named_pairs(const Case& input) {
  coupling::LoosePairs pairs;
  for (const ContactSpec& spec : input.contact)
    if (const auto& named = spec.between.regions; named && (*named)[0] != (*named)[1])
      pairs.add((*named)[0], (*named)[1]);
  return pairs;
}

contact::LawTable make_contact_laws(const Model& model, const Case& input) {
  if (input.contact.empty()) return {};
  const std::vector<std::string> names = region_names(model);
  const std::size_t hexahedral = model.mesh.regions.size();
  contact::LawTable laws(names.size());
  for (std::size_t a = 0; a < names.size(); ++a)
    for (std::size_t b = a; b < names.size(); ++b) {
      const ContactSpec* spec = entry_for(input, names[a], names[b]);
      if (!spec) continue;
      const bool hertz = spec->law == "hertz" && b >= hexahedral;  // hexahedra deform by themselves
      laws.set(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b),
               {hertz ? Law::Normal::hertz : Law::Normal::penalty, spec->stiffness_factor, spec->restitution,
                spec->friction});
    }
  return laws;
}

}  // namespace geist
