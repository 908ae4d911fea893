// Frames against readers that are not ours: frames.py has the cases.
#include <cstdlib>

#include "mesher/app/testing_command.hpp"

namespace cbc3d {
namespace {

class Frames : public testing::CommandTest {};

TEST_F(Frames, AreThoseOfIndependentReaders) {
  constexpr int kMissing = 77;
  const std::string command =
      "/usr/bin/python3 " CBC3D_FRAMES " " CBC3D_COMMAND " " + folder_.string() + " > " + at("log") + " 2>&1";
  const int status = std::system(command.c_str());
  if (WEXITSTATUS(status) == kMissing) {
    GTEST_SKIP() << "python3-nibabel is not installed";
  }
  EXPECT_EQ(WEXITSTATUS(status), 0) << testing::bytes_of(at("log"));
}

}  // namespace
}  // namespace cbc3d
