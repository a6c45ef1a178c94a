#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frangia/acquisition/measure_display.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"
#include "frangia/service/capture_settings.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/project_scan.h"

namespace frangia {

/// A mesh as a screen shows it: a part of the vertices of the exact mesh, joined by fewer
/// triangles. What is known of a vertex, such as its sigma, stays exact.
struct DisplayLevel {
  std::vector<std::uint32_t> vertices;    ///< in the exact mesh, ascending; empty: all of them
  std::vector<Mesh::Triangle> triangles;  ///< corners in `vertices`; empty: those of the mesh
  bool exact = false;                     ///< it is the mesh itself
  double error_mm = 0.0;                  ///< largest distance from the mesh, as estimated
};

/// Simplifies a mesh to at most about so many triangles; a mesh that has no more is exact.
///
/// @units    mm
/// @errors   Error(Cancelled)
/// @source   quadric error metrics, Garland & Heckbert 1997, by meshoptimizer
[[nodiscard]] DisplayLevel display_level(const Mesh& mesh, std::size_t most, const Run& run = {});

/// Packs a level as encode_mesh packs a mesh, with `revision` among the values of the header.
/// `normals` are those of the vertices of the exact mesh.
///
/// Colors are left out. A triangle has the largest mark that all of its corners share, where a
/// corner has that of every exact triangle around it.
[[nodiscard]] std::string encode_level(const Mesh& mesh,
                                       const std::vector<Eigen::Vector3f>& normals,
                                       const DisplayLevel& level,
                                       int revision);

/// The triangles of a level that show a selection: those all of whose corners belong to selected
/// triangles of the mesh. Empty when nothing is selected.
[[nodiscard]] Selection selection_of_level(const Mesh& mesh,
                                           const Selection& selection,
                                           const DisplayLevel& level);

/// Values of the exact mesh at the vertices of a level; empty when there are none.
template <typename T>
[[nodiscard]] std::vector<T> values_of_level(const std::vector<T>& values,
                                             const DisplayLevel& level) {
  if (level.exact || values.empty()) return values;
  std::vector<T> taken;
  taken.reserve(level.vertices.size());
  for (const std::uint32_t vertex : level.vertices)
    taken.push_back(values[vertex]);
  return taken;
}

/// Measures the display and the camera of a project by `measure_display`, and writes what it found
/// into the project's rig.toml; the rig before is kept.
///
/// @errors   as open_devices, measure_display and with_display; rig.toml is then unchanged
[[nodiscard]] DisplayMeasurement measure_project_display(const ProjectFolder& project,
                                                         const CaptureSettings& settings,
                                                         const CaptureSetup& setup,
                                                         const Run& run);

}  // namespace frangia
