// Rules that need several values of a case together.
#include "case/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace geist {

namespace {

constexpr double largest_lattice_poisson = 0.25;

/// Where ν > 1/4, k_s of (5) is negative: a published lattice of such springs is refused.
void check_lattice_materials(Document& document, const View& root) {
  if (root.get<std::string>("method") == "consistent") return;  // de::assemble knows the limits of its bonds
  std::map<std::string, std::vector<std::string>> lattices;     // of each material
  for (const View& region : root.named("regions"))
    if (region.get<std::string>("type") == "lattice")
      if (const auto material = region.get<std::string>("material"))
        lattices[*material].push_back(fmt::format("'{}'", region.name()));
  for (const View& material : root.named("materials")) {
    const auto poisson = material.get<double>("poisson");
    const auto users = lattices.find(material.name());
    if (!poisson || *poisson <= largest_lattice_poisson || users == lattices.end()) continue;
    document.report(
        material.place("poisson"),
        fmt::format("'poisson' = {} does not suit a lattice ({} {} made of it): allowed there is (-1, 0.25]; "
                    "above 1/4 the bonds' tangential stiffness k_s of equation (5) is negative",
                    *poisson, join(users->second, "and"), users->second.size() > 1 ? "are" : "is"));
  }
}

/// No component may be prescribed twice by one support.
void check_components(Document& document, const View& support) {
  std::vector<std::string> seen =
      support.get<std::vector<std::string>>("fix").value_or(std::vector<std::string>{});
  for (const char* key : {"displacement", "velocity"}) {
    const auto motion = support.table(key);
    if (!motion) continue;
    for (const std::string& component : motion->keys()) {
      if (std::find(seen.begin(), seen.end(), component) != seen.end())
        document.report(motion->place(component),
                        fmt::format("component '{}' is prescribed twice by this support", component));
      seen.push_back(component);
    }
  }
}

void check_supports(Document& document, const View& root) {
  for (const View& support : root.tables("supports")) {
    check_components(document, support);
    if (support.has("curve") && support.has("fix") && !support.has("displacement") &&
        !support.has("velocity"))
      document.report(support.place("curve"),
                      "'curve' has nothing to multiply: only 'displacement' and 'velocity' follow a curve");
  }
}

/// A state of rest needs something that holds the body and something that deforms it.
void check_rest(Document& document, const View& root, const View& analysis, std::string_view type) {
  const std::vector<View> supports = root.tables("supports"), loads = root.tables("loads");
  const auto none = [&](const char* key, const std::vector<View>& list) {
    return list.empty() && (!root.has(key) || root.acceptable(key));  // not where the list itself is wrong
  };
  if (none("supports", supports)) {
    document.report(analysis.place("type"),
                    fmt::format("a {} case needs at least one of [[supports]]", type));
    return;
  }
  const bool moving = std::any_of(supports.begin(), supports.end(), [](const View& support) {
    return support.has("displacement") || support.has("velocity");
  });
  if (!moving && none("loads", loads))
    document.report(
        analysis.place("type"),
        fmt::format("a {} case needs one of [[loads]], or a support with a displacement or velocity", type));
}

/// Equilibrium is solved for at once: nothing may depend on the way there.
void check_equilibrium(Document& document, const View& root, const View& analysis, const char* key) {
  if (!root.tables("contact").empty())
    document.report(analysis.place(key),
                    "equilibrium is solved for without [[contact]], which changes with the motion; "
                    "type = \"quasi-static\" takes it");
}

void check_static(Document& document, const View& root, const View& analysis) {
  check_equilibrium(document, root, analysis, "type");
  for (const View& support : root.tables("supports"))
    if (support.has("velocity"))
      document.report(support.place("velocity"),
                      "a static analysis knows no velocity; give a displacement and a curve");
  if (!root.tables("initial").empty())
    document.report(analysis.place("type"), "a static analysis knows no velocity: it has no [[initial]]");
}

/// What cannot turn yet.
void check_finite(Document& document, const View& root) {
  const auto coupling = root.table("coupling");
  if (coupling && coupling->get<std::string>("rotation") == "none")
    document.report(coupling->place("rotation"),
                    "ghosts that do not turn resist any rotation of the body: set kinematics = \"small\" "
                    "under [analysis] "
                    "(a dynamic analysis is finite by default), or let them turn");
}

void check_analysis(Document& document, const View& root) {
  const auto analysis = root.table("analysis");
  if (!analysis) return;
  const std::string type = analysis->get<std::string>("type").value_or("");
  if (type == "quasi-static" || type == "static") check_rest(document, root, *analysis, type);
  if (type == "static") check_static(document, root, *analysis);
  if (type == "dynamic" && analysis->get<std::string>("start") == "static")
    check_equilibrium(document, root, *analysis, "start");
  if (analysis->get<std::string>("kinematics") == "finite") check_finite(document, root);
}

}  // namespace

void check_rules(Document& document) {
  const View root(document);
  check_lattice_materials(document, root);
  for (const View& region : root.named("regions")) {
    const auto type = region.get<std::string>("type");
    if (type == "lattice") check_lattice(document, region);
    if (type == "hexahedra") check_hexahedra(document, region);
  }
  check_contact(document, root);
  check_supports(document, root);
  check_analysis(document, root);
}

}  // namespace geist
