// Rules that need several values of a case together.
#pragma once
#include "case/document.hpp"
#include "case/view.hpp"

namespace geist {

/// Report every broken rule in document.problems. Values that are wrong by themselves are passed over.
void check_rules(Document& document);

/// Rules of [[contact]] and of what needs it (rules_contact.cpp).
void check_contact(Document& document, const View& root);

/// Rules of one region's geometry (rules_geometry.cpp, rules_hexahedra.cpp).
void check_lattice(Document& document, const View& region);
void check_hexahedra(Document& document, const View& region);

/// Whether a cylinder, if there is one, has ends.
void check_length(Document& document, const std::optional<View>& cylinder);

inline constexpr double most_places_in_region = 2e9;  ///< sites or elements

}  // namespace geist
