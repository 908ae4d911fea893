// Files of a test, and why an image is not read from one.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::testing {

class Files : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_.file(name); }
  void write(const std::string& name, const std::string& bytes) const { folder_.write(name, bytes); }
  [[nodiscard]] std::string why_not_read(const std::string& name) const {
    try {
      read_label_image(file(name));
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << "names the file";
      return error.what();
    }
    return "";
  }
  TemporaryFolder folder_{"io"};
};

}  // namespace cbc3d::testing
