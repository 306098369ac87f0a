// Case: a validated case file as plain data. Made by read.hpp, turned into a Simulation by build.hpp.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/vec.hpp"
#include "geometry/shapes.hpp"
#include "geometry/solids.hpp"
#include "model/material.hpp"
#include "solver/curve.hpp"

namespace geist {

/// Place of something in the case file, for messages.
struct Source {
  int line = 0, column = 0;
  std::string text;    ///< the offending text: a key, a value, or the name of a table
  std::string origin;  ///< the --set option that it, or something in it, comes from; else empty
};

struct Units {
  std::string length, mass, time;
};

/// A block, ball or cylinder of hexahedra, or what is left of it when `minus` is cut out.
struct HexahedraSpec {
  Body body;  ///< a block is given by its corners in VTK's order; `box` in the file is the special case
  Gradings gradings;
  std::vector<Box> minus;
  std::string formulation;  ///< "selective-reduced", "full", "assumed-strain", "one-point"
  std::string hourglass;    ///< "stiffness", "viscous"; for "one-point"
  double hourglass_coefficient;
};

/// Flush cubic packing in the union of boxes minus shapes.
struct LatticeSpec {
  std::vector<Box> boxes;
  std::vector<Shape> minus;
  double radius;
  std::string rotary_inertia;  ///< "sphere", "cube"
};

struct RegionSpec {
  std::string name, material;
  std::variant<HexahedraSpec, LatticeSpec> shape;
  Source source;
};

/// Which nodes and particles: every condition must hold. Equal ends make a plane.
struct Where {
  struct Interval {
    double low, high;
    bool plane() const { return low == high; }
  };
  std::array<std::optional<Interval>, 3> axis;
  std::optional<std::string> region;
  Source source;
};

/// How the bodies of a pair of regions act on each other where they touch.
struct ContactSpec {
  /// Two regions, or the same one twice; none: any two, and each with itself.
  struct Between {
    std::optional<std::array<std::string, 2>> regions;
  } between;
  std::string law;  ///< "penalty", "hertz"
  double stiffness_factor, restitution, friction;
  Source source;
};

struct SupportSpec {
  Where where;
  std::array<bool, 6> fixed{};                        ///< x y z rx ry rz
  std::array<std::optional<double>, 6> displacement;  ///< × curve(t)
  std::array<std::optional<double>, 6> velocity;      ///< × curve(t) (1 where no curve is named)
  std::string curve;                                  ///< name, or empty
  Source source;
};

struct LoadSpec {
  enum class Kind { total_force, traction, gravity } kind;
  Vec3 value;
  std::optional<Where> where;  ///< gravity acts on everything
  std::string curve;           ///< name, or empty: constant 1
  Source source;
};

/// Motion at time 0: v = velocity + spin × (X − about); particles and ghosts spin too.
struct InitialSpec {
  Where where;
  Vec3 velocity, spin, about;
  Source source;
};

struct ProbeSpec {
  std::string name;
  Where where;
  std::string quantity;            ///< "displacement", "velocity", "rotation", "reaction", "contact-force"
  std::string component;           ///< "x", "y", "z", "magnitude"
  std::string reduce;              ///< "mean", "min", "max", "sum"
  std::optional<double> expected;  ///< shown beside the final value
  std::string expected_from;       ///< where it comes from, or empty
  Source source;
};

struct AnalysisSpec {
  std::string type;                  ///< "dynamic", "quasi-static", "static"
  std::string start = "undeformed";  ///< dynamic: or "static", at equilibrium under the loads of time 0
  std::string kinematics = "small";  ///< or "finite"
  double duration = 0;               ///< dynamic: the end; quasi-static: give up then (0: after max_steps)
  double tolerance = 1e-6;           ///< static, quasi-static: residual / load
  long max_iterations = 10'000;      ///< static
  long max_steps = 10'000'000;
  double safety = 0.9;              ///< time step / safe bound
  std::optional<double> time_step;  ///< overrides the above; must not exceed the bound
  bool subcycling =
      false;           ///< dynamic: what limits the step may take shorter ones, unless time_step is given
  double damping = 0;  ///< α of f = −α m v, 1/time; dynamic only
  double balance_tolerance = 0.05;  ///< stop when the energy balance leaves this share of the energies' sum
  Source source;
};

struct OutputSpec {
  std::optional<double> fields_every,
      history_every;              ///< in time; absent: fields at the ends only, 1000 rows or less
  std::vector<double> fields_at;  ///< in time, beside the above
  bool compress = true;
  std::string precision = "double";  ///< of the state in field files: "double" or "single"
};

struct Case {
  std::string file, title;
  Units units;
  std::string method = "consistent";  ///< or "published"
  std::map<std::string, Material> materials;
  std::vector<RegionSpec> regions;           ///< in file order
  std::string coupling = "ghost-particles";  ///< or "none"
  std::string rotation = "continuum";        ///< or "one-step-back", "none"
  Source coupling_source;
  std::vector<ContactSpec> contact;
  std::map<std::string, Curve> curves;
  std::vector<SupportSpec> supports;
  std::vector<LoadSpec> loads;
  std::vector<InitialSpec> initial;
  AnalysisSpec analysis;
  std::vector<ProbeSpec> probes;
  OutputSpec output;
  std::string toml;      ///< the complete case as run, defaults filled in, as TOML
  std::string original;  ///< the file as read, for messages
};

}  // namespace geist
