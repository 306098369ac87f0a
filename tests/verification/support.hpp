// What the verification tests share: cases from the examples, and the literal reference of a case.
#pragma once
#include <string>
#include <vector>

#include "case/build.hpp"
#include "case/read.hpp"
#include "reference/incremental.hpp"
#include "solver/run.hpp"

namespace geist::verification {

/// examples/<name>/case.toml with --set options.
Case example(const std::string& name, const std::vector<std::string>& set = {});

/// The same by the published method.
Case published(const std::string& name, std::vector<std::string> set = {});

/// Run it on one thread to its end.
Outcome run_to_end(const Case& input, Built& built, const std::vector<Observer*>& observers = {});

/// The value of the probe `tip` after a quasi-static run, which must have converged.
double static_tip(const Case& input);

/// The options that make a region of the beam a block of hexahedra with these divisions.
std::string hexahedra(const std::string& region, double from, double to, const std::string& divisions);

/// The same body and the same loads, supports and initial motion for the literal algorithm. The mesh is taken
/// over, the lattice is made anew from its boxes.
reference::Incremental reference_of(const Case& input, const Simulation& sim);

/// Site of the lattice whose centre is X, which must be one.
std::size_t site_at(const Lattice& lattice, Vec3 X);

}  // namespace geist::verification
