// What became of one job, decoded from its line: tables, charts, the gate and the report read this and no
// JSON.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/core/label_names.hpp"
#include "metrics/catalog.hpp"
#include "reports/results/result.hpp"

namespace cbc3d::reports {

/// Parameters of a mesher by their keys.
using Parameters = std::map<std::string, std::string>;

/// The image of a case, as it was read.
struct ImageData {
  std::vector<std::int64_t> size;  ///< voxels along each axis
  std::vector<double> spacing_mm;
  std::vector<std::int64_t> labels;
  LabelNames names{};  ///< of its labels
};

struct JobResult {
  std::string id;  ///< "CASE-MESHER-tTHREADS-rREPEAT", see result_id
  std::string case_name, mesher;
  int threads = 1;
  int repeat = 0;
  std::optional<std::int64_t> budget;  ///< elements that the mesh should have; none: no number was asked for
  std::string budget_shortfall;        ///< why it has not about so many; empty: it has
  Parameters parameters;               ///< that the job ran with
  std::string status;                  ///< one of kStatuses; empty: the line has none
  std::string reason;                  ///< why the job is not ok
  std::string mesh_file;               ///< relative to the run's folder; empty: no mesh
  std::string mesh_sha256;
  std::optional<ImageData> image;  ///< none: it was not read
  metrics::Figures figures;
  /// The labels named beside a figure: where it is the worst, or which have what is counted.
  std::map<metrics::MetricId, std::vector<long>> worst_labels;
  std::vector<long> missing_labels;  ///< of the image, not in the mesh
  std::string solver_reason;  ///< why a solver that was asked has no figures; empty: it has, or was not asked
  std::vector<double> dihedral_histogram;  ///< angles in steps of 5 degrees; empty: not known
  std::vector<std::pair<std::string, double>> stage_seconds;  ///< in the order in which the stages ran
  bool includes_files = false;          ///< the time is of the whole process, reading and writing included
  Parameters reported_parameters;       ///< that the mesher says were in force
  std::optional<double> target_points;  ///< of a deformation
  metrics::Figures voxel_surface;       ///< section `shape` for the voxel faces in place of the mesh
  std::size_t labels_with_shape = 0;    ///< whose true shape the mesh was compared with
  bool mesher_is_deterministic = true;
  std::string image_file;  ///< that was meshed; empty: not known
  Json line;               ///< all of it, with what nobody here reads, to be written again

  [[nodiscard]] bool is_ok() const { return status == "ok"; }
  /// Seconds of a stage; none where the job has no such stage.
  [[nodiscard]] std::optional<double> stage(const std::string& name) const;
  /// An entry of the open record of where the figures come from; null where there is none.
  [[nodiscard]] Json provenance(const char* key) const;
};

/// Lines of one case and mesher, say, in a list of results.
using Runs = std::vector<const JobResult*>;

/// Decodes a line. What is absent, or of another type than it should be, counts as not known.
JobResult decode(Json line);
std::vector<JobResult> decode_lines(std::vector<Json> lines);

/// The results of a run's folder. Throws InputError when it holds none, and as read_results.
std::vector<JobResult> results_of(const std::filesystem::path& folder);

/// Status and reason of a job that is not ok: "crashed: SIGSEGV".
std::string failure_of(const JobResult& result);

/// "12 jobs: 10 ok, 1 crashed, 1 skipped".
std::string summary_line(const std::vector<JobResult>& results);

}  // namespace cbc3d::reports
