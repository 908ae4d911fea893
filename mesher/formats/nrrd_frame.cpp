#include "mesher/formats/nrrd_frame.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesher/formats/header_text.hpp"
#include "mesher/formats/units.hpp"

namespace cbc3d::formats {
namespace {

using Vector = std::optional<std::vector<double>>;  // none for an axis outside space

const std::string* find(const NrrdFields& fields, const std::string& key) {
  const auto found = fields.find(key);
  return found == fields.end() ? nullptr : &found->second;
}

/// What a named space is: its number of coordinates and their signs in LPS.
struct Space {
  std::size_t dimension = 3;
  Triple signs{1, 1, 1};
  bool anatomical = true;
};

Space space_of_name(const std::string& text) {
  std::string name = lower_case(text);
  Space space;
  if (name.ends_with("-time")) {
    space.dimension = 4;
    name.resize(name.size() - 5);
  } else if (name == "rast" || name == "last" || name == "lpst") {
    space.dimension = 4;
    name.pop_back();
  }
  if (name == "right-anterior-superior" || name == "ras") {
    space.signs = {-1, -1, 1};
  } else if (name == "left-anterior-superior" || name == "las") {
    space.signs = {1, -1, 1};
  } else if (name == "scanner-xyz" || name == "3d-right-handed" || name == "3d-left-handed") {
    space.anatomical = false;
  } else if (name != "left-posterior-superior" && name != "lps") {
    throw FormatError(
        "its space is " + in_quotes(text) +
        "; known are right-anterior-superior, left-anterior-superior, left-posterior-superior (RAS, "
        "LAS, LPS), scanner-xyz, 3D-right-handed, 3D-left-handed");
  }
  return space;
}

std::optional<Space> space_of(const NrrdFields& fields, ImageHeader& image) {
  const std::string* const name = find(fields, "space");
  const std::string* const dimension = find(fields, "spacedimension");
  if (name == nullptr && dimension == nullptr) {
    return std::nullopt;
  }
  if (name != nullptr && dimension != nullptr) {
    throw FormatError("its header has both 'space' and 'space dimension'; repair its header");
  }
  Space space;
  if (name != nullptr) {
    space = space_of_name(*name);
  } else {
    const std::int64_t count = integers_of("space dimension", *dimension, 1)[0];
    if (count != 3 && count != 4) {
      throw FormatError("its space dimension is " + *dimension +
                        "; give an image in a space of 3 dimensions");
    }
    space.dimension = static_cast<std::size_t>(count);
    space.anatomical = false;
  }
  if (!space.anatomical) {
    image.warnings.push_back("its space " +
                             (name != nullptr ? in_quotes(*name) : std::string("without a name")) +
                             " says nothing of left and right; it is taken as left-posterior-superior");
  }
  return space;
}

/// The numbers of "(a,b,c)". Throws FormatError.
std::vector<double> vector_of(const std::string& key, std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string& word : words_of(text, ", \t()")) {
    const auto number = to_number(word);
    if (!number) {
      throw FormatError("its header has " + key + " " + in_quotes(text) +
                        ", which is no vector; repair its header");
    }
    numbers.push_back(*number);
  }
  if (numbers.size() != count) {
    throw FormatError("its header has " + key + " " + in_quotes(text) + ", which has " +
                      std::to_string(numbers.size()) + " numbers and not " + std::to_string(count) +
                      "; repair its header");
  }
  return numbers;
}

/// The vectors of all axes, in the order of the axes: "(a,b,c)" or "none".
std::vector<Vector> directions_of(const std::string& text, std::size_t axes, std::size_t dimension) {
  std::vector<Vector> directions;
  std::string_view rest = trimmed(text);
  while (!rest.empty()) {
    const bool vector = rest.starts_with('(');
    const std::size_t end = vector ? rest.find(')') : std::min(rest.find_first_of(" \t("), rest.size());
    if (end == std::string_view::npos) {
      throw FormatError("its space directions " + in_quotes(rest) + " do not end; repair its header");
    }
    const std::string_view word = rest.substr(0, vector ? end + 1 : end);
    if (!vector && lower_case(word) != "none") {
      throw FormatError("its space directions have " + in_quotes(word) +
                        ", which is no vector; repair its header");
    }
    directions.push_back(vector ? Vector(vector_of("space directions", word, dimension)) : std::nullopt);
    rest = trimmed(rest.substr(word.size()));
  }
  if (directions.size() != axes) {
    throw FormatError("its space directions are " + std::to_string(directions.size()) + ", but it has " +
                      std::to_string(axes) + " axes; repair its header");
  }
  return directions;
}

/// Words in quotes: "mm" "mm" "mm".
std::vector<std::string> quoted_words(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = text.find('"'); at != std::string::npos;) {
    const std::size_t end = text.find('"', at + 1);
    if (end == std::string::npos) {
      break;
    }
    words.push_back(text.substr(at + 1, end - at - 1));
    at = text.find('"', end + 1);
  }
  return words.empty() ? words_of(text) : words;
}

