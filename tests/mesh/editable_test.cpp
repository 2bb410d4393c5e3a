#include "mesh/editable.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "../base/testing.hpp"
#include "image/atomic_file.hpp"
#include "mesh/gltf.hpp"
#include "mesh/io.hpp"
#include "mesh/obj.hpp"
#include "mesh/ply.hpp"

namespace wold {
namespace {

using testing_base::error_of;
using testing_base::expect_contains;

void expect_near(const DVec3& a, const DVec3& b, double tolerance = 1e-6) {
  EXPECT_LT(glm::length(a - b), tolerance)
      << a.x << " " << a.y << " " << a.z << " for " << b.x << " " << b.y << " " << b.z;
}

/// Two quads side by side with all that OBJ files have, Windows' line ends in one place.
const std::string obj_quads =
    "# Blender\nmtllib hill.mtl\no Hill\n"
    "v 0.000000 0.000000 1.500000 0.1 0.2 0.3\nv 1 0 1e0\nv 1 1 1.0\r\nv  0 1\t1 # corner\n"
    "v 2 0 1 \\\n  1.0\nv 2 1 1\nvp 0.5\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0.0000 0.0000 1.0000\n"
    "g left\nusemtl grass\ns off\nf 1/1/1 2/2/1 3/3/1 4/4/1\n"
    "g right\nf -5/1/-1 -2/2/-1 -1/3/-1 3/4/1\nl 1 2 3\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(EditableMesh, UnchangedFilesAreTheSameBytes) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.3F}};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  const std::vector<std::pair<std::string, std::string>> files{{"a.obj", obj_quads},
                                                               {"b.obj", obj_text(mesh)},
                                                               {"a.ply", ply_bytes(mesh)},
                                                               {"a.glb", glb_bytes(mesh)}};
  for (const auto& [name, bytes] : files)
    for (const UpAxis up : {UpAxis::z, UpAxis::y})
      EXPECT_EQ(EditableMesh::parse(bytes, name, up).bytes(), bytes) << name;
}

TEST(EditableMesh, OnlyTheNumbersOfMovedVerticesChangeInObj) {
  EditableMesh mesh =
      EditableMesh::parse(replaced(replaced(obj_quads, "/1 2/2/1 3/3/1 4/4/1", " 2/2 3/3 4/4"),
                                   "/-1 -2/2/-1 -1/3/-1 3/4/1", " -2/2 -1/3 3/4"),
                          "a.obj");
  ASSERT_EQ(mesh.positions().size(), 6U);
  EXPECT_EQ(mesh.positions()[0], DVec3(0, 0, 1.5));
  EXPECT_EQ(mesh.triangles().size(), 4U);  // two quads
  EXPECT_EQ(mesh.triangles()[3], UVec3(1, 5, 2));
  const std::string before = mesh.bytes();
  mesh.positions()[0].z = 1.25;
  mesh.positions()[3].z = 0.1;
  EXPECT_EQ(mesh.bytes(), replaced(replaced(before, "1.500000 0.1 0.2 0.3", "1.25 0.1 0.2 0.3"),
                                   "v  0 1\t1 # corner", "v  0 1\t0.1 # corner"));
}

TEST(EditableMesh, YUpObjMovesItsSecondNumber) {
  EditableMesh mesh =
      EditableMesh::parse("v 0 5 0\nv 1 5 0\nv 0 5 -1\nf 1 2 3\n", "a.obj", UpAxis::y);
  EXPECT_EQ(mesh.positions()[2], DVec3(0, 1, 5));
  mesh.positions()[2].z += 2;
  EXPECT_EQ(mesh.bytes(), "v 0 5 0\nv 1 5 0\nv 0 7 -1\nf 1 2 3\n");
}

