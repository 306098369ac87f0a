#include "solver/fine_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/subcycling.hpp"

namespace geist {
namespace {

constexpr int most_substeps = 8;
constexpr double least_gain = 1.05;

/// Times of one core in ns, in cache (docs/performance.md): a node's own part of a step, and of a short one;
/// an element's forces; a site of the grid; a ghost that follows and reacts.
constexpr double node_time = 3, short_node_time = 20;

double element_time(const HexRegion& region, Kinematics kinematics) {
  const bool one_point = region.formulation != "full" && region.formulation != "selective-reduced";
  return (one_point ? 30 : 50) + (kinematics == Kinematics::finite ? 18 : 0);
}

double block_time(const Mesh& mesh, std::size_t b) {
  const HexBlock& block = mesh.blocks[b];
  const double time = block.count * element_time(mesh.regions[region_of(mesh, block.first)], mesh.kinematics);
  return !mesh.cuts.empty() && mesh.cut_of_block[b] >= 0 ? 2 * time : time;
}

double site_time(const Lattice& lattice) { return lattice.kinematics == Kinematics::finite ? 30 : 10; }

double ghost_time(const Lattice& lattice) { return lattice.kinematics == Kinematics::finite ? 80 : 40; }

double time_of_sites(const Model& model) {
  double time = 0;
  for (const Lattice& lattice : model.lattices)
    time += site_time(lattice) * static_cast<double>(lattice.grid.size());
  return time;
}

double time_of_lattices(const Model& model) {
  double time = time_of_sites(model);
  for (const Lattice& lattice : model.lattices)
    time += ghost_time(lattice) * static_cast<double>(lattice.ghosts.size());
  return time;
}

double time_of_a_step(const Model& model) {
  double time = node_time * static_cast<double>(model.mesh.nodes());
  for (std::size_t b = 0; b < model.mesh.blocks.size(); ++b) time += block_time(model.mesh, b);
  return time + time_of_lattices(model);
}

/// Marks of nodes, and all nodes of elements that have one of them.
std::vector<std::uint8_t> with_neighbours(const Mesh& mesh, const std::vector<std::uint8_t>& marked) {
  std::vector<std::uint8_t> wider = marked;
  for (const auto& element : mesh.elements)
    if (std::any_of(element.begin(), element.end(), [&](std::int32_t i) { return marked[i] != 0; }))
      for (const std::int32_t i : element) wider[i] = 1;
  return wider;
}

void list_blocks(const Mesh& mesh, FinePart& fine) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    bool touches = false;
    visit_nodes(mesh, mesh.blocks[b], [&](std::int32_t i) { touches |= fine.is_fine[i] != 0; });
    (touches ? fine.blocks : fine.others).push_back(static_cast<std::int32_t>(b));
  }
}

double time_of_a_short_step(const Model& model, const FinePart& fine) {
  const Mesh& mesh = model.mesh;
  const std::vector<std::uint8_t> touched = with_neighbours(mesh, fine.is_fine);
  double time = short_node_time * static_cast<double>(std::count(touched.begin(), touched.end(), 1));
  for (const std::int32_t b : fine.blocks) time += block_time(mesh, static_cast<std::size_t>(b));
  return time + (fine.lattices ? time_of_lattices(model) : 0);
}

/// Particles set out, add up their increments and come back.
double time_of_coming_back(const Model& model, const FinePart& fine) {
  return fine.lattices ? 0.5 * time_of_sites(model) : 0;
}

class Search {
 public:
  Search(const Model& model, const TimeStepLimits& limits, double safety)
      : model_(model),
        mesh_(model.mesh),
        at_(limits.nodes),
        particles_may_touch_(limits.particles_may_touch),
        safety_(safety),
        whole_(time_of_a_step(model)),
        body_(bodies_of(model.mesh)),
        fastest_(std::sqrt(*std::max_element(at_.frequency_squared.begin(), at_.frequency_squared.end()))),
        one_(safety * critical(limits.bounds).bound) {
    for (std::size_t l = mesh_.regions.size(); l < limits.bounds.size(); ++l)
      lattices_ = std::min(lattices_, limits.bounds[l].bound);
    coupled_.resize(mesh_.nodes());
    for_ghost_nodes([this](std::int32_t i) { coupled_[body_[i]] = 1; });
  }

  FinePart part(double dt) const {
    FinePart fine;
    fine.lattices = too_long_for_lattices(dt);
    fine.m = substeps_for(dt, fine.lattices ? std::max(fastest_, 2 / lattices_) : fastest_);
    if (fine.m == 0 || (fine.lattices && particles_may_touch_)) return {};
    fine.is_fine = fine_nodes(dt, fine.lattices);
    const double remainder = stable_remainder(fine.m);
    for (std::size_t i = 0; i < mesh_.nodes(); ++i)
      if (fine.is_fine[i] && !can_be_fine(i, dt, fine.lattices, remainder)) return {};
    list_blocks(mesh_, fine);
    return fine;
  }

