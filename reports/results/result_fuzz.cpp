// Result lines of any bytes: decoded results and their summary, or an InputError.
#include <cstdint>

#include "mesher/core/error.hpp"
#include "mesher/testing/fuzz_file.hpp"
#include "reports/results/columns.hpp"
#include "reports/results/job_result.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  namespace reports = cbc3d::reports;
  const cbc3d::testing::FuzzFile file(bytes, size);
  try {
    const std::vector<reports::JobResult> results = reports::decode_lines(reports::read_results(file.path()));
    const reports::Columns columns(results);
    static_cast<void>(reports::case_names(results));
    static_cast<void>(reports::summary_line(results));
  } catch (const cbc3d::InputError&) {
    return 0;
  }
  return 0;
}
