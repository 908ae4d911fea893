// The table of names that lies beside an image.
#pragma once

#include <filesystem>
#include <optional>

namespace cbc3d {

/// For NAME.nii.gz, NAME.nrrd and so on the first of NAME.tsv, NAME.label, NAME.ctbl, NAME.csv and NAME.txt
/// that is there. For an image of BIDS, NAME_dseg, also a table _dseg.tsv of its folder or those above, up to
/// that of the data set (dataset_description.json), whose name has no entity that the image lacks: the
/// nearest, and in one folder that with the most entities. None where there is no table.
std::optional<std::filesystem::path> table_beside(const std::filesystem::path& image);

}  // namespace cbc3d
