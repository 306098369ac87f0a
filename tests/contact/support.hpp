// What the tests of contact share: models made of boxes by hand, and surfaces to probe.
#pragma once
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "contact/contacts.hpp"
#include "contact/search.hpp"
#include "contact/surface.hpp"
#include "contact/touch.hpp"
#include "geometry/shapes.hpp"
#include "model/model.hpp"

namespace geist::contact::testing {

inline const Material stone{"stone", 2.5, 30, 0.2}, soft{"soft", 1, 12, 0.3};

/// Numbers of order 1, always the same.
class Random {
 public:
  explicit Random(int seed) : engine_(seed) {}
  double number(double low = -1, double high = 1) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 vector(double scale = 1) { return scale * Vec3{number(), number(), number()}; }
  Vec3 unit();

 private:
  std::mt19937 engine_;
};

/// Collects regions; made() lumps masses and connects bonds. Hexahedra first, as everywhere.
class Builder {
 public:
  Builder& hexahedra(const Box& box, const std::array<int, 3>& divisions, const std::vector<Box>& minus = {},
                     const Material& material = stone);
  Builder& particles(const Box& box, double radius, const Material& material = stone);
  /// Move nodes of the reference state.
  Builder& move_nodes(const std::function<Vec3(Vec3)>& moved);
  /// Support all three components of the nodes that `where` says.
  Builder& hold(const std::function<bool(Vec3)>& where);
  /// Ghosts are placed where lattices meet hexahedra.
  Builder& coupled();
  /// Kick all particles from the list.
  Builder& list_all();
  Model made() const;

 private:
  std::vector<std::function<void(Model&)>> steps_;
  std::function<bool(Vec3)> held_;
  bool coupled_ = false, listed_ = false;
};

/// A surface at the reference positions of its model, that can be probed.
class Probed {
 public:
  explicit Probed(const Builder& builder);
  Touch sphere(Vec3 x, double radius) const;
  /// A node that faces `outward`.
  Touch node(Vec3 x, Vec3 outward, double reach) const;

  Model model;
  Surface surface;
  Field<3> x;
  std::vector<std::int32_t> all;
};

/// d: displacement along the shortest way out.
inline Vec3 way(const Touch& t) { return t.count ? t.overlap * t.normal : Vec3{}; }

LawTable one_law(std::size_t regions, std::int32_t a, std::int32_t b, const Law& law);

/// Velocities, and displacements if wanted, at random.
void move_at_random(Model& model, Random& random, double displacement, double velocity);

}  // namespace geist::contact::testing
