#include "mesh/io.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "../base/testing.hpp"
#include "image/atomic_file.hpp"
#include "mesh/gltf.hpp"
#include "mesh/obj.hpp"
#include "mesh/ply.hpp"

namespace wold {
namespace {

using testing_base::error_of;
using testing_base::expect_contains;

class MeshIo : public testing_base::FolderTest {};

/// Two materials, awkward numbers, every vertex used in order.
TriangleMesh sample_mesh(bool normals, bool uvs) {
  TriangleMesh mesh;
  mesh.positions = {{0.1F, 1e-7F, -3}, {1234.567F, 0, 0}, {0, 1.0F / 3, 0}, {-1, 2, 8.5F}};
  if (normals) mesh.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0.6F, 0, -0.8F}};
  if (uvs) mesh.uvs = {{0, 0}, {1, 0}, {0.25F, 0.5F}, {12.5F, -1}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {2, 3, 0}};
  mesh.parts = {{"bark of birch", 0, 1}, {"leaf", 1, 2}};
  return mesh;
}

void expect_same(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.uvs, b.uvs);
  EXPECT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t k = 0; k < a.parts.size(); ++k) {
    EXPECT_EQ(a.parts[k].material, b.parts[k].material);
    EXPECT_EQ(a.parts[k].first_triangle, b.parts[k].first_triangle);
    EXPECT_EQ(a.parts[k].triangle_count, b.parts[k].triangle_count);
  }
}

TEST_F(MeshIo, EveryFormatKeepsEverything) {
  for (const std::string name : {"a.obj", "a.ply", "a.glb"})
    for (const bool normals : {false, true})
      for (const bool uvs : {false, true}) {
        SCOPED_TRACE(name + (normals ? " normals" : "") + (uvs ? " uvs" : ""));
        const TriangleMesh mesh = sample_mesh(normals, uvs);
        write_mesh(path(name), mesh);
        expect_same(read_mesh(path(name)), mesh);
      }
}

TEST_F(MeshIo, EmptyMeshesAndMeshesWithoutPartsWork) {
  TriangleMesh mesh = sample_mesh(true, false);
  mesh.parts.clear();
  for (const std::string name : {"a.obj", "a.ply", "a.glb"}) {
    write_mesh(path(name), mesh);
    EXPECT_EQ(read_mesh(path(name)).triangles, mesh.triangles) << name;
    write_mesh(path(name), TriangleMesh{});
    EXPECT_TRUE(read_mesh(path(name)).triangles.empty()) << name;
  }
}

TEST_F(MeshIo, GlbIsYUpAndWellFormed) {
  const std::string bytes = glb_bytes(sample_mesh(true, true));
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 4; k-- > 0;)
      value = value << 8U | static_cast<unsigned char>(bytes[at + k]);
    return value;
  };
  EXPECT_EQ(word(4), 2U);
  EXPECT_EQ(word(8), bytes.size());
  const std::uint32_t json_size = word(12);
  EXPECT_EQ(json_size % 4, 0U);
  EXPECT_EQ(word(20 + json_size) % 4, 0U);
  EXPECT_EQ(28 + json_size + word(20 + json_size), bytes.size());
  const std::string json = bytes.substr(20, json_size);
  expect_contains(json, "\"max\":[1234.");
  float first[3];  // 0.1, 1e-7, -3 in wold
  std::memcpy(first, bytes.data() + 28 + json_size, sizeof(first));
  EXPECT_EQ(first[0], 0.1F);
  EXPECT_EQ(first[1], -3.0F);
  EXPECT_EQ(first[2], -1e-7F);
}

TEST_F(MeshIo, GltfTransformsOfNodesAreApplied) {
  TriangleMesh mesh = sample_mesh(true, false);
  std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"children":[1],"translation":[10,20,30]},
             {"mesh":0,"scale":[2,2,2],"rotation":[0,0.70710678118654752,0,0.70710678118654752]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":4}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/"}]})";
  write_file(path("a.gltf"), json);
  const TriangleMesh read = read_mesh(path("a.gltf"));
  // x, y and z units; a quarter turn about y (x -> -z, z -> x), twice as large, then moved; Z up.
  ASSERT_EQ(read.positions.size(), 3U);
  const std::vector<Vec3> expected{{10, -28, 20}, {10, -30, 22}, {12, -30, 20}};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_LT(glm::length(read.positions[k] - expected[k]), 1e-5F) << k;
  const auto at = json.find("\"count\":3");
  json.replace(at, 9, "\"count\":4");
  write_file(path("a.gltf"), json);
  expect_contains(error_of([&] { read_mesh(path("a.gltf")); }), "reaches beyond its buffer");
}

TEST_F(MeshIo, GltfNestedWithoutEndIsRefused) {
  const std::size_t depth = 300'000;
  const std::string json = R"({"asset":{"version":"2.0"},"extras":)" + std::string(depth, '[') +
                           std::string(depth, ']') + "}";
  expect_contains(error_of([&] { parse_gltf(json, "a.gltf"); }), "nested too deeply");
  const std::string text =
      R"({"asset":{"version":"2.0","generator":"\"[)" + std::string(depth, '[') + R"("}})";
  EXPECT_TRUE(parse_gltf(text, "a.gltf").triangles.empty());
}

