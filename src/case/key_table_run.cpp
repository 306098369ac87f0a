// The key table's data, second part: contact, supports, loads, the analysis, probes and output.
#include "case/key_table.hpp"

namespace geist {

using namespace key_builders;

namespace {

constexpr Condition dynamic{"type", "dynamic"}, quasi_static{"type", "quasi-static"},
    statics{"type", "static"};
constexpr Condition no_gravity{"gravity", {}, true};

Key where(std::string_view say) { return within(Type::table, "where", "where", say); }
Key curve(std::string_view say) { return within(Type::reference, "curve", "curves", say); }

/// Six components, of the unit for translations and the one for rotations.
std::vector<Key> components(std::string_view along, std::string_view about) {
  return {number("x", along, "Along x."),
          number("y", along, "Along y."),
          number("z", along, "Along z."),
          number("rx", about, "About x, of particles."),
          number("ry", about, "About y, of particles."),
          number("rz", about, "About z, of particles.")};
}

}  // namespace

Table contact_table() {
  return {
      "contact[]",
      "[[contact]]",
      "Contact between bodies: without it they pass through each other. Stiffnesses come from the materials. "
      "A pair that is named outdoes \"all\". Regions of a named pair may touch or leave any gap: blocks of "
      "hexahedra share no nodes then, and need no matching divisions. Only a lattice that lies flush on "
      "hexahedra is bonded to them by ghosts as ever (unless the coupling's type is none).",
      {within(Type::pair, "between", "regions",
              "The two regions; the same one twice for contact with itself; or \"all\" for any two and each "
              "with "
              "itself.")
           .required(),
       choice("law", {"penalty", "hertz"},
              "Normal force: linear in the overlap (penalty), or Hertz' law of spheres, for pairs with "
              "particles; "
              "hexahedra deform by themselves, so where \"all\" means two of them it stands for penalty.")
           .otherwise("\"penalty\""),
       number("stiffness_factor", "-", "Multiplies the stiffness that the materials give.")
           .above(0)
           .otherwise("1"),
       number("restitution", "-",
              "Speed after / speed before a central collision of two particles; less than 1 adds damping. "
              "Between "
              "hexahedra it calms nodes that slide over the edges of facets (0.3 does).")
           .range_is({0.01, 1})
           .otherwise("1"),
       number("friction", "-", "Coulomb's coefficient.").at_least(0).otherwise("0")}};
}

Table where_table() {
  return {
      "where",
      "{ x = …, y = …, z = …, region = … }",
      "A selection of nodes and particles; every condition given must hold. A plane selects the nodes on it "
      "and the particles whose cell touches it; an interval selects nodes and particle centres within.",
      {value(Type::interval, "x", "length", "The plane at this x, or an interval of x."),
       value(Type::interval, "y", "length", "The plane at this y, or an interval of y."),
       value(Type::interval, "z", "length", "The plane at this z, or an interval of z."),
       within(Type::reference, "region", "regions", "Only nodes or particles of this region.")},
      {{false, {"x", "y", "z", "region"}}}};
}

Table supports_table() {
  return {
      "supports[]",
      "[[supports]]",
      "Prescribed motion: components that are fixed, or that follow a given displacement or velocity.",
      {where("The nodes and particles that are supported.").required(),
       choice("fix", {"x", "y", "z", "rx", "ry", "rz"},
              "Components that stay at rest; rx, ry and rz are the rotations of particles.", Type::choices),
       within(Type::table, "displacement", "displacement",
              "Displacement at the time when the curve is 1; it needs a curve, for it cannot jump."),
       within(Type::table, "velocity", "velocity", "Velocity, multiplied by the curve where one is named."),
       curve("The function of time that multiplies displacement and velocity.")
           .required_when({"displacement", {}})},
      {{false, {"fix", "displacement", "velocity"}}}};
}

Table displacement_table() {
  return {"displacement",
          "{ x = …, y = …, z = …, rx = …, ry = …, rz = … }",
          "Components of a prescribed displacement; those not named are free. A static analysis with "
          "kinematics = \"finite\" wants all three rotations prescribed or fixed, or none prescribed.",
          components("length", "radians"),
          {{false, {"x", "y", "z", "rx", "ry", "rz"}}}};
}

Table velocity_table() {
  return {"velocity",
          "{ x = …, y = …, z = …, rx = …, ry = …, rz = … }",
          "Components of a prescribed velocity; those not named are free.",
          components("length/time", "radians/time"),
          {{false, {"x", "y", "z", "rx", "ry", "rz"}}}};
}

Table loads_table() {
  return {"loads[]",
          "[[loads]]",
          "A load: exactly one of a total force, a traction, or gravity.",
          {where("The surface that the load acts on.").required().when(no_gravity),
           value(Type::vector, "total_force", "force",
                 "Force on the whole selection, spread over its nodes and particles by tributary area."),
           value(Type::vector, "traction", "stress", "Force per area."),
           value(Type::vector, "gravity", "length/time²", "Acceleration of gravity, on everything."),
           curve("The function of time that multiplies the load; without it the load is constant.")},
          {{true, {"total_force", "traction", "gravity"}}}};
}

Table initial_table() {
  return {"initial[]",
          "[[initial]]",
          "Motion at time 0: velocity + spin × (X − about) at every point X selected; particles spin too.",
          {where("The nodes and particles that move; without it, all."),
           value(Type::vector, "velocity", "length/time", "Velocity."),
           value(Type::vector, "spin", "radians/time", "Angular velocity."),
           value(Type::vector, "about", "length", "A point of the axis of the spin.")
               .otherwise("[0, 0, 0]")
               .when({"spin", {}})},
          {{false, {"velocity", "spin"}}}};
}

Key kinematics() {
  return choice(
      "kinematics", {"small", "finite"},
      "Displacements: small, with directions frozen as in the papers; or finite, in axes that turn with "
      "every hexahedron and every particle: rotations may be any, strains moderate.");
}

/// What is computed, from where, until when.
std::vector<Key> analysis_kind() {
  return {
      choice("type", {"dynamic", "static", "quasi-static"}, "What is computed.").required(),
      choice("start", {"undeformed", "static"},
             "Where the motion begins: undeformed, or (static) in equilibrium under loads and displacements "
             "as they "
             "are at time 0; [[initial]] adds its velocities.")
          .otherwise("\"undeformed\"")
          .when(dynamic),
      kinematics().otherwise("\"small\"").when({"start", "static"}),
      kinematics().otherwise("\"finite\"", "\"small\"").when(dynamic),
      kinematics().otherwise("\"small\"").when({"type", "dynamic", true}),
      number("duration", "time",
             "Dynamic: the end of the run. Quasi-static: where to give up (without it, "
             "after max_steps).")
          .above(0)
          .required_when(dynamic)};
}

/// How it is found.
std::vector<Key> analysis_steps() {
  return {
      number("tolerance", "-",
             "The solution is found when the residual force, relative to the load, is below this.")
          .range_is({0, 1, true, true})
          .otherwise("1e-8")
          .when(statics),
      value(Type::integer, "max_iterations", "-", "Where to give up; a hundred iterations are usual.")
          .at_least(1)
          .otherwise("10000")
          .when(statics),
      number("tolerance", "-", "The run ends when the residual force, relative to the load, is below this.")
          .range_is({0, 1, true, true})
          .otherwise("1e-6")
          .when(quasi_static),
      value(Type::integer, "max_steps", "-", "Where to give up in any case.")
          .at_least(1)
          .otherwise("10000000"),
      number("safety", "-", "Time step relative to the safe bound that Geist computes for the case.")
          .range_is({0, 1, true, false})
          .otherwise("0.9"),
      number("time_step", "time",
             "Time step, instead of the one computed; it must not exceed the safe bound.")
          .above(0),
      boolean(
          "subcycling",
          "Small elements, or the lattices with what their ghosts ride on, take shorter steps than the rest, "
          "where that saves time and no time_step is given; Geist finds out which and how many.")
          .otherwise("true", "false")
          .when(dynamic),
      number("damping", "1/time", "Viscous damping proportional to mass: f = −damping·m·v.")
          .at_least(0)
          .otherwise("0")
          .when(dynamic),
      number(
          "balance_tolerance", "-",
          "The run is stopped when the energy balance is off by more than this share of the energies' sum.")
          .above(0)
          .otherwise("0.05")};
}

Table analysis_table() {
  std::vector<Key> keys = analysis_kind();
  for (const Key& key : analysis_steps()) keys.push_back(key);
  return {
      "analysis", "[analysis]",
      "Either the motion over a given time (dynamic), or the state of rest under the loads: solved for at "
      "once "
      "(static), or found by adaptive dynamic relaxation (quasi-static), which takes a hundred times longer "
      "but also "
      "contact. Both take loads and supports as they are when no curve changes any more. A static analysis "
      "has no "
      "time: what is said about time and steps has no meaning for it.",
      keys};
}

Table probes_table() {
  constexpr Condition reaction{"quantity", "reaction"}, contact_force{"quantity", "contact-force"};
  const std::vector<std::string_view> ways{"mean", "min", "max", "sum"};
  return {
      "probes.*",
      "[probes.NAME]",
      "One number over time, from all nodes and particles of a selection.",
      {where("The nodes and particles looked at.").required(),
       choice("quantity", {"displacement", "velocity", "rotation", "reaction", "contact-force"},
              "What is looked at; only particles have a rotation, only supports a reaction; a "
              "contact-force needs [[contact]].")
           .required(),
       choice("component", {"x", "y", "z", "magnitude"},
              "A component, or the magnitude of each vector (of a reaction or contact-force: of the sum).")
           .required(),
       choice("reduce", {"sum"}, "A reaction is that of all supports in the selection together.")
           .otherwise("\"sum\"")
           .when(reaction),
       choice("reduce", {"sum"}, "A contact-force is that on the whole selection.")
           .otherwise("\"sum\"")
           .when(contact_force),
       choice("reduce", ways, "Of other quantities: how the selection's values become one.")
           .otherwise("\"mean\""),
       number("expected", "that of the quantity",
              "A value to show the final one beside, with the difference."),
       text("expected_from", "Where the expected value comes from.").when({"expected", {}})}};
}

Table output_table() {
  return {
      "output",
      "[output]",
      "What is written. Fields are for ParaView; the history has the probes, the energies and the residual.",
      {within(Type::table, "fields", "fields", "When fields are written; without it, at the end only."),
       within(Type::table, "history", "every",
              "How often a row of the history is written; without it, about 1000 rows of a dynamic run, but "
              "at most one in 20 steps."),
       boolean("compress", "Whether field files are compressed.").otherwise("true"),
       choice("precision", {"double", "single"},
              "Of displacements and rotations in field files: every digit, which strains made from them need "
              "where a body has moved far; or seven, which halves the files. What is derived from them "
              "(velocities, stresses, energies) has seven anyway.")
           .otherwise("\"double\"")}};
}

Table fields_table() {
  return {
      "fields",
      "{ every = …, at = […] }",
      "When fields are written, besides the beginning and the end.",
      {number("every", "time", "Time from one picture to the next.").above(0),
       value(Type::numbers, "at", "time", "Instants: the first step at or after each.").range_is({0, {}})},
      {{false, {"every", "at"}}}};
}

Table every_table() {
  return {"every",
          "{ every = … }",
          "An interval of output.",
          {number("every", "time", "Time from one output to the next.").above(0).required()}};
}

}  // namespace geist
