#include "mesher/mesh_formats/abaqus_reading.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/file_text.hpp"
#include "mesher/mesh_formats/mesh_builder.hpp"
#include "mesher/mesh_formats/mesh_statements.hpp"

namespace cbc3d {
namespace {

constexpr std::size_t kNoSet = ~std::size_t{0};

std::string upper(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c != ' ' && c != '\t') out += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return out;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::string_view field = line.substr(begin, end - begin);
    while (!field.empty() && (field.front() == ' ' || field.front() == '\t')) field.remove_prefix(1);
    while (!field.empty() && (field.back() == ' ' || field.back() == '\t')) field.remove_suffix(1);
    fields.push_back(field);
    begin = end + 1;
  }
  if (!fields.empty() && fields.back().empty()) fields.pop_back();  // a comma at the end
  return fields;
}

/// "*ELEMENT, TYPE=C3D4, ELSET=A": its keyword and parameters, in capitals without blanks, and as they are
/// written.
struct Keyword {
  std::string name;
  std::map<std::string, std::string> parameters, written;

  explicit Keyword(std::string_view line) {
    for (const std::string_view field : fields_of(line)) {
      const std::string word = upper(field);
      if (name.empty()) {
        name = word;
        continue;
      }
      const std::size_t equals = word.find('='), written_equals = field.find('=');
      const std::string parameter = word.substr(0, equals);
      parameters[parameter] = equals == std::string::npos ? "" : word.substr(equals + 1);
      written[parameter] = equals == std::string::npos ? "" : field.substr(written_equals + 1);
    }
  }
  [[nodiscard]] std::string get(const std::string& parameter) const {
    return value_in(parameters, parameter);
  }
  [[nodiscard]] std::string get_written(const std::string& parameter) const {
    return value_in(written, parameter);
  }

 private:
  static std::string value_in(const std::map<std::string, std::string>& values,
                              const std::string& parameter) {
    const auto found = values.find(parameter);
    return found == values.end() ? "" : found->second;
  }
};

/// The number at the end of a name.
std::optional<Label> number_at_end(const std::string& name) {
  constexpr std::size_t kMostDigits = 9;
  std::size_t digits = 0;
  while (digits < name.size() &&
         std::isdigit(static_cast<unsigned char>(name[name.size() - 1 - digits])) != 0) {
    ++digits;
  }
  if (digits == 0 || digits > kMostDigits) return std::nullopt;
  const Label number = std::stoi(name.substr(name.size() - digits));
  const bool minus = name.ends_with("LABEL_M" + name.substr(name.size() - digits));
  return minus ? -number : number;
}

/// A volume element before the sets are known.
struct Element {
  std::int64_t number;
  CellKind kind;
  std::array<std::int64_t, 8> nodes;
  std::size_t set;
};

class AbaqusReader {
 public:
  AbaqusReader(const std::filesystem::path& path, MeshFileOptions& stated)
      : file_(path), builder_([this](const std::string& what) { file_.fail(what); }), statements_(stated) {}

  Mesh read() {
    while (!file_.at_end()) read_line();
    require_whole_element();
    require_stated_counts();
    take_sets_of_elsets();
    const std::vector<Label> labels = labels_of_sets();
    for (std::size_t s = 0; s < labels.size(); ++s) {
      take_group_name(labels[s], written_names_.at(set_names_[s]), statements_.names);
    }
    for (const Element& element : elements_) {
      const std::size_t corners = row_of(element.kind).corners;
      builder_.add_cell(element.kind, std::span(element.nodes).first(corners),
                        element.set == kNoSet ? 1 : labels[element.set]);
    }
    return builder_.take();
  }

 private:
  /// Numbers of elements in a set of *ELSET.
  struct Range {
    std::size_t elset;
    std::int64_t first, last, step;
  };
  enum class Data { other, heading, nodes, elements, element_set };

  void read_line() {
    const std::string_view line = file_.line();
    if (line.starts_with("**")) return read_comment(line);
    require_end_of_line();
    if (line.starts_with('*')) return read_keyword(Keyword(line.substr(1)));
    if (line.find_first_not_of(" \t") == std::string_view::npos) return;
    switch (data_) {
      case Data::nodes:
        return read_node(fields_of(line));
      case Data::elements:
        return read_element(fields_of(line));
      case Data::element_set:
        return read_set_line(fields_of(line));
      case Data::heading:
        return read_heading(line);
      case Data::other:
        return;
    }
  }

  /// "CBC3D mesh, coordinates LPS, mm"
  void read_heading(std::string_view line) {
    constexpr std::string_view kBegin = "CBC3D mesh, ";
    if (line.starts_with(kBegin)) take_statement(line.substr(kBegin.size()), statements_);
  }

  /// Digits may be missing at the end of a file.
  void require_end_of_line() {
    if (data_ != Data::other && data_ != Data::heading && file_.at_end() && !file_.ends_a_line()) {
      file_.fail("its last line has no end; the file is truncated, or needs an end of line");
    }
  }

