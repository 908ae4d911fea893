// Baselines of any bytes: a verdict on a run in all its forms, or an InputError.
#include <cstdint>

#include "mesher/core/error.hpp"
#include "mesher/testing/fuzz_file.hpp"
#include "reports/gate/gate.hpp"

namespace {

/// A run of one job that is good and one that is not.
std::vector<cbc3d::reports::JobResult> run() {
  using cbc3d::reports::Json;
  Json good = cbc3d::reports::empty_result(), bad = good;
  for (Json* const line : {&good, &bad}) {
    (*line)["case"] = "box";
    (*line)["threads"] = 1;
    (*line)["repeat"] = 0;
  }
  good["mesher"] = "cbc3d";
  good["status"] = "ok";
  good["counts"] = {{"vertices", 10}, {"tets", 20}, {"pyramids", 0}, {"wedges", 0}, {"hexes", 0}};
  bad["mesher"] = "cgal";
  bad["status"] = "failed";
  bad["reason"] = "no room";
  return cbc3d::reports::decode_lines({good, bad});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  namespace reports = cbc3d::reports;
  static const std::vector<reports::JobResult> results = run();
  const cbc3d::testing::FuzzFile file(bytes, size);
  try {
    const reports::Verdict verdict = reports::compare(results, reports::read_baseline(file.path()));
    static_cast<void>(reports::to_junit(verdict) + reports::to_text(verdict) +
                      reports::to_step_summary(verdict) + reports::to_annotations(verdict));
  } catch (const cbc3d::InputError&) {
    return 0;
  }
  return 0;
}
