// Signals: a run that is stopped ends in order.
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <thread>

#include "apps/program.hpp"

namespace geist {
namespace {

using Signals = testing::Program;

const std::vector<std::string> endless{
    "run", "case.toml", "--out", "out", "--set", "analysis.type=dynamic", "--set", "analysis.duration=1e6"};

void sleep_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

TEST_F(Signals, StopARunWithAllItsFilesWritten) {
  for (const int signal : {SIGINT, SIGTERM}) {
    auto words = endless;
    words[3] = "out" + std::to_string(signal);
    const int process = start(words);
    for (int i = 0; i < 500 && !exists(words[3] + "/history.csv"); ++i) sleep_ms(20);
    sleep_ms(200);
    kill(process, signal);
    const auto ended = wait_for(process);
    EXPECT_EQ(ended.code, 128 + signal) << ended.err;
    for (const std::string name : {"case-as-run.toml", "history.csv", "summary.json", "fields.pvd"})
      EXPECT_TRUE(exists(words[3] + "/" + name)) << name;
    const auto summary = this->summary(words[3]);
    EXPECT_EQ(summary["status"], "interrupted");
    EXPECT_GT(summary["steps"].get<long>(), 0);
    EXPECT_GE(contents(words[3] + "/fields").size(), 1u);  // the last state
    const std::string history = read(words[3] + "/history.csv");
    EXPECT_EQ(history.back(), '\n');
  }
}

}  // namespace
}  // namespace geist
