// What the machine is, and how busy others keep it.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace geist::bench {

/// Description in pairs of name and value: processor, cores, caches, memory, compiler, instruction set.
std::vector<std::pair<std::string, std::string>> describe_machine();

/// Runnable processes on the average of the last minute.
double load_average();

/// Processors that everything but this program keeps busy.
class Others {
 public:
  Others();
  /// The mean since the construction.
  double busy() const;

 private:
  double begin_, all_, own_;
};

/// Use n threads. Unlike set_threads() alone it can be called again: the first thread is let loose before.
void use_threads(int n);

}  // namespace geist::bench
