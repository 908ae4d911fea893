// Options by name of any bytes, one NAME=VALUE a line: a value that is read back, or an OptionError.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "mesher/pipeline/option_table.hpp"
#include "mesher/pipeline/presets.hpp"

namespace {

void set_and_read_back(cbc3d::MeshImageOptions& options, const std::string& name, const std::string& value) {
  cbc3d::set_option(options, name, value);
  const cbc3d::OptionRow& row = cbc3d::find_option(name);
  const cbc3d::OptionValue found = row.get(options);
  const bool of_labels = row.kind == cbc3d::OptionKind::label_numbers;  // which join those that are there
  if (!of_labels && found != cbc3d::checked_value(row, value)) std::abort();
  if (cbc3d::value_text(found).empty()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  cbc3d::MeshImageOptions options = cbc3d::preset_options("quality", {});
  std::istringstream lines(std::string(reinterpret_cast<const char*>(bytes), size));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    try {
      set_and_read_back(options, line.substr(0, equals),
                        equals == std::string::npos ? "" : line.substr(equals + 1));
    } catch (const cbc3d::OptionError&) {
      continue;
    }
  }
  return 0;
}
