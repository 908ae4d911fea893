#include "reports/tables/table_list.hpp"

#include "reports/tables/catalog_table.hpp"
#include "reports/tables/deformation_pattern_table.hpp"
#include "reports/tables/front_table.hpp"
#include "reports/tables/image_data_table.hpp"
#include "reports/tables/input_parameter_table.hpp"
#include "reports/tables/microbenchmark_table.hpp"
#include "reports/tables/parallel_table.hpp"
#include "reports/tables/scaling_table.hpp"
#include "reports/tables/smoothness_table.hpp"
#include "reports/tables/speed_table.hpp"
#include "reports/tables/success_table.hpp"
#include "reports/tables/sweep_tables.hpp"
#include "reports/tables/target_table.hpp"

namespace cbc3d::reports {

const std::vector<TableBuilder>& table_list() {
  static const std::vector<TableBuilder> list{
      success_table,
      front_table,
      front_loss_table,
      catalog_table("element_count", "Element count"),
      catalog_table("element_quality", "Element quality"),
      catalog_table(
          "shape",
          "Shape of the elements (1 is best, 0 flat; edge ratio: longest over shortest) and how their "
          "sizes change"),
      catalog_table("surface", "How the surface of all labels as one looks"),
      for_solved_meshes(catalog_table(
          "solver",
          "What a finite-element solver makes of the meshes (Poisson's equation with a known solution)")),
      catalog_table("fidelity",
                    "Fidelity (HD: the paper's Hausdorff distance of surface vertices and boundary voxels)"),
      catalog_table("time", "Time and memory (meshing end to end, without reading and writing files)"),
      for_mixed_meshes(
          catalog_table("vertices", "Vertices and elements of the mixed meshes beside the tetrahedral ones")),
      speed_table,
      scaling_table,
      target_table,
      smoothness_table,
      deformation_pattern_table,
      sweep_table,
      sweep_stage_table,
      sweep_parallel_table,
      microbenchmarks_of_run,
      image_data_table,
      input_parameter_table};
  return list;
}

}  // namespace cbc3d::reports
