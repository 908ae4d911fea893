// What a command runs: cases, meshers and their parameters, as given on its command line.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "reports/run/runner.hpp"

namespace cbc3d::reports {

struct Selection {
  std::vector<std::string> suites, cases, meshers;
  std::vector<std::string> externals;  ///< JSON files of meshers from outside
  std::vector<std::string> data;       ///< folders with case images
  std::vector<std::string> settings;   ///< MESHER.KEY=VALUE
  std::string parameter_set;           ///< of the cases' manifests; empty: none
  std::string manifests;               ///< folder of case manifests; empty: the installed ones
};

/// Adds --suite, --case, --mesher, --external, --data, --parameter-set, --set and --manifests.
void add_selection_options(CLI::App* parser, Selection& selection);
/// Adds --threads, --repeat, --timeout, --memory-limit (in GiB, into `memory_limit_gib`).
void add_limit_options(CLI::App* parser, RunOptions& run, double& memory_limit_gib);

/// The case manifests of a folder, or the installed ones when it is empty.
std::vector<cases::Case> cases_of(const std::string& manifests);

/// The meshers of the registry and those of JSON files. Throws InputError for one that is there twice.
std::vector<baselines::Adapter> all_meshers(const std::vector<std::string>& externals);

/// What the selection runs with; generated images go to `out_dir`/images. Throws InputError naming the
/// option.
Bench make_bench(const Selection& selection, const std::filesystem::path& out_dir);

/// The parameters by mesher that the selection sets. Throws InputError.
std::map<std::string, Parameters> parse_settings(const Selection& selection);

/// "2/8". Throws InputError.
Shard parse_shard(const std::string& text);

}  // namespace cbc3d::reports
