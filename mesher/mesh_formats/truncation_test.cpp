// Files of every format that is read, cut short: one line, or the very mesh of the whole file with the same
// names and coordinates.
#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <string>

#include "mesher/core/error.hpp"
#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/mesh_format.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

/// A mesh and what its file states, as text that tells any two apart.
std::string text_of(const Mesh& mesh, const MeshFileOptions& stated) {
  std::string text = stated.coordinates + "\n";
  const auto add = [&text](auto number) { text += std::to_string(number) + " "; };
  for (const NamedLabel& named : stated.names.entries())
    text += std::to_string(named.label) + named.name + "\n";
  for (const Vec3& p : mesh.points) add(p.x), add(p.y), add(p.z);
  const auto add_block = [&](const auto& block) {
    for (std::size_t c = 0; c < block.size(); ++c) {
      add(block.labels[c]);
      for (const VertexId v : block.nodes[c]) add(v);
    }
  };
  add_block(mesh.tets), add_block(mesh.pyramids), add_block(mesh.wedges), add_block(mesh.hexes);
  return text;
}

class Truncation : public ::testing::Test {
 protected:
  /// The mesh as text; empty where the file is refused.
  [[nodiscard]] std::string mesh_in(const std::string& name) const {
    try {
      MeshFileOptions stated;
      const Mesh mesh = read_mesh(folder_.file(name), {}, nullptr, stated);
      return text_of(mesh, stated);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return "";
    }
  }

  /// Cuts the file at some 150 places, and everywhere within its last 80 bytes.
  void expect_cuts_refused(const std::string& name) const {
    const std::string whole = folder_.content(name), mesh = mesh_in(name);
    ASSERT_NE(mesh, "") << name;
    const std::string cut = "cut" + folder_.file(name).extension().string();
    const std::size_t step = std::max<std::size_t>(1, whole.size() / 150);
    for (std::size_t length = 0; length < whole.size(); length += length + 80 < whole.size() ? step : 1) {
      folder_.write(cut, whole.substr(0, length));
      const std::string found = mesh_in(cut);
      EXPECT_TRUE(found.empty() || found == mesh)
          << name << " cut at byte " << length << " of " << whole.size() << " is taken as another mesh";
    }
  }

  [[nodiscard]] MeshFileOptions options() const {
    MeshFileOptions options;
    for (const Label label : {3, 4, 5, 6}) {
      options.names.set({.label = label, .name = "part " + std::to_string(label), .colour = {}});
    }
    return options;
  }
  testing::TemporaryFolder folder_{"truncation"};
};

TEST_F(Truncation, FilesThatAreWritten) {
  for (const MeshFormat& format : mesh_formats()) {
    if (format.read == nullptr) continue;
    MeshFileOptions written = options();
    written.format = format.name;
    const std::string name = std::string(format.name) + std::string(format.extension);
    write_mesh(testing::one_of_each(), folder_.file(name), written);
    expect_cuts_refused(name);
  }
}

/// The grid of a .vtu file written again by VTK's own writer.
template <typename Writer, typename Choose>
void write_again(const std::filesystem::path& from, const std::filesystem::path& to, const Choose& choose) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(from.c_str());
  vtkNew<Writer> writer;
  writer->SetInputConnection(reader->GetOutputPort());
  writer->SetFileName(to.c_str());
  choose(*writer);
  ASSERT_EQ(writer->Write(), 1);
}

TEST_F(Truncation, XmlOfEveryEncoding) {
  using Writer = vtkXMLUnstructuredGridWriter;
  write_mesh(testing::one_of_each(), folder_.file("whole.vtu"), options());
  for (const int mode : {Writer::Ascii, Writer::Binary, Writer::Appended}) {
    for (const int compressor : {Writer::NONE, Writer::ZLIB, Writer::LZ4}) {
      for (const int encoded : {0, 1}) {
        if (mode != Writer::Appended && encoded == 1) continue;
        if (mode == Writer::Ascii && compressor != Writer::NONE) continue;
        const std::string name =
            "m" + std::to_string(mode) + std::to_string(compressor) + std::to_string(encoded) + ".vtu";
        write_again<Writer>(folder_.file("whole.vtu"), folder_.file(name), [&](Writer& writer) {
          writer.SetDataMode(mode);
          writer.SetCompressorType(compressor);
          writer.SetEncodeAppendedData(encoded);
        });
        expect_cuts_refused(name);
      }
    }
  }
}

TEST_F(Truncation, LegacyFilesOfTheNewerVersion) {
  using Writer = vtkUnstructuredGridWriter;
  write_mesh(testing::one_of_each(), folder_.file("whole.vtu"), options());
  for (const int type : {VTK_BINARY, VTK_ASCII}) {
    const std::string name = "m" + std::to_string(type) + ".vtk";
    write_again<Writer>(folder_.file("whole.vtu"), folder_.file(name),
                        [&](Writer& writer) { writer.SetFileType(type); });
    expect_cuts_refused(name);
  }
}

}  // namespace
}  // namespace cbc3d
