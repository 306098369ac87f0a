// What the statics ask of a model: its forces at rest, how they change with a motion, and the motion itself.
// Vectors have six numbers a place. Forces come from the kernels of a step.
#pragma once
#include <string>

#include "solver/places.hpp"
#include "solver/simulation.hpp"

namespace geist {

/// A simulation's model, undeformed to begin with; velocities stay as they are.
class StaticModel {
 public:
  StaticModel(Simulation& sim, std::size_t block_size);
  ~StaticModel() { swap_velocities(); }
  StaticModel(const StaticModel&) = delete;
  StaticModel& operator=(const StaticModel&) = delete;

  const Places& places() const { return places_; }
  bool turns() const { return turns_; }  ///< whether anything has finite rotations

  /// What the supports prescribe in the end, zero elsewhere: displacements and rotation vectors.
  PlaceVector prescribed() const;

  /// Why that cannot be prescribed, in words; empty if it can.
  std::string refusal(const PlaceVector& prescribed) const;

  /// r = factor · loads + forces of elements and bonds. Where components are held this is minus the reaction.
  void residual(double factor, PlaceVector& r);
  /// q = −K p, K the tangent at the state of the last residual().
  void tangent(const PlaceVector& p, PlaceVector& q);
  /// Move by p: displacements add, rotations R ← exp(p×) R.
  void move(const PlaceVector& p);

  /// Let the simulation's model have the present state; tangent() leaves it somewhere near.
  void show();

  /// A state to come back to.
  struct State {
    PlaceVector x, rotation;
  };
  State state() const { return {x_, rotation_}; }
  void back_to(State state);

  /// Out of balance over free components, and the reactions: moments count as moment / r.
  struct Norms {
    double free = 0, held = 0;
    Norms& operator+=(const Norms& b) { return free += b.free, held += b.held, *this; }
  };
  Norms norms(const PlaceVector& r) const;

 private:
  void swap_velocities();
  void add_loads();
  void show(const PlaceVector& p, double factor);
  void turn(Lattice& lattice, std::int32_t l, const PlaceVector& p, double factor);
  void find_forces(PlaceVector& f);
  double largest(const PlaceVector& p, double length) const;

  Simulation& sim_;
  Model& model_;
  const Places places_;
  const bool turns_;
  double length_;         ///< smallest edge or pitch
  PlaceVector load_, x_;  ///< x: displacements, and rotations of lattices with small ones
  PlaceVector rotation_;  ///< nine numbers a place: R − I of lattices with finite rotations
  PlaceVector present_, other_, internal_;
};

}  // namespace geist
