// The results as a table for people, and as CSV and JSON.
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "measure.hpp"

namespace geist::bench {

struct Results {
  std::vector<std::pair<std::string, std::string>> machine;
  std::map<int, Limits> limits;  ///< by number of threads
  std::vector<Measured> measured;
};

void print_header(const Results& results);
void print_limits(const Results& results);
void print_rows(const Measured& measured, const Limits& limits);

/// STEM.csv and STEM.json.
void write_results(const Results& results, const std::string& stem);

}  // namespace geist::bench
