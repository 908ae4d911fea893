// The choices about an image in reports.
#include "mesher/input/input_json.hpp"

#include <gtest/gtest.h>

#include "mesher/input/input_options.hpp"

namespace cbc3d {
namespace {

TEST(InputJson, HoldsWhatWasChosenAlone) {
  EXPECT_EQ(chosen_json({}), nlohmann::json::object());
  const ImageInput input{.read = {.round_values = true, .volume = 0},
                         .names_file = "n.tsv",
                         .choice = {.labels = {2, 5}, .keep_rest = true}};
  const nlohmann::json expected = {
      {"round", true}, {"volume", 0}, {"names", "n.tsv"}, {"labels", {2, 5}}, {"keep_rest", true}};
  EXPECT_EQ(chosen_json(input), expected);
}

TEST(InputJson, DescribesEveryOption) {
  const nlohmann::json described = describe_input_options();
  ASSERT_EQ(described.size(), input_options().size());
  EXPECT_EQ(described[2], (nlohmann::json{{"name", "volume"},
                                          {"kind", "number"},
                                          {"symbol", "N"},
                                          {"default_text", "a 3-D image"},
                                          {"text", "volume of a 4-D image, counted from 0"}}));
  EXPECT_EQ(described[5]["kind"], "labels");
  EXPECT_EQ(described[7]["kind"], "text");
  EXPECT_EQ(described[8]["default_text"], "false");
}

}  // namespace
}  // namespace cbc3d
