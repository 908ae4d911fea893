// CBC3D from label image to mesh: the paper's section "Method" in one function.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/core/progress.hpp"
#include "mesher/core/stage_clock.hpp"
#include "mesher/deform/deform_mesh.hpp"
#include "mesher/improve/improve_mesh.hpp"
#include "mesher/lattice/check_topology.hpp"
#include "mesher/lattice/label_betti.hpp"
#include "mesher/lattice/refine_lattice.hpp"
#include "mesher/mixed/hex_core.hpp"
#include "mesher/preprocess/clean_image.hpp"
#include "mesher/quadratic/curved_mesh.hpp"

namespace cbc3d {

struct MeshImageOptions {
  /// About this many elements (within a tenth, where the image lets it): all lengths of the preset shrink or
  /// grow together until there are as many; 0: as many as the lengths give. Without the improvement it means
  /// nothing.
  std::size_t elements = 0;
  /// The surfaces' edges are about this long: the same by a length; 0: as long as the distances let them.
  double edge_length_mm = 0;
  double lattice_spacing_mm =
      0;  ///< edge of the coarsest lattice cubes; 0: default_lattice_spacing_mm of the image
  CleanOptions clean;
  ImageDomainOptions domain;
  RefineOptions refine;
  TopologyOptions topology;
  /// Hexes and pyramids in uniform regions: with the improvement those of the coarse inside (hex_core.hpp),
  /// else all that the lattice has.
  bool mixed = false;
  MixOptions mix;
  DeformOptions deform;
  ImproveOptions improve;
  std::filesystem::path dump_stages;  ///< folder for the mesh after each stage; empty: none is written
  /// Seconds of CPU that the number of the lattice's tets may foretell (work_of_lattice_s) before the work
  /// ends with an InputError; 0: any. It depends on the image and the options alone, as no clock does.
  double work_limit_s = 0;
};

/// A voxel around which a label's topology may have become another than the cleaned image's.
struct TopologyPlace {
  Label label = 0;  ///< of the voxel
  Vec3 at_mm;       ///< its centre, physical
};

struct MeshImageReport {
  double lattice_spacing_mm = 0;
  double finest_spacing_mm = 0;
  StageSeconds stage_seconds;  ///< files not included
  double seconds = 0;
  double cpu_seconds = 0;         ///< user and system, all threads, of the same stages
  double system_cpu_seconds = 0;  ///< the system's share of them
  CleanReport clean;
  RefineResult refine;  ///< without its mesh
  TopologyReport topology;
  std::vector<LabelDifference> topology_differences;  ///< labels of other topology than in the cleaned image
  std::vector<TopologyPlace> difference_places;  ///< where that may be; none where there is no such label
  MixReport mix;
  DeformReport deform;
  ImproveReport improve;
  CurveReport curve;  ///< of quadratic meshes
  std::vector<std::string> warnings;
};

/// Meshes `image` (which is cleaned in place, so hand it over if it is not needed any more); the mesh is in
/// physical space and carries the image's label values. Throws InputError for options out of range. The same
/// bytes come out at any thread count.
Mesh mesh_image(LabelImage image, const MeshImageOptions& options, const Progress& progress,
                MeshImageReport& report);

/// The same mesh with tets of ten nodes, whose edges on boundaries follow the image's smooth ones. Throws
/// InputError for the option mixed.
QuadraticMesh mesh_image_quadratic(LabelImage image, const MeshImageOptions& options,
                                   const Progress& progress, MeshImageReport& report);

}  // namespace cbc3d
