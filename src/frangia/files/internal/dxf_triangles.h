#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/files/internal/dxf_groups.h"
#include "frangia/files/internal/polygon_faces.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A POLYLINE entity with its VERTEX records.
struct DxfPolyline {
  std::int64_t flags = 0;  ///< group 70
  std::int64_t m = 0, n = 0;
  Mark mark = Mark::Measured;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::int64_t, 4>>
      faces;  ///< indices from 1; negative: hidden edge; 0: none
};

/// Collects the triangles of the entities of a DXF. Degenerate triangles are omitted.
///
/// @errors   Error(Input) that names the file and the line: a vertex index out of range, a
///          coordinate that is not finite
class DxfTriangles {
 public:
  /// Takes note of faces that are no plane polygons in `odd`.
  DxfTriangles(const DxfGroups& groups, OddFaces& odd) : groups_(groups), odd_(odd) {}

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, Mark mark);
  void add_polyface(const DxfPolyline& line);
  /// Adds a polygon of any form, such as a 3DFACE with four corners.
  void add_polygon(const std::vector<Eigen::Vector3d>& vertices,
                   std::span<const std::size_t> corners,
                   Mark mark);
  /// Adds an M x N mesh, closed in either direction where the flags say so.
  void add_grid(const DxfPolyline& line);
  /// Adds the faces of a MESH: each is a count followed by that many indices from 0.
  void add_faces(const std::vector<Eigen::Vector3d>& vertices,
                 std::span<const std::int64_t> list,
                 Mark mark);

  /// The welded mesh in mm, with marks unless all triangles are measured.
  [[nodiscard]] Mesh release_mesh(double mm_per_unit);

 private:
  const DxfGroups& groups_;
  std::vector<Eigen::Vector3f> corners_;
  std::vector<Mark> marks_;
  OddFaces& odd_;
};

}  // namespace frangia
