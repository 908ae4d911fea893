// The choices about an image as flags of a command line.
#include "mesher/input/input_options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesher/core/error.hpp"
#include "mesher/input/image_input.hpp"

namespace cbc3d {
namespace {

bool has_flag(const CLI::App& app, const InputOption& option) {
  return app.get_option_no_throw("--" + option.name) != nullptr;
}

TEST(InputOptions, AreParsedIntoTheirFields) {
  CLI::App app;
  ImageInput input;
  std::string image;
  app.add_option("image", image);
  add_input_options(app, InputScope::meshing, input);
  app.parse(
      "--labels 2,5 --background 0,1 --volume 3 --layer 1 --keep-rest --names n.tsv --many-labels --round "
      "--accept-shear --long-work a.nrrd");
  EXPECT_EQ(input.choice.labels, (std::vector<Label>{2, 5}));
  EXPECT_EQ(input.choice.background, (std::vector<Label>{0, 1}));
  EXPECT_EQ(input.read.volume, 3);
  EXPECT_EQ(input.read.layer, 1);
  EXPECT_TRUE(input.choice.keep_rest && input.many_labels && input.long_work);
  EXPECT_TRUE(input.read.round_values && input.read.accept_shear);
  EXPECT_EQ(input.names_file, "n.tsv");
  EXPECT_EQ(image, "a.nrrd");
}

TEST(InputOptions, EveryScopeHasThoseOfTheScopesBeforeIt) {
  for (const InputScope scope : {InputScope::reading, InputScope::image, InputScope::meshing}) {
    CLI::App app;
    ImageInput input;
    add_input_options(app, scope, input);
    for (const InputOption& option : input_options()) {
      EXPECT_EQ(has_flag(app, option), option.scope <= scope) << option.name;
    }
  }
}

TEST(InputOptions, HaveFieldsOfTheirOwnAndSayWhatHoldsWithoutThem) {
  ImageInput input;
  std::set<const void*> fields;
  for (const InputOption& option : input_options()) {
    const InputField field = option.field(input);
    fields.insert(std::visit([](const auto* value) -> const void* { return value; }, field));
    EXPECT_FALSE(option.text.empty()) << option.name;
    EXPECT_EQ(option.symbol.empty(), std::holds_alternative<bool*>(field)) << option.name;
    EXPECT_EQ(option.symbol.empty(), option.default_text.empty()) << option.name;
  }
  EXPECT_EQ(fields.size(), input_options().size());
}

TEST(InputOptions, SourcesHaveTheChoicesThatMakeSenseForThem) {
  const auto names = [](InputSource source) {
    std::vector<std::string> found;
    for (const InputOption* option : input_options_of(source, InputScope::image))
      found.push_back(option->name);
    return found;
  };
  EXPECT_EQ(names(InputSource::volume),
            (std::vector<std::string>{"background", "labels", "keep-rest", "many-labels"}));
  EXPECT_EQ(names(InputSource::array), (std::vector<std::string>{"volume", "background", "labels",
                                                                 "keep-rest", "names", "many-labels"}));
  EXPECT_EQ(input_options_of(InputSource::file, InputScope::meshing).size(), input_options().size());
}

const InputOption& option_named(const std::string& name) {
  const auto& all = input_options();
  return *std::find_if(all.begin(), all.end(),
                       [&](const InputOption& option) { return option.name == name; });
}

TEST(InputOptions, AreSetByTexts) {
  ImageInput input;
  set_input_option(option_named("labels"), "2, -5,7", input);
  set_input_option(option_named("keep-rest"), "true", input);
  set_input_option(option_named("volume"), "3", input);
  set_input_option(option_named("names"), "n.tsv", input);
  EXPECT_EQ(input.choice.labels, (std::vector<Label>{2, -5, 7}));
  EXPECT_TRUE(input.choice.keep_rest);
  EXPECT_EQ(input.read.volume, 3);
  EXPECT_EQ(input.names_file, "n.tsv");
  for (const auto& [name, text] :
       {std::pair("labels", "2,"), std::pair("labels", "two"), std::pair("labels", ""),
        std::pair("labels", "2 5"), std::pair("labels", "3000000000"), std::pair("volume", "-1"),
        std::pair("volume", "1,2"), std::pair("keep-rest", "yes")}) {
    try {
      set_input_option(option_named(name), text, input);
      FAIL() << name << " " << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.parameter(), name) << text;
    }
  }
}

TEST(InputOptions, VolumesAreCountedFromZero) {
  CLI::App app;
  ImageInput input;
  add_input_options(app, InputScope::reading, input);
  EXPECT_THROW(app.parse("--volume -1"), CLI::ValidationError);
}

}  // namespace
}  // namespace cbc3d
