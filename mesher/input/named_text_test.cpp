#include "mesher/input/named_text.hpp"

#include <gtest/gtest.h>

namespace cbc3d {
namespace {

TEST(NamedText, HasNamesInPlaceOfNumbers) {
  LabelNames names;
  names.set({.label = 5, .name = "right lung"});
  names.set({.label = -3, .name = "vessel"});
  EXPECT_EQ(with_names("label 5 (12 voxels) vanished", names), "right lung (5) (12 voxels) vanished");
  EXPECT_EQ(with_names("2 regions of label -3 and label 4; label 5.", names),
            "2 regions of vessel (-3) and label 4; right lung (5).");
  EXPECT_EQ(with_names("'label 5.nii': label 5", names), "'label 5.nii': right lung (5)");
  EXPECT_EQ(with_names("label 55, label 5.5, label_5, sublabel 5, label ", names),
            "label 55, label 5.5, label_5, sublabel 5, label ");
  EXPECT_EQ(with_names("a label's surface, the image's: label 5\n'a\nlabel 5", names),
            "a label's surface, the image's: right lung (5)\n'a\nright lung (5)");
  EXPECT_EQ(with_names("'it's label 5.nii' label 5", names), "'it's label 5.nii' right lung (5)");
  EXPECT_EQ(with_names("label 99999999999", names), "label 99999999999");
}

}  // namespace
}  // namespace cbc3d
