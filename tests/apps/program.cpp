#include "apps/program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

namespace geist::testing {
namespace {

namespace fs = std::filesystem;

/// In the child: run the program with its output in files; does not return.
[[noreturn]] void become(const fs::path& directory, const std::string& out, std::vector<char*> arguments) {
  const auto redirect = [](const char* file, int to) {
    const int from = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (from < 0 || dup2(from, to) < 0) _exit(125);
  };
  if (chdir(directory.c_str()) != 0) _exit(126);
  redirect(out.c_str(), STDOUT_FILENO);
  redirect("stderr.txt", STDERR_FILENO);
  execv(GEIST_PROGRAM, arguments.data());
  _exit(127);
}

}  // namespace

const std::string beam = R"(units = { length = "mm", mass = "g", time = "ms" }
[materials.m]
density = 0.001
young = 1000
poisson = 0.2
[regions.left]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [2, 1, 1]]
divisions = [4, 2, 2]
[regions.right]
type = "lattice"
material = "m"
box = [[2, 0, 0], [4, 1, 1]]
radius = 0.125
[[supports]]
where = { x = 0 }
fix = ["x", "y", "z"]
[[loads]]
where = { x = 4 }
total_force = [0, 0, -1]
[analysis]
type = "quasi-static"
tolerance = 1e-3
[probes.tip]
where = { x = 4 }
quantity = "displacement"
component = "z"
)";

Program::Program() { write("case.toml", beam); }

int Program::start(const std::vector<std::string>& arguments, const std::string& out) {
  std::vector<std::string> words{"geist"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) become(directory_, out.empty() ? "stdout.txt" : out, pointers);
  return child;
}

Ended Program::wait_for(int process) {
  int status = 0;
  waitpid(process, &status, 0);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return {code, read_text(directory_ / "stdout.txt"), read_text(directory_ / "stderr.txt")};
}

Ended Program::run(const std::vector<std::string>& arguments, const std::string& out) {
  return wait_for(start(arguments, out));
}

void Program::write(const std::string& name, const std::string& text) const {
  std::ofstream(directory_ / name, std::ios::binary) << text;
}

std::string Program::read(const std::string& name) const { return read_text(directory_ / name); }

nlohmann::json Program::summary(const std::string& folder) const {
  return nlohmann::json::parse(read(folder + "/summary.json"));
}

std::map<std::string, std::string> Program::contents(const std::string& folder) const {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory_ / folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), directory_ / folder).string()] = read_text(entry.path());
  return files;
}

}  // namespace geist::testing
