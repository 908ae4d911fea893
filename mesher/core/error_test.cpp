// Errors keep their message and their kind.
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

TEST(Error, KindsAreToldApartAndKeepTheirMessage) {
  try {
    throw InputError("a.nii: absent");
  } catch (const JobError&) {
    FAIL() << "bad input is no failed job";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "a.nii: absent");
  }
  EXPECT_THROW(throw JobError("disk full"), std::runtime_error);
  const std::set<int> codes = {kExitSuccess, kExitGateFailed, kExitBadInput, kExitJobFailed};
  EXPECT_EQ(codes, (std::set<int>{0, 1, 2, 3}));  // scripts rely on them
}

}  // namespace
}  // namespace cbc3d
