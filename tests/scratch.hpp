// For tests that write files: a directory that goes with them, and what a file holds.
#pragma once
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace geist::testing {

/// An empty directory that is removed with everything in it at the end of its scope.
class Scratch {
 public:
  Scratch() {
    std::string pattern =
        std::filesystem::temp_directory_path() / "geist-test-XXXXXX";  // as mkdtemp wants it
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no scratch directory");
    path = pattern;
  }
  ~Scratch() { std::filesystem::remove_all(path); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path / name; }

  std::filesystem::path path;
};

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace geist::testing
