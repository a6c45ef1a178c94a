#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A polygon of a file as triangles.
struct PolygonTriangles {
  std::vector<std::array<std::size_t, 3>> triangles;  ///< corners of the polygon, from 0
  double off_plane =
      0.0;               ///< largest distance of a corner from the mean plane, in units of the file
  bool crosses = false;  ///< the outline crosses itself in that plane: its triangles are a fan
};

/// Triangulates a polygon in its mean plane without further points: n corners give n - 2 triangles
/// with the orientation of the polygon. A convex polygon becomes a fan around its first corner.
///
/// @source   Newell's method for the plane; Eberly, Triangulation by Ear Clipping
[[nodiscard]] PolygonTriangles polygon_triangles(std::span<const Eigen::Vector3d> corners);

/// Counts the faces of a file that are no plane polygons, for one warning.
class OddFaces {
 public:
  /// Takes note of a face whose corners span `size`, in units of the file.
  void note(const PolygonTriangles& face, double size);
  /// Takes note of triangles with two corners at one place, which are left out.
  void note_without_area(std::size_t triangles) { without_area_ += triangles; }
  /// Warns of what was noted. `mm_per_unit` converts distances.
  void warn(const std::filesystem::path& path, double mm_per_unit, const Run& run) const;

 private:
  std::size_t not_plane_ = 0;
  std::size_t crossing_ = 0;
  std::size_t without_area_ = 0;
  double largest_ = 0.0;
};

/// The faces of a file with more than three corners. They are added as fans, since a face may come
/// before its vertices, and triangulated when all is read.
class PolygonFaces {
 public:
  /// Adds a face to the triangles of the mesh.
  void add(Mesh& mesh, std::span<const std::uint32_t> corners);
  /// Triangulates the faces in place and warns of those that are no plane polygons.
  ///
  /// @errors   Error(Input) that names the file: a concave face with more corners than any has;
  ///           Error(Cancelled)
  void triangulate(Mesh& mesh, const std::filesystem::path& path, const Run& run) const;

 private:
  struct Fan {
    std::size_t first = 0;      ///< triangle
    std::uint32_t corners = 0;  ///< more than three
  };
  std::vector<Fan> fans_;
};

}  // namespace frangia
