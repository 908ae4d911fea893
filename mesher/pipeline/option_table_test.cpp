#include "mesher/pipeline/option_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesher/pipeline/presets.hpp"
#include "mesher/pipeline/testing_option_samples.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::option_sample;

/// The message with which a value is refused; empty where it is taken.
std::string refusal(const std::string& name, const OptionValue& value) {
  MeshImageOptions options;
  try {
    set_option(options, name, value);
  } catch (const OptionError& error) {
    return error.what();
  }
  return "";
}

TEST(OptionTable, RowsAreCompleteAndNamedOnce) {
  std::set<std::string> names, keys;
  for (const OptionRow& row : option_table()) {
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(names.insert(row.name).second);
    EXPECT_TRUE(keys.insert(report_key(row) + "/" + row.label_key).second);
    EXPECT_FALSE(row.text.empty());
    EXPECT_EQ(row.text.find('\n'), std::string::npos);
    EXPECT_EQ(row.symbol.empty(), row.kind == OptionKind::on_off || row.kind == OptionKind::choice);
    EXPECT_EQ(row.choices.empty(), row.kind != OptionKind::choice);
    EXPECT_EQ(&find_option(row.name), &row);
  }
}

TEST(OptionTable, EveryOptionIsSetByTextAndReadBack) {
  for (const OptionRow& row : option_table()) {
    SCOPED_TRACE(row.name);
    for (const char* preset : {"quality", "paper"}) {
      MeshImageOptions options = preset_options(preset, ImageFrame());
      const std::string sample = option_sample(row, options);
      EXPECT_NE(row.get(options), checked_value(row, sample));
      set_option(options, row.name, sample);
      EXPECT_EQ(value_text(row.get(options)), row.label_key.empty() ? sample : value_text(row.get(options)));
      EXPECT_FALSE(is_unset(row, options));
      EXPECT_EQ(row.get(options), checked_value(row, sample));
    }
  }
}

TEST(OptionTable, SetsOneFieldAndLeavesTheOthers) {
  MeshImageOptions options, untouched;
  set_option(options, "pair-distance", "0.75");
  EXPECT_EQ(options.deform.displacement.pair_distance, 0.75);
  for (const OptionRow& row : option_table()) {
    if (row.name != "pair-distance") {
      EXPECT_EQ(row.get(options), row.get(untouched)) << row.name;
    }
  }
}

TEST(OptionTable, RefusesWhatIsOutOfRangeNamingParameterValueAndRange) {
  EXPECT_EQ(refusal("fidelity", "2"), "fidelity 2: give a number in [1e-06, 1]");
  EXPECT_EQ(refusal("iterations", "2.5"), "iterations 2.5: give a whole number in [0, 1000]");
  EXPECT_EQ(refusal("lattice-spacing", "0"), "lattice-spacing 0: give a number in (0, 1e+09]");
  EXPECT_EQ(refusal("mixed", "yes"), "mixed yes: give true or false");
  EXPECT_EQ(refusal("relabel-noise", "all"), "relabel-noise all: give none, holes, specks or both");
  EXPECT_EQ(refusal("material-fidelity", "2:1"),
            "material-fidelity 2:1: give LABEL=F with a number in (0, 1], as 2=0.4");
  for (const OptionRow& row : option_table()) {
    SCOPED_TRACE(row.name);
    for (const char* bad :
         {"", "nonsense", "nan", "inf", "-1", "1e999", "2=", "=2", "2=-1", "2=0.4,", "2=0.4 x"}) {
      EXPECT_NE(refusal(row.name, bad).find(row.name + " " + bad + ": give "), std::string::npos) << bad;
    }
  }
}

TEST(OptionTable, BoundsAreInTheRangeUnlessExcluded) {
  for (const OptionRow& row : option_table()) {
    if (row.kind == OptionKind::number) {
      EXPECT_EQ(refusal(row.name, row.range.lowest).empty(), !row.range.excludes_lowest) << row.name;
      if (std::isfinite(row.range.highest)) {
        EXPECT_EQ(refusal(row.name, row.range.highest).empty(), !row.range.excludes_highest) << row.name;
        EXPECT_FALSE(refusal(row.name, std::nextafter(row.range.highest, 1e300)).empty()) << row.name;
      }
    }
  }
}

TEST(OptionTable, TakesTypedValuesAndUnderscores) {
  MeshImageOptions options;
  set_option(options, "min_scaled_jacobian", 0.25);
  set_option(options, "iterations", 3);
  set_option(options, "mixed", true);
  set_option(options, "size", LabelNumbers{{7, 1.5}});
  set_option(options, "lattice_spacing", 4);  // a whole number is a number too
  EXPECT_EQ(options.deform.quality.min_scaled_jacobian, 0.25);
  EXPECT_EQ(options.deform.iterations, 3);
  EXPECT_TRUE(options.mixed);
  EXPECT_EQ(options.improve.size_mm, (std::map<Label, double>{{7, 1.5}}));
  EXPECT_EQ(options.lattice_spacing_mm, 4);
  EXPECT_NE(refusal("iterations", 2.5), "");
  EXPECT_NE(refusal("mixed", 1), "");
  EXPECT_NE(refusal("fidelity", true), "");
}

