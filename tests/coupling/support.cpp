#include "coupling/support.hpp"

#include <algorithm>
#include <cmath>

namespace geist::coupling::testing {

Builder& Builder::hexahedra(const std::string& name, const Box& box, const std::array<int, 3>& divisions,
                            const std::vector<Box>& minus) {
  steps_.push_back([=](Model& model) {
    HexRegion region;
    region.name = name;
    append_block(model.mesh, region, corners_of(box), divisions, minus);
  });
  return *this;
}

Builder& Builder::particles(const std::string& name, const std::vector<Box>& boxes, double radius,
                            const std::vector<Shape>& minus) {
  steps_.push_back([=](Model& model) {
    Lattice lattice;
    lattice.name = name;
    lattice.material = {"stone", 2.5, 30, 0.2};
    pack(lattice, boxes, minus, radius);
    lattice.mass = 2.5 * std::pow(2 * radius, 3), lattice.inertia = 0.4 * lattice.mass * radius * radius;
    model.lattices.push_back(std::move(lattice));
  });
  return *this;
}

Builder& Builder::move_nodes(const std::function<Vec3(Vec3)>& moved) {
  steps_.push_back([=](Model& model) {
    for (Vec3& p : model.mesh.points) p = moved(p);
  });
  return *this;
}

Model Builder::made() const {
  Model model;
  for (const auto& step : steps_) step(model);
  finish(model.mesh);
  return model;
}

std::optional<Clash> Builder::clash() const {
  Model model = made();
  const Locator locator(model.mesh);
  for (Lattice& lattice : model.lattices) place_ghosts(lattice, model.mesh, locator);
  return find_clash(model, locator);
}

Model Builder::couple() const {
  Model model = made();
  const Locator locator(model.mesh);
  for (Lattice& lattice : model.lattices) {
    place_ghosts(lattice, model.mesh, locator);
    trim(lattice), connect(lattice), finish(lattice);
    list_sites(lattice, {});
  }
  return model;
}

std::vector<std::array<long, 3>> places(const std::vector<Vec3>& points, double radius) {
  std::vector<std::array<long, 3>> found;
  const double unit = radius / 1000;
  for (const Vec3 p : points)
    found.push_back({std::lround(p.x / unit), std::lround(p.y / unit), std::lround(p.z / unit)});
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::array<long, 3>> ghost_places(const Lattice& lattice) {
  std::vector<Vec3> points;
  for (const Ghost& ghost : lattice.ghosts) points.push_back(lattice.grid.centre(ghost.site));
  return places(points, lattice.radius());
}

}  // namespace geist::coupling::testing
