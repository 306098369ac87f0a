#include "case/contact_laws.hpp"

#include <algorithm>

namespace geist {
namespace {

using contact::Law;

/// The entry that holds for regions a and b; null if there is none.
const ContactSpec* entry_for(const Case& input, const std::string& a, const std::string& b) {
  const ContactSpec* found = nullptr;
  for (const ContactSpec& spec : input.contact) {
    const auto& named = spec.between.regions;
    if (named && std::minmax((*named)[0], (*named)[1]) == std::minmax(a, b)) return &spec;
    if (!named) found = &spec;
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
  const auto hexahedral = static_cast<std::int32_t>(model.mesh.regions.size());
  const auto regions = hexahedral + static_cast<std::int32_t>(model.lattices.size());
  contact::LawTable laws(static_cast<std::size_t>(regions));
  for (std::int32_t a = 0; a < regions; ++a)
    for (std::int32_t b = a; b < regions; ++b) {
      const ContactSpec* spec = entry_for(input, region_name(model, a), region_name(model, b));
      if (!spec) continue;
      const bool hertz = spec->law == "hertz" && b >= hexahedral;  // hexahedra deform by themselves
      laws.set(a, b,
               {hertz ? Law::Normal::hertz : Law::Normal::penalty, spec->stiffness_factor, spec->restitution,
                spec->friction});
    }
  return laws;
}

}  // namespace geist
