// A mesh as bytes for the page's 3D view, which view/decode_mesh.js reads.
//
// Format: one zlib stream of bytes in planes, that is of many numbers first all lowest bytes, then all second
// ones, so that equal bytes lie together. With n vertices and m tets:
//   x, y, z       n each, 2 planes: positions in `step` from `origin`, modulo 65536 less that of the vertex
//   before a, b, c, d    m each, 3 planes: the corners of a tet in descending order; of a what it is less
//   than the number of
//                 vertices of the tets before plus 3, of the others what each is less than the corner before
//   label         m, 2 planes: less the label index of the tet before, modulo 65536
//   angle         m, 1 plane: smallest dihedral angle in 1/3.5 degree
//   ratio         m, 1 plane: mean ratio in 1/250, 0 where it is negative
//   boundary      m, 1 plane: bit i is set where the face opposite corner i (in this order) is a facet
// Vertices are numbered in the order in which the tets need them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "reports/viewer/shown_mesh.hpp"

namespace cbc3d::reports {

struct MeshPayload {
  nlohmann::json
      header;  ///< vertices, tets, origin, step, and the worst tets with their points relative to origin
  std::string bytes;
};

MeshPayload mesh_payload(const ShownMesh& mesh);

}  // namespace cbc3d::reports
