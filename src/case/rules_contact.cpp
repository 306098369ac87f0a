// Rules of contact that need several tables together.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "case/rules.hpp"

namespace geist {

namespace {

using Between = ContactSpec::Between;

/// The two names in one order; both empty for "all".
std::pair<std::string, std::string> unordered(const Between& between) {
  if (!between.regions) return {};
  const auto& [a, b] = *between.regions;
  return std::minmax(a, b);
}

std::string words(const Between& between) {
  if (!between.regions) return "\"all\"";
  const auto& [a, b] = *between.regions;
  return a == b ? fmt::format("'{}' with itself", a) : fmt::format("'{}' and '{}'", a, b);
}

std::string where(const Document& document, const toml::source_region& place) {
  return from_set(document, place) ? *place.path : fmt::format("line {}", place.begin.line);
}

void check_declared_once(Document& document, const std::vector<View>& list) {
  std::map<std::pair<std::string, std::string>, toml::source_region> declared;
  for (const View& view : list) {
    const auto between = view.get<Between>("between");
    if (!between) continue;
    const auto [it, fresh] = declared.try_emplace(unordered(*between), view.place("between"));
    if (!fresh)
      document.report(view.place("between"), fmt::format("contact between {} is declared already, in {}",
                                                         words(*between), where(document, it->second)));
  }
}

/// Hertz' law is that of a sphere: two regions of hexahedra have none.
void check_law(Document& document, const View& root, const View& contact) {
  const auto between = contact.get<Between>("between");
  if (!between || !between->regions || contact.get<std::string>("law") != "hertz") return;
  const auto is_hexahedra = [&](const std::string& name) {
    const std::vector<View> regions = root.named("regions");
    return std::any_of(regions.begin(), regions.end(), [&](const View& region) {
      return region.name() == name && region.get<std::string>("type") == "hexahedra";
    });
  };
  const auto& [a, b] = *between->regions;
  if (is_hexahedra(a) && is_hexahedra(b))
    document.report(contact.place("law"),
                    fmt::format("'law' = \"hertz\" is for pairs with particles, and {} are hexahedra, which "
                                "deform by themselves; use \"penalty\"",
                                a == b ? fmt::format("those of '{}'", a) : words(*between)));
}

}  // namespace

void check_contact(Document& document, const View& root) {
  const std::vector<View> list = root.tables("contact");
  check_declared_once(document, list);
  for (const View& contact : list) check_law(document, root, contact);
  const bool none = list.empty() && (!root.has("contact") || root.acceptable("contact"));
  for (const View& probe : root.named("probes"))
    if (none && probe.get<std::string>("quantity") == "contact-force")
      document.report(probe.place("quantity"), "a \"contact-force\" needs at least one of [[contact]]");
}

}  // namespace geist
