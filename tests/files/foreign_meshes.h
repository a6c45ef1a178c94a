#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/files/read_mesh.h"

#include "files/folder_fixture.h"

namespace frangia::testing {

using Faces = std::vector<std::vector<std::size_t>>;

/// A solid of polygons.
struct Solid {
  std::vector<Eigen::Vector3d> vertices;
  Faces faces;
};

/// A prism of height 10 over an outline, whose caps begin with any corner.
inline Solid prism(const std::vector<Eigen::Vector2d>& outline, std::size_t start) {
  const std::size_t count = outline.size();
  Solid solid;
  for (const double z : {0.0, 10.0})
    for (const Eigen::Vector2d& point : outline)
      solid.vertices.emplace_back(point.x(), point.y(), z);
  std::vector<std::size_t> bottom;
  std::vector<std::size_t> top;
  for (std::size_t i = 0; i < count; ++i) {
    bottom.push_back((2 * count - 1 - i - start) % count);
    top.push_back(count + (i + start) % count);
    solid.faces.push_back({i, (i + 1) % count, (i + 1) % count + count, i + count});
  }
  solid.faces.push_back(bottom);
  solid.faces.push_back(top);
  return solid;
}

/// A U of 30 x 20 with a notch of 10 x 15.
inline const std::vector<Eigen::Vector2d> kU{
    {0, 0}, {30, 0}, {30, 20}, {20, 20}, {20, 5}, {10, 5}, {10, 20}, {0, 20}};
/// An arrowhead, which is a concave quadrilateral.
inline const std::vector<Eigen::Vector2d> kArrow{{0, 0}, {15, 10}, {30, 0}, {15, 30}};

inline std::string obj_of(const Solid& solid) {
  std::string text;
  for (const Eigen::Vector3d& v : solid.vertices)
    text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& face : solid.faces) {
    text += "f";
    for (const std::size_t corner : face)
      text += fmt::format(" {}", corner + 1);
    text += "\n";
  }
  return text;
}

inline std::string list_of_faces(const Solid& solid) {
  std::string text;
  for (const Eigen::Vector3d& v : solid.vertices)
    text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& face : solid.faces) {
    text += fmt::format("{}", face.size());
    for (const std::size_t corner : face)
      text += fmt::format(" {}", corner);
    text += "\n";
  }
  return text;
}

inline std::string off_of(const Solid& solid) {
  return fmt::format("OFF\n{} {} 0\n", solid.vertices.size(), solid.faces.size()) +
         list_of_faces(solid);
}

inline std::string ply_of(const Solid& solid) {
  return fmt::format(
             "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
             "property float z\nelement face {}\nproperty list uchar int vertex_indices\n"
             "end_header\n",
             solid.vertices.size(),
             solid.faces.size()) +
         list_of_faces(solid);
}

inline std::string group(int code, const std::string& value) {
  return fmt::format("{}\n{}\n", code, value);
}

inline std::string point_group(int corner, const Eigen::Vector3d& v) {
  return group(10 + corner, fmt::format("{}", v.x())) +
         group(20 + corner, fmt::format("{}", v.y())) +
         group(30 + corner, fmt::format("{}", v.z()));
}

inline std::string drawing(const std::string& entities, const std::string& before = {}) {
  return before + group(0, "SECTION") + group(2, "ENTITIES") + entities + group(0, "ENDSEC") +
         group(0, "EOF");
}

/// A MESH, or 3DFACEs where all faces have four corners.
inline std::string dxf_of(const Solid& solid, bool quads) {
  std::string text;
  if (quads) {
    for (const auto& face : solid.faces) {
      text += group(0, "3DFACE") + group(8, "0");
      for (int k = 0; k < 4; ++k)
        text += point_group(k, solid.vertices[face[static_cast<std::size_t>(k)]]);
    }
    return drawing(text);
  }
  text = group(0, "MESH") + group(8, "0") + group(91, "0") +
         group(92, std::to_string(solid.vertices.size()));
  for (const Eigen::Vector3d& v : solid.vertices)
    text += point_group(0, v);
  std::size_t entries = 0;
  std::string list;
  for (const auto& face : solid.faces) {
    entries += 1 + face.size();
    list += group(90, std::to_string(face.size()));
    for (const std::size_t corner : face)
      list += group(90, std::to_string(corner));
  }
  return drawing(text + group(93, std::to_string(entries)) + list);
}

inline double area_of(const Mesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.vertices_mm[a].cast<double>();
    area += 0.5 * (mesh.vertices_mm[b].cast<double>() - p)
                      .cross(mesh.vertices_mm[c].cast<double>() - p)
                      .norm();
  }
  return area;
}

inline double volume_of(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.vertices_mm[a].cast<double>().dot(
                  mesh.vertices_mm[b].cast<double>().cross(mesh.vertices_mm[c].cast<double>())) /
              6.0;
  return volume;
}

inline Eigen::AlignedBox3d box_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.vertices_mm)
    box.extend(vertex.cast<double>());
  return box;
}

/// Reads files as other programs write them.
class ForeignMeshes : public FolderFixture {
 protected:
  /// Reads a text as a file of that name, with what the reader warns of.
  Mesh read(const std::string& name, const std::string& bytes) {
    said_.clear();
    frangia::Run run;
    run.on_warning = [&](const std::string& sentence) { said_ += sentence + "\n"; };
    return read_mesh(put(name, bytes), run);
  }
  [[nodiscard]] bool said(const std::string& words) const {
    return said_.find(words) != std::string::npos;
  }
  [[nodiscard]] const std::string& said() const { return said_; }

 private:
  std::string said_;
};

}  // namespace frangia::testing
