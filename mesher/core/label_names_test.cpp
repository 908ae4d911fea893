#include "mesher/core/label_names.hpp"

#include <gtest/gtest.h>

namespace cbc3d {
namespace {

LabelNames lungs() {
  LabelNames names;
  names.set({.label = 5, .name = "right lung", .colour = {{200, 10, 20}}});
  names.set({.label = -2, .name = "left lung", .colour = std::nullopt});
  return names;
}

TEST(LabelNames, AreFoundByLabelInAscendingOrder) {
  const LabelNames names = lungs();
  ASSERT_EQ(names.entries().size(), 2U);
  EXPECT_EQ(names.entries().front().label, -2);
  ASSERT_NE(names.find(5), nullptr);
  EXPECT_EQ(names.find(5)->name, "right lung");
  EXPECT_EQ(names.find(4), nullptr);
}

TEST(LabelNames, ASecondNameReplacesTheFirst) {
  LabelNames names = lungs();
  names.set({.label = 5, .name = "heart\n", .colour = std::nullopt});
  EXPECT_EQ(names.entries().size(), 2U);
  EXPECT_EQ(names.find(5)->name, "heart ");
}

TEST(LabelNames, AreReadWithTheirNumber) {
  EXPECT_EQ(lungs().text(5), "right lung (5)");
  EXPECT_EQ(lungs().text(7), "label 7");
}

TEST(LabelNames, OfSomeLabels) {
  LabelNames names = lungs();
  names.set({.label = 6, .name = "", .colour = std::nullopt});
  EXPECT_EQ(names.of({5, 6, 7}).entries().size(), 1U) << "6 has neither name nor colour";
  LabelNames more;
  more.set({.label = 5, .name = "other", .colour = std::nullopt});
  more.set({.label = 9,
            .name = "H\xFC"
                    "fte",
            .colour = std::nullopt});
  names.add_unknown(more);
  EXPECT_EQ(names.text(5), "right lung (5)");
  EXPECT_EQ(names.text(9),
            "H\xC3\xBC"
            "fte (9)")
      << "Latin-1 becomes UTF-8";
}

TEST(LabelNames, BecomeIdentifiers) {
  LabelNames names = lungs();
  EXPECT_EQ(names.identifier(5), "right_lung");
  EXPECT_EQ(names.identifier(7), "label_7");
  EXPECT_EQ(names.identifier(-7), "label_m7");
  names.set({.label = 8, .name = " -- ", .colour = std::nullopt});
  names.set({.label = 9, .name = "3rd ventricle", .colour = std::nullopt});
  names.set({.label = 10, .name = "  T1/T2 (part) ", .colour = std::nullopt});
  EXPECT_EQ(names.identifier(8), "label_8");
  EXPECT_EQ(names.identifier(9), "label_9");
  EXPECT_EQ(names.identifier(10), "T1_T2_part");
}

TEST(LabelNames, OfTwoLabelsGetTheirNumbersAsIdentifiers) {
  LabelNames names = lungs();
  names.set({.label = 6, .name = "Right-Lung", .colour = std::nullopt});
  EXPECT_EQ(names.identifier(5), "right_lung_5");
  EXPECT_EQ(names.identifier(6), "Right_Lung_6");
}

}  // namespace
}  // namespace cbc3d
