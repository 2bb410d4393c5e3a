#pragma once
// Triangle meshes from and to files. Files are written whole or not at all.
//
//   OBJ   text; Z up as in wold; materials by name (usemtl, no .mtl file)
//   PLY   binary little endian; Z up; parts as a face property `material_index` whose names are
//         comments "material INDEX NAME"; reads ASCII and both byte orders
//   GLB   glTF 2.0 binary, one primitive and material per part; Y up as glTF asks for:
//         (x, y, z) of glTF = (X, Z, -Y) of wold, v of glTF = 1 - v; reads .gltf too, with the
//         transforms of its nodes applied
//
// Polygons are read as fans of triangles. Corners that share position, normal and texture
// coordinates become one vertex. Normals or texture coordinates that only a part of the vertices
// has are left out.

#include <string>
#include <vector>

#include "base/mesh.hpp"

namespace wold {

void write_obj(const std::string& path, const TriangleMesh& mesh);
void write_ply(const std::string& path, const TriangleMesh& mesh);
/// Throws Error(limit) above 4 GiB, which is more than a GLB can hold.
void write_glb(const std::string& path, const TriangleMesh& mesh);

/// By extension: .obj, .ply, .glb. Throws Error(usage) for another extension, Error(io) if it
/// cannot be written.
void write_mesh(const std::string& path, const TriangleMesh& mesh);

/// The extensions that `write_mesh` knows.
const std::vector<std::string>& mesh_extensions();

/// To be called before long work: throws unless `path` could be written as a mesh.
void check_mesh_writable(const std::string& path);

/// By extension: .obj, .ply, .glb, .gltf. Throws Error(io) for a missing file, Error(usage) for an
/// unknown extension, Error(input) with file and, in texts, line for what is wrong in it.
TriangleMesh read_mesh(const std::string& path);

}  // namespace wold
