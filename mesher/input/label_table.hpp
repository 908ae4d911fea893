// Tables of label names and colours, as other programs write them beside images.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesher/core/label_names.hpp"

namespace cbc3d {

/// Reads a table, whose kind its content tells:
///   JSON        {"5": "right lung"} or {"right lung": 5}, plain or below "labels" or "label_names", or a
///   list of
///               objects with label (index, value, id), name and color;
///   .tsv, .csv  a line of column names, index (label, value, id), name and color or r, g, b, or without it
///               label, name and colour in this order; BIDS `_dseg.tsv` and the tables of 3D Slicer 5.6 among
///               them;
///   ITK-SNAP    IDX R G B A VIS MSH "NAME" in every line;
///   FreeSurfer  NUMBER NAME R G B A in every line, 3D Slicer's .ctbl too; NUMBER NAME alone.
/// Lines that begin with # or // and empty ones are left out. A colour is #rrggbb, three numbers from 0 to
/// 255, or three fractions from 0 to 1. Throws InputError, one line that names file, line and remedy, for a
/// line without a whole number or a name, a bad colour, a label that stands twice and a file of more than 16
/// MB.
LabelNames read_label_table(const std::filesystem::path& path);

/// The same of a text; `subject` begins what it throws ("cannot read 'a.tsv'"), `extension` is in lower case.
LabelNames parse_label_table(std::string_view text, const std::string& subject, const std::string& extension);

}  // namespace cbc3d
