#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/plan_decoding.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/indirect_light/indirect_correction.h"
#include "frangia/indirect_light/indirect_phase.h"
#include "frangia/indirect_light/surface_light.h"
#include "frangia/reconstruct/internal/measure_views.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// A scan in which indirect light is looked for. The references must outlive it.
struct LitScan {
  const Scan& scan;                            ///< of all cameras
  const Image<Eigen::Vector2f>& rays;          ///< of the reference camera
  const DecodePlan& plan;                      ///< of the scan's patterns
  const std::vector<FringesOfViews>& fringes;  ///< what the frames of each camera show
};

/// Copies of the views of a camera, or of every few pixels of them: their surface shows where
/// indirect light comes from.
struct ThinnedViews {
  ViewStore views;                ///< with phases
  const MeasuredViews& measured;  ///< from which they are taken
  std::size_t camera_index;
  int step_px;                  ///< one, two or four
  CameraModel camera;           ///< of every `step_px`-th pixel
  Image<Eigen::Vector2f> rays;  ///< of its pixels

  /// `all` must outlive it.
  ThinnedViews(const MeasuredViews& all,
               std::size_t camera_number,
               const CameraModel& model,
               int step,
               const Run& run);
  /// Options for a surface with this many pixels of the whole camera between samples, at least one
  /// and a half of the thinned views, without systematic parts.
  [[nodiscard]] FusionOptions coarse_fusion(double voxel_px, FusionOptions options) const;
};

/// Every how many pixels of the views still show whether there is indirect light.
[[nodiscard]] int thinning_px(const MeasuredViews& measured);

/// The views of a camera in which indirect light is looked for.
struct LitViews {
  const ViewStore& views;               ///< every `step_px`-th pixel of the camera
  const Image<Eigen::Vector2f>& rays;   ///< of their pixels
  int step_px = 1;                      ///< one, two or four
  std::vector<std::size_t> of_scan{};   ///< the view of the scan that each one is
  const Projector& projector;           ///< in the frame of the camera
  const DirectionPlan* plan = nullptr;  ///< of the points' direction; null: no fringes
  const FringesOfViews& fringes;        ///< what their frames show
};

/// Thinned views, and the projector in the frame of their camera.
[[nodiscard]] LitViews lit_views(const ThinnedViews& thinned,
                                 const LitScan& lit,
                                 const Projector& projector);

/// Where the rig stands in the frame of the object, for each view.
[[nodiscard]] std::vector<Eigen::Isometry3d> poses_of(const ViewStore& views);

/// What becomes of the points that indirect light shifts.
enum class ShiftedPoints {
  Moved,  ///< to where they are without the predicted error; sigma counts what may remain
  Kept    ///< other phases determine them, too: sigma counts all of the error
};

/// Indirect light that was found in the views of a camera.
struct IndirectPart {
  std::shared_ptr<const SurfaceLight> light;  ///< in the poses of the views
  double albedo = 0.0;                        ///< reflectance of the surface, 0 to 1
  PhaseSource source = PhaseSource::Finest;
  double unexplained = 1.0;     ///< of the frames' indirect light; see AlbedoEstimate
  std::size_t most_of_all = 0;  ///< the view that sees most of it

  [[nodiscard]] IndirectCorrection correction(ShiftedPoints points) const {
    return {light, albedo, source, points == ShiftedPoints::Moved};
  }
};

/// Summarizes what a part adds to the points of the view that sees most of it. `rays` are those of
/// the pixels of the views.
[[nodiscard]] IndirectLightReport report_of(const IndirectPart& part,
                                            ShiftedPoints points,
                                            const ViewStore& views,
                                            const Image<Eigen::Vector2f>& rays);

/// Whether a surface may light itself, as a few pixels of the view that sees most of it show.
///
/// First some points of the surface look whether they see other parts of it, then some pixels of
/// each view whether that is lit, and then contrast and phases give a reflectance
/// (`estimate_albedo`) or not.
///
/// @shape    `surface` is the fused mesh of the views, object frame
/// @errors   Error(Cancelled)
[[nodiscard]] bool may_light_itself(const LitViews& lit, const Mesh& surface, const Run& run);

/// Finds out whether a surface lights itself, and by how much: where it may, light is collected all
/// over it, and what up to three views show decides. Nothing is returned when they show no
/// indirect light.
///
/// @shape    as above
/// @errors   Error(Cancelled)
[[nodiscard]] std::optional<IndirectPart> indirect_part(const LitViews& lit,
                                                        const Mesh& surface,
                                                        const Run& run);

}  // namespace frangia