  /// "** NODES 8, ELEMENTS 5": what our writer says, for the format itself has no counts.
  void read_counts(std::string_view line) {
    const std::vector<std::string_view> fields = fields_of(line);
    constexpr std::string_view kNodes = "** NODES ", kElements = "ELEMENTS ";
    if (fields.size() != 2 || !fields[0].starts_with(kNodes) || !fields[1].starts_with(kElements)) return;
    stated_nodes_ = file_.integer_of(fields[0].substr(kNodes.size()), "comment on counts");
    stated_elements_ = file_.integer_of(fields[1].substr(kElements.size()), "comment on counts");
  }

  void require_stated_counts() const {
    const auto require = [this](std::optional<std::int64_t> stated, std::size_t found, const char* what) {
      if (stated && *stated > static_cast<std::int64_t>(found)) {
        file_.fail("it promises " + std::to_string(*stated) + what + " and has " + std::to_string(found) +
                   "; the file is truncated, export it again (or remove the comment ** NODES)");
      }
    };
    require(stated_nodes_, builder_.node_count(), " nodes");
    require(stated_elements_, elements_.size(), " volume elements");
  }

  /// "** LABEL 5 = liver"
  void read_comment(std::string_view line) {
    read_counts(line);
    take_statement(line.substr(2), statements_);
    constexpr std::string_view kBegin = "** LABEL ";
    const std::size_t equals = line.find(" = ");
    if (!line.starts_with(kBegin) || equals == std::string_view::npos || equals < kBegin.size()) return;
    const std::string number = upper(line.substr(kBegin.size(), equals - kBegin.size()));
    if (number.empty() || number.size() > 11 || number.find_first_not_of("-0123456789") != std::string::npos)
      return;
    stated_[upper(line.substr(equals + 3))] =
        static_cast<Label>(file_.integer_of(number, "comment on a label"));
  }

  void read_keyword(const Keyword& keyword) {
    require_whole_element();
    data_ = Data::other;
    written_names_.emplace(keyword.get("ELSET"), keyword.get_written("ELSET"));
    if (keyword.name == "NODE") {
      data_ = Data::nodes;
    } else if (keyword.name == "HEADING") {
      data_ = Data::heading;
    } else if (keyword.name == "ELEMENT") {
      begin_elements(keyword.get("TYPE"), keyword.get("ELSET"));
    } else if (keyword.name == "ELSET") {
      data_ = Data::element_set;
      generate_ = keyword.parameters.contains("GENERATE");
      elset_names_.push_back(keyword.get("ELSET"));
      set_of_elset_.push_back(kNoSet);
    } else if (keyword.name == "INCLUDE") {
      file_.fail("it includes another file; give one file with the whole mesh");
    }
  }

  /// C3D4 and what adds letters to it (C3D8R, C3D4H), of heat and acoustics too (DC3D4, AC3D4). Shells,
  /// trusses and so on are passed over.
  void begin_elements(const std::string& type, const std::string& set) {
    const std::size_t solid = type.find("C3D");
    if (solid == std::string::npos || solid > 1) return;
    const std::string digits =
        type.substr(solid + 3, type.find_first_not_of("0123456789", solid + 3) - solid - 3);
    for (std::size_t kind = 0; kind < kCellKinds.size(); ++kind) {
      if (digits == std::string(kCellKinds[kind].abaqus).substr(3)) {
        data_ = Data::elements;
        kind_ = static_cast<CellKind>(kind);
        set_ = set.empty() ? kNoSet : number_of_set(set);
        return;
      }
    }
    file_.fail("it has elements of type " + type.substr(0, 20) +
               "; known are C3D4, C3D5, C3D6 and C3D8, export linear elements");
  }

  std::size_t number_of_set(const std::string& name) {
    const auto found = std::find(set_names_.begin(), set_names_.end(), name);
    if (found == set_names_.end()) set_names_.push_back(name);
    return static_cast<std::size_t>(std::find(set_names_.begin(), set_names_.end(), name) -
                                    set_names_.begin());
  }

  void read_node(const std::vector<std::string_view>& fields) {
    if (fields.size() < 4) {
      file_.fail(
          "a node has no number and three coordinates; the file is truncated or damaged, export it again");
    }
    const std::int64_t number = file_.integer_of(fields[0], "nodes");
    builder_.add_node(number, {file_.real_of(fields[1], "nodes"), file_.real_of(fields[2], "nodes"),
                               file_.real_of(fields[3], "nodes")});
  }

  /// An element may go on in the next line.
  void read_element(const std::vector<std::string_view>& fields) {
    for (const std::string_view field : fields) pending_.push_back(file_.integer_of(field, "elements"));
    const std::size_t wanted = row_of(kind_).corners + std::size_t{1};
    if (pending_.size() > wanted) {
      file_.fail("an element has more nodes than its type; the file is damaged, export it again");
    }
    if (pending_.size() < wanted) return;
    Element element{pending_[0], kind_, {}, set_};
    std::copy(pending_.begin() + 1, pending_.end(), element.nodes.begin());
    elements_.push_back(element);
    pending_.clear();
  }

  void require_whole_element() {
    if (!pending_.empty()) file_.fail_at_end("elements");
  }

