// The interfaces of a mesh of any cells, by their labels.
#pragma once

#include <vector>

#include "mesher/mesh_formats/file_mesh.hpp"

namespace cbc3d {

/// All facets between two labels and all on the outside, each pair of labels one interface; ordered by the
/// lower label, then the higher, the outside last. Facets are ordered by their nodes. Throws InputError where
/// a facet belongs to more than two cells.
std::vector<Interface> labelled_interfaces(const std::vector<FileCells>& blocks, std::size_t points);

}  // namespace cbc3d
