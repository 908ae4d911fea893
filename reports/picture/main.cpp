// cbc3d-picture: PNG pictures of a mesh. VTK's rendering needs an X server (a virtual one will do) and ends
// the process without one, so it lives in a program of its own.
#include <CLI/CLI.hpp>
#include <iostream>

#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/mesh_io.hpp"
#include "mesher/core/progress.hpp"
#include "mesher/core/runtime.hpp"
#include "reports/picture/scene.hpp"

namespace {

struct Options {
  std::string mesh, image, cut, surface;
  cbc3d::reports::PictureOptions picture;
  int threads = 0;
  bool quiet = false;
};

int draw(const Options& options) {
  cbc3d::set_thread_count(options.threads);
  cbc3d::Progress progress(options.quiet);
  progress.step("reading", 0);
  const cbc3d::Mesh mesh = cbc3d::read_mesh(options.mesh);
  const cbc3d::LabelImage image = cbc3d::read_label_image(options.image);
  if (!options.cut.empty()) {
    progress.step("cut section", 0.4);
    cbc3d::reports::draw_cut_section(mesh, image, options.picture, options.cut);
  }
  if (!options.surface.empty()) {
    progress.step("surface", 0.7);
    cbc3d::reports::draw_surface(mesh, image, options.picture, options.surface);
  }
  return cbc3d::kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Draws a mesh: its cut section and its surface. Needs an X server: xvfb-run -a cbc3d-picture ..."};
  Options options;
  app.add_option("MESH", options.mesh, "mesh file: .vtu, .vtk or .msh")->required();
  app.add_option("--image", options.image,
                 "label image that the mesh was made from: it gives plane, view and colours")
      ->required();
  app.add_option("--cut", options.cut, "PNG file of the cut section");
  app.add_option("--surface", options.surface, "PNG file of the surface");
  app.add_option("--caption", options.picture.caption, "text above the picture");
  app.add_option("--size", options.picture.size_px, "width and height, pixels")
      ->check(CLI::Range(100, 8000))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "threads; 0: all cores")->capture_default_str();
  app.add_flag("--quiet", options.quiet, "no progress");
  try {
    app.parse(argc, argv);
    return draw(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cbc3d::kExitSuccess : cbc3d::kExitBadInput;
  } catch (const cbc3d::InputError& error) {
    std::cerr << error.what() << '\n';
    return cbc3d::kExitBadInput;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return cbc3d::kExitJobFailed;
  }
}
