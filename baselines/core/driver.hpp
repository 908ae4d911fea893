// The protocol of the meshers' executables:
//
//   EXE --image IMAGE --out MESH --report FILE.json --threads N [--quiet] [--key value]...
//
// Exit codes as everywhere in the project (0, 2, 3). The report is written on failure too, and holds
//   {"status":"ok|failed|out_of_memory","reason":"","seconds":{"total":s,"cpu":s,"stages":{"name":s}},
//    "peak_rss_bytes":n,"counts":{"vertices":n,"tets":n},"parameters":{...},"versions":{...}}
// where "total" and "cpu" cover the meshing from the image in memory to the mesh in memory, child processes
// included.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "baselines/core/adapter.hpp"
#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/core/stage_clock.hpp"

namespace cbc3d::baselines {

/// Parameter values by key, checked as they are read.
class ParameterValues {
 public:
  /// Starts from the defaults of `specs`.
  explicit ParameterValues(const std::vector<ParameterSpec>& specs);
  /// The value's text, to be set by a command-line parser. `key` must be one of the specs'.
  std::string& text(const std::string& key) { return values_.at(key); }
  [[nodiscard]] const std::map<std::string, std::string>& all() const { return values_; }

  /// The value as a number in [lowest, highest]. Throws InputError.
  [[nodiscard]] double number(const std::string& key, double lowest, double highest) const;
  /// The value as a whole number in [lowest, highest]. Throws InputError.
  [[nodiscard]] int count(const std::string& key, int lowest, int highest) const;
  /// The value, which is one of the choices. Throws InputError.
  [[nodiscard]] const std::string& one_of(const std::string& key,
                                          const std::vector<std::string>& choices) const;
  /// The value as true or false. Throws InputError.
  [[nodiscard]] bool flag(const std::string& key) const;

 private:
  std::map<std::string, std::string> values_;
};

/// A mesher behind the protocol.
struct MesherProgram {
  Adapter adapter;                              ///< gives the name and the parameters
  std::map<std::string, std::string> versions;  ///< of the libraries that do the work
  /// Checks the parameter values. Throws InputError. Called before the image is read.
  std::function<void(const ParameterValues&)> check;
  /// Meshes the image; the result is in physical space with the image's own labels.
  std::function<Mesh(const LabelImage&, const ParameterValues&, int threads, StageClock&)> run;
};

/// What a mesher has to say of its mesh, a line each on standard error.
void print_warnings(const std::vector<std::string>& notes);

/// The whole of main(): parse, read, mesh, write, report. Returns the exit code.
int run_mesher_program(const MesherProgram& program, int argc, char** argv);

}  // namespace cbc3d::baselines
