#include "mesher/mesh_formats/gmsh_reading.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/file_text.hpp"
#include "mesher/mesh_formats/mesh_builder.hpp"
#include "mesher/mesh_formats/mesh_statements.hpp"

namespace cbc3d {
namespace {

/// Nodes of Gmsh's types of elements that are no volumes: boundary markers of other tools. 0: another type.
std::size_t nodes_of_lower_type(std::int64_t type) {
  static const std::map<std::int64_t, std::size_t> kNodes = {
      {1, 2},   {2, 3},   {3, 4},   {15, 1},  {8, 3},   {9, 6},  {10, 9}, {16, 8}, {20, 9},
      {21, 10}, {22, 12}, {23, 15}, {24, 15}, {25, 21}, {26, 4}, {27, 5}, {28, 6}};
  const auto found = kNodes.find(type);
  return found == kNodes.end() ? 0 : found->second;
}

const CellKindRow* volume_of_type(std::int64_t type) {
  for (const CellKindRow& row : kCellKinds) {
    if (row.gmsh == type) return &row;
  }
  return nullptr;
}

class GmshReader {
 public:
  GmshReader(const std::filesystem::path& path, bool geometrical, MeshFileOptions& stated)
      : file_(path),
        builder_([this](const std::string& what) { file_.fail(what); }),
        geometrical_(geometrical),
        stated_(stated) {}

  Mesh read() {
    while (!file_.at_end()) {
      const std::string section(file_.line());
      if (!section.starts_with('$')) continue;
      read_section(section.substr(1, section.find_last_not_of(" \t")));
    }
    if (version_ == 0) file_.fail("not a Gmsh file: it has no $MeshFormat");
    take_group_names();
    return builder_.take();
  }

 private:
  void read_section(const std::string& name) {
    if (name == "MeshFormat") return read_format();
    if (name == "Comments" || version_ != 0) {
      if (name == "Nodes") {
        version_ < 4 ? read_nodes2() : read_nodes4();
      } else if (name == "Elements") {
        version_ < 4 ? read_elements2() : read_elements4();
      } else if (name == "Entities") {
        read_entities();
      } else if (name == "Comments") {
        return read_comments();
      } else if (name == "PhysicalNames") {
        read_group_names();
      } else if (!file_.skip_past_line("$End" + name)) {
        file_.fail_at_end(("section $" + name).c_str());
      } else {
        return;
      }
      return require_end(name);
    }
    file_.fail("the section $" + name.substr(0, 40) + " stands before $MeshFormat; export it again");
  }

  void require_end(const std::string& name) {
    const std::string_view word = file_.word();
    if (word.empty()) file_.fail_at_end(("section $" + name).c_str());
    if (word != "$End" + name) {
      file_.fail("the section $" + name +
                 " is longer than its counts promise; the file is damaged, export it again");
    }
    file_.line();
  }

  void read_format() {
    const double version = file_.real("format");
    const std::int64_t kind = file_.integer("format"), bytes = file_.integer("format");
    if (!(version >= 2 && version < 3) && version != 4.1) {
      file_.fail("its version is not 2.2 or 4.1; export it with `gmsh -save -format msh41`");
    }
    if ((kind != 0 && kind != 1) || bytes != 8) {
      file_.fail(
          "its header is neither that of a text nor of a binary file with numbers of 8 bytes; export it "
          "again");
    }
    file_.line();
    binary_ = kind == 1;
    if (binary_) file_.set_binary();
    if (binary_ && file_.bytes<std::int32_t>("format") != 1) {
      file_.fail("its bytes are in the other order; export it as text");
    }
    version_ = version;
    require_end("MeshFormat");
  }

  /// Comments may stand before $MeshFormat too.
  void read_comments() {
    while (!file_.at_end()) {
      const std::string_view line = file_.line();
      if (line.starts_with("$EndComments")) return;
      take_statement(line, stated_);
    }
    file_.fail_at_end("section $Comments");
  }

