// The part of the report that shows every mesh in 3D.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

struct ViewOptions {
  double megabytes = 8;  ///< of the page that the meshes may take; 0: no view
  /// Each mesh shows so many tets at most, whatever the page may hold: a phone turns them smoothly.
  std::size_t most_tets = 250'000;
};

/// The mesh of the first good job of every case, mesher, thread count and budget, as data of the page, and
/// the place where the script puts the view; what is not shown is named with its reason. Without the script
/// (see view_script) it is a line that says so. `folder`: of the run, in which its mesh files are.
std::string view_section(const std::filesystem::path& folder, const std::vector<JobResult>& results,
                         const ViewOptions& options);

}  // namespace cbc3d::reports
