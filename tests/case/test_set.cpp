// --set changes a case as if the file had said so.
#include <gtest/gtest.h>

#include "case/malformed.hpp"
#include "case/read.hpp"

namespace geist {

namespace {

Case read_with(const std::vector<std::string>& set) { return read_case_text(good_case, "case.toml", set); }

TEST(Set, Number) {
  EXPECT_EQ(std::get<LatticeSpec>(read_with({"regions.middle.radius=0.125"}).regions[1].shape).radius, 0.125);
  EXPECT_EQ(read_with({" materials . polymer . young = 2_000 "}).materials.at("polymer").young, 2000);
}

TEST(Set, WordWithoutQuotes) {
  const Case changed = read_with({"regions.left.formulation=full", "title=Another block"});
  EXPECT_EQ(std::get<HexahedraSpec>(changed.regions[0].shape).formulation, "full");
  EXPECT_EQ(changed.title, "Another block");
  EXPECT_EQ(read_with({"title='In quotes = here'"}).title, "In quotes = here");
}

TEST(Set, ListsAndEntriesOfLists) {
  const Case changed = read_with({"regions.left.divisions=[14, 4, 2]", "loads.0.total_force=[0, 0, -2]"});
  const auto& left = std::get<HexahedraSpec>(changed.regions[0].shape);
  EXPECT_EQ(std::get<BlockBody>(left.body).divisions, (std::array<int, 3>{14, 4, 2}));
  EXPECT_EQ(changed.loads[0].value.z, -2);
  EXPECT_EQ(read_with({"loads.0.total_force.2=-3"}).loads[0].value, (Vec3{0, 0, -3}));
}

TEST(Set, LaterOptionsWin) {
  EXPECT_EQ(read_with({"analysis.safety=0.5", "analysis.safety=0.7"}).analysis.safety, 0.7);
}

TEST(Set, NewKeysAndTables) {
  const Case changed = read_with({"output.fields.every=2", "coupling.rotation=none",
                                  "initial.0.velocity=[1, 0, 0]", "loads.1={ gravity = [0, 0, -9.81] }"});
  EXPECT_EQ(changed.output.fields_every, 2);
  EXPECT_EQ(changed.rotation, "none");
  EXPECT_EQ(changed.initial.at(0).velocity.x, 1);
  EXPECT_EQ(changed.loads.at(1).kind, LoadSpec::Kind::gravity);
}

TEST(Set, NewRegionComesLast) {
  const Case changed = read_with({"regions.a.type=hexahedra", "regions.a.material=polymer",
                                  "regions.a.box=[[4, 0, 0], [5, 2, 2]]", "regions.a.divisions=[1, 1, 1]"});
  ASSERT_EQ(changed.regions.size(), 3u);
  EXPECT_EQ(changed.regions[2].name, "a");
}

TEST(Set, KeysOfAnotherChoiceAreLeftOut) {
  const Case all_hexahedra =
      read_with({"regions.middle.type=hexahedra", "regions.middle.divisions=[4, 4, 4]"});
  EXPECT_TRUE(std::holds_alternative<HexahedraSpec>(all_hexahedra.regions[1].shape));
  EXPECT_EQ(all_hexahedra.toml.find("radius"), std::string::npos);
  const Case dynamic = read_with({"analysis.type=dynamic", "analysis.duration=5"});
  EXPECT_EQ(dynamic.toml.find("\ntolerance"), std::string::npos);
  EXPECT_EQ(dynamic.analysis.duration, 5);
  const Case lattice =
      read_case_text(dynamic.toml, "case.toml", {"regions.left.type=lattice", "regions.left.radius=0.25"});
  EXPECT_EQ(lattice.toml.find("divisions"), std::string::npos);
}

TEST(Set, ExcludedKeysAreLeftOut) {
  EXPECT_EQ(read_with({"loads.0.traction=[0, 0, 1]"}).loads[0].kind, LoadSpec::Kind::traction);
  EXPECT_FALSE(read_with({"loads.0.gravity=[0, 0, 1]"}).loads[0].where.has_value());
  const Case boxes = read_with({"regions.middle.boxes=[[[2, 0, 0], [3, 2, 2]], [[3, 0, 0], [4, 1, 1]]]"});
  EXPECT_EQ(std::get<LatticeSpec>(boxes.regions[1].shape).boxes.size(), 2u);
}

TEST(Set, KeysOfTheFileAreNotLeftOutWithoutCause) {
  EXPECT_THROW(read_with({"regions.middle.divisions=[4, 4, 4]"}), CaseError);
  EXPECT_THROW(read_with({"regions.middle.type=hexahedra"}), CaseError);
}

TEST(Set, CannotSmuggleInMore) {
  for (const char* option : {"title=\"a\"\nyoung = 3", "title=1\r\n", "=3", ".=3", "title", "a.b.c.d.e=1",
                             "title=\x01", "title=\xFF", "title=\"\xFF\"", "title={", "loads.-1.curve=a",
                             "loads.99999999999999999999=1", "loads.x=1", "=", "", "regions=1", "loads.0=1"})
    EXPECT_THROW(read_with({option}), CaseError) << option;
  std::string deep = "a";
  for (int i = 0; i < 100000; ++i) deep += ".a";
  EXPECT_THROW(read_with({deep + "=1"}), CaseError);
}

}  // namespace

}  // namespace geist
