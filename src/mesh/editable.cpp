#include "mesh/editable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "image/atomic_file.hpp"
#include "mesh/edit.hpp"
#include "mesh/gltf.hpp"
#include "mesh/io.hpp"
#include "mesh/obj.hpp"
#include "mesh/ply.hpp"

namespace wold {

using mesh_edit::Edit;
using mesh_edit::FileFormat;

namespace {

FileFormat format_of(const std::string& file) {
  const std::string extension = extension_of(file);
  if (extension == ".obj") return FileFormat::obj;
  if (extension == ".ply") return FileFormat::ply;
  if (extension == ".glb" || extension == ".gltf") return FileFormat::gltf;
  throw Error(ErrorKind::usage,
              fmt::format("cannot read '{}' as a mesh: unknown extension '{}'; known are .obj, "
                          ".ply, .glb, .gltf",
                          file, extension));
}

DVec3 z_up(const DVec3& p, UpAxis up) {
  return up == UpAxis::z ? p : DVec3(p.x, -p.z, p.y);
}
DVec3 from_z_up(const DVec3& p, UpAxis up) {
  return up == UpAxis::z ? p : DVec3(p.x, p.z, -p.y);
}

void check_finite(const std::vector<DVec3>& positions, const std::string& file) {
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const DVec3& p = positions[k];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw Error(ErrorKind::input,
                  fmt::format("'{}': the position of vertex {} (counted from 0) is not finite: "
                              "({}, {}, {})",
                              file, k, p.x, p.y, p.z));
  }
}

}  // namespace

EditableMesh EditableMesh::read(const std::string& path, UpAxis up) {
  format_of(path);
  return parse(read_file(path), path, up);
}

EditableMesh EditableMesh::parse(std::string bytes, const std::string& file, UpAxis up) {
  EditableMesh mesh;
  mesh.format_ = format_of(file);
  mesh.bytes_ = std::move(bytes);
  mesh.file_ = file;
  mesh.up_ = mesh.format_ == FileFormat::gltf ? UpAxis::y : up;
  switch (mesh.format_) {
    case FileFormat::obj: mesh.content_ = mesh_edit::obj_content(mesh.bytes_, file); break;
    case FileFormat::ply: mesh.content_ = mesh_edit::ply_content(mesh.bytes_, file); break;
    case FileFormat::gltf: mesh.content_ = mesh_edit::gltf_content(mesh.bytes_, file); break;
  }
  check_finite(mesh.content_.positions, file);
  for (const DVec3& p : mesh.content_.positions) mesh.positions_.push_back(z_up(p, mesh.up_));
  return mesh;
}

std::string EditableMesh::bytes() const {
  check_finite(positions_, file_);
  std::vector<DVec3> positions;
  for (const DVec3& p : positions_) positions.push_back(from_z_up(p, up_));
  if (positions == content_.positions) return bytes_;
  const Edit edit = mesh_edit::edit_of(content_, positions);
  switch (format_) {
    case FileFormat::obj: return mesh_edit::edited_obj(bytes_, file_, edit);
    case FileFormat::ply: return mesh_edit::edited_ply(bytes_, file_, edit);
    case FileFormat::gltf: return mesh_edit::edited_gltf(bytes_, file_, edit);
  }
  return {};
}

void EditableMesh::write(const std::string& path) const {
  check_editable_writable(file_, path);
  if (extension_of(path) == extension_of(file_)) return write_file(path, bytes());
  TriangleMesh mesh;
  switch (format_) {
    case FileFormat::obj: mesh = parse_obj(bytes(), file_); break;
    case FileFormat::ply: mesh = parse_ply(bytes(), file_); break;
    case FileFormat::gltf: mesh = parse_gltf(bytes(), file_); break;
  }
  const bool turn = up_ == UpAxis::y && format_ != FileFormat::gltf;  // parse_gltf has turned it
  if (turn) {
    for (Vec3& p : mesh.positions) p = Vec3(z_up(DVec3(p), up_));
    for (Vec3& n : mesh.normals) n = Vec3(z_up(DVec3(n), up_));
  }
  write_mesh(path, mesh);
}

void check_editable_writable(const std::string& from, const std::string& path) {
  format_of(from);
  if (extension_of(path) == extension_of(from))
    check_writable(path);
  else
    check_mesh_writable(path);
}

}  // namespace wold
