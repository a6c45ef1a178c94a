#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/editor/edit_history.h"
#include "frangia/geometry/median_sigma.h"
#include "frangia/service/project_folder.h"

namespace frangia {

/// A hole of the surface, with the number that operations of the editor use.
struct SurfaceHole {
  std::size_t number = 0;
  double size_mm = 0.0;
  double length_mm = 0.0;
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
};

/// A plane, cylinder or sphere that was fitted to selected triangles.
struct SurfaceFit {
  std::string kind;  ///< "plane", "cylinder" or "sphere"
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double diameter_mm = kMissing;  ///< NaN for a plane
  double u95_mm = kMissing;       ///< expanded uncertainty of the diameter, or of a plane's offset
  double rms_mm = 0.0;            ///< of the residuals
  double form_mm = 0.0;           ///< range of the residuals
  std::size_t points = 0;
};

/// What clients see of a surface. Immutable, so that a client reads it while an edit runs.
struct SurfaceSnapshot {
  int mesh_revision = 0;       ///< changes with the mesh
  int selection_revision = 0;  ///< changes with the selection or the mesh
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t selected = 0;  ///< triangles
  std::size_t components = 0;
  MedianSigma sigma;
  std::vector<SurfaceHole> holes;  ///< the largest first, at most kMostHoles
  std::size_t hole_count = 0;
  std::vector<EditStep> steps;  ///< those after the first `done` were undone
  std::size_t done = 0;
  std::vector<SurfaceFit> fits;  ///< of the present mesh, the newest last, at most kMostFits
  std::shared_ptr<const std::string> mesh;       ///< packed
  std::shared_ptr<const std::string> selection;  ///< packed

  static constexpr std::size_t kMostHoles = 100;
  static constexpr std::size_t kMostFits = 12;
};
using SurfacePtr = std::shared_ptr<const SurfaceSnapshot>;

/// The surface of a project under edit. Used by one thread at a time; every change saves the steps
/// and returns a new snapshot.
class SurfaceModel {
 public:
  /// Reads surface.ply and applies the saved steps.
  ///
  /// @errors   as read_mesh, read_edit_script and apply_step
  SurfaceModel(const ProjectFolder& project, int revision, const Run& run);

  [[nodiscard]] const Mesh& mesh() const { return history_->mesh(); }
  /// Applies a step.
  SurfacePtr apply(const EditStep& step, const Run& run);
  /// Selects the connected component of a triangle.
  SurfacePtr select_component_of(std::size_t triangle, const Run& run);
  /// Fits a shape, "plane", "cylinder" or "sphere", to the selected triangles.
  ///
  /// @errors   Error(Input) for another kind, for too small a selection, or when its points do not
  ///          determine the shape
  SurfacePtr fit(const std::string& kind, const Run& run);
  SurfacePtr undo();  ///< Error(Input) without a step to undo
  SurfacePtr redo();  ///< Error(Input) without a step to redo
  [[nodiscard]] SurfacePtr snapshot() const { return snapshot_; }

 private:
  SurfacePtr publish(const EditState* before);
  void save() const;

  ProjectFolder project_;
  std::optional<EditHistory> history_;
  int revision_ = 0;
  SurfacePtr snapshot_;
};

}  // namespace frangia
