#include "cases/core/sha256.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::cases {
namespace {

using cbc3d::testing::TemporaryFolder;

// FIPS 180-2's test vectors.
constexpr const char* kShaOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kShaOfNothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

TEST(Sha256, KnownDigests) {
  const TemporaryFolder folder("sha");
  folder.write("abc", "abc");
  folder.write("nothing", "");
  EXPECT_EQ(sha256_of_file(folder.path() / "abc"), kShaOfAbc);
  EXPECT_EQ(sha256_of_file(folder.path() / "nothing"), kShaOfNothing);
  EXPECT_EQ(sha256_of_text("abc"), kShaOfAbc);
  folder.write("million", std::string(1000000, 'a'));
  EXPECT_EQ(sha256_of_file(folder.path() / "million"),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_THROW(sha256_of_file(folder.path() / "absent"), InputError);
}

}  // namespace
}  // namespace cbc3d::cases
