// Each kind of damaged, unusual or misleading file, by three or more files that are made here, through the
// command.
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "mesher/app/testing_command.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/formats/testing_dicom.hpp"
#include "mesher/formats/testing_headers.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

namespace fs = std::filesystem;
using formats::testing::put;
using testing::bytes_of;
using testing::run_command;
using Strings = std::vector<std::string>;

class FaultKinds : public testing::CommandTest {
 protected:
  [[nodiscard]] std::string write(const std::string& name, const std::string& bytes) const {
    temporary_.write(name, bytes);
    return at(name);
  }
  void expect_refused(const std::string& name, const std::string& bytes, const std::string& words) const {
    expect_refusal("info '" + write(name, bytes) + "'", words, "none");
  }
  [[nodiscard]] nlohmann::json info(const std::string& name, const std::string& bytes) const {
    const testing::Outcome outcome = run_command("info '" + write(name, bytes) + "' --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    return outcome.exit_code == 0 ? nlohmann::json::parse(outcome.text) : nlohmann::json();
  }
  static void expect_near(const nlohmann::json& triple, const Vec3& wanted, const std::string& what) {
    const Vec3 got{triple[0].get<double>(), triple[1].get<double>(), triple[2].get<double>()};
    EXPECT_LT((got - wanted).norm(), 1e-5) << what << ": " << got.x << ' ' << got.y << ' ' << got.z;
  }
  /// A file of a ball in every format that is written.
  [[nodiscard]] Strings balls() const {
    Strings names;
    for (const char* name : {"ball.nii", "ball.nii.gz", "ball.nrrd", "ball.mha"}) {
      write_label_image(testing::ball_image(14, 1, 5, 2), at(name));
      names.emplace_back(name);
    }
    return names;
  }
};

std::string nifti_with(const std::function<void(std::string&)>& change, bool big_endian = false) {
  std::string bytes = formats::testing::nifti(big_endian);
  change(bytes);
  return bytes;
}

std::string inrimage(const std::string& lines) {
  std::string header =
      "#INRIMAGE-4#{\n" + lines + "VDIM=1\nTYPE=unsigned fixed\nPIXSIZE=8 bits\nSCALE=2**0\nCPU=decm\n";
  header.resize(256 - 4, '\n');
  return header + "##}\n" + std::string(12, '\0') + std::string(12, '\1');
}

TEST_F(FaultKinds, CutFilesAreRefusedInEveryFormat) {
  for (const std::string& name : balls()) {
    const std::string whole = bytes_of(at(name));
    for (const double share : {0.3, 0.6, 0.97}) {
      const auto length = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
      expect_refused("cut-" + name, whole.substr(0, length), "cannot read");
    }
  }
}

TEST_F(FaultKinds, ChangedBytesOfCompressedVoxelsAreRefused) {
  static_cast<void>(balls());
  for (const char* name : {"ball.nii.gz", "ball.nrrd", "ball.mha"}) {
    const std::string whole = bytes_of(at(name));
    for (const std::size_t from_end : {6U, 14U, 25U, 40U, 60U}) {
      std::string changed = whole;
      changed[changed.size() - from_end] = static_cast<char>(changed[changed.size() - from_end] ^ 0x10);
      const std::string file = write(std::string("changed-") + name, changed);
      const auto outcome = run_command("info " + file);
      if (outcome.exit_code == 0) {  // a bit that pads the compressed data
        EXPECT_EQ(read_label_image(file).voxels, read_label_image(at(name)).voxels)
            << name << ' ' << from_end;
      } else {
        expect_refusal("info " + file, "cannot read", "none");
      }
    }
  }
}

TEST_F(FaultKinds, ThinLabelsStayInOnePiece) {
  const auto meshed = [&](const std::string& name, const std::function<int(const Vec3&)>& material,
                          const Index3& size = {20, 20, 14}) {
    write_label_image(testing::make_image(size, {1, 1, 1}, 1, material), at(name));
    const auto outcome = run_command("mesh " + at(name) + " --quiet --out " + at("o.vtu"));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.text.find("parts, tunnels"), std::string::npos) << name << ": " << outcome.text;
  };
  meshed("ring.nrrd", [](const Vec3& p) {
    const double far = std::max(std::fabs(p.x - 9), std::fabs(p.y - 9));
    return p.z == 6 && far == 6 ? 1 : 0;
  });
  meshed("corner.nrrd", [](const Vec3& p) {
    const bool inside = p.x > 3 && p.x < 15 && p.y > 3 && p.y < 15 && p.z > 2 && p.z < 12;
    return inside && (p.x == 4 || p.z == 3) ? 1 : 0;
  });
  meshed("stairs.nrrd", [](const Vec3& p) {
    const double n = p.x - 3;
    return n >= 0 && n <= 10 && p.z == 6 && (p.y == 3 + n || p.y == 4 + n) ? 1 : 0;
  });
  // A hundred wires, whose lattice has more tets for each boundary voxel than any organ's.
  const auto wires = [](const Vec3& p) { return std::fmod(p.x, 4) == 0 && std::fmod(p.y, 4) == 0 ? 1 : 0; };
  meshed("wires.nrrd", wires, {40, 40, 40});
}

