// What a command runs: cases, meshers and their parameters, as given on its command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "reports/run/runner.hpp"

namespace cbc3d::reports {

struct Selection {
  std::vector<std::string> suites, cases, meshers;
  std::vector<std::string> externals;  ///< JSON files of meshers from outside
  std::vector<std::string> data;       ///< folders with case images
  std::vector<std::string> settings;   ///< MESHER.KEY=VALUE
  std::string parameter_set;           ///< of the cases' manifests or the meshers; empty: none
  std::string manifests;               ///< folder of case manifests; empty: the installed ones
};

/// Adds --suite, --case, --mesher, --external, --data, --parameter-set, --set and --manifests.
void add_selection_options(CLI::App* parser, Selection& selection);
/// Adds --threads, --repeat, --timeout, --evaluation-timeout, --file-limit, --memory-limit (in GiB, into
/// `memory_limit_gib`).
void add_limit_options(CLI::App* parser, RunOptions& run, double& memory_limit_gib);

/// The case manifests of a folder, or the installed ones when it is empty.
std::vector<cases::Case> cases_of(const std::string& manifests);

/// The meshers of the registry and those of JSON files. Throws InputError for one that is there twice.
std::vector<baselines::Adapter> all_meshers(const std::vector<std::string>& externals);

/// The suite in which every mesher's size dial is swept over budgets.
inline constexpr std::string_view kFrontSuite = "front";
/// Its budgets, elements.
inline const std::vector<std::int64_t> kFrontBudgets{25'000, 50'000, 100'000, 200'000, 400'000};
/// The parameter set of meshers at their best, which it takes unless another is named.
inline constexpr std::string_view kTunedSet = "tuned";
/// The name for the manifests' parameters as they stand.
inline constexpr std::string_view kPublishedSet = "published";

/// True when the suite `front` is among the selection's.
bool selects_front(const Selection& selection);

/// What the selection runs with; generated images go to `out_dir`/images. Throws InputError naming the
/// option.
Bench make_bench(const Selection& selection, const std::filesystem::path& out_dir);

/// The parameters by mesher that the selection sets. Throws InputError.
std::map<std::string, Parameters> parse_settings(const Selection& selection);

/// "2/8". Throws InputError.
Shard parse_shard(const std::string& text);

}  // namespace cbc3d::reports
