#pragma once
// A mesh whose vertices are moved within its own file: faces (also of more than three corners), the
// order of vertices, texture coordinates, materials, groups, colours and all else that the file
// holds stay as they are; only positions change, and normals around what moved.
//
//   EditableMesh mesh = EditableMesh::read("hill.obj");
//   for (DVec3& p : mesh.positions()) p.z *= 2;
//   mesh.write("higher.obj");
//
//   OBJ   only the numbers that changed are written anew. A normal that several places share, and
//         that is no longer the same in all of them, becomes several: the faces' numbers of normals
//         change, and nothing else of them
//   PLY   all else byte for byte, in the file's own format and byte order
//   glTF  transforms of nodes stay; the bounds of positions are kept right. A mesh that several
//         nodes show becomes one for each, as each moves at its own place. In .gltf, buffers are
//         put into the file
//
// A new normal is the mean of the faces around (weighted with their angle there) among which the
// old one was shared: smooth stays smooth, an edge stays an edge. Tangents of glTF stay as they
// were. Files that the mesh names (.mtl, pictures) are neither copied nor renamed.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"

namespace wold {

/// The upward axis of files that do not say: OBJ and PLY. glTF is always Y up.
enum class UpAxis { z, y };

namespace mesh_edit {

/// Of a corner without a normal.
inline constexpr std::uint32_t no_point = 0xffffffffU;

/// A position with one normal, as corners of faces use them.
struct Point {
  std::uint32_t position = 0;
  Vec3 normal{0};
  std::uint32_t number = 0;  ///< of the normal in an OBJ file, from 0
};

/// What the file holds, in its own axes.
struct Content {
  std::vector<DVec3> positions;
  std::vector<UVec3> triangles;        ///< of positions; polygons are fans
  std::vector<Point> points;           ///< empty if there are no normals
  std::vector<UVec3> triangle_points;  ///< of points; none or one per triangle
};

enum class FileFormat { obj, ply, gltf };

}  // namespace mesh_edit

class EditableMesh {
 public:
  /// By extension: .obj, .ply, .glb, .gltf. Throws Error(io) for a missing file, Error(usage) for
  /// another extension, Error(input) with file and, in texts, line for what is wrong in it.
  static EditableMesh read(const std::string& path, UpAxis up = UpAxis::z);
  /// `file` is for messages, its extension for the format.
  static EditableMesh parse(std::string bytes, const std::string& file, UpAxis up = UpAxis::z);

  /// Z up, in the file's unit (glTF: metres), in the file's order. Change them in place.
  std::span<DVec3> positions() { return positions_; }
  std::span<const DVec3> positions() const { return positions_; }
  /// Of positions; polygons as fans, in the file's order.
  std::span<const UVec3> triangles() const { return content_.triangles; }

  /// The file with the positions as they are now. Unchanged, it is the file that was read. Throws
  /// Error(input) for positions that are not finite, Error(limit) above the 4 GiB of a GLB.
  std::string bytes() const;

  /// Writes `bytes` if the extension is that of the file that was read. Else the mesh goes through
  /// a TriangleMesh into the other format (mesh/io.hpp): triangles, materials by name, normals and
  /// texture coordinates, no more. Throws as `write_mesh`.
  void write(const std::string& path) const;

 private:
  EditableMesh() = default;

  std::string bytes_;
  std::string file_;
  mesh_edit::FileFormat format_ = mesh_edit::FileFormat::obj;
  UpAxis up_ = UpAxis::z;
  mesh_edit::Content content_;
  std::vector<DVec3> positions_;
};

/// To be called before long work: throws unless a mesh that was read from `from` could be written
/// as `path`.
void check_editable_writable(const std::string& from, const std::string& path);

}  // namespace wold
