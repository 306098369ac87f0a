// Which regions of a case act on each other where they touch, and how.
#pragma once
#include "case/case.hpp"
#include "contact/law.hpp"
#include "coupling/interfaces.hpp"
#include "model/model.hpp"

namespace geist {

/// Pairs of different regions that [[contact]] names.
coupling::LoosePairs named_pairs(const Case& input);

/// The laws of all pairs; a named pair outdoes "all". Regions are numbered hexahedra first, then lattices.
contact::LawTable make_contact_laws(const Model& model, const Case& input);

}  // namespace geist