TEST_F(FaultKinds, UnitsOfNiftiScaleSpacingAndOrigin) {
  for (const auto& [unit, mm] : {std::pair(1, 1000.0), std::pair(3, 1e-3), std::pair(2, 1.0)}) {
    const auto found =
        info("unit.nii", nifti_with([unit](std::string& b) { b[123] = static_cast<char>(unit); }));
    expect_near(found["spacing_mm"], Vec3{0.5, 1, 1.5} * mm, "spacing");
    expect_near(found["origin_mm"], Vec3{-10, -20, 30} * mm, "origin");
  }
}

TEST_F(FaultKinds, SpacesOfNrrdTurnTheRightAxes) {
  const std::string frame = "space directions: (1,0,0) (0,2,0) (0,0,3)\nspace origin: (5,6,7)\n";
  for (const auto& [space, origin] :
       {std::pair("left-anterior-superior", Vec3{5, -6, 7}), std::pair("LAS", Vec3{5, -6, 7}),
        std::pair("RAS", Vec3{-5, -6, 7}), std::pair("right-anterior-superior", Vec3{-5, -6, 7}),
        std::pair("LPS", Vec3{5, 6, 7})}) {
    const auto found =
        info("space.nrrd", formats::testing::nrrd("space: " + std::string(space) + "\n" + frame));
    expect_near(found["origin_mm"], origin, space);
  }
}

TEST_F(FaultKinds, TwoPlacesOrNoneAreToldOnce) {
  const auto warning = [&](const std::string& bytes) {
    const auto warnings = info("two.nii", bytes)["warnings"];
    EXPECT_EQ(warnings.size(), 1U) << warnings;
    return warnings.empty() ? "" : warnings[0].get<std::string>();
  };
  for (const float shift : {1.0F, 50.0F, -300.0F}) {
    EXPECT_NE(warning(nifti_with([shift](std::string& b) {
                put(b, 252, std::int16_t{1});
                put(b, 268, 10 + shift), put(b, 272, 20.0F), put(b, 276, 30.0F);
              })).find("mm apart"),
              std::string::npos);
  }
  for (const bool big_endian : {false, true}) {
    EXPECT_NE(warning(nifti_with([](std::string& b) { put(b, 254, std::int16_t{0}); }, big_endian))
                  .find("neither qform nor sform"),
              std::string::npos);
  }
  EXPECT_NE(warning(formats::testing::nrrd("spacings: 1 1 1\n")).find("no space directions"),
            std::string::npos);
}

TEST_F(FaultKinds, SlopesAreThoseOfTheStandard) {
  for (const auto& [slope, intercept, label] : {std::tuple(0.0F, 5.0F, 1), std::tuple(0.0F, -7.0F, 1),
                                                std::tuple(2.0F, 0.0F, 2), std::tuple(1.0F, 0.0F, 1)}) {
    const auto found =
        info("slope.nii",
             nifti_with([s = slope, i = intercept](std::string& b) { put(b, 112, s), put(b, 116, i); }));
    EXPECT_EQ(found["labels"][0]["label"], label) << slope;
  }
}

