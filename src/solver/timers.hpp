// Timers: where the time of a step goes.
#pragma once
#include <array>
#include <chrono>

namespace geist {

enum class Phase { equilibrium, drift, coupling, contact, elements, lattice, nodes, observe };
inline constexpr std::array<const char*, 8> phase_names{
    "equilibrium", "drift", "coupling", "contact", "elements", "lattice", "nodes and loads", "observation"};

class Timers {
 public:
  /// Adds the time until its end to a phase.
  class Scope {
   public:
    explicit Scope(double& total) : total_(total), begin_(Clock::now()) {}
    Scope(const Scope&) = delete;
    ~Scope() { total_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }

   private:
    double& total_;
    std::chrono::steady_clock::time_point begin_;
  };

  [[nodiscard]] Scope time(Phase phase) { return Scope(seconds_[static_cast<int>(phase)]); }
  double seconds(Phase phase) const { return seconds_[static_cast<int>(phase)]; }

 private:
  using Clock = std::chrono::steady_clock;
  std::array<double, phase_names.size()> seconds_{};
};

}  // namespace geist
