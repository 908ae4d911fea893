// cbc3d-picture: PNG pictures of a mesh. VTK's rendering needs an X server (a virtual one will do) and ends
// the process without one, so it lives in a program of its own.
#include <CLI/CLI.hpp>
#include <iostream>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/input/image_input.hpp"
#include "mesher/input/input_options.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "reports/picture/scene.hpp"

namespace {

struct Options {
  std::string mesh, image, cut, surface, close_up, overlay, beside, mixed_mesh, mixed_caption, small;
  cbc3d::ImageInput input{.many_labels = true};
  cbc3d::reports::PictureOptions picture;
  int threads = 0;
  bool quiet = false;
};

/// A kind of picture of one mesh.
struct Kind {
  const char* name;
  const std::string& png;
  void (*draw)(const cbc3d::Mesh&, const cbc3d::LabelImage&, const cbc3d::reports::PictureOptions&,
               const std::filesystem::path&);
};

int draw(Options options) {
  options.picture.small_dir = options.small;
  cbc3d::set_thread_count(options.threads);
  cbc3d::TerminalProgress progress(options.quiet);
  progress.step("reading", 0);
  const cbc3d::LabelImage image = cbc3d::read_input_image(options.image, options.input);
  cbc3d::MeshFileOptions stated;
  const cbc3d::Mesh mesh = cbc3d::read_mesh(options.mesh, {}, &image.frame, stated);
  options.picture.names = options.input.names;
  options.picture.names.add_unknown(stated.names);
  const std::vector<Kind> kinds{{"cut section", options.cut, cbc3d::reports::draw_cut_section},
                                {"surface", options.surface, cbc3d::reports::draw_surface},
                                {"close-up", options.close_up, cbc3d::reports::draw_close_up},
                                {"overlay", options.overlay, cbc3d::reports::draw_overlay}};
  double share = 0.2;
  for (const Kind& kind : kinds) {
    if (!kind.png.empty()) {
      progress.step(kind.name, share += 0.15);
      kind.draw(mesh, image, options.picture, kind.png);
    }
  }
  if (!options.beside.empty()) {
    progress.step("beside", 0.9);
    cbc3d::reports::PictureOptions mixed = options.picture;
    mixed.caption = options.mixed_caption;
    cbc3d::reports::draw_beside(mesh, cbc3d::read_mesh(options.mixed_mesh), image, options.picture, mixed,
                                options.beside);
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
  app.add_option("--close-up", options.close_up, "PNG file of a part of the surface, six times as near");
  app.add_option("--overlay", options.overlay, "PNG file of the mesh's interfaces over the segmentation");
  CLI::Option* beside =
      app.add_option("--beside", options.beside, "PNG file of two cut sections side by side");
  beside->needs(app.add_option("--mixed-mesh", options.mixed_mesh, "the other mesh of --beside"));
  app.add_option("--mixed-caption", options.mixed_caption, "text above the other mesh");
  app.add_option("--small", options.small, "folder for copies as JPEG of half the size");
  app.add_option("--caption", options.picture.caption, "text above the picture");
  app.add_option("--size", options.picture.size_px, "width and height, pixels")
      ->check(CLI::Range(100, 8000))
      ->capture_default_str();
  cbc3d::add_input_options(app, cbc3d::InputScope::reading, options.input);
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
