// cbc3d-bench list: what there is to run.
#include <iostream>
#include <map>

#include "cases/core/case.hpp"
#include "cases/manifest.hpp"
#include "metrics/catalog.hpp"
#include "reports/commands/commands.hpp"
#include "reports/commands/selection.hpp"
#include "reports/run/workplace.hpp"

namespace cbc3d::reports {
namespace {

struct ListOptions {
  std::string what;
  std::vector<std::string> data, externals;
  std::string manifests;
  int threads = 0;
  bool quiet = false;
};

void list_dial_and_sets(const baselines::Adapter& mesher) {
  if (const auto dial = baselines::size_dial_of(mesher, bin_dir())) {
    std::cout << "    size dial: " << dial->parameter << '\n';
  }
  for (const auto& [set, parameters] : mesher.parameter_sets) {
    std::cout << "    parameter set " << set << ':';
    for (const auto& [key, value] : parameters) {
      std::cout << ' ' << key << '=' << value;
    }
    std::cout << '\n';
  }
}

void list_meshers(const ListOptions& options) {
  for (const baselines::Adapter& mesher : all_meshers(options.externals)) {
    const baselines::Availability availability = mesher.availability(bin_dir());
    std::cout << mesher.name << ": " << mesher.description << " [" << mesher.licence << "]"
              << (mesher.multithreaded ? "" : ", sequential")
              << (mesher.deterministic ? "" : ", not deterministic")
              << (availability.available ? "" : "\n    unavailable: " + availability.reason) << '\n';
    for (const baselines::ParameterSpec& parameter : mesher.parameters.in(bin_dir())) {
      std::cout << "    " << parameter.key << " = " << parameter.default_value
                << (parameter.unit.empty() ? "" : " " + parameter.unit) << ": " << parameter.description
                << '\n';
    }
    list_dial_and_sets(mesher);
  }
}

void list_cases(const ListOptions& options) {
  const auto folders = data_dirs({options.data.begin(), options.data.end()});
  for (const cases::Case& subject : cases_of(options.manifests)) {
    std::cout << subject.name << ": " << subject.title << '\n';
    std::cout << "    suites:";
    for (const std::string& suite : subject.suites) {
      std::cout << ' ' << suite;
    }
    std::cout << '\n';
    if (subject.image_file) {
      const std::string& file = subject.image_file.value();
      std::cout << "    image: " << file << " (" << subject.image_source << ")\n";
      bool found = false;
      for (const auto& folder : folders) {
        found = found || std::filesystem::exists(folder / file);
      }
      std::cout << (found ? "" : "    not found in the data folders: will be skipped\n");
    } else if (subject.phantom) {
      std::cout << "    phantom: " << subject.phantom.value().name << '\n';
    }
  }
}

void list_suites(const ListOptions& options) {
  std::map<std::string, std::string> suites;
  for (const cases::Case& subject : cases_of(options.manifests)) {
    for (const std::string& suite : subject.suites) {
      suites[suite] += " " + subject.name;
    }
  }
  for (const auto& [suite, names] : suites) {
    const std::string way =
        suite == kFrontSuite ? " (every mesher at 25, 50, 100, 200 and 400 thousand elements)" : "";
    std::cout << suite << way << ":" << names << '\n';
  }
}

}  // namespace

Command add_list_command(CLI::App& app) {
  auto options = std::make_shared<ListOptions>();
  CLI::App* parser = app.add_subcommand("list", "Lists the meshers, the cases, the suites or the metrics");
  parser->add_option("WHAT", options->what, "meshers, cases, suites or metrics")
      ->required()
      ->check(CLI::IsMember({"meshers", "cases", "suites", "metrics"}));
  parser->add_option("--data", options->data, "folder with case images (may be given again)")
      ->allow_extra_args(false);
  parser
      ->add_option("--external", options->externals,
                   "JSON file of a mesher from outside (may be given again)")
      ->allow_extra_args(false);
  add_manifests_option(parser, options->manifests);
  add_idle_options(parser, options->threads, "listing needs", options->quiet,
                   "no progress (listing shows none)");
  return {parser, [options] {
            if (options->what == "meshers") {
              list_meshers(*options);
            } else if (options->what == "cases") {
              list_cases(*options);
            } else if (options->what == "suites") {
              list_suites(*options);
            } else {
              std::cout << metrics::catalog_text();
            }
            return 0;
          }};
}

}  // namespace cbc3d::reports
