// Running the program as a user does: a process of its own, in a directory of its own.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scratch.hpp"

namespace geist::testing {

/// A short beam, half hexahedra and half particles; quasi-static, done in a fraction of a second.
extern const std::string beam;

/// How a process ended, and what it said.
struct Ended {
  int code = -1;  ///< exit code, or minus the signal that ended it
  std::string out, err;
};

/// Gives every test an empty directory to run in, with case.toml in it.
class Program : public ::testing::Test {
 protected:
  Program();

  /// Run to the end. Standard output goes to the file `out` if one is named.
  Ended run(const std::vector<std::string>& arguments, const std::string& out = "");
  /// Start and do not wait; its process.
  int start(const std::vector<std::string>& arguments, const std::string& out = "");
  Ended wait_for(int process);

  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  nlohmann::json summary(const std::string& folder) const;
  /// Contents of all files below a folder, by name.
  std::map<std::string, std::string> contents(const std::string& folder) const;
  bool exists(const std::string& name) const { return std::filesystem::exists(directory_ / name); }

  const Scratch scratch_;
  const std::filesystem::path& directory_ = scratch_.path;
};

}  // namespace geist::testing
