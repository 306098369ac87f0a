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

/// Times of one core in ns (docs/performance.md): an element's forces, a node's own part of a step, a
/// particle.
constexpr double node_time = 10, short_node_time = 20;  // its own part of a step, and of a short one

double element_time(const HexRegion& region, Kinematics kinematics) {
  const bool one_point = region.formulation != "full" && region.formulation != "selective-reduced";
  return (one_point ? 30 : 60) + (kinematics == Kinematics::finite ? 40 : 0);
}

double particle_time(const Lattice& lattice) {
  if (lattice.kinematics == Kinematics::finite) return 42;
  return lattice.consistent() ? 21 : 15;
}

double time_of_a_step(const Model& model) {
  double time = node_time * static_cast<double>(model.mesh.nodes());
  for (const HexRegion& region : model.mesh.regions)
    time += element_time(region, model.mesh.kinematics) * static_cast<double>(region.count);
  for (const Lattice& lattice : model.lattices)
    time += particle_time(lattice) * static_cast<double>(lattice.count(site::particle));
  return time;
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
    for (int l = 0; l < mesh.blocks[b].count; ++l)
      for (const std::int32_t i : mesh.elements[mesh.blocks[b].first + l]) touches |= fine.is_fine[i] != 0;
    (touches ? fine.blocks : fine.others).push_back(static_cast<std::int32_t>(b));
  }
}

double time_of_a_short_step(const Mesh& mesh, const FinePart& fine) {
  const std::vector<std::uint8_t> touched = with_neighbours(mesh, fine.is_fine);
  double time = short_node_time * static_cast<double>(std::count(touched.begin(), touched.end(), 1));
  for (const std::int32_t b : fine.blocks) {
    const HexBlock& block = mesh.blocks[b];
    const HexRegion& region = mesh.regions[region_of(mesh, block.first)];
    time += element_time(region, mesh.kinematics) * block.count;
  }
  return time;
}

class Search {
 public:
  Search(const Model& model, const TimeStepLimits& limits, double safety)
      : mesh_(model.mesh),
        at_(limits.nodes),
        safety_(safety),
        whole_(time_of_a_step(model)),
        body_(bodies_of(model.mesh)),
        fastest_(std::sqrt(*std::max_element(at_.frequency_squared.begin(), at_.frequency_squared.end()))),
        one_(safety * critical(limits.bounds).bound) {
    for (std::size_t l = mesh_.regions.size(); l < limits.bounds.size(); ++l)
      longest_ = std::min(longest_, safety * limits.bounds[l].bound);
  }

  FinePart part(double dt) const {
    FinePart fine{substeps_for(dt), {}, {}, {}};
    if (fine.m == 0 || dt > longest_ * (1 + 1e-12)) return {};
    fine.is_fine = fine_nodes(dt);
    const double remainder = stable_remainder(fine.m);
    for (std::size_t i = 0; i < mesh_.nodes(); ++i)
      if (fine.is_fine[i] && !can_be_fine(i, dt, remainder)) return {};
    list_blocks(mesh_, fine);
    return fine;
  }

  /// The longer the step, the more is fine: no gain is left once the short steps take nearly all of the time.
  Division best() const {
    Division best{0, {}, least_gain};
    for (const double dt : candidates()) {
      Division next{rounded_down(dt), part(rounded_down(dt))};
      if (next.fine.empty()) break;
      const double more = time_of_a_short_step(mesh_, next.fine);
      if (more * best.gain > whole_) break;
      next.gain = whole_ / one_ / ((whole_ + (next.fine.m - 1) * more) / next.dt);
      if (next.gain > best.gain) best = std::move(next);
    }
    return best.fine.empty() ? Division{} : best;
  }

 private:
  /// The longest for every number of short steps, some in between, and what the lattices allow.
  std::vector<double> candidates() const {
    const double end = safety_ * stable_phase(most_substeps) / fastest_;
    std::vector<double> all{std::min(longest_, end)};
    for (int m = 2; m < most_substeps; ++m) all.push_back(safety_ * stable_phase(m) / fastest_);
    for (double dt = 1.1 * one_; dt < end; dt *= 1.1) all.push_back(dt);
    std::sort(all.begin(), all.end());
    std::erase_if(all, [this](double dt) { return dt > longest_ || dt <= one_ * least_gain; });
    return all;
  }

  /// The fewest short steps that are stable; 0 if there are none.
  int substeps_for(double dt) const {
    for (int m = 2; m <= most_substeps; ++m)
      if (dt * fastest_ <= safety_ * stable_phase(m)) return m;
    return 0;
  }

  /// Where others than elements act, the whole body is fine.
  std::vector<std::uint8_t> fine_nodes(double dt) const {
    std::vector<std::uint8_t> fine(mesh_.nodes());
    for (std::size_t i = 0; i < fine.size(); ++i)
      fine[i] = at_.frequency_squared[i] * dt * dt > 4 * safety_ * safety_;
    fine = with_neighbours(mesh_, fine);
    std::vector<std::uint8_t> whole(mesh_.nodes());
    for (std::size_t i = 0; i < fine.size(); ++i)
      if (fine[i] && at_.of_others[i] > 0) whole[body_[i]] = 1;
    for (std::size_t i = 0; i < fine.size(); ++i) fine[i] |= whole[body_[i]];
    return fine;
  }

  bool can_be_fine(std::size_t node, double dt, double remainder) const {
    return !at_.viscous[node] && at_.of_others[node] * dt * dt <= remainder;
  }

  const Mesh& mesh_;
  const NodeLimits& at_;
  double safety_, whole_;
  std::vector<std::int32_t> body_;
  double fastest_;                                            ///< ω of any node
  double one_;                                                ///< step if all take the same
  double longest_ = std::numeric_limits<double>::infinity();  ///< step that the lattices allow
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
