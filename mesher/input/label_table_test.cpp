// Tables of names as other programs write them, and bad ones.
#include "mesher/input/label_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>

#include <random>

#include "mesher/core/error.hpp"
#include "mesher/testing/error_of.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

LabelNames parse(const std::string& text, const std::string& extension) {
  return parse_label_table(text, "cannot read 'a'", extension);
}

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kOrange{200, 80, 0};

void expect_lung(const LabelNames& names, bool with_colour = true) {
  EXPECT_EQ(names.text(5), "right lung (5)");
  ASSERT_NE(names.find(5), nullptr);
  EXPECT_EQ(names.find(5)->colour, with_colour ? std::optional(kOrange) : std::nullopt);
}

void expect_refusal(const std::string& text, const std::string& extension, const std::string& words) {
  const std::string error = testing::error_of([&] { static_cast<void>(parse(text, extension)); });
  EXPECT_NE(error.find(words), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos);
}

TEST(LabelTable, OfBids) {
  expect_lung(
      parse("index\tname\tabbreviation\tcolor\tmapping\n1\tliver\tLI\t#00ff00\t0\n"
            "5\tright lung\tRL\t#C85000\t0\n",
            ".tsv"));
  EXPECT_FALSE(parse("index\tname\tcolor\n5\tright lung\tn/a\n", ".tsv").find(5)->colour);
}

TEST(LabelTable, OfItkSnap) {
  const LabelNames names = parse(
      "################################\n# ITK-SnAP Label Description File\n"
      "    0     0    0    0        0  0  0    \"Clear Label\"\r\n"
      "    5   200   80    0        1  1  1    \"right lung\"\r\n",
      ".label");
  expect_lung(names);
  EXPECT_EQ(names.text(0), "Clear Label (0)");
}

TEST(LabelTable, OfFreeSurferAndSlicer) {
  const LabelNames names = parse(
      "#No. Label Name:            R   G   B   A\n\n"
      "0   Unknown                 0   0   0   0\n"
      "2   Left-Cerebral-White-Matter 245 245 245 0\n"
      "5   right lung              200 80  0   255\n",
      ".txt");
  expect_lung(names);
  EXPECT_EQ(names.text(2), "Left-Cerebral-White-Matter (2)");
  expect_lung(parse("5 right lung\n7 lobe 2\n", ".txt"), false);
  EXPECT_EQ(parse("5 right lung\n7 lobe 2\n", ".txt").text(7), "lobe 2 (7)");
}

TEST(LabelTable, OfColumnsWithCommas) {
  expect_lung(
      parse("LabelValue,Name,Color_R,Color_G,Color_B,Color_A\n5,\"right lung\",200,80,0,255\n", ".csv"));
  expect_lung(parse("5,right lung,200,80,0\n", ".csv"));
  expect_lung(parse("5;right lung;#c85000\n", ".csv"));
  expect_lung(parse("\xEF\xBB\xBFlabel,name\n5.0,right lung\n", ".csv"), false);
  EXPECT_EQ(parse("1,\"lung, \"\"right\"\"\"\n", ".csv").text(1), "lung, \"right\" (1)");
}

TEST(LabelTable, OfJson) {
  expect_lung(parse(R"({"5": "right lung", "7": "liver"})", ".json"), false);
  expect_lung(parse(R"({"name": "task", "labels": {"background": 0, "right lung": 5}})", ".json"), false);
  expect_lung(parse(R"({"label_names": {"5": "right lung"}, "status": "ok"})", ".json"), false);
  expect_lung(parse(R"([{"label": 5, "name": "right lung", "color": [200, 80, 0]}])", ".json"));
  expect_lung(parse(R"({"5": {"name": "right lung", "color": "#c85000"}})", ".json"));
}

TEST(LabelTable, ColoursAreHexadecimalNumbersOrFractions) {
  const auto colour_in = [](const std::string& text, const std::string& extension) {
    return parse(text, extension).find(1)->colour;
  };
  EXPECT_EQ(colour_in("1 a 1.0 0.5 0.0\n", ".txt"), std::optional(Rgb{255, 128, 0}));
  EXPECT_EQ(colour_in("1,a,#0102037f\n", ".csv"), std::optional(Rgb{1, 2, 3}));
}

TEST(LabelTable, NamesInLatin1BecomeUtf8) {
  EXPECT_EQ(parse("1 H\xFC"
                  "fte\n",
                  ".txt")
                .text(1),
            "H\xC3\xBC"
            "fte (1)");
  EXPECT_EQ(parse("1 H\xC3\xBC"
                  "fte\n",
                  ".txt")
                .text(1),
            "H\xC3\xBC"
            "fte (1)");
}

TEST(LabelTable, BadOnesNameLineAndRemedy) {
  expect_refusal("# c\nright lung 5\n", ".txt", "cannot read 'a': line 2 'right lung 5' has no whole number");
  expect_refusal("5\n", ".txt", "line 1 '5' has no name; write label, name and colour");
  expect_refusal("5 a\n6 b\n5 c\n", ".txt", "line 3 '5 c' names label 5 a second time, after line 1; remove");
  expect_refusal("5 a 1 2 300\n", ".txt", "line 1 '5 a 1 2 300' has a colour that is none");
  expect_refusal("number\n1\n", ".csv", "names no column 'name'");
  expect_refusal("a\tb\n", ".tsv", "names no column 'index'");
  expect_refusal("index\tname\n5\n", ".tsv", "has 1 columns, too few");
  expect_refusal("index\tname\n5.5\tx\n", ".tsv", "no whole number where the label stands ('5.5')");
  expect_refusal("5 1 2 3 1 1 1 \"a\n", ".label", "closing quote");
  expect_refusal("", ".txt", "names no label");
  expect_refusal("{\"5\": ", ".json", "is no JSON");
  expect_refusal("{\"a\": [1, 2]}", ".json", "no whole number");
  expect_refusal("[5]", ".json", "is no object");
  expect_refusal("99999999999 a\n", ".txt", "no whole number");
}

TEST(LabelTable, FilesAreReadOrRefused) {
  const testing::TemporaryFolder folder("table");
  folder.write("a.tsv", "index\tname\n5\tright lung\n");
  expect_lung(read_label_table(folder.file("a.tsv")), false);
  EXPECT_THROW(read_label_table(folder.file("absent.tsv")), InputError);
  EXPECT_THROW(read_label_table(folder.path()), InputError);
}

TEST(LabelTable, RandomBytesAreReadOrRefusedInOneLine) {
  std::mt19937 random(3);
  const std::string pieces[] = {"5", " ", "\t", ",", "\n", "\"",   "lung", "#",
                                "{", "}", "[",  ":", "-",  "\xFF", "0.5"};
  for (int round = 0; round < 4000; ++round) {
    std::string text;
    for (unsigned n = random() % 24; n > 0; --n) {
      text += pieces[random() % std::size(pieces)];
    }
    for (const char* const extension : {".tsv", ".csv", ".txt", ".json"}) {
      try {
        static_cast<void>(parse(text, extension));
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << text;
      }
    }
  }
}

}  // namespace
}  // namespace cbc3d
