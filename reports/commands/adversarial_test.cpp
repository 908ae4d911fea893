// Every adversarial image through `cbc3d mesh` and through all metrics: a mesh or one clear line, in time and
// within 2 GiB.
#include <gtest/gtest.h>

#include <algorithm>

#include "cases/adversarial.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

// Of the processor, so that a busy machine fails no test; a command that waits for ever is ended by ctest.
constexpr const char* kCpuLimitS = "300";
constexpr std::int64_t kMemoryLimitBytes = std::int64_t{2} << 30;

class Adversarial : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const auto all = cases::adversarial_images();
    subject_ = &*std::find_if(all.begin(), all.end(),
                              [](const cases::AdversarialImage& image) { return image.name == GetParam(); });
    image_ = folder_.path() / (std::string(subject_->name) + std::string(subject_->extension));
    subject_->write(image_);
  }

  /// Runs a command; it ends by itself, with a result or with one line.
  bool succeeds(std::vector<std::string> argv) {
    argv.insert(argv.begin(), {"/bin/sh", "-c", R"(ulimit -t "$0" && exec "$@")", kCpuLimitS});
    argv.insert(argv.end(), {"--quiet", "--threads", "1"});
    const ChildResult child = run_child({argv, 1, 0, kMemoryLimitBytes});
    EXPECT_EQ(child.end, ChildEnd::exited)
        << argv[5] << ": " << child.cpu_s << " s CPU: " << child.stderr_tail;
    EXPECT_LT(child.peak_rss_bytes, kMemoryLimitBytes);
    if (child.exit_code == 0) {
      return true;
    }
    EXPECT_TRUE(child.exit_code == 2 || child.exit_code == 3) << child.exit_code;
    EXPECT_EQ(std::count(child.stderr_tail.begin(), child.stderr_tail.end(), '\n'), 1) << child.stderr_tail;
    EXPECT_GT(child.stderr_tail.size(), 20U);
    EXPECT_TRUE(subject_->readable || child.exit_code == 2) << child.stderr_tail;
    return false;
  }
  TemporaryFolder folder_;
  const cases::AdversarialImage* subject_ = nullptr;
  std::filesystem::path image_;
};

TEST_P(Adversarial, MeshOrOneLine) {
  const auto mesh = folder_.path() / "mesh.vtu";
  std::vector<std::string> argv{MESHER, "mesh", image_, "--out", mesh};
  argv.insert(argv.end(), subject_->mesh_options.begin(), subject_->mesh_options.end());
  const bool meshed = succeeds(argv);
  EXPECT_EQ(meshed, std::filesystem::exists(mesh));
  if (!meshed) {  // a mesh of something else, so that the metrics see the image too
    Mesh tet;
    tet.points = {{0, 0, 0}, {5, 0, 0}, {0, 5, 0}, {0, 0, 5}};
    tet.tets.add({0, 1, 2, 3}, 1);
    write_mesh(tet, mesh);
  } else {
    EXPECT_GT(read_mesh(mesh).tets.size(), 0U);
  }
  const bool evaluated = succeeds({BENCH, "evaluate", mesh, image_, "--json", folder_.path() / "f.json"});
  EXPECT_EQ(evaluated, subject_->readable);
  EXPECT_FALSE(meshed && !subject_->readable);
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const cases::AdversarialImage& image : cases::adversarial_images()) {
    all.emplace_back(image.name);
  }
  return all;
}

std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Image, Adversarial, ::testing::ValuesIn(names()), test_name);

}  // namespace
}  // namespace cbc3d::reports
