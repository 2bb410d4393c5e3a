#include "mesh/io.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "image/atomic_file.hpp"
#include "mesh/gltf.hpp"
#include "mesh/obj.hpp"
#include "mesh/ply.hpp"

namespace wold {

void write_obj(const std::string& path, const TriangleMesh& mesh) {
  write_file(path, obj_text(mesh));
}

void write_ply(const std::string& path, const TriangleMesh& mesh) {
  write_file(path, ply_bytes(mesh));
}

void write_glb(const std::string& path, const TriangleMesh& mesh) {
  write_file(path, glb_bytes(mesh));
}

void write_mesh(const std::string& path, const TriangleMesh& mesh) {
  check_mesh_writable(path);
  const std::string extension = extension_of(path);
  if (extension == ".obj") return write_obj(path, mesh);
  if (extension == ".ply") return write_ply(path, mesh);
  write_glb(path, mesh);
}

const std::vector<std::string>& mesh_extensions() {
  static const std::vector<std::string> extensions{".obj", ".ply", ".glb"};
  return extensions;
}

void check_mesh_writable(const std::string& path) {
  check_writable(path, mesh_extensions());
}

TriangleMesh read_mesh(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".obj") return parse_obj(read_file(path), path);
  if (extension == ".ply") return parse_ply(read_file(path), path);
  if (extension == ".glb" || extension == ".gltf") return parse_gltf(read_file(path), path);
  throw Error(ErrorKind::usage,
              fmt::format("cannot read '{}' as a mesh: unknown extension '{}'; known are .obj, "
                          ".ply, .glb, .gltf",
                          path, extension));
}

}  // namespace wold
