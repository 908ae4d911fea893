// Output that is either whole or absent.
#pragma once

#include <cerrno>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "mesher/core/error.hpp"

namespace cbc3d {

/// A file could not be written; the message names the file and the reason.
class WriteError : public JobError {
 public:
  WriteError(const std::filesystem::path& path, const std::string& reason);
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

/// Throws WriteError with the reason that `error`, a value of errno, stands for. Libraries that do not keep
/// errno are called after it was set to 0, which means that the reason is not known.
[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error = errno);

/// A file under construction. Write to `temporary()`, then `commit()` gives it its final name; without a
/// commit the temporary file is removed, so nothing half-written is ever found under the final name.
class AtomicFile {
 public:
  /// Throws InputError when the folder of `path` is absent or cannot be written to.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Gives the file its final name. Throws WriteError when that fails.
  void commit();
  /// Lets `write` write the temporary file and commits. What it throws as a WriteError gets the final name.
  void fill(const std::function<void(const std::filesystem::path&)>& write);

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// Throws InputError unless a file could be created in the folder of `path` and `path` itself is no folder.
void require_writable(const std::filesystem::path& path);

/// Writes `text` as the whole content of `path`, atomically. Throws WriteError (a full disk, say).
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace cbc3d
