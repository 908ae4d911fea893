#include "mesher/core/json_text.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "mesher/testing/error_of.hpp"

namespace cbc3d {
namespace {

using Json = nlohmann::json;

std::string refusal(const std::string& text) {
  const std::string line =
      testing::error_of([&] { static_cast<void>(parse_json<Json>(std::string_view(text), "'a.json'")); });
  EXPECT_TRUE(line.starts_with("'a.json' ")) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  return line;
}

std::string nested(int depth, const std::string& open, const std::string& close) {
  std::string text;
  for (int n = 0; n < depth; ++n) {
    text += open;
  }
  text += "1";
  for (int n = 0; n < depth; ++n) {
    text += close;
  }
  return text;
}

TEST(ParseJson, GivesWhatTheTextSays) {
  EXPECT_EQ(parse_json<Json>(R"({"a": [1, {"b": "]]"}]})", "'a.json'")["a"][1]["b"], "]]");
  EXPECT_EQ(parse_json<Json>(nested(kMostJsonDepth, "[", "]"), "'a.json'").size(), 1U);
}

TEST(ParseJson, DepthCountsBracketsOutsideStrings) {
  EXPECT_EQ(json_depth("1"), 0);
  EXPECT_EQ(json_depth("[{}, [[]]]"), 3);
  EXPECT_EQ(json_depth(R"(["[[[\"[[", "\\", []])"), 2);
  EXPECT_EQ(json_depth("[[["), 3);
}

TEST(ParseJson, RefusesDeepTextsWithoutOverflowingTheStack) {
  for (const auto& [open, close] :
       {std::pair("[", "]"), std::pair("{\"a\":", "}"), std::pair("[{\"a\":", "}]"), std::pair("[", "")}) {
    EXPECT_NE(refusal(nested(1000000, open, close)).find("deep, more than 100"), std::string::npos);
  }
}

TEST(ParseJson, RefusesNumbersThatAreNoneAndNamesThem) {
  for (const char* number : {"1e999", "-1e999", "NaN", "Infinity", "0x10", "1.", "+1"}) {
    const std::string line = refusal(R"({"figure": )" + std::string(number) + "}");
    EXPECT_NE(line.find(number), std::string::npos) << line;
  }
}

TEST(ParseJson, RefusesWhatIsNoJson) {
  for (const char* text : {"", "{", "{\"a\": 1,}", "[1\n2]", "\"\xff\"", "{} {}"}) {
    EXPECT_NE(refusal(text).find("is no JSON"), std::string::npos);
  }
}

TEST(ParseJson, BytesThatAreNoUtf8AreReplacedWhenWritten) {
  const Json json = {{"file", "caf\xE9.nii"}, {"label", 1}};
  EXPECT_EQ(json_text(json, -1), "{\"file\":\"caf\xEF\xBF\xBD.nii\",\"label\":1}");
  EXPECT_EQ(parse_json<Json>(std::string_view(json_text(json)), "")["label"], 1);
}

TEST(ParseJson, ReportsThatAreDamagedAreEmptyObjects) {
  for (const auto& [text, size] :
       {std::pair(std::string(R"({"a": 1})"), 1U), std::pair(std::string("[1]"), 0U),
        std::pair(std::string("{"), 0U), std::pair(nested(100000, "[", "]"), 0U)}) {
    std::istringstream stream(text);
    const Json object = json_object_or_empty<Json>(stream);
    EXPECT_TRUE(object.is_object());
    EXPECT_EQ(object.size(), size);
  }
}

}  // namespace
}  // namespace cbc3d
