// Well-composed images: voxels of a label that touch at an edge or a corner alone are joined or cut, so that
// the image says by itself which topology each of its labels has.
//
// A label image is well-composed when every label's boundary, background's too, is a manifold (Latecki,
// Eckhardt, Rosenfeld: Well-composed sets, Computer Vision and Image Understanding 61, 1995). Then voxels
// that are connected through corners are connected through faces, open and closed sets have the same
// components, tunnels and cavities, and a mesh has one topology to keep. The paper's clean-up
// (voxel_contacts.hpp) takes the contacts of labels one by one and leaves those of their complements.
//
// Notation: contact  a 2x2 square of voxels with one label at the ends of a diagonal and not at the others;
//                    or a 2x2x2 cell with one label at the ends of a space diagonal and at none of the
//                    others, or at all of the others and at neither end;
//           join     background voxels become the label's, so that its parts are connected;
//           cut      voxels of a label become background's.
#pragma once

#include "mesher/preprocess/voxel_contacts.hpp"

namespace cbc3d {

/// Removes the contacts of all labels, background included, one after the other. Of the changes of one voxel
/// (or of the two on a path) that remove a contact and leave fewer in all, it takes a join before a cut, so
/// that thin vessels stay whole, then the one that leaves the fewest contacts, then the one whose new label
/// has most of the voxels around. Parts and cavities of one voxel stay. Where no change leaves fewer contacts
/// one is made all the same, but none of a voxel that has changed three times: so it ends. `contacts_left`
/// has what is left. Serial in the contacts, and in their order in the image: the same result at any thread
/// count.
ContactReport make_well_composed(LabelImage& image);

}  // namespace cbc3d
