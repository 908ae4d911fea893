// Output that is either whole or absent.
#pragma once

#include <filesystem>
#include <string_view>

namespace cbc3d {

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
  /// Gives the file its final name. Throws JobError when that fails.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// Throws InputError unless a file could be created in the folder of `path` and `path` itself is no folder.
void require_writable(const std::filesystem::path& path);

/// Writes `text` as the whole content of `path`, atomically. Throws JobError (a full disk, say).
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace cbc3d