/// Millimetres of each unit of a field; 1 where there is none.
std::vector<double> units_mm(const std::string* text, std::size_t count, ImageHeader& image) {
  std::vector<double> mm(count, 1);
  const std::vector<std::string> words = text == nullptr ? std::vector<std::string>{} : quoted_words(*text);
  if (text != nullptr && words.size() != count) {
    throw FormatError("its header has units " + in_quotes(*text) + ", which are " +
                      std::to_string(words.size()) + " and not " + std::to_string(count) +
                      "; repair its header");
  }
  for (std::size_t n = 0; n < words.size(); ++n) {
    const std::string word = lower_case(words[n]);
    const auto length = millimetres_of(word);
    if (!length && !word.empty() && word != "none" && word != "???" && n < 3) {
      image.warnings.push_back("its unit " + in_quotes(words[n]) +
                               " is no length that is known; mm are taken");
    }
    mm[n] = length.value_or(1);
  }
  return mm;
}

/// Another axis than those of space: volumes, or layers of segments, where it is the first or the last one.
void take_volumes(std::size_t axis, const std::vector<std::int64_t>& sizes, ImageHeader& image) {
  if (image.volumes > 1 || (axis > 0 && axis + 1 < sizes.size())) {
    throw FormatError("it is " + std::to_string(sizes.size()) + "-dimensional with " +
                      std::to_string(sizes[axis]) +
                      " values along an axis between others; give one 3-D volume of it");
  }
  image.volumes = static_cast<std::size_t>(sizes[axis]);
  image.volumes_interleaved = axis == 0;
}

/// The numbers of the three axes of space; of the others one may have several samples, which are volumes.
std::array<std::size_t, 3> space_axes(const std::vector<bool>& in_space,
                                      const std::vector<std::int64_t>& sizes, const NrrdFields& fields,
                                      ImageHeader& image) {
  std::array<std::size_t, 3> axes{};
  std::size_t count = 0;
  const auto kinds = words_of(find(fields, "kinds") != nullptr ? *find(fields, "kinds") : "");
  for (std::size_t axis = 0; axis < sizes.size(); ++axis) {
    if (in_space[axis] && (count < 3 || sizes[axis] > 1)) {
      if (count == 3) {
        take_volumes(axis, sizes, image);
      } else {
        axes[count++] = axis;
      }
    } else if (sizes[axis] > 1) {
      const std::string kind = axis < kinds.size() ? lower_case(kinds[axis]) : "";
      if (kind != "list" && kind != "time" && !kind.empty() && kind != "none" && kind != "???") {
        throw FormatError("it has " + std::to_string(sizes[axis]) +
                          " components per voxel (a colour or vector image, kind " + kind +
                          "); give a label image with one value per voxel");
      }
      take_volumes(axis, sizes, image);
    }
  }
  if (count < 3) {
    throw FormatError("only " + std::to_string(count) + " of its axes lie in space; give a 3-D image");
  }
  return axes;
}

/// Which axes are of space where no directions say it: those whose kind is none of a component's.
std::vector<bool> domain_axes(const NrrdFields& fields, std::size_t count) {
  std::vector<bool> domain(count, true);
  const std::string* const text = find(fields, "kinds");
  const auto kinds = words_of(text != nullptr ? *text : "");
  if (text != nullptr && kinds.size() != count) {
    throw FormatError("its kinds are " + std::to_string(kinds.size()) + ", but it has " +
                      std::to_string(count) + " axes; repair its header");
  }
  for (std::size_t axis = 0; axis < kinds.size(); ++axis) {
    const std::string kind = lower_case(kinds[axis]);
    domain[axis] = kind == "domain" || kind == "space" || kind == "time" || kind == "none" || kind == "???";
  }
  return domain;
}

void take_directions(const NrrdFields& fields, const std::string& text, const Space& space,
                     const std::vector<std::int64_t>& sizes, ImageHeader& image) {
  const auto directions = directions_of(text, sizes.size(), space.dimension);
  std::vector<bool> in_space;
  for (std::size_t axis = 0; axis < directions.size(); ++axis) {
    const Vector& v = directions[axis];
    const bool time = v && space.dimension == 4 && (*v)[0] == 0 && (*v)[1] == 0 && (*v)[2] == 0;
    in_space.push_back(v.has_value() && !(time && sizes[axis] == 1));
  }
  const auto mm = units_mm(find(fields, "spaceunits"), space.dimension, image);
  const auto axes = space_axes(in_space, sizes, fields, image);
  std::array<Triple, 3> steps{};
  for (std::size_t n = 0; n < 3; ++n) {
    image.size[n] = static_cast<std::size_t>(sizes[axes[n]]);
    const Vector& direction = directions[axes[n]];
    for (std::size_t row = 0; direction && row < 3; ++row) {
      steps[n][row] = (*direction)[row] * space.signs[row] * mm[row];
    }
  }
  set_steps(image, steps, "space directions");
  const std::string* const origin = find(fields, "spaceorigin");
  if (origin == nullptr) {
    image.warnings.emplace_back("its header has no space origin: its first voxel is taken at 0");
    return;
  }
  const auto at = vector_of("space origin", *origin, space.dimension);
  for (std::size_t row = 0; row < 3; ++row) {
    image.origin_mm[row] = at[row] * space.signs[row] * mm[row];
  }
}