  /// `3 5 "right lung"`, text in binary files too.
  void read_group_names() {
    const std::size_t count = file_.count("physical names", 6);
    for (std::size_t n = 0; n < count; ++n) {
      const std::int64_t dimension = file_.integer("physical names"), group = file_.integer("physical names");
      const std::string_view rest = file_.line();
      const std::size_t begin = rest.find('"'), end = rest.rfind('"');
      if (begin == end) file_.fail("a physical group has no name in quotes; export it again");
      if (dimension == 3) group_names_.emplace_back(group, rest.substr(begin + 1, end - begin - 1));
    }
  }

  /// Names of groups are those of labels where labels are the groups.
  void take_group_names() {
    for (const auto& [group, name] : group_names_) {
      if (!geometrical_) take_group_name(label_of(group), name, stated_.names);
    }
  }

  // Numbers of text or binary files.
  std::int64_t next_int(const char* what) {
    return binary_ ? file_.bytes<std::int32_t>(what) : file_.integer(what);
  }
  std::int64_t next_size(const char* what) {
    return binary_ ? file_.bytes<std::int64_t>(what) : file_.integer(what);
  }
  double next_real(const char* what) {
    if (!binary_) return file_.real(what);
    const auto value = file_.bytes<double>(what);
    if (!std::isfinite(value)) {
      file_.fail(std::string("a number that is not finite stands among its ") + what +
                 "; the file is damaged, export it again");
    }
    return value;
  }
  std::size_t next_count(const char* what, std::size_t least_bytes) {
    return file_.checked_count(next_size(what), what, least_bytes);
  }
  Vec3 next_point() {
    const double x = next_real("nodes"), y = next_real("nodes"), z = next_real("nodes");
    return {x, y, z};
  }
  Label label_of(std::int64_t number) {
    if (number < std::numeric_limits<Label>::min() || number > std::numeric_limits<Label>::max()) {
      file_.fail("the group " + std::to_string(number) + " is no integer of 32 bits");
    }
    return static_cast<Label>(number);
  }

  void read_nodes2() {
    const std::size_t count = file_.count("nodes", 8);  // "1 0 0 0" and the end of the line
    file_.line();
    for (std::size_t v = 0; v < count; ++v) {
      const std::int64_t number = next_int("nodes");
      builder_.add_node(number, next_point());
    }
  }

  void read_elements2() {
    const std::size_t count = file_.count("elements", 6);  // "1 15 0" and the end of the line
    file_.line();
    for (std::size_t e = 0; e < count;) {
      const std::int64_t first = binary_ ? 0 : next_int("elements"), type = next_int("elements");
      static_cast<void>(first);
      const std::size_t block = binary_ ? file_.checked_count(next_int("elements"), "elements", 4) : 1;
      const std::int64_t tags = next_int("elements");
      if (tags < 0 || tags > kMostTags) {
        file_.fail("an element has " + std::to_string(tags) + " tags; the file is damaged, export it again");
      }
      if (block == 0 || block > count - e) {
        file_.fail("it has other elements than its count promises; the file is damaged, export it again");
      }
      for (std::size_t b = 0; b < block; ++b) {
        if (binary_) next_int("elements");
        const Label label = read_tags(tags);
        read_cell(type, label, false);
      }
      e += block;
    }
  }

  Label read_tags(std::int64_t tags) {
    Label label = 0;
    for (std::int64_t t = 0; t < tags; ++t) {
      const std::int64_t tag = next_int("elements");
      if (t == (geometrical_ ? 1 : 0)) label = label_of(tag);
    }
    return label;
  }

  void read_cell(std::int64_t type, Label label, bool wide) {
    const CellKindRow* const volume = volume_of_type(type);
    const std::size_t count = volume != nullptr ? volume->corners : nodes_of_lower_type(type);
    if (count == 0) {
      file_.fail("it has elements of Gmsh type " + std::to_string(type) +
                 "; known are linear volume elements, export it with `-order 1`");
    }
    numbers_.resize(count);
    for (std::int64_t& number : numbers_) number = wide ? next_size("elements") : next_int("elements");
    if (volume != nullptr) {
      builder_.add_cell(static_cast<CellKind>(volume - kCellKinds.data()), numbers_, label);
    }
  }

