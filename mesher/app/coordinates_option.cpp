#include "mesher/app/coordinates_option.hpp"

#include <map>

namespace cbc3d {

void add_coordinates_option(CLI::App& command, std::string& coordinates) {
  const std::map<std::string, std::string> names = {{"lps", "LPS"}, {"ras", "RAS"}, {"voxel", "voxel"}};
  command
      .add_option(
          "--coordinates", coordinates,
          "coordinates of the mesh's points: lps or ras, mm, or voxel, indices of the image from 0 on; "
          "written into the file and the report [lps]")
      ->type_name("lps|ras|voxel")
      ->transform(CLI::Transformer(names, CLI::ignore_case))
      ->check(CLI::IsMember({"LPS", "RAS", "voxel"}));
}

}  // namespace cbc3d
