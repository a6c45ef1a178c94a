#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/service/display_level.h"

namespace frangia {

/// Of each setup, for the picture of how they join: a millimetre apart on a part of a hand's size.
inline constexpr std::size_t kPointsOfSetup = 60'000;

/// Writes the files of a new version into a folder, see VersionFiles. All are on the disk when the
/// function returns; whatever was in the folder is not. `warnings` are those of the reconstruction,
/// which stay with its figures.
///
/// @errors   Error(File); Error(Cancelled)
void write_surface_build(const std::filesystem::path& folder,
                         const Reconstruction& result,
                         const std::vector<std::string>& warnings,
                         const Run& run);

/// Likewise for a mesh that no scan of this project made; without figures of a reconstruction.
void write_given_surface(const std::filesystem::path& folder, const Mesh& mesh, const Run& run);

/// A state of the mesh under edit and its levels of detail, the coarsest first. Immutable, so that
/// clients read it while the mesh is edited.
class SurfacePicture {
 public:
  /// Triangles of the level that follows the hand. tests/app/large_mesh.mjs measures the time of a
  /// frame: without a graphics card it grows with the number of triangles.
  static constexpr std::size_t kMovingTriangles = 100'000;
  /// Up to here the exact mesh follows the hand.
  static constexpr std::size_t kSmall = 2 * kMovingTriangles;
  /// Triangles of the level that is drawn at rest: about as many as it has pixels on a screen.
  static constexpr std::size_t kRestTriangles = 500'000;

  /// Copies the mesh and makes the coarsest level.
  SurfacePicture(const Mesh& mesh, int revision, const Run& run);

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  [[nodiscard]] int revision() const { return revision_; }
  [[nodiscard]] const std::vector<std::shared_ptr<const DisplayLevel>>& levels() const {
    return levels_;
  }
  /// Whether the level at rest is missing.
  [[nodiscard]] bool is_coarse() const;
  /// The same picture with the level at rest.
  [[nodiscard]] std::shared_ptr<const SurfacePicture> refined(const Run& run) const;

  /// The level, packed; empty when there is no such level.
  [[nodiscard]] std::string packed_level(std::size_t level) const;
  /// The flags of a selection of the exact mesh for the triangles of a level, packed.
  [[nodiscard]] std::string packed_selection(std::size_t level,
                                             const Selection& selection,
                                             int revision) const;
  /// Memory of the mesh and its levels.
  [[nodiscard]] std::size_t bytes() const;

 private:
  std::shared_ptr<const Mesh> mesh_;
  std::shared_ptr<const std::vector<Eigen::Vector3f>> normals_;
  std::vector<std::shared_ptr<const DisplayLevel>> levels_;
  int revision_ = 0;
};
using PicturePtr = std::shared_ptr<const SurfacePicture>;

}  // namespace frangia
