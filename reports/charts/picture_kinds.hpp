// The kinds of pictures that are drawn of a mesh, and their files.
#pragma once

#include <string>
#include <vector>

namespace cbc3d::reports {

struct PictureKind {
  const char* name;   ///< end of the file name, and option of cbc3d-picture
  const char* title;  ///< one line
};

/// In the order in which they are shown.
inline const std::vector<PictureKind>& picture_kinds() {
  static const std::vector<PictureKind> kinds{
      {"cut", "Cut section, the same plane for all"},
      {"surface", "Surface"},
      {"close-up", "Surface, close-up"},
      {"overlay", "Interfaces of the mesh over the segmentation, same plane"},
      {"beside", "Tetrahedra beside mixed elements"}};
  return kinds;
}

/// Start of the file names of a mesh's pictures.
inline std::string picture_stem(const std::string& case_name, const std::string& mesher) {
  std::string stem = case_name + "-" + mesher;
  for (char& c : stem) {
    c = c == ':' || c == '/' ? '_' : c;
  }
  return stem;
}

}  // namespace cbc3d::reports
