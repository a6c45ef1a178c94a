#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/editor/edit_history.h"
#include "frangia/editor/edit_script.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/inspection/inspect_part.h"
#include "frangia/service/internal/surface_build.h"
#include "frangia/service/internal/surface_versions.h"

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

/// What a step did to the surface, for a sentence about it.
struct StepChange {
  std::ptrdiff_t triangles = 0;   ///< more than before
  std::ptrdiff_t holes = 0;       ///< more than before
  std::ptrdiff_t components = 0;  ///< more than before
  std::size_t moved = 0;          ///< vertices whose place changed, while the triangles stayed
  std::size_t selected = 0;       ///< triangles that are selected after it
};

/// An edit that was tried and not applied.
struct SurfacePreview {
  EditStep step;
  StepChange change;
  int revision = 0;  ///< of these arrays
  /// Packed: `added_positions`, `added_triangles` and `added_normals` are the triangles that the
  /// edit would create, `removed_...` those that it would remove.
  std::shared_ptr<const std::string> arrays;
};

/// How a surface is inspected.
struct InspectionRequest {
  InspectionPlan plan;    ///< with the file of its reference
  std::string reference;  ///< name of that file, for people; empty: none
  std::string basis;      ///< see `inspection_basis`
  bool features = false;  ///< looks for all of them, not only for those of the plan
  /// Of the surface, which still lies as it was scanned; null otherwise.
  std::shared_ptr<const Scan> scan;
};

/// An inspection of the surface by a plan, and what the page draws of it.
struct ShownInspection {
  int revision = 0;
  InspectionRequest asked;
  Inspection found;              ///< without its mesh: the surface, moved by the alignment
  std::vector<float> histogram;  ///< shares of the area, from `low_mm` to `high_mm`
  double low_mm = 0.0;           ///< of the color scale: twice the tolerance
  double high_mm = 0.0;          ///< likewise
};

/// What clients see of a surface. Immutable, so that a client reads it while an edit runs.
struct SurfaceSnapshot {
  int version = 0;             ///< number of the SurfaceVersion
  int mesh_revision = 0;       ///< at which this mesh was first shown
  int selection_revision = 0;  ///< of the selection of this mesh; undo brings it back, too
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t selected = 0;  ///< triangles
  std::size_t components = 0;
  MedianSigma sigma;
  std::vector<SurfaceHole> holes;  ///< the largest first, at most kMostHoles
  std::size_t hole_count = 0;
  std::vector<EditStep> steps;  ///< those after the first `done` were undone
  std::size_t done = 0;
  std::vector<StepChange> changes;  ///< one for each step
  std::vector<SurfaceFit> fits;     ///< of the present mesh, the newest last, at most kMostFits
  PicturePtr picture;
  std::shared_ptr<const Selection> selection;         ///< of the exact mesh
  std::shared_ptr<const SurfacePreview> preview;      ///< null without one
  std::shared_ptr<const ShownInspection> inspection;  ///< of the present mesh; null without one
  std::shared_ptr<const std::string> summary;         ///< JSON of the reconstruction; may be empty

  static constexpr std::size_t kMostHoles = 100;
  static constexpr std::size_t kMostFits = 12;
};
using SurfacePtr = std::shared_ptr<const SurfaceSnapshot>;

/// The name of its mesh, by which measurements know what they are of.
[[nodiscard]] std::string mesh_name(const SurfaceSnapshot& surface);

/// A version of the surface under edit, in memory. Every change is worked out completely as another
/// model, which shares what is the same and takes the place of this one without failing; writing it
/// to disk in between may fail or be stopped. Revisions are those of SurfaceVersions;
/// previews and inspections count on their own.
class SurfaceModel {
 public:
  /// Reads the files of a version and applies its saved steps.
  ///
  /// @errors   as read_mesh, read_edit_script and apply_step
  SurfaceModel(const VersionFiles& files, int version, int revision, const Run& run);

  [[nodiscard]] const Mesh& mesh() const { return history_->mesh(); }
  [[nodiscard]] EditScript script() const { return {history_->steps(), history_->done()}; }
  [[nodiscard]] const SurfacePtr& snapshot() const { return snapshot_; }

  [[nodiscard]] SurfaceModel applied(const EditStep& step, int revision, const Run& run) const;
  /// Applies the steps of another version, all or none.
  ///
  /// @errors   as apply_step, with the number of the step
  [[nodiscard]] SurfaceModel replayed(const std::vector<EditStep>& steps,
                                      int revision,
                                      const Run& run) const;
  /// Selects the connected component of a triangle.
  [[nodiscard]] SurfaceModel with_component_of(std::size_t triangle,
                                               int revision,
                                               const Run& run) const;
  [[nodiscard]] SurfaceModel undone(int revision, const Run& run) const;  ///< Error(Input): no step
  [[nodiscard]] SurfaceModel redone(int revision, const Run& run) const;  ///< Error(Input): no step

  /// Fits a shape, "plane", "cylinder" or "sphere", to the selected triangles.
  ///
  /// @errors   Error(Input) for another kind, for too small a selection, or when its points do not
  ///          determine the shape
  [[nodiscard]] SurfaceModel with_fit(const std::string& kind, const Run& run) const;
  /// Tries a step and shows what it would change; the next edit drops the preview.
  [[nodiscard]] SurfaceModel with_preview(const EditStep& step, int count, const Run& run) const;
  [[nodiscard]] SurfaceModel without_preview() const;
  /// Inspects the surface.
  ///
  /// @errors   as read_inspection_reference and inspect_part
  [[nodiscard]] SurfaceModel inspected(const InspectionRequest& asked,
                                       int count,
                                       const Run& run) const;
  /// Whether the level that is drawn at rest is missing.
  [[nodiscard]] bool is_coarse() const { return snapshot_->picture->is_coarse(); }
  /// Adds that level, which a client does not have to wait for.
  [[nodiscard]] SurfaceModel refined(const Run& run) const;

 private:
  /// Pictures of the steps nearest to the present one that are kept, so that undo shows them at
  /// once.
  static constexpr std::size_t kMostPictureBytes = 512UL * 1024 * 1024;

  void publish(int revision, const Run& run);
  void show(std::shared_ptr<SurfaceSnapshot> next);
  void forget_undone();  ///< before a step is added
  void forget_far_pictures();

  std::shared_ptr<const EditHistory> history_;
  SurfacePtr snapshot_;
  std::vector<StepChange> changes_;
  std::vector<SurfacePtr> shown_;  ///< after so many steps; null: not known any more
};

}  // namespace frangia
