// A table of malformed cases: one small good case, and what each change of it must be answered with. The
// tests run over it, and docs/malformed-cases.md is made from it.
#pragma once
#include <array>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace geist {

/// A change of the good case (or a --set option), and the first diagnostic that it must lead to.
struct Malformed {
  const char* name;     ///< of the test
  const char* replace;  ///< text of the good case, empty: all of it; "--set": nothing, `by` is an option
  const char* by;       ///< what stands there instead
  int line, column;     ///< 0, 0: of a --set option
  std::array<const char*, 4> fragments;  ///< of the message; null: no more
  std::size_t problems = 1;              ///< diagnostics in all
};

/// What GoogleTest prints of it.
inline void PrintTo(const Malformed& malformed, std::ostream* out) { *out << malformed.name; }

extern const char* const good_case;

// The parts of the table.
std::span<const Malformed> malformed_syntax();
std::span<const Malformed> malformed_keys();
std::span<const Malformed> malformed_values();
std::span<const Malformed> malformed_contacts();
std::span<const Malformed> malformed_rules();
std::span<const Malformed> malformed_sets();

/// All of them.
std::vector<Malformed> malformed_cases();

/// The malformed case as text, and the options that it is read with.
std::string malformed_text(const Malformed& malformed);
std::vector<std::string> malformed_options(const Malformed& malformed);

}  // namespace geist
