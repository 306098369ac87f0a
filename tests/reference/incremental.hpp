// The published algorithm, (15)–(27) of the journal paper, written down literally and slowly: the yardstick
// of the fast kernels. It shares nothing with them but the element formulations: particles and ghosts are
// found by trying all positions, bonds by trying all pairs, and every bond keeps its own d of (23) in its own
// axes.
//
// Two things are settled as in the method's description: the moment on a ghost is the mechanical one,
// m_g = r_g × f_g, and a particle weighs what its cell weighs.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "geometry/shapes.hpp"
#include "model/material.hpp"

namespace geist::reference {

/// What a body is made of.
struct Description {
  struct Hexahedron {
    std::array<std::int32_t, 8> node;
    Material material;
    std::string formulation;
    double hourglass_coefficient = 0;
  };
  std::vector<Vec3> nodes;
  std::vector<Hexahedron> hexahedra;
  std::vector<Box> lattice;  ///< the union of these boxes is filled with particles
  Material lattice_material;
  double radius = 0;
  bool cube_inertia = false;  ///< m (2r)²/6 instead of 2/5 m r²
  bool ghosts_spin = true;    ///< "one-step back"; otherwise ω_g = 0
};

/// A mass point with a rotation: node (no rotation), particle, or ghost (no translation of its own).
struct Point {
  Vec3 X;
  double mass = 0, inertia = 0;  ///< zero inertia: no rotation
  Vec3 u{}, theta{};             ///< accumulated v Δt and ω Δt
  Vec3 v{}, omega{};             ///< at t^n, or at t^{n+1/2} in the course of a step
  Vec3 f{}, m{};                 ///< force and moment at t^n
  Vec3 load{};                   ///< constant force
  bool held = false;             ///< v = 0
};

/// A ghost's place in its hexahedron.
struct Rider {
  std::size_t hexahedron;
  std::array<double, 8> N;
};

/// A pair of particles, or a particle and a ghost.
struct Bond {
  std::size_t i, j;    ///< i is a particle
  bool to_ghost;       ///< whether j is a ghost
  Vec3 n, s, t;        ///< axes: from i to j, and two across
  double k_n, k_s;     ///< (5)
  double half_length;  ///< from either centre to the contact point c
  Vec3 d;              ///< (23) in the axes n, s, t
};

class Incremental {
 public:
  explicit Incremental(const Description& description);

  std::vector<Point> nodes, particles, ghosts;
  std::vector<Rider> riders;  ///< by ghost
  std::vector<Bond> bonds;

  /// Forces at t^0, with d = 0 and u = 0.
  void start() { forces(); }

  /// One step: velocities and forces from t^n to t^{n+1}.
  void step(double dt);

  /// Move with the present velocities for a time dt and find the forces: (19)–(23), (3), (13), (14), (1).
  void move(double dt);

  /// ½ Σ d·K d of the bonds.
  double bond_energy() const;

 private:
  void half_kick(double dt);
  void bond_forces();
  void element_forces();
  void forces();
  Vec3 ghost_velocity(std::size_t g) const;
  void find_particles();
  void find_ghosts();
  void find_bonds();
  void lump_masses();

  Description description_;
};

/// Shape functions (8).
std::array<double, 8> shape(Vec3 xi);

}  // namespace geist::reference
