#include "coupling/interfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/facets.hpp"
#include "geometry/hex8.hpp"

namespace geist::coupling {
namespace {

std::string place(Vec3 p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

const std::string& name_of_region(const Mesh& mesh, std::int32_t element) {
  return mesh.regions[region_of(mesh, element)].name;
}

/// Whether p lies in a cell of the lattice's particles.
bool in_cell(const Lattice& lattice, Vec3 p) {
  const Grid& grid = lattice.grid;
  const auto at = [&](int c) { return static_cast<int>(std::lround((p[c] - grid.origin[c]) / grid.pitch)); };
  const int i = at(0), j = at(1), k = at(2);
  return grid.contains(i, j, k) && lattice.is(grid.index(i, j, k), site::particle);
}

/// Who else is at p: the name of a region of hexahedra or of another lattice, or nothing.
struct Surroundings {
  const Model& model;
  const Locator& locator;
  const Lattice* self;
  bool coupled;
  const LoosePairs& loose;

  std::string lattice_at(Vec3 p) const {
    for (const Lattice& other : model.lattices)
      if (&other != self && in_cell(other, p)) return other.name;
    return {};
  }
  std::string hexahedra_at(Vec3 p) const {
    const auto found = locator.find(p);
    return found ? name_of_region(model.mesh, found->element) : std::string();
  }
  std::string at(Vec3 p) const {
    const std::string name = hexahedra_at(p);
    return name.empty() ? lattice_at(p) : name;
  }
};

/// Nine points of the face of the cell at x towards `step`.
std::array<Vec3, 9> face_points(const Lattice& lattice, Vec3 x, Vec3 step) {
  const double r = lattice.radius();
  const Vec3 side1{step.y, step.z, step.x}, side2{step.z, step.x, step.y};
  std::array<Vec3, 9> points;
  std::size_t n = 0;
  for (const double a : {0.0, -0.9, 0.9})
    for (const double b : {0.0, -0.9, 0.9}) points[n++] = x + r * step + (r * a) * side1 + (r * b) * side2;
  return points;
}

/// Overlap: a point well inside the particle's cell belongs to somebody else.
std::optional<Clash> overlap(const Lattice& lattice, Vec3 x, const Surroundings& around) {
  for (const double a : {-0.999, 0.0, 0.999})
    for (const double b : {-0.999, 0.0, 0.999})
      for (const double c : {-0.999, 0.0, 0.999}) {
        const Vec3 p = x + lattice.radius() * Vec3{a, b, c};
        if (const std::string other = around.at(p); !other.empty())
          return Clash{lattice.name, other,
                       fmt::format("regions '{}' and '{}' overlap at {}", lattice.name, other, place(p))};
      }
  return std::nullopt;
}

/// A gap: the first region met on the way out from a point of a face.
std::optional<Clash> gap(const Lattice& lattice, Vec3 on_face, Vec3 step, const Surroundings& around) {
  const double r = lattice.radius();
  for (const double distance : {1e-3, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 1.95}) {
    const std::string other = around.at(on_face + (distance * r) * step);
    if (other.empty()) continue;
    if (around.loose.contains(lattice.name, other)) return std::nullopt;
    return Clash{lattice.name, other,
                 fmt::format("regions '{}' and '{}' leave a gap thinner than a particle (2r = {:.6g}) at {}",
                             lattice.name, other, 2 * r, place(on_face))};
  }
  return std::nullopt;
}

/// Across the face of the cell at x towards `step`, which is empty: nothing, or flush hexahedra with a ghost.
std::optional<Clash> across_face(const Lattice& lattice, Vec3 x, Vec3 step, const Surroundings& around) {
  const double r = lattice.radius();
  const auto points = face_points(lattice, x, step);
  for (const Vec3 on_face : points) {
    const std::string touching = around.lattice_at(on_face + (1e-3 * r) * step);
    if (!touching.empty() && !around.loose.contains(lattice.name, touching))
      return Clash{
          lattice.name, touching,
          fmt::format("lattice regions '{}' and '{}' touch at {}, but would not be bonded there; make "
                      "one region of several boxes, or let them touch in [[contact]]",
                      lattice.name, touching, place(on_face))};
    const std::string flush = around.hexahedra_at(on_face + (1e-3 * r) * step);
    if (flush.empty() || around.loose.contains(lattice.name, flush)) {
      if (auto clash = gap(lattice, on_face, step, around)) return clash;
    } else if (on_face == points[0] && around.hexahedra_at(on_face + r * step).empty()) {
      return Clash{lattice.name, flush,
                   fmt::format("region '{}' is thinner than a particle's radius behind the interface at {}, "
                               "so it holds no ghost for region '{}'",
                               flush, place(on_face), lattice.name)};
    }
  }
  return std::nullopt;
}

/// Steps across the faces of a site's cell that no particle of its own lattice covers.
std::vector<Vec3> open_faces(const Lattice& lattice, std::size_t s) {
  const Grid& grid = lattice.grid;
  const auto [i, j, k] = grid.ijk(s);
  std::vector<Vec3> outward;
  for (const auto& [a, b, c] : directions)
    if (std::abs(a) + std::abs(b) + std::abs(c) == 1 &&
        !(grid.contains(i + a, j + b, k + c) && lattice.is(grid.index(i + a, j + b, k + c), site::particle)))
      outward.push_back({double(a), double(b), double(c)});
  return outward;
}

std::optional<Clash> around_particle(const Lattice& lattice, std::size_t s, const Surroundings& around) {
  const Vec3 x = lattice.grid.centre(s);
  const std::vector<Vec3> outward = open_faces(lattice, s);
  if (outward.empty()) return std::nullopt;
  if (auto clash = overlap(lattice, x, around)) return clash;
  for (const Vec3 step : outward)
    if (auto clash = around.coupled ? across_face(lattice, x, step, around) : std::nullopt) return clash;
  return std::nullopt;
}

/// A node of a region's surface that lies in a hexahedron which it is no corner of. One on the faces of
/// others overlaps them if its own hexahedron does, just inside of the node; otherwise it touches them.
std::optional<Clash> between_hexahedra(const Model& model, const Locator& locator, const LoosePairs& loose) {
  const Mesh& mesh = model.mesh;
  std::vector<bool> stands_alone(mesh.nodes(), false);
  for (const Facet& facet : exterior_facets(mesh))
    for (const std::int32_t node : facet.node) {
      if (stands_alone[node]) continue;
      const Vec3 p = mesh.points[node];
      auto found = locator.find(p, -1e-6, node);
      const auto touching = found ? found : locator.find(p, 1e-6, node);
      if (!touching) {
        stands_alone[node] = true;
        continue;
      }
      const std::string a = name_of_region(mesh, facet.element), b = name_of_region(mesh, touching->element);
      const Vec3 centre = hex8::map(hex8::corners(mesh, static_cast<std::size_t>(facet.element)), {0, 0, 0});
      if (!found) found = locator.find(p + 1e-5 * (centre - p), 1e-7, node);
      if (!found && loose.contains(a, b)) continue;
      return Clash{
          a, b,
          found ? fmt::format("regions '{}' and '{}' overlap at {}", a, b, place(p))
                : fmt::format("regions '{}' and '{}' touch at {} without sharing nodes; their divisions "
                              "must match there (or let them touch in [[contact]])",
                              a, b, place(p))};
    }
  return std::nullopt;
}

/// A hexahedron whose centre lies in a particle's cell (smaller than the points tested above) or in another
/// hexahedron (which it may share all nodes with).
std::optional<Clash> centres_elsewhere(const Model& model, const Locator& locator) {
  for (std::size_t e = 0; e < model.mesh.elements.size(); ++e) {
    const auto element = static_cast<std::int32_t>(e);
    const Vec3 p = hex8::map(hex8::corners(model.mesh, e), {0, 0, 0});
    const auto clash = [&](const std::string& a, const std::string& b) {
      return Clash{a, b, fmt::format("regions '{}' and '{}' overlap at {}", a, b, place(p))};
    };
    const std::string& name = name_of_region(model.mesh, element);
    for (const Lattice& lattice : model.lattices)
      if (in_cell(lattice, p)) return clash(lattice.name, name);
    const auto found = locator.find_before(element, p);
    if (found) return clash(name, name_of_region(model.mesh, found->element));
  }
  return std::nullopt;
}

}  // namespace

bool flush(const Lattice& lattice, const HexRegion& region, const Locator& locator) {
  const auto lies_on = [&](Vec3 x, Vec3 step) {
    const auto points = face_points(lattice, x, step);
    return std::any_of(points.begin(), points.end(), [&](Vec3 p) {
      const auto found = locator.find(p + (1e-3 * lattice.radius()) * step);
      return found && static_cast<std::size_t>(found->element) - region.first < region.count;
    });
  };
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    if (!lattice.is(s, site::particle)) continue;
    for (const Vec3 step : open_faces(lattice, s))
      if (lies_on(lattice.grid.centre(s), step)) return true;
  }
  return false;
}

std::optional<Clash> find_clash(const Model& model, const Locator& locator, bool coupled,
                                const LoosePairs& loose) {
  if (auto clash = centres_elsewhere(model, locator)) return clash;
  if (auto clash = between_hexahedra(model, locator, loose)) return clash;
  for (const Lattice& lattice : model.lattices) {
    const Surroundings around{model, locator, &lattice, coupled, loose};
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      if (lattice.is(s, site::particle))
        if (auto clash = around_particle(lattice, s, around)) return clash;
  }
  return std::nullopt;
}

}  // namespace geist::coupling
