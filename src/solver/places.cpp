#include "solver/places.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "coupling/ghosts.hpp"
#include "geometry/shapes.hpp"

namespace geist {
namespace {

constexpr std::size_t grain = 2000;

/// Of a listed site, the components that a support prescribes: a ghost follows its nodes in the first three.
Place site_place(const Lattice& lattice, std::int32_t l, std::size_t s) {
  Place place{lattice.grid.centre(s), s, l, -1, 0b111111, 0};
  if (lattice.is(s, site::free)) return place;
  place.slot = listed_slot(lattice, s);
  place.held = lattice.listed_held[place.slot];
  place.free = 0b111111 & ~place.held;
  if (lattice.is(s, site::ghost)) place.held &= 0b111000;
  return place;
}

}  // namespace

Places::Places(const Model& model, std::size_t block_size) {
  add_nodes(model);
  std::size_t first = 0;  // blocks do not span regions
  for (const HexRegion& region : model.mesh.regions) {
    std::vector<bool> in_region(model.mesh.nodes(), false);
    for (std::size_t e = region.first; e < region.first + region.count; ++e)
      for (const std::int32_t i : model.mesh.elements[e]) in_region[i] = true;
    const auto end = std::stable_partition(all_.begin() + first, all_.end(),
                                           [&](const Place& p) { return in_region[p.index]; });
    const auto last = static_cast<std::size_t>(end - all_.begin());
    divide(first, last, block_size);
    first = last;
  }
  for (std::size_t l = 0; l < model.lattices.size(); ++l) {
    first = all_.size();
    add_sites(model, l);
    divide(first, all_.size(), block_size);
  }
  number(model);
}

void Places::add_nodes(const Model& model) {
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i) {
    const std::uint8_t held = model.mesh.held[i];
    all_.push_back({model.mesh.points[i], i, -1, -1, static_cast<std::uint8_t>(0b111 & ~held), held});
  }
}

void Places::add_sites(const Model& model, std::size_t l) {
  const Lattice& lattice = model.lattices[l];
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    if (lattice.word[s] & (site::particle | site::ghost))
      all_.push_back(site_place(lattice, static_cast<std::int32_t>(l), s));
}

/// Cut in the middle of the longest edge of what is there until the pieces are small enough.
void Places::divide(std::size_t first, std::size_t last, std::size_t block_size) {
  if (first == last) return;
  Box box = nowhere();
  for (std::size_t k = first; k < last; ++k) widen(box, all_[k].X);
  const Vec3 edge = box.high - box.low;
  int axis = 0;
  for (int c = 1; c < 3; ++c)
    if (edge[c] > edge[axis] * (1 + 1e-9)) axis = c;
  if (last - first <= block_size || !(edge[axis] > 0)) {
    begin_.push_back(last);
    return;
  }
  const double middle = box.low[axis] + (0.5 + 1e-9) * edge[axis];
  const auto cut = std::stable_partition(all_.begin() + first, all_.begin() + last,
                                         [=](const Place& p) { return p.X[axis] < middle; });
  const auto half = static_cast<std::size_t>(cut - all_.begin());
  divide(first, half, block_size);
  divide(half, last, block_size);
}

void Places::number(const Model& model) {
  block_of_.resize(size());
  for (std::size_t b = 0; b < blocks(); ++b)
    std::fill(block_of_.begin() + begin_[b], block_of_.begin() + begin_[b + 1], static_cast<std::int32_t>(b));
  of_node_.assign(model.mesh.nodes(), -1);
  for (const Lattice& lattice : model.lattices) of_site_.emplace_back(lattice.grid.size(), -1);
  for (std::size_t k = 0; k < size(); ++k) {
    const Place& place = all_[k];
    (place.lattice < 0 ? of_node_ : of_site_[place.lattice])[place.index] = static_cast<std::int32_t>(k);
  }
}

void Places::put(const PlaceVector& x, Model& model) const {
  for_each(
      size(),
      [this, &model, from = x.data()](std::size_t k) {
        const Place& place = all_[k];
        int components = place.free | place.held;
        if (place.lattice >= 0 && model.lattices[place.lattice].kinematics == Kinematics::finite)
          components &= 0b000111;
        for (int c = 0; c < 6; ++c)
          if (components >> c & 1)
            (place.lattice < 0 ? model.mesh.u[c] : model.lattices[place.lattice].motion[c])[place.index] =
                from[6 * k + c];
      },
      grain);
  for (Lattice& lattice : model.lattices) coupling::follow(lattice, model.mesh);
}

void Places::take(const Model& model, PlaceVector& f) const {
  for_each(
      size(),
      [this, &model, to = f.data()](std::size_t k) {
        const Place& place = all_[k];
        const int components = place.free | place.held;
        for (int c = 0; c < 6; ++c) {
          const bool there = components >> c & 1;
          if (!there)
            to[6 * k + c] = 0;
          else if (place.lattice < 0)
            to[6 * k + c] = model.mesh.f[c][place.index];
          else if (place.slot < 0)
            to[6 * k + c] = model.lattices[place.lattice].velocity[c][place.index];
          else
            to[6 * k + c] = model.lattices[place.lattice].listed_force[c][place.slot];
        }
      },
      grain);
}

}  // namespace geist
