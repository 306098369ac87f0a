// Good cases are read as they were meant, and what cannot be read at all is refused cleanly.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "case/everything.hpp"
#include "case/malformed.hpp"
#include "case/read.hpp"

namespace geist {

namespace {

Case read_everything() { return read_case_text(everything, "everything.toml"); }

template <class F>
std::string message_of(F f) {
  try {
    f();
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Read, Beam) {
  const Case beam = read_case(GEIST_SOURCE_DIR "/examples/beam/case.toml");
  EXPECT_EQ(beam.title, "Cantilever with a discrete middle");
  ASSERT_EQ(beam.regions.size(), 3u);
  EXPECT_EQ(beam.regions[0].name, "left");
  EXPECT_EQ(beam.regions[1].name, "middle");
  const auto& left = std::get<HexahedraSpec>(beam.regions[0].shape);
  const auto& block = std::get<BlockBody>(left.body);
  EXPECT_EQ(block.corners[6], (Vec3{7, 2, 2}));
  EXPECT_EQ(block.corners[3], (Vec3{0, 2, 0}));
  EXPECT_EQ(block.divisions, (std::array<int, 3>{14, 4, 4}));
  const auto& middle = std::get<LatticeSpec>(beam.regions[1].shape);
  EXPECT_EQ(middle.radius, 0.1);
  EXPECT_EQ(beam.analysis.tolerance, 1e-6);
  EXPECT_EQ(beam.probes.at(0).reduce, "mean");
  EXPECT_EQ(beam.output.history_every, 0.01);
  EXPECT_TRUE(beam.output.compress);
  EXPECT_EQ(beam.output.precision, "double");
}

/// What a method's defaults are, and in which analyses displacements are finite.
TEST(Read, DefaultsOfTheMethods) {
  const std::string dynamic = "analysis={type=\"dynamic\",duration=1}";
  const auto beam = [](const std::vector<std::string>& set) {
    return read_case(GEIST_SOURCE_DIR "/examples/beam/case.toml", set);
  };
  const auto expect = [](const Case& is, const std::string& formulation, const std::string& inertia,
                         const std::string& rotation, const std::string& kinematics) {
    EXPECT_EQ(std::get<HexahedraSpec>(is.regions[0].shape).formulation, formulation);
    EXPECT_EQ(std::get<LatticeSpec>(is.regions[1].shape).rotary_inertia, inertia);
    EXPECT_EQ(is.rotation, rotation);
    EXPECT_EQ(is.analysis.kinematics, kinematics);
  };
  EXPECT_EQ(beam({}).method, "consistent");
  expect(beam({}), "assumed-strain", "cube", "continuum", "small");
  expect(beam({"analysis.type=static"}), "assumed-strain", "cube", "continuum", "small");
  expect(beam({dynamic}), "assumed-strain", "cube", "continuum", "finite");
  expect(beam({dynamic, "analysis.start=static"}), "assumed-strain", "cube", "continuum", "small");
  expect(beam({"method=published"}), "selective-reduced", "sphere", "one-step-back", "small");
  expect(beam({"method=published", dynamic}), "selective-reduced", "sphere", "one-step-back", "small");
}

TEST(Read, WideBeam) {
  const Case beam = read_case(GEIST_SOURCE_DIR "/examples/wide-beam/case.toml");
  EXPECT_EQ(beam.materials.at("polymer").poisson, 0.23);
  EXPECT_EQ(beam.loads.at(0).value, (Vec3{0, 0, -0.4}));
}

TEST(Read, RegionsKeepTheirOrder) {
  const Case all = read_everything();
  ASSERT_EQ(all.regions.size(), 5u);
  EXPECT_EQ(all.regions[0].name, "zebra");
  EXPECT_EQ(all.regions[1].name, "ant");
  EXPECT_EQ(all.regions[2].name, "mole");
  EXPECT_EQ(all.probes.at(0).name, "z-force");
}

TEST(Read, HexahedraFromCorners) {
  const Case all = read_everything();
  const auto& zebra = std::get<HexahedraSpec>(all.regions[0].shape);
  EXPECT_EQ(std::get<BlockBody>(zebra.body).corners[6], (Vec3{2.5, 2.5, 2.5}));
  EXPECT_EQ(zebra.formulation, "one-point");
  EXPECT_EQ(zebra.hourglass, "viscous");
  EXPECT_EQ(zebra.hourglass_coefficient, 0.1);
  EXPECT_EQ(zebra.minus.at(0).high, (Vec3{1, 1, 1}));
  EXPECT_EQ(std::get<HexahedraSpec>(all.regions[2].shape).hourglass, "");
}

TEST(Read, RoundBodiesOfHexahedra) {
  const Case all = read_everything();
  const auto& newt = std::get<HexahedraSpec>(all.regions[3].shape);
  const auto& ball = std::get<BallBody>(newt.body);
  EXPECT_EQ(ball.shape.centre, (Vec3{20, 0, 0}));
  EXPECT_EQ(ball.shape.radius, 2);
  EXPECT_EQ(ball.core, 4);
  EXPECT_EQ(ball.shells, 3);
  EXPECT_EQ(newt.gradings.axis[0].towards, Towards::middle);
  EXPECT_EQ(newt.gradings.axis[1].towards, Towards::ends);
  EXPECT_EQ(newt.gradings.axis[1].ratio, 1.5);
  EXPECT_EQ(newt.gradings.axis[2].towards, Towards::high);
  EXPECT_EQ(newt.gradings.radius.towards, Towards::low);
  const auto& worm = std::get<HexahedraSpec>(all.regions[4].shape);
  const auto& cylinder = std::get<CylinderBody>(worm.body);
  EXPECT_EQ(cylinder.shape.to, (Vec3{30, 0, 8}));
  EXPECT_EQ(cylinder.core, 2);
  EXPECT_EQ(cylinder.shells, 1);
  EXPECT_EQ(cylinder.layers, 5);
  EXPECT_EQ(worm.gradings.axis[2].ratio, 1);
}

TEST(Read, LatticeOfSeveralBoxes) {
  const Case all = read_everything();
  const auto& ant = std::get<LatticeSpec>(all.regions[1].shape);
  ASSERT_EQ(ant.boxes.size(), 2u);
  EXPECT_EQ(ant.boxes[1].high, (Vec3{7, 2, 1}));
  ASSERT_EQ(ant.minus.size(), 3u);
  EXPECT_EQ(std::get<Box>(ant.minus[0]).high.x, 5.5);
  EXPECT_EQ(std::get<Cylinder>(ant.minus[1]).to, (Vec3{5, 0.5, 2}));
  EXPECT_EQ(std::get<Ball>(ant.minus[2]).centre, (Vec3{6, 1, 1}));
  EXPECT_EQ(ant.rotary_inertia, "cube");
}

TEST(Read, Supports) {
  const Case all = read_everything();
  const SupportSpec& support = all.supports.at(0);
  EXPECT_EQ(support.fixed, (std::array<bool, 6>{false, false, true, true, false, false}));
  EXPECT_EQ(support.displacement[0], 0.1);
  EXPECT_EQ(support.displacement[4], 0.5);
  EXPECT_FALSE(support.displacement[1].has_value());
  EXPECT_EQ(support.velocity[1], -2.5);
  EXPECT_EQ(support.velocity[5], 3);
  EXPECT_EQ(support.curve, "ramp");
  EXPECT_TRUE(support.where.axis[0]->plane());
  EXPECT_EQ(support.where.axis[1]->high, 1);
  EXPECT_EQ(support.where.region, "zebra");
}

TEST(Read, LoadsInitialAndAnalysis) {
  const Case all = read_everything();
  ASSERT_EQ(all.loads.size(), 3u);
  EXPECT_EQ(all.loads[1].kind, LoadSpec::Kind::traction);
  EXPECT_EQ(all.loads[1].value, (Vec3{1, 2, 3}));
  EXPECT_EQ(all.loads[1].curve, "");
  EXPECT_EQ(all.loads[2].kind, LoadSpec::Kind::gravity);
  EXPECT_FALSE(all.loads[2].where.has_value());
  EXPECT_EQ(all.initial.at(0).about, (Vec3{7, 8, 9}));
  EXPECT_FALSE(all.initial.at(1).where.region.has_value());
  EXPECT_EQ(all.analysis.time_step, 1e-7);
  EXPECT_EQ(all.analysis.max_steps, 1000);
  EXPECT_EQ(all.probes.at(0).reduce, "sum");
  EXPECT_EQ(all.probes.at(1).reduce, "max");
  EXPECT_EQ(all.curves.at("ramp").points.at(2)[1], 1.5);
  EXPECT_EQ(all.coupling, "none");
}

TEST(Read, SourcesSayWhereThingsAre) {
  const Case good = read_case_text(good_case, "case.toml");
  EXPECT_EQ(good.regions[1].source.line, 15);
  EXPECT_EQ(good.regions[1].source.text, "[regions.middle]");
  EXPECT_EQ(good.supports[0].where.source.line, 25);
  EXPECT_EQ(good.supports[0].where.source.column, 9);
  EXPECT_EQ(good.supports[0].where.source.text, "{ x = 0 }");
  EXPECT_EQ(good.loads[0].source.line, 28);
  EXPECT_EQ(good.probes[0].source.line, 37);
  EXPECT_EQ(good.analysis.source.line, 33);
}

TEST(Read, LaterErrorsLookLikeEarlierOnes) {
  const Case good = read_case_text(good_case, "case.toml");
  const CaseError error = error_at(good, good.supports[0].where.source, "nothing is selected");
  EXPECT_STREQ(error.what(),
               "case.toml:25:9: error: nothing is selected\n"
               "    25 | where = { x = 0 }\n"
               "       |         ^~~~~~~~~");
}

TEST(Read, LaterErrorsNameTheOptionThatChangedTheirPlace) {
  const Case moved = read_case_text(good_case, "case.toml", {"supports.0.where.x=9"});
  const std::string inside = error_at(moved, moved.supports[0].where.source, "nothing is selected").what();
  EXPECT_EQ(inside.substr(0, inside.find('\n')),
            "case.toml:25:9: error: nothing is selected (changed by --set supports.0.where.x=9)");
  const Case replaced = read_case_text(good_case, "case.toml", {"supports.0.where={ x = 9 }"});
  EXPECT_STREQ(error_at(replaced, replaced.supports[0].where.source, "nothing is selected").what(),
               "--set supports.0.where={ x = 9 }: nothing is selected");
}

TEST(Read, CompleteCaseReadsBackTheSame) {
  const std::vector<std::string> texts{everything, good_case,
                                       read_case(GEIST_SOURCE_DIR "/examples/beam/case.toml").toml};
  for (const std::string& text : texts) {
    const Case first = read_case_text(text, "case.toml");
    const Case again = read_case_text(first.toml, "again.toml");
    EXPECT_EQ(first.toml, again.toml);
    EXPECT_EQ(first.title, again.title);
    ASSERT_EQ(first.regions.size(), again.regions.size());
    for (std::size_t r = 0; r < first.regions.size(); ++r)
      EXPECT_EQ(first.regions[r].name, again.regions[r].name);
    EXPECT_EQ(first.analysis.safety, again.analysis.safety);
  }
}

TEST(Read, CompleteCaseHasDefaultsAndChanges) {
  const Case changed = read_case_text(good_case, "case.toml", {"analysis.safety=0.5"});
  EXPECT_NE(changed.toml.find("safety = 0.5\n"), std::string::npos);
  EXPECT_NE(changed.toml.find("rotation = \"continuum\"\n"), std::string::npos);
  EXPECT_EQ(changed.original, good_case);
}

TEST(Read, AllProblemsAtOnceInTheOrderOfTheFile) {
  std::string text = good_case;
  text.replace(text.find("radius = 0.25"), 13, "radius = \"a\"");
  text.replace(text.find("young = 1000"), 12, "young = -1  ");
  text.replace(text.find("\"ramp\""), 6, "\"rump\"");
  try {
    read_case_text(text, "case.toml", {"title=[1]"});
    FAIL();
  } catch (const CaseError& error) {
    ASSERT_EQ(error.diagnostics().size(), 4u) << error.what();
    EXPECT_EQ(error.diagnostics()[0].line, 6);
    EXPECT_EQ(error.diagnostics()[1].line, 19);
    EXPECT_EQ(error.diagnostics()[2].line, 31);
    EXPECT_EQ(error.diagnostics()[3].line, 0);
  }
}

TEST(Read, MissingFile) {
  EXPECT_EQ(message_of([] { read_case("no/such/case.toml"); }), "no/such/case.toml: error: no such file");
}

TEST(Read, Directory) {
  EXPECT_EQ(message_of([] { read_case(GEIST_SOURCE_DIR); }),
            std::string(GEIST_SOURCE_DIR) + ": error: is a directory, not a case file");
}

TEST(Read, BinaryAndHugeFiles) {
  const std::string zero(
      "\x7F"
      "ELF\0\0\1",
      7);
  EXPECT_EQ(message_of([&] { read_case_text(zero, "a"); }), "a: error: is not a text file");
  EXPECT_EQ(message_of([] { read_case_text(std::string((16u << 20) + 1, '\n'), "a"); }),
            "a: error: is larger than 16 MB; a case file should be small");
}

TEST(Read, FileOnDisk) {
  const auto path = std::filesystem::temp_directory_path() / "geist_test_read.toml";
  std::ofstream(path) << good_case;
  EXPECT_EQ(read_case(path.string()).title, "A block");
  EXPECT_EQ(read_case(path.string()).file, path.string());
  std::filesystem::remove(path);
}

TEST(Read, WindowsLineEndsAndByteOrderMark) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : std::string(good_case)) text += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(read_case_text(text, "case.toml").regions.size(), 2u);
}

}  // namespace

}  // namespace geist
