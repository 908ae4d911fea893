#include <gtest/gtest.h>

#include "cases/core/sha256.hpp"
#include "cases/core/testing_folder.hpp"
#include "cases/manifest.hpp"
#include "cases/phantoms/registry.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"

namespace cbc3d::cases {
namespace {

// FIPS 180-2's test vectors.
constexpr const char* kShaOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kShaOfNothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

Case file_case(const std::string& sha256) {
  Case one;
  one.image_file = "one.bin";
  one.image_sha256 = sha256;
  one.image_source = "somewhere (MIT)";
  return one;
}

bool says(const ResolvedImage& image, const std::string& what) {
  return image.skipped_reason.find(what) != std::string::npos;
}

TEST(Sha256, KnownDigests) {
  const test::Folder folder("sha");
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

TEST(ResolveImage, FileIsFoundByItsDigest) {
  const test::Folder wrong("wrong"), right("right"), cache("cache");
  wrong.write("one.bin", "abd");
  right.write("one.bin", "abc");
  const auto found = resolve_image(file_case(kShaOfAbc), {wrong.path(), right.path()}, cache.path());
  EXPECT_EQ(found.path, right.path() / "one.bin");
  EXPECT_EQ(found.skipped_reason, "");
}

TEST(ResolveImage, AbsentFileSaysWhatIsWantedAndWhereToGetIt) {
  const test::Folder data("data");
  const auto found = resolve_image(file_case(kShaOfAbc), {data.path()}, data.path());
  EXPECT_TRUE(found.path.empty());
  EXPECT_TRUE(says(found, "'one.bin'"));
  EXPECT_TRUE(says(found, data.path().string()));
  EXPECT_TRUE(says(found, "somewhere (MIT)"));
  EXPECT_TRUE(says(found, "--data"));
  EXPECT_TRUE(says(resolve_image(file_case(kShaOfAbc), {}, data.path()), "none given"));
}

TEST(ResolveImage, AnotherFileOfTheSameNameIsSkipped) {
  const test::Folder data("data");
  data.write("one.bin", "abc");
  const auto found = resolve_image(file_case(kShaOfNothing), {data.path()}, data.path());
  EXPECT_TRUE(found.path.empty());
  EXPECT_TRUE(says(found, "sha256"));
  EXPECT_TRUE(says(found, kShaOfAbc));
  EXPECT_TRUE(says(found, kShaOfNothing));
}

TEST(ResolveImage, PhantomIsGeneratedOnce) {
  const test::Folder folder("cache");
  const auto cache = folder.path() / "new" / "cache";
  Case one;
  one.phantom = Phantom{"organs", {24, 20, 16}, {.7, 1, 1.5}, 4, ""};
  const auto first = resolve_image(one, {}, cache);
  ASSERT_EQ(first.skipped_reason, "");
  const LabelImage image = read_label_image(first.path);
  EXPECT_EQ(image.voxels, make_phantom(*one.phantom).voxels);
  EXPECT_EQ(image.frame.spacing_mm, one.phantom->spacing_mm);
  const auto written = std::filesystem::last_write_time(first.path);
  EXPECT_EQ(resolve_image(one, {}, cache).path, first.path);
  EXPECT_EQ(std::filesystem::last_write_time(first.path), written);
  one.phantom->seed = 5;
  EXPECT_NE(resolve_image(one, {}, cache).path, first.path);
}

}  // namespace
}  // namespace cbc3d::cases
