// What is measured: cubes of particles and of hexahedra, built from case texts as the program builds them.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "case/build.hpp"
#include "work.hpp"

namespace geist::bench {

/// A piece of a step that can be called by itself, over and over, without changing the state.
struct Kernel {
  std::string name;
  std::function<void()> run;
  Work work;
};

/// A cube, one face held and the opposite one pulled, in smooth motion.
struct Subject {
  std::string name;             ///< "lattice", or a formulation of hexahedra; then what follows
  int edge = 0;                 ///< particles or elements along an edge
  double items = 0;             ///< particles or elements
  std::size_t working_set = 0;  ///< bytes that a step touches
  double build_seconds = 0;
  Work step;  ///< of a whole step
  Built built;
  std::vector<Kernel> kernels;

  Simulation& simulation() { return built.simulation; }
  std::string size() const;
};

/// Behind the material any of: "+contact", another body is near, all may touch, and nothing does; "+finite",
/// rotations are finite; "+consistent", a lattice's method is.
std::unique_ptr<Subject> make_subject(const std::string& name, int edge);

}  // namespace geist::bench
