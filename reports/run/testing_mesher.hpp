// A mesher and an image for tests of the runner.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "baselines/core/adapter.hpp"
#include "mesher/core/image_io.hpp"

namespace cbc3d::reports::test {

/// A mesher that is the test child in one of its modes.
inline baselines::Adapter fake_mesher(const std::string& mode, bool available = true) {
  baselines::Adapter adapter;
  adapter.name = mode;
  adapter.description = "a fake";
  adapter.multithreaded = true;
  adapter.parameters = {{"size", "1", "mm", "element size"}};
  adapter.availability = [available](const std::filesystem::path&) {
    return baselines::Availability{available, available ? "" : "not built; install it"};
  };
  adapter.command = [mode](const std::filesystem::path&, const baselines::MeshJob& job) {
    return std::vector<std::string>{TEST_CHILD, mode, mode == "exit" ? "0" : job.mesh.string(), job.report};
  };
  return adapter;
}

/// An image of 8 x 8 x 8 voxels with a row of six that have the label 1.
inline void write_row_image(const std::filesystem::path& file) {
  LabelImage image;
  image.frame.size = {8, 8, 8};
  image.labels = {0, 1};
  image.voxels.assign(image.frame.voxel_count(), 0);
  for (int n = 1; n < 7; ++n) {
    image.voxels[image.frame.offset(n, 1, 1)] = 1;
  }
  write_label_image(image, file);
}

}  // namespace cbc3d::reports::test