TEST_F(FaultKinds, FiguresOfHeadersThatAreNoneAreRefused) {
  const std::string size = "XDIM=2\nYDIM=3\nZDIM=4\n", spacing = "VX=1\nVY=1\nVZ=1\n";
  EXPECT_EQ(info("good.inr", inrimage(size + spacing))["labels"].size(), 1U);
  for (const auto& [lines, words] :
       {std::pair("XDIM=2\nYDIM=3\nZDIM=4\nVX=inf\nVY=1\nVZ=1\n", "VX 'inf'"),
        std::pair("XDIM=2.5\nYDIM=3\nZDIM=4\nVX=1\nVY=1\nVZ=1\n", "XDIM '2.5'"),
        std::pair("XDIM=-2\nYDIM=3\nZDIM=4\nVX=1\nVY=1\nVZ=1\n", "XDIM"),
        std::pair("XDIM=2\nYDIM=3\nZDIM=4\nVX=0\nVY=1\nVZ=1\n", "spacing"),
        std::pair("XDIM=2000000000\nYDIM=2000000000\nZDIM=2000000000\n", "counted"),
        std::pair("XDIM=0\nYDIM=3\nZDIM=4\nVX=1\nVY=1\nVZ=1\n", "XDIM")}) {
    expect_refused("bad.inr", inrimage(lines), words);
  }
  for (const char* number : {"nan", "inf", "-inf", "0", "1e-300", "1e300", "x"}) {
    expect_refused("bad.nrrd", formats::testing::nrrd("spacings: " + std::string(number) + " 1 1\n"),
                   "cannot read");
    expect_refused("bad.mha",
                   formats::testing::metaimage("ElementSpacing = " + std::string(number) + " 1 1\n"),
                   "cannot read");
  }
  for (const char* directions : {"(1,0,0) (1,0,0) (0,0,1)", "(0,0,0) (0,1,0) (0,0,1)",
                                 "(1e300,0,0) (0,1,0) (0,0,1)", "(nan,0,0) (0,1,0) (0,0,1)"}) {
    expect_refused("turned.nrrd",
                   formats::testing::nrrd("space: LPS\nspace directions: " + std::string(directions) + "\n"),
                   "cannot read");
  }
}

TEST_F(FaultKinds, HeadersThatHurtParsersAreRefused) {
  const std::string long_line(200000, 'x');
  expect_refused("long.nrrd", formats::testing::nrrd("space: " + long_line + "\n"), "cannot read");
  expect_refused("long.mha", formats::testing::metaimage("Comment = " + long_line + "\n"), "cannot read");
  expect_refused("long.inr", "#INRIMAGE-4#{\nXDIM=" + long_line, "cannot read");
  const std::string mhd =
      "ObjectType = Image\nNDims = 3\nDimSize = 2 3 4\nElementType = MET_UCHAR\nElementDataFile = ";
  for (const char* file :
       {"%s 1 4 1", "%n%n%n%n 0 9 1", "%99999999d 1 4 1", "LIST", ".", "/dev/zero", "a.mhd"}) {
    expect_refused("a.mhd", mhd + std::string(file) + "\n", "cannot read");
  }
  for (const char* count : {"-1", "0", "99", "3.5", "99999999999999999999"}) {
    expect_refused("dims.mha", "ObjectType = Image\nNDims = " + std::string(count) + "\nDimSize = 2 3 4\n",
                   "cannot read");
    expect_refused("dims.nrrd", "NRRD0004\ntype: uchar\ndimension: " + std::string(count) + "\n\n",
                   "cannot read");
  }
}

TEST_F(FaultKinds, FractionsAreShownAsTheyAreAndRoundedOnDemand) {
  const auto floats = [](float value) {
    return nifti_with([value](std::string& b) {
      put(b, 70, std::int16_t{16}), put(b, 72, std::int16_t{32});
      b.resize(352 + 96, '\0');
      std::fill(b.begin() + 352, b.end(), '\0');
      put(b, 400, value);
    });
  };
  for (const auto& [value, words] : {std::pair(1.0000001F, "1.0000001"), std::pair(2.99995F, "2.99995"),
                                     std::pair(0.5F, "0.5"), std::pair(-1.25F, "-1.25")}) {
    expect_refused("fraction.nii", floats(value), words);
    const bool is_near = std::fabs(value - std::nearbyint(value)) <= 1e-4F;
    EXPECT_EQ(run_command("info --round " + at("fraction.nii")).exit_code, is_near ? 0 : 2) << value;
  }
}

