#include "baselines/core/program_file.hpp"

#include <gtest/gtest.h>

#include <cerrno>

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {
namespace {

TEST(ProgramFile, IsThatOfTheTests) {
  EXPECT_EQ(program_file().filename(), ::program_invocation_short_name);
  EXPECT_TRUE(program_file().is_absolute());
  EXPECT_EQ(program_folder(), program_file().parent_path());
}

}  // namespace
}  // namespace cbc3d::baselines