  /// The longer the step, the more is fine: what cannot be cannot be with a longer one, but for ghosts once
  /// their lattices are fine; and no gain is left once the short steps take nearly all of the time.
  Division best() const {
    Division best{0, {}, least_gain};
    bool hopeless[2] = {};  // without and with lattices
    for (const double dt : candidates()) {
      if (hopeless[too_long_for_lattices(dt)]) continue;
      Division next{rounded_down(dt), part(rounded_down(dt))};
      if (next.fine.empty()) {
        hopeless[too_long_for_lattices(dt)] = true;
        continue;
      }
      const double more = time_of_a_short_step(model_, next.fine);
      if (more * best.gain > whole_) break;
      const double time = whole_ + (next.fine.m - 1) * more + time_of_coming_back(model_, next.fine);
      next.gain = whole_ / one_ / (time / next.dt);
      if (next.gain > best.gain) best = std::move(next);
    }
    return best.fine.empty() ? Division{} : best;
  }

 private:
  /// The longest for every number of short steps, some in between, and what the lattices allow.
  std::vector<double> candidates() const {
    const double fastest = std::max(fastest_, 2 / lattices_), end = stable_phase(most_substeps) / fastest;
    std::vector<double> all{lattices_};
    for (int m = 2; m <= most_substeps; ++m) all.push_back(stable_phase(m) / fastest);
    for (double dt = 1.1 * one_ / safety_; dt < end; dt *= 1.1) all.push_back(dt);
    std::sort(all.begin(), all.end());
    for (double& dt : all) dt *= safety_;
    std::erase_if(all, [this, end](double dt) { return dt > safety_ * end || dt <= one_ * least_gain; });
    return all;
  }

  /// The fewest short steps that are stable; 0 if there are none.
  int substeps_for(double dt, double fastest) const {
    for (int m = 2; m <= most_substeps; ++m)
      if (dt * fastest <= safety_ * stable_phase(m) * (1 + 1e-12)) return m;
    return 0;
  }

  bool too_long_for_lattices(double dt) const { return dt > safety_ * lattices_ * (1 + 1e-12); }

  template <class Visit>
  void for_ghost_nodes(Visit visit) const {
    for (const Lattice& lattice : model_.lattices)
      for (const Ghost& ghost : lattice.ghosts)
        for (const GhostNode& I : ghost.nodes) visit(I.node);
  }

  double of_others(std::size_t node, bool lattices) const {
    return at_.of_contacts[node] + (lattices ? 0 : at_.of_ghosts[node]);
  }

  std::vector<std::uint8_t> fine_nodes(double dt, bool lattices) const {
    std::vector<std::uint8_t> fine(mesh_.nodes());
    for (std::size_t i = 0; i < fine.size(); ++i)
      fine[i] = at_.frequency_squared[i] * dt * dt > 4 * safety_ * safety_;
    fine = with_neighbours(mesh_, fine);
    if (lattices) for_ghost_nodes([&fine](std::int32_t i) { fine[i] = 1; });
    make_whole(fine, lattices);
    return fine;
  }

  /// Where others act, the whole body is fine.
  void make_whole(std::vector<std::uint8_t>& fine, bool lattices) const {
    std::vector<std::uint8_t> whole(mesh_.nodes());
    for (std::size_t i = 0; i < fine.size(); ++i)
      if (fine[i] && of_others(i, lattices) > 0) whole[body_[i]] = 1;
    for (std::size_t i = 0; i < fine.size(); ++i) fine[i] |= whole[body_[i]];
  }

  bool can_be_fine(std::size_t node, double dt, bool lattices, double remainder) const {
    if (lattices && at_.of_contacts[node] > 0 && coupled_[body_[node]]) return false;
    return !at_.viscous[node] && of_others(node, lattices) * dt * dt <= remainder;
  }

  const Model& model_;
  const Mesh& mesh_;
  const NodeLimits& at_;
  bool particles_may_touch_;
  double safety_, whole_;
  std::vector<std::int32_t> body_;
  std::vector<std::uint8_t> coupled_;                          ///< by body: whether ghosts ride on it
  double fastest_;                                             ///< ω of any node
  double one_;                                                 ///< step if all take the same
  double lattices_ = std::numeric_limits<double>::infinity();  ///< bound of the lattices' steps
};

}  // namespace

FinePart fine_part(const Model& model, const TimeStepLimits& limits, double dt, double safety) {
  if (model.mesh.elements.empty()) return {};
  return Search(model, limits, safety).part(dt);
}

Division best_division(const Model& model, const TimeStepLimits& limits, double safety) {
  if (model.mesh.elements.empty()) return {};
  return Search(model, limits, safety).best();
}

}  // namespace geist
