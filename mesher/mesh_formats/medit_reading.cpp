#include "mesher/mesh_formats/medit_reading.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/file_text.hpp"
#include "mesher/mesh_formats/mesh_builder.hpp"
#include "mesher/mesh_formats/mesh_statements.hpp"

namespace cbc3d {
namespace {

class MeditReader {
 public:
  MeditReader(const std::filesystem::path& path, MeshFileOptions& stated)
      : file_(path), builder_([this](const std::string& what) { file_.fail(what); }), stated_(stated) {}

  Mesh read() {
    if (word() != "MeshVersionFormatted") file_.fail("not a Medit text file: it has no MeshVersionFormatted");
    integer("version");
    for (std::string section(word()); section != "End"; section = word()) {
      if (section.empty()) file_.fail("it has no End; the file is truncated, export it again");
      read_section(section);
    }
    return builder_.take();
  }

 private:
  /// The next word that is in no comment.
  std::string_view word() {
    while (file_.peek_word().starts_with('#')) read_comment(file_.line());
    return file_.word();
  }
  void read_comment(std::string_view line) {
    line.remove_prefix(line.find('#') + 1);
    constexpr std::string_view kBegin = " CBC3D mesh, ";
    take_statement(line.starts_with(kBegin) ? line.substr(kBegin.size()) : line, stated_);
  }
  std::int64_t integer(const char* what) { return file_.integer_of(word(), what); }
  std::size_t count(const char* what, std::size_t least_bytes) {
    return file_.checked_count(integer(what), what, least_bytes);
  }

  void read_section(const std::string& section) {
    if (section == "Dimension") {
      if (integer("dimension") != 3) file_.fail("its dimension is not 3; give a volume mesh");
    } else if (section == "Vertices") {
      read_vertices();
    } else if (section.ends_with("P2") && section.starts_with("Tetrahedra")) {
      file_.fail("it has quadratic tets; known are linear volume elements, export it with those");
    } else if (const CellKindRow* const row = row_named(section)) {
      read_cells(*row);
    } else if (std::isalpha(static_cast<unsigned char>(section[0])) != 0) {
      skip_numbers();  // facets, edges, corners and so on
    } else {
      file_.fail("'" + section.substr(0, 20) +
                 "' stands where a section should begin: the one before it is longer than its count; export "
                 "it again");
    }
  }

  static const CellKindRow* row_named(const std::string& section) {
    for (const CellKindRow& row : kCellKinds) {
      if (section == row.medit) return &row;
    }
    return nullptr;
  }

  void skip_numbers() {
    const auto begins_section = [this] {
      const std::string_view next = file_.peek_word();
      return next.empty() || (std::isalpha(static_cast<unsigned char>(next[0])) != 0);
    };
    while (!begins_section()) word();
  }

  void read_vertices() {
    if (builder_.has_nodes()) file_.fail("it has its Vertices twice; export it again");
    const std::size_t vertices = count("vertices", 8);
    for (std::size_t v = 0; v < vertices; ++v) {
      const double x = real(), y = real(), z = real();
      integer("vertices");
      builder_.add_node(static_cast<std::int64_t>(v) + 1, {x, y, z});
    }
  }
  double real() { return file_.real_of(word(), "vertices"); }

  void read_cells(const CellKindRow& row) {
    const std::size_t cells = count(row.medit, 2U * row.corners);
    std::vector<std::int64_t> numbers(row.corners);
    for (std::size_t c = 0; c < cells; ++c) {
      for (std::int64_t& number : numbers) number = integer(row.medit);
      const std::int64_t label = integer(row.medit);
      if (label < std::numeric_limits<Label>::min() || label > std::numeric_limits<Label>::max()) {
        file_.fail("the reference " + std::to_string(label) + " is no integer of 32 bits");
      }
      builder_.add_cell(static_cast<CellKind>(&row - kCellKinds.data()), numbers, static_cast<Label>(label));
    }
  }

  FileText file_;
  MeshBuilder builder_;
  MeshFileOptions& stated_;
};

}  // namespace

Mesh read_medit(const std::filesystem::path& path, const ReadMeshOptions& options, MeshFileOptions& stated) {
  if (!options.label_array.empty()) {
    throw InputError("cannot read '" + path.string() +
                     "': label_array: a Medit file has the references of its cells alone; leave it out");
  }
  return MeditReader(path, stated).read();
}

Mesh read_medit(const std::filesystem::path& path, const ReadMeshOptions& options) {
  MeshFileOptions stated;
  return read_medit(path, options, stated);
}

}  // namespace cbc3d