TEST(EditableMesh, ASharedNormalOfObjBecomesSeveralWherePlacesDiffer) {
  EditableMesh mesh = EditableMesh::parse(obj_quads, "a.obj");
  mesh.positions()[0].z = 1;
  mesh.positions()[4].z = 2;  // the right quad rises eastwards at one corner
  const std::string text = mesh.bytes();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n') -
                std::count(obj_quads.begin(), obj_quads.end(), '\n'),
            3);  // the middle's two points, and the two in the east, differ from what stays flat
  expect_contains(text, "f 1/1/1 2/2/");
  const TriangleMesh read = parse_obj(text, "a.obj");
  ASSERT_EQ(read.normals.size(), read.positions.size());
  for (std::size_t k = 0; k < read.positions.size(); ++k) {
    EXPECT_NEAR(glm::length(read.normals[k]), 1, 1e-5F);
    if (read.positions[k].x == 0) {
      EXPECT_EQ(read.normals[k], Vec3(0, 0, 1));
    }
    if (read.positions[k] == Vec3(2, 0, 2))
      expect_near(read.normals[k], DVec3(-1, 1, 1) / std::sqrt(3.0), 1e-5);
  }
  for (const char* kept : {"mtllib hill.mtl", "g left\nusemtl grass\ns off\n", "l 1 2 3", "vp 0.5"})
    expect_contains(text, kept);
}

TEST(EditableMesh, EdgesOfObjStayEdges) {
  // A roof with two flat sides: each has one normal for its four corners.
  EditableMesh mesh = EditableMesh::parse(
      "v 0 0 0\nv 1 0 1\nv 1 1 1\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvn -0.7071 0 0.7071\n"
      "vn 0.7071 0 0.7071\nf 1//1 2//1 3//1 4//1\nf 2//2 5//2 6//2 3//2\n",
      "roof.obj");
  mesh.positions()[1].z = mesh.positions()[2].z = 2;
  expect_contains(mesh.bytes(),
                  "v 2 1 0\nvn -0.894427 0.000000 0.447214\nvn 0.894427 0.000000 0.447214\n"
                  "f 1//1 2//1 3//1 4//1\nf 2//2 5//2 6//2 3//2\n");
}

std::string reversed(std::string bytes) {
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}
template <class T>
std::string big(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return reversed(bytes);
}

TEST(EditableMesh, PlyWithOtherPropertiesKeepsThem) {
  const std::string header =
      "ply\nformat binary_big_endian 1.0\ncomment scanned\nobj_info x\nelement vertex 4\n"
      "property uchar red\nproperty double x\nproperty float y\nproperty list uchar short tags\n"
      "property float z\nproperty float quality\nelement face 1\nproperty float area\n"
      "property list uchar int vertex_indices\nelement other 1\nproperty double d\nend_header\n";
  const auto file = [&](const std::array<float, 4>& z) {
    std::string bytes = header;
    for (int k = 0; k < 4; ++k)
      bytes += big(static_cast<std::uint8_t>(200 + k)) + big(k == 1 || k == 2 ? 1e6 : 0.0) +
               big(k >= 2 ? 1.0F : 0.0F) + big(std::uint8_t{1}) + big(std::int16_t{7}) +
               big(z[static_cast<std::size_t>(k)]) + big(0.5F);
    bytes += big(1.5F) + big(std::uint8_t{4});
    for (int k = 0; k < 4; ++k) bytes += big(k);
    return bytes + big(3.25) + "tail";
  };
  const std::string before = file({0, 0.1F, 0.2F, 0.3F});
  EditableMesh mesh = EditableMesh::parse(before, "a.ply");
  EXPECT_EQ(mesh.positions()[2], DVec3(1e6, 1, double{0.2F}));
  EXPECT_EQ(mesh.triangles().size(), 2U);
  EXPECT_EQ(mesh.bytes(), before);
  mesh.positions()[2].z = 8.5;
  EXPECT_EQ(mesh.bytes(), file({0, 0.1F, 8.5F, 0.3F}));
}