  /// Of points: place and groups; of what has a dimension: box, groups, bounds. The first group counts.
  void read_entity(int dimension) {
    const std::int64_t tag = next_int("entities");
    for (int n = 0; n < (dimension == 0 ? 3 : 6); ++n) next_real("entities");
    const std::size_t groups = next_count("entities", 2);
    for (std::size_t g = 0; g < groups; ++g) {
      const std::int64_t group = next_int("entities");
      if (g == 0 && dimension == 3) group_of_volume_[tag] = group;
    }
    const std::size_t bounds = dimension == 0 ? 0 : next_count("entities", 2);
    for (std::size_t b = 0; b < bounds; ++b) next_int("entities");
  }

  void read_entities() {
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = next_count("entities", 8);
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t e = 0; e < counts[static_cast<std::size_t>(dimension)]; ++e) read_entity(dimension);
    }
  }

  void read_nodes4() {
    const std::size_t blocks = next_count("node blocks", 8), total = next_count("nodes", 8);
    next_size("nodes"), next_size("nodes");
    std::size_t read = 0;
    std::vector<std::int64_t> tags;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::int64_t dimension = next_int("nodes");
      next_int("nodes");
      const bool parametric = next_int("nodes") != 0;
      tags.resize(next_count("nodes", 8));
      for (std::int64_t& tag : tags) tag = next_size("nodes");
      for (const std::int64_t tag : tags) {
        builder_.add_node(tag, next_point());
        for (std::int64_t p = 0; parametric && p < dimension; ++p) next_real("nodes");
      }
      read += tags.size();
    }
    if (read != total) {
      file_.fail("it promises " + std::to_string(total) + " nodes and has " + std::to_string(read) +
                 "; the file is damaged, export it again");
    }
  }

  void read_elements4() {
    const std::size_t blocks = next_count("element blocks", 8), total = next_count("elements", 4);
    next_size("elements"), next_size("elements");
    std::size_t read = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      next_int("elements");
      const std::int64_t tag = next_int("elements"), type = next_int("elements");
      const std::size_t count = next_count("elements", 4);
      const auto group = group_of_volume_.find(tag);
      const Label label = geometrical_                      ? label_of(tag)
                          : group == group_of_volume_.end() ? 0
                                                            : label_of(group->second);
      for (std::size_t e = 0; e < count; ++e) {
        next_size("elements");
        read_cell(type, label, true);
      }
      read += count;
    }
    if (read != total) {
      file_.fail("it promises " + std::to_string(total) + " elements and has " + std::to_string(read) +
                 "; the file is damaged, export it again");
    }
  }

  static constexpr std::int64_t kMostTags = 1000;

  FileText file_;
  MeshBuilder builder_;
  bool geometrical_;
  MeshFileOptions& stated_;
  double version_ = 0;
  bool binary_ = false;
  std::map<std::int64_t, std::int64_t> group_of_volume_;
  std::vector<std::pair<std::int64_t, std::string>> group_names_;  // of volumes
  std::vector<std::int64_t> numbers_;
};

}  // namespace

Mesh read_gmsh(const std::filesystem::path& path, const ReadMeshOptions& options, MeshFileOptions& stated) {
  const std::string& array = options.label_array;
  if (!array.empty() && array != "gmsh:physical" && array != "gmsh:geometrical") {
    throw InputError("cannot read '" + path.string() + "': label_array '" + array +
                     "': a Gmsh file has gmsh:physical and gmsh:geometrical");
  }
  return GmshReader(path, array == "gmsh:geometrical", stated).read();
}

Mesh read_gmsh(const std::filesystem::path& path, const ReadMeshOptions& options) {
  MeshFileOptions stated;
  return read_gmsh(path, options, stated);
}

}  // namespace cbc3d
