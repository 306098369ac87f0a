// Velocities are shown at the time t^n of the displacements: the mean of those half a step before and after.
// What is kept for a checkpoint is the state itself, at n + 1/2.
#include "output/field_list.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "de/bonds.hpp"
#include "de/rotation.hpp"
#include "fe/elements.hpp"

namespace geist::output {
namespace {

using Values = std::vector<double>;

Values node_vectors(const Field<3>& field) {
  Values values(3 * field.size());
  for (std::size_t i = 0; i < field.size(); ++i)
    for (int c = 0; c < 3; ++c) values[3 * i + c] = field[c][i];
  return values;
}

Values mean(Values a, const Values& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = 0.5 * (a[i] + b[i]);
  return a;
}

Values stresses(const Model& model) {
  Values values;
  values.reserve(6 * model.mesh.elements.size());
  for (const std::array<double, 6>& s : fe::centre_stresses(model.mesh))
    values.insert(values.end(), s.begin(), s.end());
  return values;
}

Values von_mises_stresses(const Model& model) {
  Values values;
  values.reserve(model.mesh.elements.size());
  for (const std::array<double, 6>& s : fe::centre_stresses(model.mesh)) values.push_back(von_mises(s));
  return values;
}

/// Hexahedral regions are numbered first, then the lattices.
Values hexahedron_regions(const Model& model) {
  Values values(model.mesh.elements.size());
  for (std::size_t r = 0; r < model.mesh.regions.size(); ++r) {
    const HexRegion& region = model.mesh.regions[r];
    std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(region.first), region.count,
                static_cast<double>(r));
  }
  return values;
}

/// visit(lattice, its number, site) for every site with the flag.
template <class F>
void visit_sites(const Model& model, std::uint32_t flag, F visit) {
  for (std::size_t l = 0; l < model.lattices.size(); ++l)
    for (std::size_t s = 0; s < model.lattices[l].word.size(); ++s)
      if (model.lattices[l].is(s, flag)) visit(model.lattices[l], l, s);
}

/// One number for every site with the flag.
template <class F>
Values site_values(const Model& model, std::uint32_t flag, F value) {
  Values values;
  visit_sites(model, flag, [&](const Lattice& lattice, std::size_t l, std::size_t s) {
    values.push_back(value(lattice, l, s));
  });
  return values;
}

/// Three components of a field of the lattice, from the first on, for every site with the flag.
Values site_vectors(const Model& model, std::uint32_t flag, Field<6> Lattice::*field, int first) {
  Values values;
  visit_sites(model, flag, [&](const Lattice& lattice, std::size_t, std::size_t s) {
    for (int c = 0; c < 3; ++c) values.push_back((lattice.*field)[first + c][s]);
  });
  return values;
}

template <std::uint32_t flag>
Values site_displacements(const Model& model) {
  return site_vectors(model, flag, &Lattice::motion, 0);
}
template <std::uint32_t flag>
Values rotations(const Model& model) {
  Values values;
  visit_sites(model, flag, [&](const Lattice& lattice, std::size_t, std::size_t s) {
    const Vec3 theta = de::rotation_vector(lattice, s);
    values.insert(values.end(), {theta.x, theta.y, theta.z});
  });
  return values;
}
template <std::uint32_t flag, int first>
Values velocity_after(const Model& model) {
  return site_vectors(model, flag, &Lattice::velocity, first);
}
template <std::uint32_t flag, int first>
Values velocity_now(const Model& model) {
  return mean(site_vectors(model, flag, &Lattice::velocity_before, first),
              velocity_after<flag, first>(model));
}
template <std::uint32_t flag>
Values radii(const Model& model) {
  return site_values(model, flag,
                     [](const Lattice& lattice, std::size_t, std::size_t) { return lattice.radius(); });
}

Values strain_energies(const Model& model) {
  std::vector<Values> energies;
  for (const Lattice& lattice : model.lattices) energies.push_back(de::site_energies(lattice));
  return site_values(model, site::particle,
                     [&](const Lattice&, std::size_t l, std::size_t s) { return energies[l][s]; });
}

Values intact_bonds(const Model& model) {
  return site_values(model, site::particle, [](const Lattice& lattice, std::size_t, std::size_t s) {
    return std::popcount(lattice.word[s] & site::bonds);
  });
}

template <std::uint32_t flag>
Values lattice_regions(const Model& model) {
  const std::size_t before = model.mesh.regions.size();
  return site_values(model, flag, [before](const Lattice&, std::size_t l, std::size_t) {
    return static_cast<double>(before + l);
  });
}

Values ghost_hexahedra(const Model& model) {
  Values values;
  for (const Lattice& lattice : model.lattices)
    for (const Ghost& ghost : lattice.ghosts) values.push_back(ghost.element);
  return values;
}

Values node_displacements(const Model& model) { return node_vectors(model.mesh.u); }
Values node_velocities_after(const Model& model) { return node_vectors(model.mesh.v); }
Values node_velocities(const Model& model) {
  return mean(node_vectors(model.mesh.v_before), node_velocities_after(model));
}

Values node_contact_forces(const Simulation& sim) {
  Values values(3 * sim.model.mesh.nodes());
  for (const contact::TouchedPlace& touched : sim.contacts.touched())
    if (touched.place.lattice < 0)
      for (int c = 0; c < 3; ++c) values[3 * touched.place.index + c] = touched.force[c];
  return values;
}

/// Touched places come in the order of lattices and sites, too, after the nodes.
Values particle_contact_forces(const Simulation& sim) {
  const std::vector<contact::TouchedPlace>& touched = sim.contacts.touched();
  auto next =
      std::find_if(touched.begin(), touched.end(), [](const auto& t) { return t.place.lattice >= 0; });
  Values values;
  visit_sites(sim.model, site::particle, [&](const Lattice&, std::size_t l, std::size_t s) {
    Vec3 force;
    const bool here = next != touched.end() && next->place.lattice == static_cast<std::int32_t>(l) &&
                      next->place.index == s;
    if (here) force = (next++)->force;
    for (int c = 0; c < 3; ++c) values.push_back(force[c]);
  });
  return values;
}

using enum Place;
using enum Storage;
namespace dim = dimension;
constexpr std::uint32_t p = site::particle, g = site::ghost;
constexpr bool yes = true, no = false;

// clang-format off
constexpr FieldInfo list[] = {
    // name              place      components, unit      storage shown kept values
    {"displacement",     nodes,     3, dim::length,       full,    yes, yes, node_displacements},
    {"velocity",         nodes,     3, dim::velocity,     single,  yes, no,  node_velocities},
    {"velocity_after",   nodes,     3, dim::velocity,     full,    no,  yes, node_velocities_after},
    {"contact_force",    nodes,     3, dim::force,        single,  yes, no,  node_contact_forces},

    {"stress",           hexahedra, 6, dim::stress,       single,  yes, no,  stresses},
    {"von_mises",        hexahedra, 1, dim::stress,       single,  yes, no,  von_mises_stresses},
    {"region",           hexahedra, 1, dim::none,         integer, yes, no,  hexahedron_regions},

    {"displacement",     particles, 3, dim::length,       full,    yes, yes, site_displacements<p>},
    {"rotation",         particles, 3, dim::angle,        full,    yes, yes, rotations<p>},
    {"velocity",         particles, 3, dim::velocity,     single,  yes, no,  velocity_now<p, 0>},
    {"spin",             particles, 3, dim::spin,         single,  yes, no,  velocity_now<p, 3>},
    {"velocity_after",   particles, 3, dim::velocity,     full,    no,  yes, velocity_after<p, 0>},
    {"spin_after",       particles, 3, dim::spin,         full,    no,  yes, velocity_after<p, 3>},
    {"radius",           particles, 1, dim::length,       full,    yes, no,  radii<p>},
    {"strain_energy",    particles, 1, dim::energy,       single,  yes, no,  strain_energies},
    {"intact_bonds",     particles, 1, dim::none,         integer, yes, no,  intact_bonds},
    {"contact_force",    particles, 3, dim::force,        single,  yes, no,  particle_contact_forces},
    {"region",           particles, 1, dim::none,         integer, yes, no,  lattice_regions<p>},

    {"displacement",     ghosts,    3, dim::length,       full,    yes, no,  site_displacements<g>},
    {"rotation",         ghosts,    3, dim::angle,        full,    yes, yes, rotations<g>},
    {"spin_after",       ghosts,    3, dim::spin,         full,    no,  yes, velocity_after<g, 3>},
    {"radius",           ghosts,    1, dim::length,       full,    yes, no,  radii<g>},
    {"hexahedron",       ghosts,    1, dim::none,         integer, yes, no,  ghost_hexahedra},
    {"region",           ghosts,    1, dim::none,         integer, yes, no,  lattice_regions<g>},
};
// clang-format on

}  // namespace

std::span<const FieldInfo> fields() { return list; }

std::vector<std::string> component_names(const FieldInfo& field) {
  if (field.components != 6) return {};
  return {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
}

double von_mises(const std::array<double, 6>& stress) {
  const auto& [xx, yy, zz, xy, yz, xz] = stress;
  const double normal = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx);
  return std::sqrt(0.5 * normal + 3 * (xy * xy + yz * yz + xz * xz));
}

}  // namespace geist::output
