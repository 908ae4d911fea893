#include "reports/commands/selection.hpp"

#include <algorithm>
#include <charconv>

#include "baselines/external.hpp"
#include "baselines/registry.hpp"
#include "mesher/command_line/number_range.hpp"
#include "mesher/core/error.hpp"
#include "reports/commands/commands.hpp"
#include "reports/run/solve.hpp"
#include "reports/run/workplace.hpp"

namespace cbc3d::reports {
namespace {

template <class Things>
std::string names_of(const Things& things) {
  std::string names;
  for (const auto& thing : things) {
    names += (names.empty() ? "" : ", ") + thing.name;
  }
  return names;
}

template <class Things>
auto find_named(const Things& things, const std::string& name) {
  return std::find_if(things.begin(), things.end(), [&](const auto& thing) { return thing.name == name; });
}

std::vector<cases::Case> chosen_cases(const Selection& selection, const std::vector<cases::Case>& all) {
  // Cases beside the suite `front` are run in its way.
  const bool is_front_of_cases = selection.suites == std::vector<std::string>{std::string(kFrontSuite)};
  if (selection.suites.empty() == selection.cases.empty() && !is_front_of_cases) {
    throw InputError("give either --suite or --case; `cbc3d-bench list suites` and `list cases` name them");
  }
  std::vector<cases::Case> chosen;
  const auto add = [&](const cases::Case& subject) {
    if (find_named(chosen, subject.name) == chosen.end()) {
      chosen.push_back(subject);
    }
  };
  for (const std::string& name : selection.cases) {
    const auto found = find_named(all, name);
    if (found == all.end()) {
      throw InputError("--case '" + name + "' is unknown; there are " + names_of(all));
    }
    add(*found);
  }
  for (const std::string& suite : chosen.empty() ? selection.suites : std::vector<std::string>{}) {
    const auto is_in = [&](const cases::Case& c) {
      return std::find(c.suites.begin(), c.suites.end(), suite) != c.suites.end();
    };
    if (std::none_of(all.begin(), all.end(), is_in)) {
      throw InputError("--suite '" + suite + "' is unknown; `cbc3d-bench list suites` names them");
    }
    for (const cases::Case& subject : all) {
      if (is_in(subject)) {
        add(subject);
      }
    }
  }
  return chosen;
}

std::vector<baselines::Adapter> chosen_meshers(const Selection& selection) {
  std::vector<baselines::Adapter> all = all_meshers(selection.externals);
  if (selection.meshers.empty()) {
    return all;
  }
  std::vector<baselines::Adapter> chosen;
  for (const std::string& name : selection.meshers) {
    const auto found = find_named(all, name);
    if (found == all.end()) {
      throw InputError("--mesher '" + name + "' is unknown; there are " + names_of(all) +
                       "; --external FILE.json adds one");
    }
    if (find_named(chosen, name) == chosen.end()) {
      chosen.push_back(*found);
    }
  }
  return chosen;
}

/// Lays a parameter set over the parameters of a case: what the meshers have under that name, then what the
/// case has. Throws InputError where neither has any, if the set `is_needed`.
void lay_over(cases::Case& subject, const std::string& set, bool is_needed,
              const std::vector<baselines::Adapter>& meshers) {
  if (set == kPublishedSet) {
    return;
  }
  bool is_meshers = false;
  for (const baselines::Adapter& mesher : meshers) {
    const auto found = mesher.parameter_sets.find(set);
    if (found != mesher.parameter_sets.end()) {
      is_meshers = true;
      for (const auto& [key, value] : found->second) {
        subject.parameters[mesher.name][key] = value;
      }
    }
  }
  if (subject.parameter_sets.contains(set) || (is_needed && !is_meshers)) {
    cases::use_parameter_set(subject, set);
  }
}

}  // namespace

bool selects_front(const Selection& selection) {
  return std::find(selection.suites.begin(), selection.suites.end(), kFrontSuite) != selection.suites.end();
}

void add_selection_options(CLI::App* parser, Selection& selection) {
  parser->add_option("--suite", selection.suites, "suites of cases (see: list suites)");
  parser->add_option("--case", selection.cases, "cases (see: list cases)");
  parser->add_option("--mesher", selection.meshers, "meshers; default: all (see: list meshers)");
  parser
      ->add_option("--external", selection.externals,
                   "JSON file that names the command of a mesher from outside (may be given again); it is "
                   "then called external:NAME")
      ->allow_extra_args(false);
  parser
      ->add_option("--data", selection.data,
                   "folder with case images (may be given again); then those in CBC3D_DATA, then ../data "
                   "beside the programs")
      ->allow_extra_args(false);
  parser->add_option(
      "--parameter-set", selection.parameter_set,
      "a named set of the cases' manifests or the meshers (equal_count, tuned), laid over "
      "the cases' parameters; published: these as they are. Default: published, with the suite "
      "front tuned");
  parser
      ->add_option("--set", selection.settings,
                   "MESHER.KEY=VALUE: a parameter of a mesher (may be given again)")
      ->allow_extra_args(false);
  add_manifests_option(parser, selection.manifests);
}

void add_limit_options(CLI::App* parser, RunOptions& run, double& memory_limit_gib) {
  parser
      ->add_option("--threads", run.threads,
                   "thread counts, separated by commas; 0: all cores. Sequential meshers run once, with 1")
      ->delimiter(',')
      ->check(thread_count())
      ->capture_default_str();
  parser->add_flag(
      "--bind-threads", run.bind_threads,
      "threads of OpenMP meshers stay each on a core of its own (OMP_PROC_BIND), so that no time goes to "
      "the system finding them one; for a machine that does nothing else");
  parser->add_option("--repeat", run.repeats, "runs of every job")
      ->check(whole_number_between(1, 10000))
      ->capture_default_str();
  parser->add_option("--timeout", run.timeout_s, "time limit of every mesher and solver, s")
      ->check(number_between(1e-3, 1e7))
      ->capture_default_str();
  parser
      ->add_option(
          "--evaluation-timeout", run.evaluation_timeout_s,
          "time limit of judging one mesh, s; a mesh that could not be judged in time keeps its counts "
          "and seconds")
      ->check(number_between(1e-3, 1e7))
      ->capture_default_str();
  parser
      ->add_option_function<double>(
          "--file-limit",
          [&run](double gib) { run.file_limit_bytes = static_cast<std::int64_t>(gib * double(1 << 30)); },
          "limit of every file that a mesher writes, GiB")
      ->check(number_between(1e-6, 1e6))
      ->default_str("16");
  parser->add_option("--memory-limit", memory_limit_gib, "memory limit of every job's processes, GiB")
      ->check(number_between(1e-3, 1e6))
      ->capture_default_str();
}

std::vector<cases::Case> cases_of(const std::string& manifests) {
  return cases::load_cases(manifests.empty() ? manifest_dir() : std::filesystem::path(manifests));
}

std::vector<baselines::Adapter> all_meshers(const std::vector<std::string>& externals) {
  std::vector<baselines::Adapter> all = baselines::registry();
  for (const std::string& file : externals) {
    baselines::Adapter mesher = baselines::load_external_mesher(file);
    if (find_named(all, mesher.name) != all.end()) {
      throw InputError("--external '" + file + "': \"name\" gives " + mesher.name +
                       ", which another file gives too; choose another name");
    }
    all.push_back(std::move(mesher));
  }
  return all;
}

Bench make_bench(const Selection& selection, const std::filesystem::path& out_dir) {
  Bench bench;
  bench.cases = chosen_cases(selection, cases_of(selection.manifests));
  bench.meshers = chosen_meshers(selection);
  const bool is_named = !selection.parameter_set.empty();
  const std::string set = is_named                   ? selection.parameter_set
                          : selects_front(selection) ? std::string(kTunedSet)
                                                     : std::string(kPublishedSet);
  for (cases::Case& subject : bench.cases) {
    lay_over(subject, set, is_named, bench.meshers);
  }
  bench.bin_dir = bin_dir();
  bench.evaluate_command = {executable_file(), "evaluate"};
  bench.solve_command = solve_command(bench.bin_dir);
  bench.resolve_image = [folders = data_dirs({selection.data.begin(), selection.data.end()}),
                         cache_dir = out_dir / "images"](const cases::Case& subject) {
    return cases::resolve_image(subject, folders, cache_dir);
  };
  return bench;
}

std::map<std::string, Parameters> parse_settings(const Selection& selection) {
  const std::vector<baselines::Adapter> all = all_meshers(selection.externals);
  std::map<std::string, Parameters> parameters;
  for (const std::string& setting : selection.settings) {
    const std::size_t equals = setting.find('=');
    const std::size_t dot = setting.find('.');
    if (dot == std::string::npos || equals == std::string::npos || dot > equals || dot == 0) {
      throw InputError("--set '" + setting + "': give MESHER.KEY=VALUE, for example cgal.cell-size=2");
    }
    const std::string mesher = setting.substr(0, dot);
    if (find_named(all, mesher) == all.end()) {
      throw InputError("--set '" + setting + "': mesher '" + mesher + "' is unknown; there are " +
                       names_of(all));
    }
    parameters[mesher][setting.substr(dot + 1, equals - dot - 1)] = setting.substr(equals + 1);
  }
  return parameters;
}

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool slash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto count = slash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
  if (!slash || count.ec != std::errc() || count.ptr != end || shard.index < 1 || shard.index > shard.count) {
    throw InputError("--shard '" + text + "': give I/N with I from 1 to N, for example 2/8");
  }
  return shard;
}

}  // namespace cbc3d::reports
