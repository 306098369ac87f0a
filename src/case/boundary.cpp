#include "case/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "case/diagnostic.hpp"

namespace geist {
namespace {

constexpr std::array<const char*, 6> component_names{"x", "y", "z", "rx", "ry", "rz"};

Selection select_some(const Case& input, const Selector& selector, const Where& where) {
  Selection found = selector.select(where);
  const Box& all = selector.bounds();
  if (found.empty())
    throw error_at(
        input, where.source,
        fmt::format("selects nothing: no node lies and no particle touches there; everything is within "
                    "x = [{:.6g}, {:.6g}], y = [{:.6g}, {:.6g}], z = [{:.6g}, {:.6g}]",
                    all.low.x, all.high.x, all.low.y, all.high.y, all.low.z, all.high.z));
  return found;
}

Curve curve_of(const Case& input, const std::string& name) {
  return name.empty() ? Curve{} : input.curves.at(name);
}

/// The motion that a support gives to component c, if any.
std::optional<Motion> motion_of(const Case& input, const SupportSpec& spec, int c) {
  if (spec.fixed[c]) return Motion{};
  if (spec.displacement[c])
    return Motion{Motion::Kind::displacement, *spec.displacement[c], curve_of(input, spec.curve)};
  if (spec.velocity[c]) return Motion{Motion::Kind::velocity, *spec.velocity[c], curve_of(input, spec.curve)};
  return std::nullopt;
}

/// Collects held components and refuses two motions of one.
class HeldCollector {
 public:
  HeldCollector(const Case& input, Supports& supports) : input_(input), supports_(supports) {}

  void hold(const SupportSpec& spec, std::int32_t lattice, std::size_t place, int component,
            std::int32_t motion) {
    const auto [it, fresh] = motion_of_.try_emplace({lattice, place, component}, motion);
    if (fresh) return supports_.held.push_back({lattice, place, 0, component, motion});
    const auto still = [&](std::int32_t m) { return supports_.motions[m].kind == Motion::Kind::held; };
    if (!still(it->second) || !still(motion))
      throw error_at(
          input_, spec.source,
          fmt::format("component '{}' of some of these nodes or particles is moved by another support "
                      "already",
                      component_names[component]));
  }

