// Execute: a case from validation to its last file.
#pragma once
#include <csignal>
#include <filesystem>
#include <string>

#include "case/case.hpp"

namespace geist {

struct ExecuteOptions {
  std::filesystem::path directory;  ///< of results
  bool force = false;               ///< overwrite results that are there
  int threads = 0;                  ///< 0: as many as pay off
  bool quiet = false;
  std::string version;
  const volatile std::sig_atomic_t* stop = nullptr;
};

/// Ends of the program.
enum ExitCode {
  exit_completed = 0,
  exit_failed = 1,
  exit_bad_input = 2,
  exit_not_converged = 3,
  exit_interrupted = 130
};

/// Build the case, run it, and write case-as-run.toml, history.csv, fields and summary.json. Returns the exit
/// code. Throws CaseError before anything is written if the case cannot be built, std::runtime_error if the
/// directory holds results and `force` is not given, or cannot be written.
int execute(const Case& input, const ExecuteOptions& options);

/// Where results go unless told otherwise: results/<name of the file, or of its folder if it is case.toml>.
std::filesystem::path default_directory(const std::filesystem::path& case_file);

}  // namespace geist
