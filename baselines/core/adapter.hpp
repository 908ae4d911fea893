// What the bench knows of a mesher: its parameters, whether it is built, and the command that runs it.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "baselines/core/size_dial.hpp"

namespace cbc3d::baselines {

/// One run of a mesher: files, threads and the parameters that differ from their defaults.
struct MeshJob {
  std::filesystem::path image{};                  ///< label image to read
  std::filesystem::path mesh{};                   ///< mesh file to write
  std::filesystem::path report{};                 ///< JSON report to write
  int threads = 1;                                ///< threads of the whole run, at least 1
  std::map<std::string, std::string> parameters;  ///< by ParameterSpec::key; absent ones take their default
};

/// A parameter of a mesher, given on its command line as `--key value`.
struct ParameterSpec {
  std::string key;            ///< its long option without hyphens
  std::string default_value;  ///< as text, or in words where it depends on the image
  std::string unit;           ///< "mm", "deg", ...; "" for a bare number, "true|false" for a switch
  std::string description;    ///< one line
};

using ParameterSpecs = std::vector<ParameterSpec>;

/// The parameters of a mesher: a list, or what its own program says of them.
class ParameterSource {
 public:
  /// Gives the parameters of the program in a folder; none where it is not there.
  using Reader = std::function<ParameterSpecs(const std::filesystem::path& bin_dir)>;

  ParameterSource(std::initializer_list<ParameterSpec> specs) : ParameterSource(ParameterSpecs(specs)) {}
  explicit ParameterSource(ParameterSpecs specs = {})
      : ParameterSource([specs = std::move(specs)](const std::filesystem::path&) { return specs; }) {}
  explicit ParameterSource(Reader reader);

  /// The parameters with the programs in `bin_dir`. The program is asked on the first call for its folder
  /// only.
  [[nodiscard]] const ParameterSpecs& in(const std::filesystem::path& bin_dir) const&;
  /// A copy, for a source that does not outlive the expression.
  [[nodiscard]] ParameterSpecs in(const std::filesystem::path& bin_dir) const&& { return in(bin_dir); }

 private:
  struct Cache;
  std::shared_ptr<Cache> cache_;  ///< shared by copies, so that the program is asked once for all
};

/// Whether a mesher can run here; `reason` says why not and how to get it.
struct Availability {
  bool available = false;
  std::string reason;  ///< empty when available
};

/// A mesher as the bench sees it.
struct Adapter {
  std::string name{};
  std::string description{};
  std::string licence{};       ///< SPDX expression
  bool deterministic = true;   ///< same input, same bytes
  bool multithreaded = false;  ///< the meshing itself gains from more threads
  bool openmp = false;         ///< all its threads are OpenMP's
  ParameterSource parameters{};
  std::function<Availability(const std::filesystem::path& bin_dir)> availability{};
  /// The argument vector of a job. Throws InputError for a parameter the mesher does not have.
  std::function<std::vector<std::string>(const std::filesystem::path& bin_dir, const MeshJob&)> command{};
  /// How the number of elements is set with the programs in `bin_dir`; null, or none: the mesher has no such
  /// parameter.
  std::function<std::optional<SizeDial>(const std::filesystem::path& bin_dir)> size_dial{};
  /// Parameters of the mesher for any image, by the name of their set.
  std::map<std::string, std::map<std::string, std::string>> parameter_sets{};
  std::string image_extension{};               ///< in which it takes images; empty: in that of the case
  std::string mesh_extension = ".vtu";         ///< of the mesh file that the command writes
  std::vector<std::string> version_command{};  ///< prints the version; empty: the report has it
};

/// The folder of the running program, which is that of all meshers' programs.
std::filesystem::path program_folder();

/// Available when `executable` is a file in `bin_dir`; otherwise the reason is `remedy`.
Availability executable_availability(const std::filesystem::path& bin_dir, const std::string& executable,
                                     const std::string& remedy);

/// Completes the adapter of a mesher whose program cbc3d-mesher-NAME follows the protocol of driver.hpp: its
/// availability, its command and its size dial. `remedy` says how to get the program where it is not there;
/// empty: by building its target.
Adapter program_adapter(Adapter mesher, const SizeDial& dial, std::string remedy = "");

/// Where the shell would find a program: a path is its own place, a name is sought in PATH. Empty when it is
/// nowhere.
std::filesystem::path find_program(const std::string& program);

/// The mesher's size dial; none where it has none.
std::optional<SizeDial> size_dial_of(const Adapter& mesher, const std::filesystem::path& bin_dir);

/// Throws InputError, naming the known keys, when the mesher has none of that name. The parameters of a
/// mesher whose program would have to name them and is not there are not judged, for its jobs end as
/// unavailable.
void require_known_parameters(const Adapter& mesher, const std::filesystem::path& bin_dir,
                              const std::map<std::string, std::string>& parameters);

/// The same for a list of parameters.
void require_known_parameters(const std::string& mesher, const ParameterSpecs& known,
                              const std::map<std::string, std::string>& parameters);

/// The argument vector of an executable that follows the protocol of driver.hpp.
std::vector<std::string> protocol_command(const std::filesystem::path& executable, const std::string& mesher,
                                          const ParameterSpecs& known, const MeshJob& job);

}  // namespace cbc3d::baselines
