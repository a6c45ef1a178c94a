#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "frangia/files/internal/dxf_groups.h"
#include "frangia/files/internal/dxf_triangles.h"

namespace frangia {

/// Reads the entities of a DXF that hold triangles: 3DFACE, POLYLINE as a polyface or M x N mesh,
/// and MESH. Counts the entities that it skips.
///
/// @errors   Error(Input) that names the file and the line
class DxfEntities {
 public:
  explicit DxfEntities(DxfGroups& groups) : groups_(groups), triangles_(groups) {}

  /// Reads from the name of an entity (group 0) to the name of the next; false at the end of the
  /// text.
  bool read();
  /// The skipped entities as "3 LINE, 1 CIRCLE"; empty when none was skipped.
  [[nodiscard]] std::string skipped() const;
  [[nodiscard]] Mesh release_mesh(double mm_per_unit) {
    return triangles_.release_mesh(mm_per_unit);
  }

 private:
  bool to_next_entity();
  void skip(const std::string& name);
  bool read_face();
  bool read_polyline();
  bool read_vertex(DxfPolyline& line);
  bool read_mesh_entity();

  DxfGroups& groups_;
  DxfTriangles triangles_;
  std::map<std::string, std::size_t> skipped_;
};

}  // namespace frangia