TEST(OptionTable, AnUnknownNameListsTheKnownOnes) {
  const std::string message = refusal("fidelitty", "1");
  EXPECT_EQ(message.find("fidelitty: no such option"), 0U) << message;
  EXPECT_NE(message.find("material-fidelity"), std::string::npos);
}

TEST(OptionTable, TheLargestDistanceIsTheReachOfTheImprovementToo) {
  MeshImageOptions options = preset_options("quality", ImageFrame());
  set_option(options, "max-distance", 2.5);
  EXPECT_EQ(options.improve.reach_mm, 2.5);
}

TEST(OptionTable, TheAngleIsThatOfThePresetsLastStage) {
  const OptionRow& angle = find_option("min-dihedral");
  const MeshImageOptions quality = preset_options("quality", ImageFrame());
  const MeshImageOptions paper = preset_options("paper", ImageFrame());
  EXPECT_EQ(angle.get(quality), OptionValue(quality.improve.min_dihedral_deg));
  EXPECT_EQ(angle.get(paper), OptionValue(paper.deform.quality.min_dihedral_deg));
  EXPECT_NE(angle.get(quality), angle.get(paper));
}

TEST(OptionTable, DefaultsAreThoseOfThePreset) {
  ImageFrame frame;
  frame.spacing_mm = {2, 3, 6};  // a diagonal of 7 mm
  const MeshImageOptions quality = preset_options("quality", frame);
  const auto of_quality = [&](const char* name) { return default_text(find_option(name), quality, 7); };
  EXPECT_EQ(of_quality("max-distance"), "1 voxel diagonals");
  EXPECT_EQ(of_quality("lattice-spacing"), "ten times the mean voxel spacing");
  EXPECT_EQ(of_quality("gradation"), "1");
  EXPECT_EQ(of_quality("size"), "no limit");
  EXPECT_EQ(of_quality("no-manifold-voxels"), "false");
  EXPECT_EQ(of_quality("target-position"), "voxel-faces");
  for (const OptionRow& row : option_table()) {
    const std::string text = default_text(row, quality, 7);
    EXPECT_FALSE(text.empty()) << row.name;
    if (!is_unset(row, quality) && !row.scales_with_voxels) {
      EXPECT_EQ(checked_value(row, text), row.get(quality)) << row.name;
    }
  }
  EXPECT_EQ(default_text(find_option("max-distance"), preset_options("paper", frame), 7), "0");
}

TEST(OptionTable, OnlyPresetsThatImproveHaveOptionsOfTheImprovement) {
  const OptionRow& row = find_option("deviation");
  EXPECT_TRUE(has_option(preset_options("quality", ImageFrame()), row));
  EXPECT_FALSE(has_option(deformation_preset_options("quality"), row));
  EXPECT_FALSE(has_option(preset_options("paper", ImageFrame()), row));
}

TEST(OptionSettings, LabelsTakeFromAllWhatIsNotTheirOwnWhateverTheOrder) {
  MeshImageOptions options;
  apply_settings({{"material-young", "2=6900,3=100"}, {"poisson", "0.25"}, {"material-young", "3=200"}},
                 options);
  const auto& by_label = options.deform.elasticity.by_label;
  ASSERT_EQ(by_label.size(), 2U);
  EXPECT_EQ(by_label.at(2).young_pa, 6900);
  EXPECT_EQ(by_label.at(3).young_pa, 200);
  EXPECT_EQ(by_label.at(2).poisson, 0.25);
}

TEST(OptionSettings, TheLastOfANameCounts) {
  const OptionSettings settings = {{"mixed", true}, {"iterations", 3}, {"mixed", "false"}, {"iterations", 4}};
  MeshImageOptions options;
  apply_settings(settings, options);
  EXPECT_FALSE(options.mixed);
  EXPECT_EQ(options.deform.iterations, 4);
}

TEST(OptionSettings, ALabelThatTheImageLacksIsNamed) {
  const LabelImage image = testing::ball_image(6, 1, 2);
  MeshImageOptions options;
  set_option(options, "material-fidelity", "1=0.5");
  EXPECT_NO_THROW(require_known_labels(options, image));
  set_option(options, "material-young", "9=100");
  try {
    require_known_labels(options, image);
    ADD_FAILURE() << "label 9 was taken";
  } catch (const OptionError& error) {
    EXPECT_STREQ(error.what(), "material-young 9=100: the image has no label 9");
  }
}

TEST(OptionTable, EveryGroupHasAHeadingOfItsOwn) {
  std::set<std::string> headings;
  for (const OptionGroup group : {OptionGroup::cleaning, OptionGroup::lattice, OptionGroup::mixed,
                                  OptionGroup::improvement, OptionGroup::deformation}) {
    EXPECT_NE(heading(group), "");
    headings.insert(heading(group));
  }
  EXPECT_EQ(headings.size(), 5U);
}

}  // namespace
}  // namespace cbc3d
