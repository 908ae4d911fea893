// The choices about an image as flags of a command line.
#include "mesher/input/input_options.hpp"

#include <gtest/gtest.h>

#include <set>

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

TEST(InputOptions, VolumesAreCountedFromZero) {
  CLI::App app;
  ImageInput input;
  add_input_options(app, InputScope::reading, input);
  EXPECT_THROW(app.parse("--volume -1"), CLI::ValidationError);
}

}  // namespace
}  // namespace cbc3d