 private:
  const Case& input_;
  Supports& supports_;
  std::map<std::tuple<std::int32_t, std::size_t, int>, std::int32_t> motion_of_;
};

void add_support(const Case& input, const SupportSpec& spec, const Selection& selection, Supports& supports,
                 HeldCollector& collector) {
  for (int c = 0; c < 6; ++c) {
    const auto motion = motion_of(input, spec, c);
    if (!motion) continue;
    if (c >= 3 && selection.particles.empty())
      throw error_at(input, spec.source,
                     fmt::format("'{}' is a rotation, but the selection holds no particle, only nodes",
                                 component_names[c]));
    const auto index = static_cast<std::int32_t>(supports.motions.size());
    supports.motions.push_back(*motion);
    if (c < 3)
      for (const std::int32_t node : selection.nodes)
        collector.hold(spec, -1, static_cast<std::size_t>(node), c, index);
    for (const auto& [lattice, s] : selection.particles) collector.hold(spec, lattice, s, c, index);
  }
}

Load make_load(const Case& input, const LoadSpec& spec, const Selector& selector) {
  Load load;
  load.curve = curve_of(input, spec.curve);
  if (spec.kind == LoadSpec::Kind::gravity) {
    load.is_gravity = true, load.gravity = spec.value;
    return load;
  }
  const Selection selection = select_some(input, selector, *spec.where);
  const Selector::Shares shares = selector.shares(*spec.where, selection);
  Vec3 total = spec.value;
  if (spec.kind == LoadSpec::Kind::traction) {
    if (!shares.by_area)
      throw error_at(input, spec.source,
                     "a traction needs a plane with exterior faces on it, and here is none");
    total *= shares.total;
  }
  for (std::size_t i = 0; i < selection.nodes.size(); ++i)
    if (shares.nodes[i] > 0) load.nodes.push_back({selection.nodes[i], shares.nodes[i] * total});
  for (std::size_t i = 0; i < selection.particles.size(); ++i)
    if (shares.particles[i] > 0)
      load.particles.push_back(
          {selection.particles[i].lattice, selection.particles[i].site, 0, shares.particles[i] * total});
  return load;
}

template <class T>
T choose(const std::string& word, std::initializer_list<std::pair<const char*, T>> list) {
  for (const auto& [name, value] : list)
    if (word == name) return value;
  return list.begin()->second;
}

Probe make_probe(const Case& input, const ProbeSpec& spec, const Selector& selector, const Simulation& sim) {
  using Quantity = Probe::Quantity;
  using Reduce = Probe::Reduce;
  Selection selection = select_some(input, selector, spec.where);
  Probe probe;
  probe.name = spec.name;
  probe.quantity = choose<Quantity>(spec.quantity, {{"displacement", Quantity::displacement},
                                                    {"velocity", Quantity::velocity},
                                                    {"rotation", Quantity::rotation},
                                                    {"reaction", Quantity::reaction},
                                                    {"contact-force", Quantity::contact_force}});
  probe.component = choose<int>(spec.component, {{"x", 0}, {"y", 1}, {"z", 2}, {"magnitude", 3}});
  probe.reduce = choose<Reduce>(
      spec.reduce,
      {{"mean", Reduce::mean}, {"min", Reduce::min}, {"max", Reduce::max}, {"sum", Reduce::sum}});
  probe.nodes = std::move(selection.nodes), probe.particles = std::move(selection.particles);
  if (probe.quantity == Quantity::rotation && probe.particles.empty())
    throw error_at(input, spec.source, "only particles have a rotation, and the selection holds none");
  if (probe.quantity != Quantity::reaction) return probe;
  const std::set<std::int32_t> nodes(probe.nodes.begin(), probe.nodes.end());
  std::set<std::pair<std::int32_t, std::size_t>> particles;
  for (const auto& [lattice, s] : probe.particles) particles.insert({lattice, s});
  for (std::size_t i = 0; i < sim.supports.held.size(); ++i) {
    const HeldComponent& h = sim.supports.held[i];
    const bool in = h.lattice < 0 ? nodes.contains(static_cast<std::int32_t>(h.place))
                                  : particles.contains({h.lattice, h.place});
    if (in) probe.held.push_back(i);
  }
  if (probe.held.empty())
    throw error_at(input, spec.source, "no support holds anything there, so there is no reaction");
  return probe;
}

}  // namespace

Supports make_supports(const Case& input, const Selector& selector) {
  Supports supports;
  HeldCollector collector(input, supports);
  for (const SupportSpec& spec : input.supports)
    add_support(input, spec, select_some(input, selector, spec.where), supports, collector);
  return supports;
}

std::vector<Load> make_loads(const Case& input, const Selector& selector) {
  std::vector<Load> loads;
  for (const LoadSpec& spec : input.loads) loads.push_back(make_load(input, spec, selector));
  return loads;
}

void set_initial_motion(Model& model, const Case& input, const Selector& selector) {
  for (const InitialSpec& spec : input.initial) {
    const Selection selection = select_some(input, selector, spec.where);
    const auto velocity = [&](Vec3 x) { return spec.velocity + cross(spec.spin, x - spec.about); };
    for (const std::int32_t node : selection.nodes) model.mesh.v.set(node, velocity(model.mesh.points[node]));
    for (const auto& [l, s] : selection.particles) {
      Lattice& lattice = model.lattices[l];
      lattice.velocity.set(s, velocity(lattice.grid.centre(s)));
      lattice.velocity.set(s, spec.spin, 3);
    }
    // A ghost spins with its hexahedron.
    for (Lattice& lattice : model.lattices)
      for (std::size_t g = 0; g < lattice.ghosts.size(); ++g) {
        const auto& nodes = model.mesh.elements[lattice.ghosts[g].element];
        const bool rides = std::any_of(nodes.begin(), nodes.end(), [&](std::int32_t n) {
          return std::binary_search(selection.nodes.begin(), selection.nodes.end(), n);
        });
        const bool spins = !(lattice.listed_held[lattice.ghost_slot[g]] & 0b111000);
        if (rides && spins) lattice.velocity.set(lattice.ghosts[g].site, spec.spin, 3);
      }
  }
}

std::vector<Probe> make_probes(const Case& input, const Selector& selector, const Simulation& sim) {
  std::vector<Probe> probes;
  for (const ProbeSpec& spec : input.probes) probes.push_back(make_probe(input, spec, selector, sim));
  return probes;
}

}  // namespace geist
