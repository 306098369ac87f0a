// Loads: forces on nodes and particles, and gravity, with their work.
#pragma once
#include <cstdint>
#include <vector>

#include "core/vec.hpp"
#include "model/model.hpp"
#include "solver/curve.hpp"

namespace geist {

/// A force on one node, or on one particle by its place in its lattice's list.
struct NodeForce {
  std::int32_t node;
  Vec3 force;
};
struct ParticleForce {
  std::int32_t lattice;
  std::size_t site;
  std::int32_t slot;  ///< set once the lattice's list is made
  Vec3 force;
};

/// Forces that vary together by one curve; or an acceleration of everything that has mass.
struct Load {
  Curve curve;
  std::vector<NodeForce> nodes;
  std::vector<ParticleForce> particles;
  Vec3 gravity;  ///< acceleration; zero for other loads
  bool is_gravity = false;

  double work = 0;                      ///< done since the start
  double q_settled = 0, t_settled = 0;  ///< up to when work is known, and q = Σ F·u then
};

/// Add all forces at time t to mesh.f and the listed forces.
void add_loads(const std::vector<Load>& loads, Model& model, double t);

/// Acceleration of gravity at time t.
Vec3 gravity(const std::vector<Load>& loads, double t);

/// Bring every load's work up to model.time by the trapezoidal rule, W += ½ (c^n + c^{n+1}) (q^{n+1} − q^n),
/// q = Σ F·u. Where the curve stays constant until `until`, it may wait: nothing is lost, and steps stay
/// cheap.
void settle(std::vector<Load>& loads, const Model& model, double until);

/// Every load's work as if it had grown in proportion to the displacement: W = ½ c q.
void reckon_proportional(std::vector<Load>& loads, const Model& model);

/// √Σ|F|² of all forces at time t.
double norm(const std::vector<Load>& loads, const Model& model, double t);

}  // namespace geist
