#include "output/file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace geist::output {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(std::string_view what, const fs::path& path, const std::error_code& reason) {
  throw std::runtime_error(fmt::format("cannot {} {}: {}", what, path.string(), reason.message()));
}

std::error_code last_error() { return {errno ? errno : EIO, std::generic_category()}; }

fs::path temporary_name(fs::path path) { return path += ".part"; }

/// Those of a run's results that lie in the directory.
std::vector<fs::path> results(const fs::path& directory) {
  std::vector<fs::path> found;
  for (const std::string_view name : std::array{summary_name, history_name, fields_name, case_name})
    if (fs::exists(directory / name)) found.push_back(directory / name);
  if (!fs::is_directory(directory / fields_folder)) return found;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory / fields_folder))
    if (entry.path().extension() == ".vtu") found.push_back(entry.path());
  return found;
}

}  // namespace

File::File(const fs::path& path, const fs::path& name) : name_(name) {
  errno = 0;
  file_.reset(std::fopen(path.c_str(), "wb"));
  if (!file_) fail();
}

void File::write(const void* data, std::size_t bytes) {
  errno = 0;
  if (bytes && std::fwrite(data, 1, bytes, file_.get()) != bytes) fail();
}

void File::flush() {
  errno = 0;
  if (std::fflush(file_.get())) fail();
}

void File::close() {
  errno = 0;
  if (file_ && std::fclose(file_.release())) fail();
}

void File::fail() const { output::fail("write", name_, last_error()); }

AtomicFile::AtomicFile(fs::path path)
    : path_(std::move(path)), temporary_(temporary_name(path_)), file_(temporary_, path_) {}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  file_.close();
  std::error_code reason;
  fs::rename(temporary_, path_, reason);
  if (reason) output::fail("write", path_, reason);
  committed_ = true;
}

void write_whole(const fs::path& path, std::string_view text) {
  AtomicFile whole(path);
  whole.file().write(text);
  whole.commit();
}

void make_directory(const fs::path& path) {
  std::error_code reason;
  fs::create_directories(path, reason);
  if (!reason && !fs::is_directory(path, reason) && !reason) reason = {ENOTDIR, std::generic_category()};
  if (reason) fail("make the directory", path, reason);
}

bool holds_results(const fs::path& directory) { return !results(directory).empty(); }

void remove_results(const fs::path& directory) {
  for (const fs::path& path : results(directory)) {
    std::error_code reason;
    fs::remove(path, reason);
    if (reason) fail("remove", path, reason);
  }
}

}  // namespace geist::output
