#include "output/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <set>

#include "core/parallel.hpp"
#include "de/bonds.hpp"
#include "fe/elements.hpp"
#include "output/field_list.hpp"
#include "output/file.hpp"
#include "output/support.hpp"

namespace geist::output {
namespace {

using geist::testing::error_of;
using geist::testing::FullDisk;
using geist::testing::read_text;
using geist::testing::read_vtu;
using geist::testing::ReadArray;
using geist::testing::Scratch;
using geist::testing::small_simulation;

const UnitSystem units{"mm", "g", "ms"};

std::vector<std::string> listed_files(const std::filesystem::path& pvd) {
  const std::string text = read_text(pvd);
  const std::regex pattern("timestep=\"([^\"]*)\".*part=\"([^\"]*)\".*file=\"([^\"]*)\"");
  std::vector<std::string> files;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    files.push_back((*it)[1].str() + " " + (*it)[2].str() + " " + (*it)[3].str());
  return files;
}

TEST(Fields, EveryFieldHasAsManyValuesAsItsPlace) {
  const Simulation sim = small_simulation();
  const std::size_t places[] = {12, 2, 12, 4};  // nodes, hexahedra, particles, ghosts
  std::set<std::pair<Place, std::string_view>> names;
  for (const FieldInfo& field : fields()) {
    EXPECT_EQ(field.values(sim).size(), field.components * places[static_cast<int>(field.place)])
        << field.name;
    EXPECT_TRUE(field.shown || field.kept) << field.name;
    EXPECT_TRUE(names.emplace(field.place, field.name).second) << field.name << " is declared twice";
  }
}

TEST(Fields, HexahedraShowMotionAndStress) {
  const Scratch scratch;
  const Simulation sim = small_simulation();
  const Model& model = sim.model;
  FieldWriter(scratch.path, units).write(sim);
  auto read = read_vtu(scratch / "fields/hexahedra_000120.vtu");
  EXPECT_EQ(read.time, model.time);
  EXPECT_EQ(read.points, 12u);
  EXPECT_EQ(read.cells, 2u);
  EXPECT_EQ(read.arrays["PointData/displacement"].values[3 * 5 + 1], model.mesh.u[1][5]);
  EXPECT_EQ(read.arrays["PointData/displacement"].unit, "mm");
  EXPECT_EQ(read.arrays["PointData/velocity"].values[3 * 5 + 1], 5) << "the mean of before and after";
  EXPECT_EQ(read.arrays["Cells/connectivity"].values[0], 0);
  EXPECT_EQ(read.arrays["Cells/connectivity"].values[1], 4);
  const auto stress = fe::centre_stresses(model.mesh);
  for (std::size_t e = 0; e < 2; ++e) {
    for (int c = 0; c < 6; ++c)
      EXPECT_EQ(read.arrays["CellData/stress"].values[6 * e + c], static_cast<float>(stress[e][c]));
    EXPECT_EQ(read.arrays["CellData/von_mises"].values[e], static_cast<float>(von_mises(stress[e])));
  }
  EXPECT_EQ(read.arrays["CellData/stress"].unit, "MPa");
  EXPECT_EQ(read.arrays["CellData/region"].values, (std::vector<double>{0, 0}));
}

TEST(Fields, ParticlesShowMotionAndEnergy) {
  const Scratch scratch;
  const Simulation sim = small_simulation();
  const Model& model = sim.model;
  const Lattice& lattice = model.lattices[0];
  FieldWriter(scratch.path, units, false).write(sim);
  auto read = read_vtu(scratch / "fields/particles_000120.vtu");
  EXPECT_EQ(read.points, 12u);
  const std::size_t s = lattice.grid.index(2, 0, 0), p = 1;  // particles are sites 1, 2, 3 of each row
  EXPECT_EQ(read.arrays["Points/Points"].values[3 * p], 2.75);
  EXPECT_EQ(read.arrays["PointData/displacement"].values[3 * p + 2], lattice.motion[2][s]);
  EXPECT_EQ(read.arrays["PointData/rotation"].values[3 * p + 2], lattice.motion[5][s]);
  EXPECT_EQ(read.arrays["PointData/velocity"].values[3 * p + 2], double(s));
  EXPECT_EQ(read.arrays["PointData/spin"].values[3 * p + 2], double(s));
  EXPECT_EQ(read.arrays["PointData/spin"].unit, "rad/ms");
  EXPECT_EQ(read.arrays["PointData/radius"].values, std::vector<double>(12, 0.25));
  EXPECT_EQ(read.arrays["PointData/strain_energy"].values[p],
            static_cast<float>(de::site_energies(lattice)[s]));
  EXPECT_EQ(read.arrays["PointData/intact_bonds"].values[p], 9);
  EXPECT_EQ(read.arrays["PointData/region"].values[p], 1);
}

/// Two bodies of the small model pressed into each other: forces at the places that touch, which add up to
/// nothing.
TEST(Fields, ContactForcesAreShown) {
  const Scratch scratch;
  Simulation sim = small_simulation();
  Lattice& lattice = sim.model.lattices[0];
  lattice.ghosts.clear();
  for (std::uint32_t& word : lattice.word) word = word & site::particle ? site::particle | site::free : 0;
  connect(lattice);
  sim.model.mesh.mass.assign(sim.model.mesh.nodes(), 1.0);
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < sim.model.mesh.nodes(); ++i) sim.model.mesh.u[c][i] = c == 0 ? 0.05 : 0;
  contact::LawTable laws(2);
  laws.set(0, 1, {});
  sim.contacts = contact::Contacts(sim.model, laws);
  sim.contacts.find(sim.model, 0);
  FieldWriter(scratch.path, units).write(sim);
  double total = 0, most = 0;
  for (const std::string part : {"hexahedra", "particles"}) {
    auto read = read_vtu(scratch / ("fields/" + part + "_000120.vtu"));
    const ReadArray& forces = read.arrays["PointData/contact_force"];
    EXPECT_EQ(forces.components, 3);
    EXPECT_EQ(forces.unit, "N");
    for (std::size_t i = 0; i < forces.values.size(); i += 3)
      total += forces.values[i], most = std::max(most, std::abs(forces.values[i]));
  }
  EXPECT_GT(most, 0.01);
  EXPECT_NEAR(total, 0, 1e-6 * most);
}

TEST(Fields, GhostsShowTheirHexahedron) {
  const Scratch scratch;
  const Simulation sim = small_simulation();
  const Model& model = sim.model;
  FieldWriter(scratch.path, units).write(sim);
  auto read = read_vtu(scratch / "fields/ghosts_000120.vtu");
  EXPECT_EQ(read.points, 4u);
  EXPECT_EQ(read.arrays["PointData/hexahedron"].values, std::vector<double>(4, 1));
  EXPECT_EQ(read.arrays["PointData/radius"].values, std::vector<double>(4, 0.25));
  EXPECT_EQ(read.arrays["PointData/rotation"].values[3],
            model.lattices[0].motion[3][model.lattices[0].ghosts[1].site]);
  EXPECT_FALSE(read.arrays.contains("PointData/spin_after")) << "kept, not shown";
}

TEST(Fields, CollectionListsEveryFileOnce) {
  const Scratch scratch;
  Simulation sim = small_simulation();
  Model& model = sim.model;
  FieldWriter writer(scratch.path, units);
  model.step = 0, model.time = 0;
  writer.write(sim);
  model.step = 7, model.time = 0.1;
  writer.write(sim);
  writer.write(sim);
  writer.finish();  // the last files may still be under way
  EXPECT_EQ(
      listed_files(scratch / "fields.pvd"),
      (std::vector<std::string>{"0 0 fields/hexahedra_000000.vtu", "0 1 fields/particles_000000.vtu",
                                "0 2 fields/ghosts_000000.vtu", "0.1 0 fields/hexahedra_000007.vtu",
                                "0.1 1 fields/particles_000007.vtu", "0.1 2 fields/ghosts_000007.vtu"}));
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(scratch / "fields")) ++files;
  EXPECT_EQ(files, 6u);
}