TEST_F(MeshIo, ObjOfOthersIsRead) {
  const TriangleMesh mesh = parse_obj(
      "o box\r\nv 0 0 0\r\nv +1 0 0 1.0\r\nv 1 1e0 0\r\nv 0 1 0\r\nvt 0 0\n\nusemtl a\n"
      "f 1/1 2/1 3/1 4/1 # a square\nusemtl b\nf -4 -3 -2\nusemtl a\nf 1/1 3/1 2/1",
      "x.obj");
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_TRUE(mesh.uvs.empty());  // not all have them
  ASSERT_EQ(mesh.parts.size(), 2U);
  EXPECT_EQ(mesh.parts[0].triangle_count, 3U);
  EXPECT_EQ(mesh.parts[1].material, "b");
}

TEST_F(MeshIo, ObjErrorsNameTheLine) {
  const auto message = [](std::string_view text) {
    return error_of([&] { parse_obj(text, "x.obj"); });
  };
  EXPECT_EQ(message("v 0 0 0\nv 1 x 0\n"), "x.obj:2: 'x' is not a number");
  EXPECT_EQ(message("v 0 0\n"), "x.obj:1: 3 numbers are expected here, found 2");
  EXPECT_EQ(message("v 0 0 0\n\nf 1 1 2\n"),
            "x.obj:3: '2' refers to number 2, but there are 1 before this line");
  EXPECT_EQ(message("v 0 0 0\nf 1 0 1\n"),
            "x.obj:2: '0' refers to number 0, but there are 1 before this line");
  expect_contains(message("v 0 0 0\nf 1 1\n"), "x.obj:2: a face has at least 3 corners");
  expect_contains(message("v 0 0 0\nf 1 1 a/2\n"), "'a/2' is not a corner");
}

TEST_F(MeshIo, PlyOfOthersIsRead) {
  const std::string header =
      "ply\r\nformat ascii 1.0\r\ncomment made elsewhere\nelement vertex 4\nproperty double x\n"
      "property float y\nproperty float z\nproperty uchar red\nelement face 1\n"
      "property list uchar uint vertex_index\nelement edge 1\nproperty int a\nend_header\n";
  const TriangleMesh mesh =
      parse_ply(header + "0 0 0 255\n1 0 0 9\n1 1 0 9\n0 1 0.5 9\n4 0 1 2 3\n7\n", "x.ply");
  EXPECT_EQ(mesh.positions[3], Vec3(0, 1, 0.5F));
  EXPECT_EQ(mesh.triangles, (std::vector<UVec3>{{0, 1, 2}, {0, 2, 3}}));
  const std::string big =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty short y\n"
      "property float z\nend_header\n" +
      std::string("\x3f\x80\0\0\xff\xfe\x40\0\0\0", 10);
  EXPECT_EQ(parse_ply(big, "x.ply").positions.at(0), Vec3(1, -2, 2));
}

TEST_F(MeshIo, PlyErrorsNameFileAndLine) {
  const auto message = [](const std::string& text) {
    return error_of([&] { parse_ply(text, "x.ply"); });
  };
  EXPECT_EQ(message("solid\n"), "x.ply:1: a PLY file begins with the line 'ply'");
  expect_contains(message("ply\nformat binary 1.0\n"), "x.ply:2: unknown format 'binary'");
  expect_contains(message("ply\nformat ascii 1.0\nelement vertex many\n"),
                  "x.ply:3: 'many' is not a number of things");
  expect_contains(message("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n"
                          "1\n"),
                  "no x, y and z");
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  expect_contains(message(header + "0 0 zero\n3 0 0 0\n"), "x.ply:10: 'zero' is not a number");
  expect_contains(message(header + "0 0 0\n3 0 0 1\n"), "refers to vertex 1, but there are 1");
  const std::string bytes = ply_bytes(sample_mesh(true, true));
  EXPECT_EQ(message(bytes.substr(0, bytes.size() - 20)), "x.ply: the file ends too early");
}

TEST_F(MeshIo, FileErrorsAreClear) {
  expect_contains(error_of([&] { read_mesh(path("no.obj")); }, ErrorKind::io),
                  "no.obj': there is no such file");
  expect_contains(error_of([&] { read_mesh(path("a.fbx")); }, ErrorKind::usage),
                  "unknown extension '.fbx'; known are .obj, .ply, .glb, .gltf");
  expect_contains(error_of([&] { write_mesh(path("a.fbx"), {}); }, ErrorKind::usage),
                  "known are .obj, .ply, .glb");
  write_file(path("a.glb"), "no mesh at all");
  expect_contains(error_of([&] { read_mesh(path("a.glb")); }), "a.glb' is no sound glTF file");
  const std::string bytes = glb_bytes(sample_mesh(true, true));
  write_file(path("b.glb"), std::string_view(bytes).substr(0, bytes.size() / 2));
  expect_contains(error_of([&] { read_mesh(path("b.glb")); }), "b.glb' is no sound glTF file");
}

}  // namespace
}  // namespace wold
