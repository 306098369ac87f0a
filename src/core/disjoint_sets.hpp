// Disjoint sets: which of n things hang together.
#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace geist {

/// Things 0 .. n − 1, each by itself until joined. A set is known by its least member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n = 0) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  /// The least member of i's set.
  std::size_t of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace geist
