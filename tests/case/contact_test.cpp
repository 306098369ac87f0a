// Contact in a case: which pairs have which law, and which regions may lie how.
#include <algorithm>

#include "case/contact_laws.hpp"
#include "small_case.hpp"

namespace geist {
namespace {

using namespace testing;
using contact::Law;

const std::string third =
    "[regions.third]\ntype = \"hexahedra\"\nmaterial = \"m\"\nbox = [[2.5, 0, 0], [3, 1, 1]]\n"
    "divisions = [1, 1, 1]\n";

std::string contact(const std::string& between, const std::string& more = "") {
  return "[[contact]]\nbetween = " + between + "\n" + more;
}

/// Hexahedra are numbered first: left 0, third 1, and then the lattice right 2.
contact::LawTable laws(const std::string& more) {
  const Case input = small_case(third + more);
  return make_contact_laws(build(input).simulation.model, input);
}

TEST(ContactOfACase, IsNoneUnlessAskedFor) {
  EXPECT_TRUE(laws("").empty());
  EXPECT_TRUE(build(small_case()).simulation.contacts.empty());
}

TEST(ContactOfACase, AllMeansAnyTwoRegionsAndEachWithItself) {
  const contact::LawTable table = laws(contact("\"all\""));
  EXPECT_EQ(table.count(), 6);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) EXPECT_GE(table.at(a, b), 0);
  const Law law = table.law(table.at(0, 2));
  EXPECT_EQ(law.normal, Law::Normal::penalty);
  EXPECT_EQ(law.factor, 1);
  EXPECT_EQ(law.restitution, 1);
  EXPECT_EQ(law.friction, 0);
}

TEST(ContactOfACase, ANamedPairOutdoesAllInAnyOrder) {
  const std::string all = contact("\"all\"", "friction = 0.1\n"),
                    named = contact("[\"right\", \"left\"]", "friction = 0.2\nrestitution = 0.5\n");
  for (const std::string& both : {all + named, named + all}) {
    const contact::LawTable table = laws(both);
    EXPECT_EQ(table.count(), 6);
    EXPECT_EQ(table.law(table.at(0, 2)).friction, 0.2);
    EXPECT_EQ(table.law(table.at(0, 2)).restitution, 0.5);
    EXPECT_EQ(table.law(table.at(0, 1)).friction, 0.1);
    EXPECT_EQ(table.law(table.at(1, 2)).restitution, 1);
  }
}

TEST(ContactOfACase, WithItself) {
  const contact::LawTable table = laws(contact("[\"right\", \"right\"]"));
  EXPECT_EQ(table.count(), 1);
  EXPECT_EQ(table.at(2, 2), 0);
}

TEST(ContactOfACase, HertzIsForParticles) {
  const contact::LawTable table = laws(contact("\"all\"", "law = \"hertz\"\n"));
  EXPECT_EQ(table.law(table.at(0, 1)).normal, Law::Normal::penalty);
  EXPECT_EQ(table.law(table.at(0, 2)).normal, Law::Normal::hertz);
}

TEST(ContactOfACase, ShortensTheTimeStep) {
  EXPECT_LT(build(small_case(third + contact("\"all\"", "stiffness_factor = 100\n"))).simulation.dt,
            0.5 * build(small_case(third)).simulation.dt);
}

TEST(ContactOfACase, ABodyHeldAltogetherHasATimeStep) {
  const std::string text = materials +
                           "[regions.a]\ntype = \"hexahedra\"\nmaterial = \"m\"\nbox = [[0, 0, 0], [1, 1, "
                           "1]]\ndivisions = [1, 1, 1]\n[[supports]]\nwhere = { x = [0, 1] }\n"
                           "fix = [\"x\", \"y\", \"z\"]\n" +
                           dynamic;
  const double dt = build(read_case_text(text, "small.toml")).simulation.dt;
  EXPECT_TRUE(dt > 0 && std::isfinite(dt)) << dt;
}

TEST(ContactOfACase, ProbesSumItsForces) {
  const Built built = build(small_case(
      third + contact("\"all\"") +
      "[probes.p]\nwhere = { region = \"third\" }\nquantity = \"contact-force\"\ncomponent = \"x\"\n"));
  EXPECT_EQ(built.probes.at(0).quantity, Probe::Quantity::contact_force);
  EXPECT_EQ(built.probes.at(0).reduce, Probe::Reduce::sum);
  EXPECT_EQ(built.probes.at(0).value(built.simulation), 0);
}

/// A region that meets `right` (x from 1 to 2, r = 0.125) or `left` (x from 0 to 1) in some way.
std::string with(const std::string& region, const std::string& contact_with) {
  const std::string named = contact_with.empty() ? "" : contact("[\"third\", \"" + contact_with + "\"]");
  return materials + two_regions + dynamic + "[regions.third]\nmaterial = \"m\"\n" + region + named;
}
Model made(const std::string& region, const std::string& contact_with) {
  return build(read_case_text(with(region, contact_with), "small.toml")).simulation.model;
}
std::string block(const std::string& box, const std::string& divisions) {
  return "type = \"hexahedra\"\nbox = " + box + "\ndivisions = " + divisions + "\n";
}

TEST(RegionsInContact, LatticesMayTouchOrLeaveASmallGap) {
  for (const std::string x : {"2", "2.05", "2.2"}) {
    const std::string lattice = "type = \"lattice\"\nbox = [[" + x + ", 0, 0], [" +
                                std::to_string(std::stod(x) + 1) + ", 1, 1]]\nradius = 0.125\n";
    EXPECT_NO_THROW(made(lattice, "right")) << x;
    EXPECT_THROW(made(lattice, ""), CaseError) << x;
  }
}

TEST(RegionsInContact, MayNotOverlap) {
  expect_build_error(with(block("[[1.9, 0, 0], [3, 1, 1]]", "[2, 2, 2]"), "right"), "[regions.right]",
                     {"overlap at ("});
  expect_build_error(with(block("[[-1, 0, 0], [0.1, 1, 1]]", "[2, 2, 2]"), "left"), "[regions.left]",
                     {"overlap at ("});
}

TEST(RegionsInContact, ALatticeNearHexahedraIsNotBonded) {
  const std::string near = block("[[2.05, 0, 0], [3, 1, 1]]", "[2, 2, 2]");
  EXPECT_THROW(made(near, ""), CaseError);
  const Model model = made(near, "right");
  for (const Ghost& ghost : model.lattices[0].ghosts) EXPECT_LT(ghost.element, 8);  // those of `left`
  EXPECT_EQ(model.lattices[0].ghosts.size(), 16u);
}

TEST(RegionsInContact, ALatticeFlushOnHexahedraIsBonded) {
  EXPECT_EQ(made(block("[[2, 0, 0], [3, 1, 1]]", "[2, 2, 2]"), "right").lattices[0].ghosts.size(), 32u);
}

TEST(RegionsInContact, HexahedraShareNoNodes) {
  const std::string flush = block("[[-1, 0, 0], [0, 1, 1]]", "[1, 2, 2]");
  EXPECT_EQ(made(flush, "").mesh.nodes(), 27u + 9);
  EXPECT_EQ(made(flush, "left").mesh.nodes(), 27u + 18);
  const std::string other = block("[[-1, 0, 0], [0, 1, 1]]", "[1, 3, 3]");
  EXPECT_THROW(made(other, ""), CaseError);
  EXPECT_EQ(made(other, "left").mesh.nodes(), 27u + 32);
}

}  // namespace
}  // namespace geist
