// FEBio's format, checked as XML by Python: Debian has no FEBio.
#include "mesher/mesh_formats/febio_writing.hpp"

#include <gtest/gtest.h>

#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/testing_meshes.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

/// Counts what stands in the sections that FEBio 4 reads, and checks that they refer to one another.
constexpr const char* kCheck = R"(
import sys, json, xml.etree.ElementTree as tree
root = tree.parse(sys.argv[1]).getroot()
assert root.tag == 'febio_spec' and root.get('version') == '4.0'
order = [section.tag for section in root]
assert order == ['Module', 'Material', 'Mesh', 'MeshDomains'], order
nodes = {n.get('id') for n in root.iter('node')}
materials = {m.get('name') for m in root.iter('material')}
parts, ids = {}, []
for part in root.find('Mesh').findall('Elements'):
    assert part.get('name') not in parts
    parts[part.get('name')] = [part.get('type'), len(part)]
    for e in part:
        ids.append(e.get('id'))
        assert set(e.text.split(',')) <= nodes
assert len(ids) == len(set(ids))
domains = {d.get('name'): d.get('mat') for d in root.find('MeshDomains')}
assert set(domains) == set(parts) and set(domains.values()) == materials
surfaces = {s.get('name'): {t: len(s.findall(t)) for t in ('tri3', 'quad4', 'tri6') if s.findall(t)} for s in root.iter('Surface')}
print(json.dumps({'nodes': len(nodes), 'parts': parts, 'domains': domains, 'surfaces': surfaces}))
)";

nlohmann::json checked(const FileMesh& mesh, const testing::TemporaryFolder& folder) {
  write_febio(mesh, folder.file("m.feb"), {});
  folder.write("check.py", kCheck);
  const auto outcome = testing::run_program("/usr/bin/python3 '" + folder.file("check.py").string() + "' '" +
                                            folder.file("m.feb").string() + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  return outcome.exit_code == 0 ? nlohmann::json::parse(outcome.text) : nlohmann::json();
}

TEST(FebioWriting, HasPartsDomainsAndSurfaces) {
  const testing::TemporaryFolder folder("febio");
  const Mesh mesh = testing::two_label_box(2);
  const nlohmann::json found = checked(FileMesh(mesh, {}), folder);
  EXPECT_EQ(found["nodes"], 27);
  EXPECT_EQ(found["parts"]["label_3"], (nlohmann::json{"tet4", 24}));
  EXPECT_EQ(found["domains"]["label_7"], "label_7");
  EXPECT_EQ(found["surfaces"]["label_3__label_7"]["tri3"], 8);
  EXPECT_EQ(found["surfaces"]["label_3__exterior"]["tri3"], 24);
}

TEST(FebioWriting, HasQuadraticAndMixedElements) {
  const testing::TemporaryFolder folder("febio");
  const QuadraticMesh quadratic = straight_quadratic_mesh(testing::two_label_box(2));
  nlohmann::json found = checked(FileMesh(quadratic, {}), folder);
  EXPECT_EQ(found["parts"]["label_3"], (nlohmann::json{"tet10", 24}));
  EXPECT_EQ(found["surfaces"]["label_3__label_7"]["tri6"], 8);
  Mesh mixed = testing::one_of_each();
  mixed.hexes.labels[0] = mixed.wedges.labels[0];
  found = checked(FileMesh(mixed, {}), folder);
  EXPECT_EQ(found["parts"]["label_5"], (nlohmann::json{"penta6", 1}));
  EXPECT_EQ(found["parts"]["label_5__hex8"], (nlohmann::json{"hex8", 1}));
  EXPECT_EQ(found["domains"]["label_5__hex8"], "label_5");
}

}  // namespace
}  // namespace cbc3d
