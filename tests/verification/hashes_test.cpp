// Golden hashes: the bits of every example after 500 steps of its own analysis, relaxation included. They
// are the same for any number of threads, observed or not, and on any machine and compiler that keeps to the
// rules of core/pack.hpp.
//
// When a change of the method changes them on purpose, run this test, check the new results by the other
// tests, and copy the table that it prints.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <map>

#include "core/parallel.hpp"
#include "model/hash.hpp"
#include "verification/bodies.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

const std::map<std::string, std::string> golden{
    {"ball-on-plate", "1be780663f22183f"},
    {"beam", "6e64e029e18468f2"},
    {"wide-beam", "b1352df12653ef50"},
};
const std::string golden_of_the_published_beam = "321e5a6c0389f80d";

constexpr long steps = 500;

struct Options {
  int threads = 1;
  long check_every = 100;
  double history_every = std::numeric_limits<double>::max();
};

/// Reads all it can, as the writers do.
class Reader : public Observer {
 public:
  void progress(const Simulation& sim, const Observation&) override { sum += sim.residual(); }
  double sum = 0;
};

std::string hash_of(const Case& input, const Options& options) {
  set_threads(options.threads);
  Built built = build(input);
  RunPlan plan = plan_of(input);
  plan.max_steps = steps, plan.check_every = options.check_every, plan.history_every = options.history_every;
  plan.balance_tolerance =
      std::numeric_limits<double>::max();  // in its first steps the beam has no energy yet
  Reader reader;
  run(built.simulation, plan, {&reader});
  set_threads(1);
  EXPECT_EQ(built.simulation.model.step, steps);
  return state_hash(built.simulation.model);
}

TEST(GoldenHash, EveryExampleHasOne) {
  for (const auto& entry : std::filesystem::directory_iterator(GEIST_SOURCE_DIR "/examples")) {
    if (!std::filesystem::exists(entry.path() / "case.toml")) continue;
    EXPECT_TRUE(golden.contains(entry.path().filename().string())) << entry.path();
  }
}

class GoldenHashByThreads : public ::testing::TestWithParam<int> {};

TEST_P(GoldenHashByThreads, IsTheSame) {
  for (const auto& [name, hash] : golden)
    EXPECT_EQ(hash_of(example(name), {.threads = GetParam()}), hash) << "    {\"" << name << "\", …},";
  EXPECT_EQ(hash_of(published("beam"), {.threads = GetParam()}), golden_of_the_published_beam);
}
INSTANTIATE_TEST_SUITE_P(Threads, GoldenHashByThreads, ::testing::Values(1, 2, 3, 4));

/// The other formulations, distorted elements, both inertias, loaded and held particles: 2000 dynamic steps.
std::string small_hash(const char* text, const std::vector<std::string>& set = {}, int threads = 1) {
  set_threads(threads);
  Simulation sim = std::move(build(read_case_text(text, "small.toml", set)).simulation);
  sim.start();
  for (int n = 0; n < 2000; ++n) sim.step(n % 100 == 0);
  set_threads(1);
  return state_hash(sim.model);
}

TEST(GoldenHash, SmallBodies) {
  const std::vector<std::string> small_and_consistent{"method=consistent", "analysis.kinematics=small"};
  EXPECT_EQ(small_hash(box_in_an_L), "bb21e90618bfb066");
  EXPECT_EQ(small_hash(L_around_a_box), "f89b9c59738a1d3a");
  EXPECT_EQ(small_hash(L_around_a_box, {"regions.block.hourglass=viscous"}), "1a647b8aed9b454f");
  EXPECT_EQ(small_hash(box_in_an_L, small_and_consistent), "ac418130b1df072c");
  EXPECT_EQ(small_hash(L_around_a_box, small_and_consistent), "ee18845552682796");
}

TEST_P(GoldenHashByThreads, IsTheSameForFiniteRotations) {
  EXPECT_EQ(small_hash(spinning_row, {}, GetParam()), "751414d9c012e3cd");
}

/// Coupled and published; a consistent L of particles alone.
TEST(GoldenHash, SmallBodiesWithFiniteRotations) {
  const std::vector<std::string> alone{"method=consistent",
                                       "regions={around={type=\"lattice\",material=\"polymer\",radius=0.1,"
                                       "boxes=[[[1,0.2,0],[1.6,1.6,1]],[[0.2,1,0],[1.6,1.6,1]]]}}",
                                       "initial=[{velocity=[3,0,-1],spin=[2,-5,9]}]",
                                       "analysis.kinematics=finite"};
  for (int n = 1; n <= 4; ++n) {
    EXPECT_EQ(small_hash(box_in_an_L, {"analysis.kinematics=finite"}, n), "0b2d51ec88c80074");
    EXPECT_EQ(small_hash(L_around_a_box, alone, n), "174c2efce8ab77ef");
  }
  set_threads(1);
}

/// Watching every step, hardly ever, or on a grid of times changes no bit.
TEST(GoldenHash, ObserversChangeNothing) {
  for (const auto& [beam, hash] : {std::pair{example("beam"), golden.at("beam")},
                                   std::pair{published("beam"), golden_of_the_published_beam}}) {
    EXPECT_EQ(hash_of(beam, {.check_every = 1}), hash);
    EXPECT_EQ(hash_of(beam, {.check_every = 7, .history_every = 0.0031}), hash);
    EXPECT_EQ(hash_of(beam, {.check_every = steps}), hash);
  }
}

}  // namespace
}  // namespace geist::verification