TEST(EditableMesh, PlyTextKeepsItsLayoutAndTurnsItsNormals) {
  const std::string text =
      "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\nproperty float y\r\n"
      "property float z\r\nproperty float nx\r\nproperty float ny\r\nproperty float nz\r\n"
      "property uchar red\r\nelement face 1\r\nproperty list uchar int vertex_index\r\n"
      "end_header\r\n0.0 0.00 0 0 0 1 9\r\n1 0 0 0 0 1 9\r\n1 1 0 0 0 1 9\r\n5 5 5 1 0 0 9\r\n"
      "3  0 1 2\r\n";
  EditableMesh mesh = EditableMesh::parse(text, "a.ply");
  mesh.positions()[1].z = 1;
  EXPECT_EQ(mesh.bytes(), replaced(text, "0.0 0.00 0 0 0 1 9\r\n1 0 0 0 0 1 9\r\n1 1 0 0 0 1 9",
                                   "0.0 0.00 0 -0.577350259 0.577350259 0.577350259 9\r\n"
                                   "1 0 1 -0.577350259 0.577350259 0.577350259 9\r\n"
                                   "1 1 0 -0.577350259 0.577350259 0.577350259 9"));
}

/// One mesh in two nodes: one moved and turned, one scaled and mirrored. Extras that no reader
/// knows. The mesh is an upward triangle with normals.
std::string two_nodes() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh.triangles = {{0, 1, 2}};
  mesh.parts = {{"rock", 0, 1}};
  const std::string glb = glb_bytes(mesh);
  std::uint32_t json_size = 0;
  std::memcpy(&json_size, glb.data() + 12, 4);
  std::string json = glb.substr(20, json_size);
  const auto nodes = json.find("\"nodes\":[{");
  EXPECT_NE(nodes, std::string::npos);
  const auto end = json.find(']', nodes);
  json.replace(nodes, end - nodes + 1,
               R"("nodes":[{"mesh":0,"translation":[10,20,30],"rotation":[0,0.70710678118654752,0,)"
               R"(0.70710678118654752]},{"mesh":0,"scale":[-2,4,2],"extras":{"who":"keep"}}])");
  json = replaced(json, "\"scenes\":[{\"nodes\":[0]}]", "\"scenes\":[{\"nodes\":[0,1]}]");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string out = "glTF";
  const auto add = [&](std::uint32_t value) {
    std::string word(4, '\0');
    std::memcpy(word.data(), &value, 4);
    out += word;
  };
  add(2);
  add(static_cast<std::uint32_t>(glb.size() - json_size + json.size()));
  add(static_cast<std::uint32_t>(json.size()));
  out += glb.substr(16, 4) + json + glb.substr(20 + json_size);
  return out;
}

TEST(EditableMesh, NodesOfGlbMoveAtTheirOwnPlaces) {
  EditableMesh mesh = EditableMesh::parse(two_nodes(), "a.glb");
  ASSERT_EQ(mesh.positions().size(), 6U);
  ASSERT_EQ(mesh.triangles().size(), 2U);
  EXPECT_EQ(mesh.bytes(), two_nodes());
  // Of the file's (x, y up, z): a quarter turn about y, then moved; Z up.
  expect_near(mesh.positions()[0], {10, -30, 20});
  expect_near(mesh.positions()[1], {10, -29, 20});
  expect_near(mesh.positions()[4], {-2, 0, 0});
  mesh.positions()[1].z += 3;
  mesh.positions()[4].z += 4;
  const std::string bytes = mesh.bytes();
  const EditableMesh again = EditableMesh::parse(bytes, "a.glb");
  ASSERT_EQ(again.positions().size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) expect_near(again.positions()[k], mesh.positions()[k]);
  expect_contains(bytes, "\"who\":\"keep\"");
  const TriangleMesh read = parse_gltf(bytes, "a.glb");
  ASSERT_EQ(read.normals.size(), 6U);
  EXPECT_EQ(read.uvs.size(), 6U);
  EXPECT_EQ(read.parts.front().material, "rock");
  for (std::size_t k = 0; k < 2; ++k) {  // upwards, at a right angle to the face
    const UVec3 t = read.triangles[k];
    const Vec3 normal = read.normals[t.x];
    EXPECT_GT(normal.z, 0.1F);
    EXPECT_NEAR(glm::dot(normal, read.positions[t.y] - read.positions[t.x]), 0, 1e-5F);
    EXPECT_NEAR(glm::dot(normal, read.positions[t.z] - read.positions[t.x]), 0, 1e-5F);
  }
  // The bounds are those of the values, in the nodes' own axes: the first rose by 3.
  expect_contains(bytes, "\"max\":[1.0,3.0,");
}

