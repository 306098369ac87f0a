// The list of element formulations: to add one, write it in a file of its own and add its word to
// `Formulations`. The names in case files, the text of the error and the conformance tests follow.
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

#include "fe/assumed_strain.hpp"
#include "fe/full.hpp"
#include "fe/one_point.hpp"
#include "fe/selective_reduced.hpp"

namespace geist::fe {

template <class... F>
struct FormulationList {};

using Formulations = FormulationList<Full, SelectiveReduced, AssumedStrain, OnePoint, OnePointViscous>;

namespace detail {

template <class... F>
std::string names(FormulationList<F...>) {
  std::string text;
  ((text += (text.empty() ? "" : ", ") + std::string(F::name)), ...);
  return text;
}

template <class... F, class Visit>
bool visit(FormulationList<F...>, std::string_view name, const Parameters& p, Visit& visit_one) {
  return ((name == F::name && (visit_one(F(p)), true)) || ...);
}

}  // namespace detail

/// Names of all formulations, "full, selective-reduced, …".
inline std::string formulation_names() { return detail::names(Formulations{}); }

/// Call visit(formulation) with the one of that name, made of p; std::invalid_argument if there is none.
template <class Visit>
void visit_formulation(std::string_view name, const Parameters& p, Visit visit) {
  if (!detail::visit(Formulations{}, name, p, visit))
    throw std::invalid_argument("unknown formulation '" + std::string(name) +
                                "'; known: " + formulation_names());
}

}  // namespace geist::fe
