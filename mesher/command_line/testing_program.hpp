// A small program with every kind of option.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "mesher/command_line/program_help.hpp"

namespace cbc3d::testing {

inline ProgramHelp knife_help() {
  return {.name = "bread-knife",
          .version = "1.2",
          .summary = "cuts bread",
          .examples = {{"bread-knife cut rye.loaf --thickness 9", "Thick slices."}},
          .exit_codes = {"success", "no bread"}};
}

inline std::unique_ptr<CLI::App> knife() {
  auto app = std::make_unique<CLI::App>("Cuts bread, not fingers.");
  app->require_subcommand(1);
  CLI::App* cut = app->add_subcommand("cut", "cuts a loaf; it's sharp");
  cut->add_option("loaf")->description("what is cut")->required();
  cut->add_option("--thickness,-t")->description("of a slice [5]")->type_name("MM")->group("Slices");
  cut->add_option("--crust")->description("what becomes of it")->type_name("keep|leave")->group("Slices");
  cut->add_option("--board")->check(CLI::IsMember({"oak", "beech"}))->required();
  cut->add_flag("--crumbs")->description("keep them: \\ and [those]");
  cut->add_flag("--secret")->group("");
  app->add_subcommand("sharpen", "sharpens the knife");
  return app;
}

}  // namespace cbc3d::testing
