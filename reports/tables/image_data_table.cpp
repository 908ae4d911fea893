#include "reports/tables/image_data_table.hpp"

#include <algorithm>
#include <functional>

#include "reports/results/columns.hpp"
#include "reports/tables/paper_protocol.hpp"

namespace cbc3d::reports {
namespace {

template <class Number>
std::string product(const std::vector<Number>& factors, int decimals) {
  std::string text;
  for (const Number factor : factors) {
    text += (text.empty() ? "" : " x ") + format_number(static_cast<double>(factor), decimals);
  }
  return text;
}

/// Decimals that show a voxel's size to three digits.
int spacing_decimals(const std::vector<double>& spacing_mm) {
  const auto least = std::min_element(spacing_mm.begin(), spacing_mm.end());
  return least == spacing_mm.end() || *least >= 0.1 ? 2 : 4;
}

Row image_row(const std::string& case_name, const ImageData& image, const cases::Case* subject) {
  const std::vector<double>& spacing_mm = image.spacing_mm;
  const bool isotropic =
      std::adjacent_find(spacing_mm.begin(), spacing_mm.end(), std::not_equal_to<>{}) == spacing_mm.end();
  std::string labels;
  for (const std::int64_t label : image.labels) {
    const NamedLabel* const named = image.names.find(static_cast<Label>(label));
    labels +=
        (labels.empty() ? "" : ", ") + std::to_string(label) + (named == nullptr ? "" : " " + named->name);
  }
  return {case_name,
          subject == nullptr ? "" : subject->title,
          0,
          {text_cell(isotropic ? "isotropic" : "anisotropic"),
           text_cell(std::to_string(image.labels.size()) + " (labels " + labels + ")"),
           text_cell(product(spacing_mm, spacing_decimals(spacing_mm))), text_cell(product(image.size, 0))}};
}

}  // namespace

Table image_data_table(const TableInput& input) {
  Table table{"image_data", "Image data", {"type", "materials", "spacing (mm)", "size (voxels)"},
              {},           "case",       "image"};
  for (const std::string& name : image_names(input.results)) {
    const auto read = std::find_if(input.results.begin(), input.results.end(), [&](const JobResult& result) {
      return result.case_name == name && result.image.has_value();
    });
    if (read != input.results.end()) {
      table.rows.push_back(image_row(name, read->image.value(), find_case(input.cases, name)));
    } else {
      table.rows.push_back({name, "not read: no mesh of it was evaluated", 0, {{}, {}, {}, {}}});
    }
  }
  for (const PaperImage& image : paper_images()) {
    table.rows.push_back({std::string("paper, ") + image.name,
                          "the paper's own",
                          0,
                          {text_cell(image.type), text_cell(image.materials), text_cell(image.spacing_mm),
                           text_cell(image.size)}});
  }
  return table;
}

}  // namespace cbc3d::reports
