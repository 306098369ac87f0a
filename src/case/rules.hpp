// Rules that need several values of a case together.
#pragma once
#include "case/document.hpp"
#include "case/view.hpp"

namespace geist {

/// Report every broken rule in document.problems. Values that are wrong by themselves are passed over.
void check_rules(Document& document);

/// Rules of [[contact]] and of what needs it (rules_contact.cpp).
void check_contact(Document& document, const View& root);

/// Rules of one region's geometry (rules_geometry.cpp).
void check_lattice(Document& document, const View& region);
void check_hexahedra(Document& document, const View& region);

}  // namespace geist