  void read_set_line(const std::vector<std::string_view>& fields) {
    if (generate_) {
      if (fields.size() < 2)
        file_.fail("a generated element set has no first and last number; export it again");
      const std::int64_t step = fields.size() > 2 ? file_.integer_of(fields[2], "element set") : 1;
      ranges_.push_back({elset_names_.size() - 1, file_.integer_of(fields[0], "element set"),
                         file_.integer_of(fields[1], "element set"), step});
      if (step < 1) file_.fail("a generated element set has a step below 1; export it again");
      return;
    }
    for (const std::string_view field : fields) {
      if (std::isdigit(static_cast<unsigned char>(field.empty() ? 'x' : field[0])) == 0)
        continue;  // another set's name
      const std::int64_t number = file_.integer_of(field, "element set");
      ranges_.push_back({elset_names_.size() - 1, number, number, 1});
    }
  }

  /// Sets of *ELSET count where *ELEMENT has none.
  void take_sets_of_elsets() {
    const auto has_set = [](const Element& element) { return element.set != kNoSet; };
    if (std::any_of(elements_.begin(), elements_.end(), has_set)) return;
    std::unordered_map<std::int64_t, Element*> by_number;
    for (Element& element : elements_) by_number[element.number] = &element;
    for (const Range& range : ranges_) {
      const std::uint64_t steps = steps_of(range);
      for (std::uint64_t n = 0; n <= steps; ++n) {
        const auto found = by_number.find(range.first + static_cast<std::int64_t>(n) * range.step);
        if (found != by_number.end()) put(*found->second, range.elset);
      }
    }
    require_sets_of_all();
  }
  [[nodiscard]] std::uint64_t steps_of(const Range& range) const {
    constexpr std::uint64_t kMost = 100000000;
    const std::uint64_t length =
        static_cast<std::uint64_t>(range.last) - static_cast<std::uint64_t>(range.first);
    const std::uint64_t steps = length / static_cast<std::uint64_t>(range.step);
    if (range.last < range.first || steps > kMost) {
      file_.fail("the element set " + elset_names_[range.elset].substr(0, 40) +
                 " has numbers beyond the elements; export it again");
    }
    return steps;
  }
  void put(Element& element, std::size_t elset) {
    if (set_of_elset_[elset] == kNoSet) set_of_elset_[elset] = number_of_set(elset_names_[elset]);
    const std::size_t set = set_of_elset_[elset];
    if (element.set != kNoSet && element.set != set) {
      file_.fail("the element " + std::to_string(element.number) + " is in the sets " +
                 set_names_[element.set].substr(0, 40) + " and " + set_names_[set].substr(0, 40) +
                 ", so that its label is unknown; name the labels' sets by ELSET= of *ELEMENT");
    }
    element.set = set;
  }
  void require_sets_of_all() {
    const auto is_out = [](const Element& element) { return element.set == kNoSet; };
    const auto out = std::find_if(elements_.begin(), elements_.end(), is_out);
    if (out != elements_.end() && !set_names_.empty()) {
      file_.fail("the element " + std::to_string(out->number) +
                 " is in no set, so that its label is unknown; put it into one");
    }
  }

  [[nodiscard]] std::vector<Label> labels_of_sets() const {
    std::vector<Label> numbers, places;
    bool stated = true;
    std::vector<Label> ends;
    std::set<Label> distinct;
    for (std::size_t s = 0; s < set_names_.size(); ++s) {
      const auto found = stated_.find(set_names_[s]);
      stated &= found != stated_.end();
      numbers.push_back(found == stated_.end() ? 0 : found->second);
      places.push_back(static_cast<Label>(s) + 1);
      if (const auto end = number_at_end(set_names_[s])) {
        ends.push_back(*end);
        distinct.insert(*end);
      }
    }
    if (stated) return numbers;
    return distinct.size() == set_names_.size() ? ends : places;
  }

  FileText file_;
  MeshBuilder builder_;
  Data data_ = Data::other;
  CellKind kind_ = CellKind::tet;
  std::size_t set_ = kNoSet;
  bool generate_ = false;
  std::vector<std::int64_t> pending_;  // numbers of an element that goes on
  std::vector<Element> elements_;
  std::vector<std::string> set_names_, elset_names_;
  std::vector<std::size_t> set_of_elset_;  // of every *ELSET, once an element is in it
  std::map<std::string, Label> stated_;
  std::map<std::string, std::string> written_names_;  // of sets, as they were first written
  MeshFileOptions& statements_;
  std::optional<std::int64_t> stated_nodes_, stated_elements_;
  std::vector<Range> ranges_;
};

}  // namespace

Mesh read_abaqus(const std::filesystem::path& path, const ReadMeshOptions& options, MeshFileOptions& stated) {
  if (!options.label_array.empty()) {
    throw InputError("cannot read '" + path.string() +
                     "': label_array: an Abaqus file has element sets alone; leave it out");
  }
  return AbaqusReader(path, stated).read();
}

Mesh read_abaqus(const std::filesystem::path& path, const ReadMeshOptions& options) {
  MeshFileOptions stated;
  return read_abaqus(path, options, stated);
}

}  // namespace cbc3d