TEST_F(FaultKinds, WhatAFileIsIsSaidTruly) {
  const std::string ball = bytes_of(at(balls()[0]));
  const auto packed = [](const std::string& bytes) { return formats::testing::packed(bytes); };
  std::string tar(1024, '\0');
  tar.replace(0, 8, "ball.nii").replace(257, 5, "ustar");
  for (const auto& [bytes, words] : std::vector<std::pair<std::string, std::string>>{
           {packed(packed(ball)), "compressed twice"},
           {"\xFD"
            "7zXZ" +
                std::string(100, '\0'),
            "xz"},
           {"\x28\xB5\x2F\xFD" + std::string(100, '\0'), "Zstandard"},
           {packed(tar), "tar archive"},
           {"PK\x03\x04" + std::string(100, '\0'), "zip archive"},
           {"<!DOCTYPE html><html>404" + std::string(100, ' '), "web page"},
           {"solid surface\n" + std::string(100, ' '), "STL"},
           {ball.substr(0, 100), "within the header"},
           {formats::testing::nrrd("kinds: list domain domain\n"), ""}}) {
    const auto outcome = run_command("info '" + write("what.nii", bytes) + "'");
    EXPECT_NE(outcome.text.find(words), std::string::npos) << outcome.text;
  }
  expect_refused("lonely.img", std::string(500, '\1'), "lonely.hdr' is not there");
}

TEST_F(FaultKinds, DicomSegmentationsAreReadAndOtherObjectsNamed) {
  auto file = formats::testing::segmentation();
  const auto found = info("seg.dcm", file.bytes());
  EXPECT_EQ(found["format"], "DICOM SEG");
  EXPECT_EQ(found["size"], (nlohmann::json{3, 2, 4}));
  ASSERT_EQ(found["warnings"].size(), 1U);
  EXPECT_NE(found["warnings"][0].get<std::string>().find("several segments"), std::string::npos);
  for (const auto& [modality, words] :
       {std::pair("CT", "modality 'CT'"), std::pair("RTSTRUCT", "contours"), std::pair("SEG", "label map")}) {
    file.sop_class = "1.2.3", file.modality = modality;
    expect_refused("other.dcm", file.bytes(), words);
  }
}

