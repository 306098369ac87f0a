// Velocities are shown at the time t^n of the displacements: the mean of those half a step before and after.
// What is kept for a checkpoint is the state itself, at n + 1/2.
#include "output/field_list.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/parallel.hpp"
#include "de/bonds.hpp"
#include "de/rotation.hpp"
#include "fe/elements.hpp"

namespace geist::output {
namespace {

using Values = std::vector<double>;

constexpr std::size_t worth_threads = 10'000;  ///< places

Values node_vectors(const Field<3>& field) {
  Values values(3 * field.size());
  const auto copy = [&field, to = values.data()](std::size_t i) {
    for (int c = 0; c < 3; ++c) to[3 * i + c] = field[c][i];
  };
  for_each(field.size(), copy, worth_threads);
  return values;
}

Values mean(Values a, const Values& b) {
  for_each(
      a.size(), [x = a.data(), y = b.data()](std::size_t i) { x[i] = 0.5 * (x[i] + y[i]); }, worth_threads);
  return a;
}

Values stresses(const Model& model) {
  const auto of_elements = fe::centre_stresses(model.mesh);
  Values values(6 * of_elements.size());
  const auto copy = [&of_elements, to = values.data()](std::size_t e) {
    std::copy(of_elements[e].begin(), of_elements[e].end(), to + 6 * e);
  };
  for_each(of_elements.size(), copy, worth_threads);
  return values;
}

Values von_mises_stresses(const Model& model) {
  const auto of_elements = fe::centre_stresses(model.mesh);
  Values values(of_elements.size());
  const auto reduce = [&of_elements, to = values.data()](std::size_t e) {
    to[e] = von_mises(of_elements[e]);
  };
  for_each(of_elements.size(), reduce, worth_threads);
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

/// By row of a lattice's sites, how many with the flag come before it, from `before` on; and all of them at
/// the end.
std::vector<std::size_t> places_of_rows(const Lattice& lattice, std::uint32_t flag, std::size_t before) {
  const std::size_t rows = lattice.grid.rows(), stride = lattice.grid.stride();
  std::vector<std::size_t> first(rows + 1, before);
  const auto count = [&lattice, flag, stride, to = first.data() + 1](std::size_t row) {
    const auto word = lattice.word.begin() + static_cast<std::ptrdiff_t>(row * stride);
    to[row] = std::count_if(word, word + static_cast<std::ptrdiff_t>(stride),
                            [flag](std::uint32_t w) { return w & flag; });
  };
  for_each(rows, count, worth_threads / stride);
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

/// `components` numbers for every site with the flag, which fill(lattice, its number, site, numbers) sets.
template <class F>
Values site_values(const Model& model, std::uint32_t flag, int components, F fill) {
  Values values;
  std::size_t places = 0;
  for (std::size_t l = 0; l < model.lattices.size(); ++l) {
    const Lattice& lattice = model.lattices[l];
    const std::size_t stride = lattice.grid.stride();
    const std::vector<std::size_t> first = places_of_rows(lattice, flag, places);
    places = first.back();
    values.resize(places * components);
    const auto fill_row = [&lattice, &fill, flag, components, l, stride, from = first.data(),
                           to = values.data()](std::size_t row) {
      double* next = to + from[row] * components;
      for (std::size_t s = row * stride; s < (row + 1) * stride; ++s)
        if (lattice.is(s, flag)) fill(lattice, l, s, next), next += components;
    };
    for_each(lattice.grid.rows(), fill_row, worth_threads / stride);
  }
  return values;
}

/// Three components of a field of the lattice, from the first on, for every site with the flag.
Values site_vectors(const Model& model, std::uint32_t flag, Field<6> Lattice::*field, int first) {
  return site_values(model, flag, 3, [=](const Lattice& lattice, std::size_t, std::size_t s, double* to) {
    for (int c = 0; c < 3; ++c) to[c] = (lattice.*field)[first + c][s];
  });
}

void put(Vec3 a, double* to) { to[0] = a.x, to[1] = a.y, to[2] = a.z; }

template <std::uint32_t flag>
Values site_displacements(const Model& model) {
  return site_vectors(model, flag, &Lattice::motion, 0);
}
template <std::uint32_t flag>
Values rotations(const Model& model) {
  return site_values(model, flag, 3, [](const Lattice& lattice, std::size_t, std::size_t s, double* to) {
    put(de::rotation_vector(lattice, s), to);
  });
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
  return site_values(model, flag, 1, [](const Lattice& lattice, std::size_t, std::size_t, double* to) {
    *to = lattice.radius();
  });
}

Values strain_energies(const Model& model) {
  std::vector<Values> energies;
  for (const Lattice& lattice : model.lattices) energies.push_back(de::site_energies(lattice));
  return site_values(model, site::particle, 1,
                     [&](const Lattice&, std::size_t l, std::size_t s, double* to) { *to = energies[l][s]; });
}

Values intact_bonds(const Model& model) {
  return site_values(model, site::particle, 1,
                     [](const Lattice& lattice, std::size_t, std::size_t s, double* to) {
                       *to = std::popcount(lattice.word[s] & site::bonds);
                     });
}

template <std::uint32_t flag>
Values lattice_regions(const Model& model) {
  const std::size_t before = model.mesh.regions.size();
  return site_values(model, flag, 1, [before](const Lattice&, std::size_t l, std::size_t, double* to) {
    *to = static_cast<double>(before + l);
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
  using contact::TouchedPlace;
  const std::vector<TouchedPlace>& touched = sim.contacts.touched();
  const auto before = [](const TouchedPlace& t, std::pair<std::int32_t, std::size_t> site) {
    return std::pair(t.place.lattice, t.place.index) < site;
  };
  return site_values(sim.model, site::particle, 3,
                     [&](const Lattice&, std::size_t l, std::size_t s, double* to) {
                       if (touched.empty()) return;
                       const std::pair site(static_cast<std::int32_t>(l), s);
                       const auto it = std::lower_bound(touched.begin(), touched.end(), site, before);
                       if (it != touched.end() && it->place.lattice == site.first && it->place.index == s)
                         put(it->force, to);
                     });
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