TEST(Fields, WhatIsWrittenIsTheStateAtTheCall) {
  const Scratch scratch;
  Simulation sim = small_simulation();
  FieldWriter writer(scratch.path, units);
  std::vector<double> expected;
  for (long step = 0; step < 20; ++step) {  // the run goes on while the last fields are still being written
    sim.model.step = step, sim.model.mesh.u[1][5] = 1.0 / double(step + 3);
    expected.push_back(sim.model.mesh.u[1][5]);
    writer.write(sim);
    sim.model.mesh.u[1][5] = 0;
  }
  writer.finish();
  for (std::size_t step = 0; step < expected.size(); ++step) {
    const std::string file =
        "fields/hexahedra_0000" + std::string(step < 10 ? "0" : "") + std::to_string(step);
    EXPECT_EQ(read_vtu(scratch / (file + ".vtu")).arrays["PointData/displacement"].values[3 * 5 + 1],
              expected[step]);
  }
}

TEST(Fields, TheListIsOfCompleteFilesOnly) {
  const Scratch scratch;
  Simulation sim = small_simulation();
  FieldWriter writer(scratch.path, units);
  for (sim.model.step = 0; sim.model.step < 10; ++sim.model.step) {
    writer.write(sim);
    if (!exists(scratch / "fields.pvd")) continue;
    for (const std::string& entry : listed_files(scratch / "fields.pvd"))
      EXPECT_TRUE(exists(scratch.path / entry.substr(entry.rfind(' ') + 1))) << entry;
  }
}

