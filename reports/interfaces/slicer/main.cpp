// cbc3d-slicer: the mesher as a command line module of 3D Slicer.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <new>

#include "mesher/core/error.hpp"
#include "mesher/core/one_line.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/mesh_formats/output_texts.hpp"
#include "mesher/pipeline/presets.hpp"
#include "reports/interfaces/slicer/module_description.hpp"
#include "reports/interfaces/slicer/module_run.hpp"

namespace {

using cbc3d::slicer::ModuleRun;

/// Every option by its flag. An empty text and kPresetChoice leave the preset's value.
void add_options(CLI::App& app, ModuleRun& run) {
  for (const cbc3d::OptionRow& row : cbc3d::option_table()) {
    if (cbc3d::slicer::widget_of(row) == cbc3d::slicer::Widget::boolean) {
      app.add_flag_callback(
          "--" + row.name, [&] { run.settings.emplace_back(row.name, true); }, row.text);
      continue;
    }
    app.add_option_function<std::string>(
        "--" + row.name,
        [&](const std::string& text) {
          if (!text.empty() && text != cbc3d::slicer::kPresetChoice) {
            run.settings.emplace_back(row.name, cbc3d::checked_value(row, text));
          }
        },
        row.text);
  }
}

/// The choices about the label map; an empty text is a choice not made.
void add_input_options(CLI::App& app, cbc3d::ImageInput& input) {
  for (const cbc3d::InputOption* const option : cbc3d::slicer::module_input_options()) {
    if (option->symbol.empty()) {
      app.add_flag_callback(
          "--" + option->name, [option, &input] { set_input_option(*option, "true", input); }, option->text);
      continue;
    }
    app.add_option_function<std::string>(
        "--" + option->name,
        [option, &input](const std::string& text) {
          if (!text.empty()) set_input_option(*option, text, input);
        },
        option->text);
  }
}

void print_description() {
  std::cout << cbc3d::slicer::module_description(CBC3D_VERSION);
  throw CLI::Success();
}

struct Arguments {
  ModuleRun run;
  int threads = 0;
  std::string return_parameters, process_address;  // Slicer may give them; the module returns no parameters
};

void add_arguments(CLI::App& app, Arguments& arguments) {
  arguments.run.preset = cbc3d::preset_names().front();
  app.add_flag_callback("--xml", print_description, "Print the module's description for Slicer and exit");
  app.set_version_flag("--version", CBC3D_VERSION);
  app.add_option("labelMap", arguments.run.label_map, "label map, in LPS")->required();
  app.add_option("mesh", arguments.run.model, "model: .vtk or .vtu, in LPS mm")->required();
  app.add_option("--preset", arguments.run.preset)->check(CLI::IsMember(cbc3d::preset_names()));
  app.add_option("--threads", arguments.threads, "0: all cores")->check(CLI::Range(0, 1024));
  app.add_option("--returnparameterfile", arguments.return_parameters)->group("");
  app.add_option("--processinformationaddress", arguments.process_address)->group("");
  app.add_option("--order", arguments.run.order, cbc3d::kOrderText)->check(CLI::IsMember({1, 2}));
  app.add_flag("--split-interfaces", arguments.run.writing.split_interfaces, cbc3d::kSplitInterfacesText);
  add_input_options(app, arguments.run.input);
  add_options(app, arguments.run);
}

int run(CLI::App& app, Arguments& arguments, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    cbc3d::set_thread_count(arguments.threads);
    for (const std::string& warning : cbc3d::slicer::run_module(arguments.run, std::cout)) {
      std::cerr << "warning: " << warning << '\n';
    }
    return cbc3d::kExitSuccess;
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::cerr << "cbc3d-slicer: " << cbc3d::one_line(error.what()) << " (see --help)\n";
    return cbc3d::kExitBadInput;
  } catch (const cbc3d::InputError& error) {
    std::cerr << "cbc3d-slicer: " << cbc3d::one_line(error.what()) << '\n';
    return cbc3d::kExitBadInput;
  } catch (const std::bad_alloc&) {
    std::cerr << "cbc3d-slicer: out of memory; use a coarser lattice or a machine with more memory\n";
    return cbc3d::kExitJobFailed;
  } catch (const std::exception& error) {
    std::cerr << "cbc3d-slicer: " << cbc3d::one_line(error.what()) << '\n';
    return cbc3d::kExitJobFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  cbc3d::open_standard_streams();
  cbc3d::let_waiting_threads_sleep(argv);
  cbc3d::keep_freed_memory();
  CLI::App app{"CBC3D as a command line module of 3D Slicer: a label map in, a mesh out, both in LPS mm"};
  Arguments arguments;
  add_arguments(app, arguments);
  return run(app, arguments, argc, argv);
}
