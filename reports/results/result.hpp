// The lines of results.jsonl: one JSON object for every job.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace cbc3d::reports {

using Json = nlohmann::ordered_json;

/// What became of a job, in the order in which summaries list it.
inline constexpr const char* kStatuses[] = {"ok",      "failed",     "crashed", "timeout", "out_of_memory",
                                            "skipped", "unavailable"};

/// A result line with every key there and every figure null.
Json empty_result();

/// Puts the sections of an evaluation that the catalog of metrics names, and its keys image, faults and
/// evaluation_peak_mb, into a result line. Keys that the evaluation lacks stay null.
void merge_evaluation(Json& result, const nlohmann::json& evaluation);

/// Appends one line with a single write and waits until it is on the disk, so that a reader, or a run that
/// was cut off, never has half a line of ours between two whole ones. On a full disk the file stays as it
/// was. Throws JobError.
void append_result(const std::filesystem::path& file, const Json& result);

/// Writes the whole file anew, atomically. Throws JobError.
void replace_results(const std::filesystem::path& file, const std::vector<Json>& results);

/// The lines of a file; a last line that was cut off is left out. No file: no lines. Throws InputError for a
/// line that is no JSON object or lacks case or mesher.
std::vector<Json> read_results(const std::filesystem::path& file);

/// Removes a last line that was cut off (a machine that went down), so that lines can be appended again.
void drop_torn_line(const std::filesystem::path& file);

/// What identifies a job among the lines of one file: "CASE-MESHER-tTHREADS-rREPEAT", and of one with a
/// budget "CASE-MESHER-nBUDGET-tTHREADS-rREPEAT".
std::string result_id(const Json& result);

/// result_id without what a file name should not have.
std::string file_stem(const Json& result);

/// The keys of a path such as "fidelity.hausdorff_mm".
std::vector<std::string> split_path(std::string_view path);

/// The figure at a path such as {"fidelity", "hausdorff_mm"}; null where any of it is absent.
Json figure(const Json& result, const std::vector<std::string>& path);

}  // namespace cbc3d::reports
