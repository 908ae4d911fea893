// The report in headless Chromium, where there is one.
#include <gtest/gtest.h>

#include <fstream>

#include "mesher/core/atomic_file.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/output/html.hpp"
#include "reports/output/output.hpp"
#include "reports/run/child_process.hpp"
#include "reports/tables/tables.hpp"
#include "reports/viewer/scripts.hpp"
#include "reports/viewer/testing_box.hpp"
#include "reports/viewer/view_section.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;
namespace fs = std::filesystem;

constexpr int kPhoneWidthPx = 390;

std::vector<Json> results() {
  std::vector<Json> lines;
  for (const char* mesher : {"cbc3d", "cgal", "external:a-mesher-with-quite-a-long-name"}) {
    Json line = empty_result();
    line["case"] = "a-case-with-a-long-name";
    line["mesher"] = mesher;
    line["threads"] = 1;
    line["repeat"] = 0;
    line["status"] = "ok";
    line["counts"]["tets"] = 1234567;
    line["fidelity"]["hausdorff_mm"] = 1.5;
    line["time_s"]["mesh"] = 3.5;
    line["quality"]["dihedral_histogram_5deg"] = std::vector<int>(36, 7);
    line["provenance"] = {{"image_sha256", std::string(64, 'a')}, {"compiler_flags", std::string(300, 'x')}};
    lines.push_back(line);
  }
  lines.back()["status"] = "crashed";
  lines.back()["reason"] = std::string(200, 'y') + " <b>not bold</b>";
  return lines;
}

/// A page that shows the report at a phone's width and writes what it finds into its own title.
std::string probe_page() {
  return "<!DOCTYPE html><title>waiting</title><iframe id=f width=" + std::to_string(kPhoneWidthPx) +
         " height=800 style=\"border:0\" src=report.html></iframe><script>f.onload=()=>{const "
         "d=f.contentDocument;"
         "document.title='width='+d.documentElement.scrollWidth+' "
         "tables='+d.querySelectorAll('table').length+"
         "' plots='+[...d.querySelectorAll('svg')].filter(s=>s.getBoundingClientRect().height>50).length+"
         "' bold='+d.querySelectorAll('b').length+' "
         "last='+[...d.querySelectorAll('section')].pop().id}</script>";
}

std::string title_in_chromium(const fs::path& folder) {
  const std::string script =
      "exec chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage "
      "--allow-file-access-from-files "
      "--user-data-dir=\"$1/profile\" --virtual-time-budget=5000 --dump-dom \"file://$1/probe.html\" "
      ">\"$1/dom.html\"";
  run_child({{"/bin/sh", "-c", script, "sh", folder}, 1, 0, 0});
  std::ifstream stream(folder / "dom.html");
  const std::string dom((std::istreambuf_iterator<char>(stream)), {});
  const std::size_t begin = dom.find("<title>");
  return begin == std::string::npos ? dom : dom.substr(begin + 7, dom.find("</title>") - begin - 7);
}

int number_after(const std::string& text, const std::string& key) {
  const std::size_t at = text.find(key);
  return at == std::string::npos ? -1 : std::stoi(text.substr(at + key.size()));
}

TEST(Browser, ShowsTheReportOnAPhoneWithoutSidewaysScrolling) {
  if (run_child({{"chromium", "--version"}, 1, 0, 0}).end == ChildEnd::not_started) {
    GTEST_SKIP() << "chromium is not installed";
  }
  const TemporaryFolder folder;
  const std::vector<JobResult> jobs = decode_lines(results());
  write_text_file(folder.path() / "report.html",
                  to_html({"A report", jobs, build_tables({jobs, {}, folder.path()}),
                           all_figures(folder.path(), jobs), folder.path() / "none"}));
  write_text_file(folder.path() / "probe.html", probe_page());
  const std::string title = title_in_chromium(folder.path());
  EXPECT_GT(number_after(title, "width="), 0) << title;
  EXPECT_LE(number_after(title, "width="), kPhoneWidthPx) << title;
  EXPECT_GE(number_after(title, "tables="), 7) << title;
  EXPECT_EQ(number_after(title, "plots="), 3) << title;
  EXPECT_EQ(number_after(title, "bold="), 0) << title;
  EXPECT_NE(title.find("last=provenance"), std::string::npos) << title;
}

bool is_there(const char* program) {
  return run_child({{program, "--version"}, 1, 0, 0}).end != ChildEnd::not_started;
}

/// Two meshers' meshes of a box of two labels.
std::vector<Json> results_with_meshes(const fs::path& folder) {
  std::vector<Json> lines = results();
  lines.resize(2);
  for (Json& line : lines) {
    const std::string file = line["mesher"].get<std::string>() + ".vtu";
    write_mesh(testing::box(line["mesher"] == "cgal" ? 8 : 12), folder / file);
    line["mesh_file"] = file;
    line["image"] = {{"size", {12, 12, 12}},
                     {"spacing_mm", {1, 1, 1}},
                     {"labels", {1, 2}},
                     {"label_names", {{"1", "<img src=x onerror=alert(1)>"}, {"2", "upper half"}}}};
  }
  return lines;
}

TEST(Browser, TurnsCutsAndPicksLabelsIn3DAndSortsTablesWithoutTheNetwork) {
  constexpr double kTimeoutS = 900;  // software draws, perhaps on a busy machine
  if (!is_there("chromium") || !is_there("node")) {
    GTEST_SKIP() << "chromium or node is not installed";
  }
  const TemporaryFolder folder;
  const std::vector<JobResult> jobs = decode_lines(results_with_meshes(folder.path()));
  const std::string view = view_section(folder.path(), jobs, {});
  write_text_file(folder.path() / "report.html",
                  to_html({"A <i>report</i>", jobs, build_tables({jobs, {}, folder.path()}),
                           all_figures(folder.path(), jobs), folder.path() / "none", view}));
  const std::string script = R"(exec node "$1" "$2/report.html" >"$2/checks.txt" 2>&1)";
  const ChildResult child =
      run_child({{"/bin/sh", "-c", script, "sh", DRIVE_REPORT, folder.path()}, 1, kTimeoutS, 0});
  EXPECT_EQ(child.exit_code, 0) << folder.content("checks.txt");
  EXPECT_EQ(child.end, ChildEnd::exited);
  EXPECT_NE(folder.content("checks.txt").find("ok: no errors, no request"), std::string::npos);
  if (view_script().empty()) {
    GTEST_SKIP() << "tables and plots alone: built without the packages of the viewer";
  }
  EXPECT_NE(folder.content("checks.txt").find("ok: a drag turns it"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d::reports
