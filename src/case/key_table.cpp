// The key table's data. A new key is one entry here and one line in extract.cpp.
//
// Units are dimensions of the case's own consistent system: stress = mass/(length·time²), force =
// mass·length/time².
#include "case/key_table.hpp"

#include "case/keys.hpp"

namespace geist {

using namespace key_builders;

namespace {

constexpr Condition hexahedra{"type", "hexahedra"}, lattice{"type", "lattice"};
constexpr Condition one_point{"formulation", "one-point"};

Table root() {
  return {
      "",
      "the whole file",
      "A case file is a TOML file. Everything it may hold is listed here; anything else is refused, with its "
      "line and column.",
      {text("title", "One line that says what the case is.").otherwise("\"\""),
       choice(
           "method", {"consistent", "published"},
           "Consistent: lattices assembled from cells, skins and edges, with bonds that bend and twist; "
           "every "
           "material point counted once where particles meet hexahedra; ghosts that turn with the continuum. "
           "Published, as in the papers: their lattice, ghosts that spin, a sphere's rotary inertia, small "
           "displacements, selective-reduced hexahedra. The last four are defaults, which their own keys "
           "change.")
           .otherwise("\"consistent\""),
       within(Type::table, "units", "units", "The units that all numbers of the file are in.").required(),
       within(Type::named, "materials", "materials.*", "What the regions are made of.").required(),
       within(Type::named, "regions", "regions.*", "The bodies: hexahedra and lattices of particles.")
           .required(),
       within(Type::table, "coupling", "coupling", "How hexahedra and particles are tied.").otherwise("{}"),
       within(Type::tables, "contact", "contact[]", "Which bodies act on each other where they touch."),
       within(Type::named, "curves", "curves.*", "Functions of time, for supports and loads."),
       within(Type::tables, "supports", "supports[]", "Where the motion is prescribed."),
       within(Type::tables, "loads", "loads[]", "Where forces act."),
       within(Type::tables, "initial", "initial[]", "Motion at time 0."),
       within(Type::table, "analysis", "analysis", "What is computed, and how.").required(),
       within(Type::named, "probes", "probes.*", "Numbers to follow over time and to report at the end."),
       within(Type::table, "output", "output", "What is written, and how often.").otherwise("{}")}};
}

Table units() {
  return {"units",
          "{ length = …, mass = …, time = … }",
          "Geist computes in the units of the file and converts nothing: the three base units fix the "
          "others. With mm, g and ms forces are in N and stresses in MPa; with mm, t and s they are as well; "
          "with m, kg and s they are in N and Pa.",
          {choice("length", {"m", "cm", "mm", "um"}, "Unit of length.").required(),
           choice("mass", {"t", "kg", "g", "mg"}, "Unit of mass.").required(),
           choice("time", {"s", "ms", "us"}, "Unit of time.").required()}};
}

Table materials() {
  return {
      "materials.*",
      "[materials.NAME]",
      "Isotropic linear elasticity.",
      {number("density", "mass/length³", "Mass per volume.").above(0).required(),
       number("young", "stress", "Young's modulus.").above(0).required(),
       number("poisson", "-",
              "Poisson's ratio; at most 1/4 in a published lattice, where k_s of equation (5) would be "
              "negative beyond. In a consistent one from 0 on (in a row of particles from -1 on); above 1/4 "
              "its cells resist dilatation beside the bonds, in small displacements only.")
           .range_is({-1, 0.5, true, true})
           .required()}};
}

/// What a region is made of, and where it is.
std::vector<Key> region_shape() {
  return {
      choice("type", {"hexahedra", "lattice"}, "What the region is made of.").required(),
      within(Type::reference, "material", "materials", "Name of the material.").required(),
      value(Type::box, "box", "length", "Lowest and highest corner."),
      value(Type::corners, "corners", "length",
            "Instead of a box: the eight corners of a block, in VTK's order (four around the bottom, "
            "counter-clockwise from above, and the four above them).")
          .when(hexahedra),
      within(Type::table, "ball", "ball", "Instead of a box: a ball, made of a core and shells around it.")
          .when(hexahedra),
      within(Type::table, "cylinder", "cylinder",
             "Instead of a box: a cylinder, every layer of which is made of a core and shells around it.")
          .when(hexahedra),
      value(Type::boxes, "boxes", "length", "Instead of one box: several, which may overlap.").when(lattice),
      value(
          Type::counts, "divisions", "-",
          "Hexahedra along the block's three directions; of a ball [core, shells]: core × core × core in the "
          "middle and so many shells around them, best about half as many; of a cylinder [core, shells, "
          "layers].")
          .range_is({1, 1e6})
          .required()
          .when(hexahedra),
      number("radius", "length", "Radius of the particles; the lattice's pitch is 2r.")
          .above(0)
          .required()
          .when(lattice)};
}

/// What is cut out of it, and how it is computed.
std::vector<Key> region_details() {
  return {
      within(Type::table, "grading", "grading", "Directions along which the hexahedra are not of one length.")
          .when(hexahedra),
      within(Type::tables, "minus", "cut", "What is cut out of the body.").when(hexahedra),
      within(Type::tables, "minus", "shape",
             "What is cut out of the boxes: sites with their centre in it stay empty.")
          .when(lattice),
      choice(
          "formulation", {"selective-reduced", "full", "assumed-strain", "one-point"},
          "Integration of the hexahedra: selective-reduced (the volumetric part at one point, the rest at "
          "2 × 2 × 2), full (all at 2 × 2 × 2), assumed-strain (one point, stabilised without a coefficient, "
          "exact in bending), or one-point with hourglass control.")
          .otherwise("\"assumed-strain\"", "\"selective-reduced\"")
          .when(hexahedra),
      choice("hourglass", {"stiffness", "viscous"}, "Form of the Flanagan–Belytschko hourglass control.")
          .otherwise("\"stiffness\"")
          .when(one_point),
      number("hourglass_coefficient", "-", "Strength of the hourglass control.")
          .range_is({0, 1})
          .otherwise("0.05")
          .when(one_point),
      choice(
          "rotary_inertia", {"sphere", "cube"},
          "Rotary inertia of a particle: 2/5 m r² of a sphere, as published, or m (2r)²/6 of the cubic cell, "
          "which allows a longer time step.")
          .otherwise("\"cube\"", "\"sphere\"")
          .when(lattice)};
}

Table regions() {
  std::vector<Key> keys = region_shape();
  for (const Key& key : region_details()) keys.push_back(key);
  return {"regions.*",
          "[regions.NAME]",
          "A block, ball or cylinder of hexahedra, or a lattice of particles: spheres of one radius r, flush "
          "with the box that "
          "they fill, "
          "their centres 2r apart. Every edge of a lattice's box is a whole number of diameters long; "
          "several boxes lie on one grid.",
          keys,
          {{true, {"box", "corners", "ball", "cylinder"}, hexahedra}, {true, {"box", "boxes"}, lattice}}};
}

Table cut() {
  return {"cut",
          "{ box = … }",
          "A piece to cut out of a block of hexahedra.",
          {value(Type::box, "box", "length", "Lowest and highest corner.").required()}};
}

Table grading() {
  return {
      "grading",
      "{ x = …, y = …, z = …, radius = … }",
      "Directions of a region of hexahedra along which their lengths grow geometrically: x, y and z are the "
      "block's own three directions. Of a ball they are those of its core, and radius is that of its shells, "
      "low at the core and high at the surface. Of a cylinder z is along the axis; x and y, across it, are "
      "the coordinate axes that follow the axis's own in the order x, y, z, x, y.",
      {within(Type::table, "x", "graded", "Along x."), within(Type::table, "y", "graded", "Along y."),
       within(Type::table, "z", "graded", "Along z."),
       within(Type::table, "radius", "graded", "Through the shells of a ball or cylinder.")},
      {{false, {"x", "y", "z", "radius"}}}};
}

Table graded() {
  return {
      "graded",
      "{ towards = …, ratio = … }",
      "Lengths of elements along one direction.",
      {choice("towards", {"low", "high", "middle", "ends"}, "Where the shortest elements are.").required(),
       number("ratio", "-", "Length of the longest element over that of the shortest one.")
           .range_is({1, 1000})
           .required()}};
}

Table shape() {
  return {"shape",
          "{ box = … }, { cylinder = … } or { ball = … }",
          "A piece to cut out of a lattice.",
          {value(Type::box, "box", "length", "Lowest and highest corner."),
           within(Type::table, "cylinder", "cylinder", "A solid cylinder."),
           within(Type::table, "ball", "ball", "A solid ball.")},
          {{true, {"box", "cylinder", "ball"}}}};
}

Table cylinder() {
  return {"cylinder",
          "{ from = …, to = …, radius = … }",
          "A solid cylinder with any axis.",
          {value(Type::vector, "from", "length", "Centre of one end face.").required(),
           value(Type::vector, "to", "length", "Centre of the other end face.").required(),
           number("radius", "length", "Radius.").above(0).required()}};
}

Table ball() {
  return {"ball",
          "{ centre = …, radius = … }",
          "A solid ball.",
          {value(Type::vector, "centre", "length", "Centre.").required(),
           number("radius", "length", "Radius.").above(0).required()}};
}

Table coupling() {
  return {
      "coupling",
      "[coupling]",
      "Ghost particles are made wherever an empty site within a bond's reach of a particle lies inside a "
      "hexahedron; nothing else needs to be said about the interfaces.",
      {choice("type", {"ghost-particles", "none"}, "How particles and hexahedra are tied.")
           .otherwise("\"ghost-particles\""),
       choice("rotation", {"continuum", "one-step-back", "none"},
              "Whether ghosts turn with the continuum (by half the curl of its displacement), spin by "
              "themselves (one-step-back, as in the journal paper) or do not turn at all (none, as in the "
              "conference paper, for comparison).")
           .otherwise("\"continuum\"", "\"one-step-back\"")}};
}

Table curves() {
  return {
      "curves.*",
      "[curves.NAME]",
      "A function of time, linear between its points and constant before the first and after the last one.",
      {value(Type::points, "points", "time, -", "The points, [[time, value], …], in order of time.")
           .required()}};
}

}  // namespace

const std::vector<Table>& key_table() {
  static const std::vector<Table> tables{root(),
                                         units(),
                                         materials(),
                                         regions(),
                                         cut(),
                                         grading(),
                                         graded(),
                                         shape(),
                                         cylinder(),
                                         ball(),
                                         coupling(),
                                         contact_table(),
                                         curves(),
                                         where_table(),
                                         supports_table(),
                                         displacement_table(),
                                         velocity_table(),
                                         loads_table(),
                                         initial_table(),
                                         analysis_table(),
                                         probes_table(),
                                         output_table(),
                                         fields_table(),
                                         every_table()};
  return tables;
}

}  // namespace geist