TEST(EditableMesh, GltfTextTakesItsBuffersIn) {
  const testing_base::TemporaryFolder folder;
  const std::string path = folder.file("a.gltf");
  const std::array<float, 9> xyz{1, 0, 0, 0, 1, 0, 0, 0, 1};
  write_file(folder.file("a.bin"), {reinterpret_cast<const char*>(xyz.data()), sizeof(xyz)});
  write_file(path, R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"a.bin"}]})");
  EditableMesh mesh = EditableMesh::read(path);
  expect_near(mesh.positions()[2], {0, -1, 0});
  mesh.positions()[2].z = 5;
  mesh.write(folder.file("b.gltf"));
  std::filesystem::remove(folder.file("a.bin"));
  expect_near(EditableMesh::read(folder.file("b.gltf")).positions()[2], {0, -1, 5});
}

TEST(EditableMesh, OtherFormatsGoThroughTriangles) {
  const testing_base::TemporaryFolder folder;
  EditableMesh mesh =
      EditableMesh::parse("v 0 5 0\nv 1 5 0\nv 0 5 -1\nusemtl a\nf 1 2 3\n", "a.obj", UpAxis::y);
  mesh.positions()[2].z = 6;
  for (const char* name : {"a.ply", "a.glb"}) {
    mesh.write(folder.file(name));
    const TriangleMesh read = read_mesh(folder.file(name));
    EXPECT_EQ(read.positions.at(2), Vec3(0, 1, 6)) << name;
    EXPECT_EQ(read.parts.at(0).material, "a");
  }
  expect_contains(error_of([&] { mesh.write(folder.file("a.stl")); }, ErrorKind::usage),
                  "known are .obj");
}

TEST(EditableMesh, ErrorsAreClear) {
  const auto message = [](const std::string& bytes, const std::string& name) {
    return error_of([&] { EditableMesh::parse(bytes, name); });
  };
  EXPECT_EQ(message("v 0 0 0\nv 1 nan 0\n", "x.obj"),
            "'x.obj': the position of vertex 1 (counted from 0) is not finite: (1, nan, 0)");
  expect_contains(message("v 0 0\n", "x.obj"), "x.obj:1: 3 numbers are expected here, found 2");
  expect_contains(message("v 0 0 0\nf 1 2 1\n", "x.obj"), "x.obj:2: '2' refers to number 2");
  expect_contains(message("ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\n"
                          "property float y\nproperty float z\nend_header\n0 0 0\n",
                          "x.ply"),
                  "the vertices' x is a whole number");
  expect_contains(message("none", "x.glb"), "x.glb' is no sound glTF file");
  expect_contains(error_of([&] { EditableMesh::parse("", "x.fbx"); }, ErrorKind::usage),
                  "unknown extension '.fbx'");
  EditableMesh mesh = EditableMesh::parse("v 0 0 0\n", "x.obj");
  mesh.positions()[0].z = std::numeric_limits<double>::infinity();
  expect_contains(error_of([&] { mesh.bytes(); }), "vertex 0 (counted from 0) is not finite");
  expect_contains(error_of([&] { EditableMesh::read("no such.obj"); }, ErrorKind::io), "no such");
}

}  // namespace
}  // namespace wold
