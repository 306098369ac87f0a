// Documents that are made by the program and kept in the tree.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace geist {

/// The file in the tree must be this text. With GEIST_UPDATE set in the environment it is written instead.
inline void expect_generated(const std::string& path, const std::string& text) {
  const std::string full = std::string(GEIST_SOURCE_DIR) + "/" + path;
  if (std::getenv("GEIST_UPDATE")) std::ofstream(full, std::ios::binary) << text;
  std::ifstream in(full, std::ios::binary);
  const std::string kept{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(kept == text) << path << " is out of date; run this test with GEIST_UPDATE=1";
}

}  // namespace geist
