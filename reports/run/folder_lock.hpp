// One runner a folder.
#pragma once

#include <filesystem>

namespace cbc3d::reports {

/// Holds a folder for one runner, by a lock on its file `.lock`. The kernel lets go of it when the runner and
/// the keeper of its running job are gone, whatever ended them, so there are no stale locks.
class FolderLock {
 public:
  /// Throws InputError when another runner holds the folder, JobError when the file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace cbc3d::reports
