#include "mesher/app/bmp_header.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

/// A BMP file of so many bits for each pixel, 5 x 3, with these bytes behind its header.
std::string bmp(char bits, char compression, const std::string& pixels, char height = 3) {
  std::string bytes(54, '\0');
  bytes[0] = 'B';
  bytes[1] = 'M';
  bytes[10] = 54;
  bytes[14] = 40;
  bytes[18] = 5;
  bytes[22] = height;
  if (height < 0) bytes.replace(23, 3, "\xFF\xFF\xFF");
  bytes[28] = bits;
  bytes[30] = compression;
  return bytes + pixels;
}

class BmpHeader : public ::testing::Test {
 protected:
  [[nodiscard]] std::string refusal_of(const std::string& bytes) const {
    folder_.write("a.bmp", bytes);
    try {
      require_whole_bmp(folder_.file("a.bmp").string());
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
  /// Expects that the file is taken whole and refused at every cut.
  void expect_whole_alone(const std::string& bytes) const {
    EXPECT_EQ(refusal_of(bytes), "");
    EXPECT_EQ(refusal_of(bytes + "more"), "");
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      EXPECT_NE(refusal_of(bytes.substr(0, length)), "") << length;
    }
  }
  testing::TemporaryFolder folder_{"bmp"};
};

TEST_F(BmpHeader, EveryCutOfRowsIsRefused) {
  expect_whole_alone(bmp(8, 0, std::string(3 * 8, 'x')));
  expect_whole_alone(bmp(8, 0, std::string(3 * 8, 'x'), -3));
  expect_whole_alone(bmp(24, 0, std::string(3 * 16, 'x')));
  expect_whole_alone(bmp(1, 0, std::string(3 * 4, 'x')));
}

TEST_F(BmpHeader, EveryCutOfRunsIsRefused) {
  const std::string run("\5\1", 2), line("\0\0", 2), five("\0\5abcde\0", 8), step("\0\2\1\1", 4),
      end("\0\1", 2);
  expect_whole_alone(bmp(8, 1, run + line + five + line + run));
  expect_whole_alone(bmp(8, 1, run + step + end));
  expect_whole_alone(bmp(4, 2, run + line + std::string("\0\5ab\1\0", 6) + line + run));
}

TEST_F(BmpHeader, WhatPromisesNoPixelsIsRefused) {
  EXPECT_NE(refusal_of(bmp(8, 0, "", 0)).find("no pixels"), std::string::npos);
  EXPECT_NE(refusal_of(bmp(0, 0, "")).find("no pixels"), std::string::npos);
  EXPECT_NE(refusal_of(bmp(8, 0, "abc")).find("promises 3 rows of 8 bytes from byte 54"), std::string::npos);
  folder_.write("a.bmp", "BM");
  folder_.write("a.png", "\x89PNG");
  EXPECT_TRUE(is_bmp(folder_.file("a.bmp").string()));
  EXPECT_FALSE(is_bmp(folder_.file("a.png").string()));
}

}  // namespace
}  // namespace cbc3d