TEST_F(FaultKinds, PipesDevicesAndNamesOfAnyBytes) {
  ASSERT_EQ(::mkfifo(at("pipe.nii").c_str(), 0600), 0);
  fs::create_symlink("loop.nii", at("loop.nii"));
  for (const auto& [name, words] :
       {std::pair(at("pipe.nii"), "pipe"), std::pair(std::string("/dev/zero"), "device"),
        std::pair(at("loop.nii"), "symbolic"), std::pair(at("."), "folder"),
        std::pair(std::string(), "does not exist"), std::pair(at("no.nii"), "not exist")}) {
    expect_refusal("mesh '" + name + "' --out " + at("o.vtu"), words, "o.vtu");
    expect_refusal("improve '" + name + "' --out " + at("o.vtu"), "", "o.vtu");
  }
  // Neither codes nor UTF-8: the warning that names the file has to reach the report.
  const std::string bytes = nifti_with([](std::string& b) { put(b, 254, std::int16_t{0}); });
  for (const char* name : {"caf\xE9.nii", "a 'b' \"c\" $HOME.nii", "two\nlines.nii"}) {
    temporary_.write(name, bytes);
    std::string quoted;
    for (const char c : at(name)) {
      quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    const auto outcome =
        run_command("clean '" + quoted + "' --quiet --out " + at("o.nrrd") + " --report " + at("r.json"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'),
              std::count(outcome.text.begin(), outcome.text.end(), ':') > 0 ? 1 : 0)
        << outcome.text;
    EXPECT_FALSE(nlohmann::json::parse(bytes_of(at("r.json"))).empty());
  }
}

TEST_F(FaultKinds, DamagedSlicesAreRefused) {
  const std::string png("\x89PNG\r\n\x1A\n", 8), no_chunk(50, '\0');
  const std::string bad_header = std::string("\0\0\0\x0DIHDR", 8) + std::string(17, '\x7F');
  for (const std::string& bytes :
       {png + no_chunk, png + bad_header, png, "BM" + std::string(100, '\x7F'), "BM" + no_chunk,
        "II*" + no_chunk, std::string("MM\0*\0\0\0\x08", 8) + std::string(40, '\xFF'),
        std::string("hello")}) {
    expect_refusal("tile " + write("slice", bytes) + " --spacing 1,1,1 --out " + at("o.nrrd"), "cannot read",
                   "o.nrrd");
  }
  for (const char* name : {"/dev/zero", "/dev/null", "."}) {
    expect_refusal("tile " + std::string(name) + " --spacing 1,1,1 --out " + at("o.nrrd"),
                   "folder, device or pipe", "o.nrrd");
  }
}

TEST_F(FaultKinds, GreyImagesAndNoiseAreRefused) {
  std::mt19937 random(7);
  const auto image_of = [](int size, int labels, const std::function<int(int, int, int)>& value) {
    LabelImage image;
    image.frame.size = {size, size, size};
    for (int label = 1; label < labels; ++label) {
      image.labels.push_back(label);
    }
    image.voxels.resize(image.frame.voxel_count());
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      const Index3 at = image.frame.index_of(v);
      image.voxels.set(v, static_cast<MaterialId>(value(at[0], at[1], at[2])));
    }
    return image;
  };
  const std::pair<const char*, LabelImage> images[] = {
      {"scan.nrrd", image_of(16, 250, [](int x, int y, int z) { return (x * 91 + y * 57 + z * 131) % 250; })},
      {"gradient.nrrd", image_of(24, 70, [](int x, int y, int z) { return x + y + z; })},
      {"chessboard.nrrd", image_of(40, 3, [](int x, int y, int z) { return 1 + (x + y + z) % 2; })},
      {"noise.nrrd", image_of(20, 3, [&](int, int, int) { return static_cast<int>(random() % 3); })},
      {"salt.nrrd", image_of(32, 2, [&](int, int, int) { return static_cast<int>(random() % 2); })}};
  for (const auto& [name, image] : images) {
    write_label_image(image, at(name));
    expect_refusal("mesh " + at(name) + " --out " + at("o.vtu"), "--many-labels takes it", "o.vtu");
  }
}

TEST_F(FaultKinds, MeshesInOtherFramesAreRefused) {
  LabelImage image = testing::make_image({16, 12, 10}, {1, 1.5, 2}, 2, [](const Vec3& p) {
    const double r = (p - Vec3{6, 7, 9}).norm();
    return r < 3.5 ? 2 : r < 6 ? 1 : 0;
  });
  image.frame.origin_mm = {40, -60, 100};
  write_label_image(image, at("a.nrrd"));
  ASSERT_EQ(run_command("mesh " + at("a.nrrd") + " --quiet --out " + at("a.vtu")).exit_code, 0);
  const Mesh mesh = read_mesh(at("a.vtu"));
  const std::pair<const char*, std::function<Vec3(const Vec3&)>> frames[] = {
      {"RAS",
       [](const Vec3& p) {
         return Vec3{-p.x, -p.y, p.z};
       }},
      {"do not lie together",
       [](const Vec3& p) {
         return p + Vec3{500, 0, 0};
       }},
      {"voxel",
       [](const Vec3& p) {
         return Vec3{p.x - 40, (p.y + 60) / 1.5, (p.z - 100) / 2};
       }},
      {"do not lie together", [](const Vec3& p) { return p * 1000.0; }}};
  for (const auto& [words, place] : frames) {
    Mesh moved = mesh;
    for (Vec3& p : moved.points) {
      p = place(p);
    }
    write_mesh(moved, at("moved.vtu"));
    for (const char* command : {"improve ", "deform "}) {
      expect_refusal(command + at("moved.vtu") + " " + at("a.nrrd") + " --out " + at("o.vtu"), words,
                     "o.vtu");
    }
  }
}

TEST_F(FaultKinds, MeshesWithFalseArraysAreRefused) {
  const auto vtu = [](const std::string& points, const std::string& ids, const std::string& offsets,
                      const std::string& types, const std::string& labels) {
    const auto array = [](const char* type, const std::string& name, const std::string& values) {
      return "<DataArray type=\"" + std::string(type) + "\" " + name + " format=\"ascii\">" + values +
             "</DataArray>";
    };
    return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
           "byte_order=\"LittleEndian\"><UnstructuredGrid><Piece "
           "NumberOfPoints=\"5\" NumberOfCells=\"2\"><CellData>" +
           array("Float64", "Name=\"label\"", labels) + "</CellData><Points>" +
           array("Float64", "NumberOfComponents=\"3\"", points) + "</Points><Cells>" +
           array("Int64", "Name=\"connectivity\"", ids) + array("Int64", "Name=\"offsets\"", offsets) +
           array("UInt8", "Name=\"types\"", types) + "</Cells></Piece></UnstructuredGrid></VTKFile>";
  };
  const std::string p = "0 0 0 4 0 0 0 4 0 0 0 4 4 4 4", c = "0 1 2 3 1 2 3 4", o = "4 8", t = "10 10",
                    l = "1 2";
  write_label_image(testing::ball_image(8, 1, 3), at("ball.nrrd"));
  for (const std::string& bytes :
       {vtu(p, c, o, t, "1 2.5"), vtu(p, c, o, t, "nan 1"), vtu(p, c, o, t, "1 1e12"), vtu(p, c, o, t, "1"),
        vtu("nan 0 0 4 0 0 0 4 0 0 0 4 4 4 4", c, o, t, l),
        vtu("0 0 0 4 0 0 0 4 0 0 0 1e999 4 4 4", c, o, t, l), vtu("0 0 0", c, o, t, l),
        vtu(p, "0 1 2 3 1 2 3 5", o, t, l), vtu(p, "0 1 2 3 1 2 3 -1", o, t, l),
        vtu(p, "0 1 2 3 1 2 3 99999999999", o, t, l), vtu(p, c, "8 4", t, l), vtu(p, c, "4 80", t, l),
        vtu(p, c, "-4 8", t, l), vtu(p, c, o, "12 10", l), vtu(p, c, o, "10 14", l)}) {
    const std::string file = write("bad.vtu", bytes);
    expect_refusal("improve " + file + " --out " + at("o.vtu"), "bad.vtu", "o.vtu");
    expect_refusal("deform " + file + " " + at("ball.nrrd") + " --out " + at("o.vtu"), "bad.vtu", "o.vtu");
  }
}

/// CPU seconds of the child processes so far.
double children_cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Small files that took minutes or half a minute once, and noise that is too small to be refused; each takes
// some seconds of CPU now.
TEST_F(FaultKinds, FewKilobytesTakeSecondsAlone) {
  constexpr double kMostCpuSeconds = 60;
  const auto random_nrrd = [](const std::string& sizes, int voxels, const std::string& spacings) {
    std::string bytes = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: " + sizes +
                        "\nencoding: raw\nspacings: " + spacings + "\n\n";
    for (int v = 0; v < voxels; ++v) {
      bytes += static_cast<char>(v * 7919 % 101 % 4);
    }
    return bytes;
  };
  write_label_image(testing::noise_image(12, 0.5, 3), at("noise.nrrd"));
  for (const std::string& file :
       {std::string(CBC3D_FAULTS) + "/slow-42.nrrd", write("a.nrrd", random_nrrd("3 6 7", 126, "900 1 1")),
        write("b.nrrd", random_nrrd("6 3 7", 126, "1 300 1")),
        write("c.nrrd", random_nrrd("7 7 7", 343, "1 1 50")), at("noise.nrrd")}) {
    const double before = children_cpu_seconds();
    const auto outcome = run_command("mesh " + file + " --threads 1 --quiet --out " + at("o.vtu"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LT(children_cpu_seconds() - before, kMostCpuSeconds) << file;
#else
    static_cast<void>(before);
    static_cast<void>(kMostCpuSeconds);
#endif
  }
}

/// Wires one voxel wide along the three axes, every six voxels.
LabelImage wire_grid(int size) {
  const auto on_plane = [](double x) { return static_cast<int>(x) % 6 == 0 ? 1 : 0; };
  return testing::make_image({size, size, size}, {1, 1, 1}, 1, [&](const Vec3& p) {
    return on_plane(p.x) + on_plane(p.y) + on_plane(p.z) >= 2 ? 1 : 0;
  });
}

// A kilobyte that would take minutes asks for consent; a larger file, or less work, does not.
TEST_F(FaultKinds, SmallFilesThatAskForMinutesAreRefused) {
  write_label_image(wire_grid(96), at("grid.nii.gz"));
  ASSERT_LT(std::filesystem::file_size(at("grid.nii.gz")), 16384U);
  const auto refused = run_command("mesh " + at("grid.nii.gz") + " --out " + at("o.vtu"));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.text.find("may take minutes of CPU"), std::string::npos) << refused.text;
  EXPECT_NE(refused.text.find("--long-work takes it"), std::string::npos) << refused.text;
  EXPECT_FALSE(std::filesystem::exists(at("o.vtu")));
  const auto paper =
      run_command("mesh " + at("grid.nii.gz") + " --quiet --preset paper --out " + at("o.vtu"));
  EXPECT_EQ(paper.exit_code, 0) << paper.text;
}

// A limit on the size of files stands for the disk: writing fails in the middle.
TEST_F(FaultKinds, AFullDiskLeavesNothingUnderTheName) {
  LabelImage image = testing::noise_image(40, 0.5, 3);
  write_label_image(image, at("noise.nrrd"));
  write_label_image(testing::ball_image(14, 1, 5, 2), at("ball.nrrd"));
  ASSERT_EQ(run_command("mesh " + at("ball.nrrd") + " --quiet --out " + at("ball.vtu")).exit_code, 0);
  const auto expect_failure = [&](const std::string& arguments, const std::string& output) {
    const std::string command = "sh -c \"trap '' XFSZ; ulimit -f 2; exec " CBC3D_COMMAND " " + arguments +
                                " --quiet --out " + at(output) + "\" > " + at("log") + " 2>&1";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 3) << arguments;
    const std::string said = bytes_of(at("log"));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_NE(said.find(output + "': "), std::string::npos) << said;
    EXPECT_NE(said.find("the limit of 1024 bytes that this process has for files"), std::string::npos)
        << said;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      EXPECT_EQ(entry.path().filename().string().find(output), std::string::npos) << entry.path();
    }
  };
  for (const char* mesh : {"full.vtu", "full.vtk", "full.msh"}) {
    expect_failure("mesh " + at("ball.nrrd"), mesh);
    expect_failure("improve " + at("ball.vtu"), mesh);
  }
  expect_failure("surface " + at("ball.vtu"), "full.obj");
  for (const char* volume : {"full.nii", "full.nii.gz", "full.nrrd", "full.mha"}) {
    expect_failure("clean " + at("noise.nrrd") + " --many-labels --relabel-noise none --no-manifold-voxels",
                   volume);
  }
}

// Without its standard streams a program's files would take their numbers, and its messages go into them.
TEST_F(FaultKinds, ClosedStandardStreamsChangeNoFile) {
  write_label_image(testing::ball_image(14, 1, 5, 2), at("ball.nrrd"));
  const auto mesh = [&](const std::string& name, const std::string& streams) {
    const std::string command =
        CBC3D_COMMAND " mesh " + at("ball.nrrd") + " --out " + at(name) + " " + streams;
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return bytes_of(at(name));
  };
  const std::string expected = mesh("a.vtu", "> " + at("log") + " 2>&1");
  EXPECT_EQ(mesh("b.vtu", "2>&-"), expected);
  EXPECT_EQ(mesh("c.vtu", "<&- >&- 2>&-"), expected);
}

}  // namespace
}  // namespace cbc3d
