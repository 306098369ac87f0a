// Diagnostics: what is wrong with a case, and where.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "case/case.hpp"

namespace geist {

/// One thing wrong, at one place.
struct Diagnostic {
  std::string file;          ///< the case file, or the "--set PATH=VALUE" that brought the value
  int line = 0, column = 0;  ///< from 1; 0: the file or option as a whole
  std::string offending;     ///< the text at fault
  std::string message;
  std::string excerpt = {};  ///< the whole line in the file, or empty

  /// "file:line:column: error: message", then the line with the offending text marked below it.
  std::string describe() const;
};

/// All that is wrong with a case: what() holds one message after the other.
class CaseError : public std::runtime_error {
 public:
  explicit CaseError(std::vector<Diagnostic> diagnostics);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// An error found after reading, when the case is turned into a model.
CaseError error_at(const Case& input, const Source& source, const std::string& message);

/// Text fit for a terminal: no control characters, at most `most` characters of the first line, "…" for the
/// rest.
std::string printable(const std::string& text, std::size_t most);

/// Line number `line` (from 1) of a text, without its end.
std::string line_of(const std::string& text, int line);

}  // namespace geist