TEST(Fields, TheSameBytesWhoeverWritesThem) {
  const Scratch one, many;
  const Simulation sim = small_simulation();
  set_threads(1);
  FieldWriter(one.path, units).write(sim);
  set_threads(4);
  {
    FieldWriter writer(many.path, units);
    writer.write(sim), writer.finish();
    writer.write(sim), writer.finish();  // with what is kept of points and cells
  }
  set_threads(1);
  for (const std::string part : {"hexahedra", "particles", "ghosts"}) {
    const std::string file = "fields/" + part + "_000120.vtu";
    EXPECT_EQ(read_text(one / file), read_text(many / file));
  }
}

TEST(Fields, StateInSinglePrecision) {
  const Scratch scratch;
  const Simulation sim = small_simulation();
  FieldWriter(scratch.path, units, true, Precision::single).write(sim);
  const ReadArray u = read_vtu(scratch / "fields/hexahedra_000120.vtu").arrays["PointData/displacement"];
  EXPECT_EQ(u.type, "Float32");
  EXPECT_EQ(u.values[3 * 5 + 1], static_cast<float>(sim.model.mesh.u[1][5]));
  EXPECT_EQ(read_vtu(scratch / "fields/hexahedra_000120.vtu").arrays["Points/Points"].type, "Float64");
}

TEST(Fields, PartsThatDoNotExistAreLeftOut) {
  const Scratch scratch;
  Simulation sim = small_simulation();
  Model& model = sim.model;
  model.lattices.clear();
  FieldWriter(scratch.path, units).write(sim);
  EXPECT_EQ(listed_files(scratch / "fields.pvd"),
            std::vector<std::string>{"0.125 0 fields/hexahedra_000120.vtu"});
}

TEST(Fields, FullDiskKeepsWhatWasThere) {
  const Scratch scratch;
  Simulation sim = small_simulation();
  Model& model = sim.model;
  FieldWriter writer(scratch.path, units);
  writer.write(sim);
  writer.finish();
  const std::string before = read_text(scratch / "fields.pvd");
  model.step = 121;
  {
    const FullDisk full(64);
    writer.write(sim);
    EXPECT_EQ(error_of([&] { writer.finish(); }),
              "cannot write " + (scratch / "fields/hexahedra_000121.vtu").string() + ": File too large");
    writer.write(sim);
    EXPECT_EQ(error_of([&] { writer.write(sim); }),
              "cannot write " + (scratch / "fields/hexahedra_000121.vtu").string() + ": File too large");
  }
  writer.finish();
  EXPECT_EQ(read_text(scratch / "fields.pvd"), before);
  EXPECT_FALSE(exists(scratch / "fields/hexahedra_000121.vtu"));
}

TEST(Fields, UnwritableDirectoryIsNamed) {
  const Scratch scratch;
  std::ofstream(scratch / "file") << "not a directory";
  EXPECT_EQ(error_of([&] { FieldWriter(scratch / "file", units); }),
            "cannot make the directory " + (scratch / "file/fields").string() + ": Not a directory");
}

TEST(Results, AreFoundAndRemovedAndNothingElse) {
  const Scratch scratch;
  EXPECT_FALSE(holds_results(scratch / "not there"));
  EXPECT_FALSE(holds_results(scratch.path));
  std::ofstream(scratch / "notes.txt") << "mine";
  EXPECT_FALSE(holds_results(scratch.path));
  FieldWriter(scratch.path, units).write(small_simulation());
  write_whole(scratch / "summary.json", "{}");
  EXPECT_TRUE(holds_results(scratch.path));
  remove_results(scratch.path);
  EXPECT_FALSE(holds_results(scratch.path));
  EXPECT_TRUE(exists(scratch / "notes.txt"));
}

}  // namespace
}  // namespace geist::output