/// A figure of every axis, "nan" where an axis has none.
std::vector<double> per_axis(const NrrdFields& fields, const std::string& key, std::size_t count) {
  std::vector<double> numbers(count, std::nan(""));
  if (const std::string* const text = find(fields, key)) {
    const auto words = words_of(*text);
    for (std::size_t n = 0; n < words.size(); ++n) {
      const auto number = to_number(words[n]);
      if (!number || words.size() != count) {
        throw FormatError("its header has " + key + " " + in_quotes(*text) + ", which are not " +
                          std::to_string(count) + " numbers; repair its header");
      }
      numbers[n] = *number;
    }
  }
  return numbers;
}

/// Spacings and the places where axes begin and end, without directions.
struct PlainAxes {
  std::vector<double> spacings, mins, maxs, mm;
  std::vector<bool> on_nodes;  ///< samples at both ends of the axis, not in the middle of cells
};

PlainAxes plain_axes(const NrrdFields& fields, std::size_t count, ImageHeader& image) {
  PlainAxes axes{per_axis(fields, "spacings", count), per_axis(fields, "axismins", count),
                 per_axis(fields, "axismaxs", count), units_mm(find(fields, "units"), count, image),
                 std::vector<bool>(count, false)};
  const auto centerings = words_of(find(fields, "centerings") != nullptr ? *find(fields, "centerings") : "");
  for (std::size_t n = 0; n < std::min(count, centerings.size()); ++n) {
    axes.on_nodes[n] = lower_case(centerings[n]) == "node";
  }
  return axes;
}

double spacing_of(const PlainAxes& axes, std::size_t axis, std::size_t size, bool given) {
  if (given) {
    return axes.spacings[axis];
  }
  const double cells = static_cast<double>(size) - (axes.on_nodes[axis] ? 1 : 0);
  const double spacing = (axes.maxs[axis] - axes.mins[axis]) / cells;
  return std::isfinite(spacing) && spacing != 0 ? spacing : std::nan("");
}

void take_spacings(const NrrdFields& fields, const std::vector<std::int64_t>& sizes, ImageHeader& image) {
  const auto chosen = space_axes(domain_axes(fields, sizes.size()), sizes, fields, image);
  const PlainAxes axes = plain_axes(fields, sizes.size(), image);
  const bool given = find(fields, "spacings") != nullptr;
  const bool extent = find(fields, "axismins") != nullptr && find(fields, "axismaxs") != nullptr;
  if (!given && !extent) {
    image.warnings.emplace_back("its header gives no spacing: 1 mm is taken");
  }
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t axis = chosen[n];
    image.size[n] = static_cast<std::size_t>(sizes[axis]);
    const double spacing = given || extent ? spacing_of(axes, axis, image.size[n], given) : 1;
    const double least = axes.mins[axis] + (axes.on_nodes[axis] ? 0 : spacing / 2);
    image.spacing_mm[n] = std::fabs(spacing) * axes.mm[axis];
    image.axes[n][n] = spacing < 0 ? -1 : 1;
    image.origin_mm[n] = std::isnan(axes.mins[axis]) ? 0 : least * axes.mm[axis];
  }
  image.warnings.emplace_back(
      "its header has no space directions: its axes are taken towards left, posterior, superior");
}

}  // namespace

void take_nrrd_frame(const NrrdFields& fields, const std::vector<std::int64_t>& sizes, ImageHeader& image) {
  const auto space = space_of(fields, image);
  const std::string* const directions = find(fields, "spacedirections");
  if (directions != nullptr) {
    if (!space) {
      throw FormatError("its header has space directions but no 'space'; repair its header");
    }
    return take_directions(fields, *directions, *space, sizes, image);
  }
  take_spacings(fields, sizes, image);
  const std::string* const origin = find(fields, "spaceorigin");
  if (space && origin != nullptr) {
    const auto at = vector_of("space origin", *origin, space->dimension);
    for (std::size_t row = 0; row < 3; ++row) {
      image.origin_mm[row] = at[row] * space->signs[row];
    }
  }
}

}  // namespace cbc3d::formats
