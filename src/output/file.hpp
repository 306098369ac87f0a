// Files that are written whole or not at all, and errors that name the file and the reason.
#pragma once
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace geist::output {

/// A file opened for writing (emptied if it exists). Every call throws std::runtime_error with the file's
/// name and the system's reason if it cannot do its work.
class File {
 public:
  explicit File(const std::filesystem::path& path) : File(path, path) {}
  /// Write at `path`, but speak of `name` in messages.
  File(const std::filesystem::path& path, const std::filesystem::path& name);

  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Hand everything written to the system, so that it survives the end of this process.
  void flush();
  void close();

 private:
  [[noreturn]] void fail() const;
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::filesystem::path name_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// A file that appears under its name, complete, at commit(); until then, or if anything fails, what was
/// there stays.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  File& file() { return file_; }
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  File file_;
  bool committed_ = false;
};

/// Write the text to the file, whole or not at all.
void write_whole(const std::filesystem::path& path, std::string_view text);

/// Make a directory and those above it; nothing happens if it exists. Throws std::runtime_error.
void make_directory(const std::filesystem::path& path);

/// Names of a run's results in its directory.
inline constexpr std::string_view summary_name = "summary.json", history_name = "history.csv",
                                  case_name = "case-as-run.toml", fields_name = "fields.pvd",
                                  fields_folder = "fields";

/// Whether the directory holds results of a run.
bool holds_results(const std::filesystem::path& directory);
/// Remove the results of an earlier run, and nothing else. Throws std::runtime_error.
void remove_results(const std::filesystem::path& directory);

}  // namespace geist::output
