#include "mesher/input/names_json.hpp"

#include <gtest/gtest.h>

namespace cbc3d {
namespace {

using nlohmann::json;

TEST(NamesJson, AreAnObjectOfNumbersAndNames) {
  LabelNames names;
  names.set({.label = 5, .name = "right lung"});
  names.set({.label = -3, .name = "vessel"});
  EXPECT_EQ(names_json(names), (json{{"5", "right lung"}, {"-3", "vessel"}}));
  EXPECT_EQ(names_json(names_of_json(names_json(names))), names_json(names));
  EXPECT_TRUE(names_of_json(json::array({1})).empty());
  EXPECT_TRUE(names_of_json(json{{"a", "b"}, {"5", 5}}).empty());
}

TEST(NamesJson, StandBesideLabelsAtAnyDepth) {
  LabelNames names;
  names.set({.label = 5, .name = "right lung"});
  json report = {{"per_label", {{{"label", 5}, {"dice", 1}}, {{"label", 6}}}}, {"label", "text"}};
  add_names(report, names);
  EXPECT_EQ(report["per_label"][0]["name"], "right lung");
  EXPECT_FALSE(report["per_label"][1].contains("name"));
  EXPECT_FALSE(report.contains("name"));
}

}  // namespace
}  // namespace cbc3d
