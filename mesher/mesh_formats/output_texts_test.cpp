#include "mesher/mesh_formats/output_texts.hpp"

#include <gtest/gtest.h>

#include <string>

namespace cbc3d {
namespace {

// Help texts, man pages and panels put them on one line beside the option.
TEST(OutputTexts, AreOneLineWithoutAStopAtTheEnd) {
  for (const std::string text : {kOrderText, kSplitInterfacesText}) {
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_NE(text.back(), '.') << text;
    EXPECT_LE(text.size(), 100U) << text;
  }
}

}  // namespace
}  // namespace cbc3d
