#include "frangia/service/compare_surface.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "frangia/align/align_best_fit.h"
#include "frangia/cad/read_cad.h"
#include "frangia/core/error.h"
#include "frangia/files/read_mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/inspect/inspect_surface.h"

namespace frangia {
namespace {

constexpr std::size_t kHistogramBins = 48;
constexpr double kScaleOverTolerance = 2.0;

}  // namespace

const std::vector<std::string>& reference_formats() {
  static const std::vector<std::string> formats = {"stl", "ply", "obj", "3mf", "step", "stp"};
  return formats;
}

SurfaceComparison compare_surface(const Mesh& mesh,
                                  const std::filesystem::path& reference,
                                  const CompareOptions& options,
                                  const Run& run) {
  options.tolerance.check();
  run.stage("reference");
  std::unique_ptr<CadModel> cad;
  if (is_cad_file(reference)) cad = read_cad(reference, {}, run);
  Mesh nominal = cad ? cad->mesh() : read_mesh(reference, run);
  require(!nominal.triangles.empty(),
          "the reference has points and no triangles; choose a file with a surface");
  SurfaceComparison found;
  found.triangles = nominal.triangles.size();
  const RayScene scene(std::move(nominal), run);
  run.stage("alignment");
  BestFitOptions fit;
  fit.start = options.start;
  Alignment alignment;
  if (options.best_fit) {
    alignment = align_best_fit(mesh, scene, fit, run);
  } else {
    alignment.pose = assess_pose(mesh, scene, Eigen::Isometry3d::Identity(), fit, run);
  }
  const Eigen::Isometry3d& pose = alignment.pose.reference_from_mesh;
  found.overlap = alignment.pose.overlap;
  found.fit_rms_mm = alignment.pose.rms_mm;
  found.turned_rad = Eigen::AngleAxisd(pose.linear()).angle();
  found.moved_mm = pose.translation().norm();
  found.free_directions = alignment.free_directions;
  for (const AlignmentPose& other : alignment.alternatives) {
    const Eigen::Isometry3d& motion = other.reference_from_mesh;
    found.poses.push_back({Eigen::AngleAxisd(motion.linear()).angle(),
                           motion.translation().norm(),
                           other.overlap,
                           other.rms_mm});
  }
  run.stage("deviations");
  const Mesh aligned = transform_mesh(mesh, pose);
  DeviationOptions deviation;
  deviation.pose = alignment.pose.uncertainty;
  deviation.exact = cad.get();
  SurfaceInspection inspection =
      inspect_surface(aligned, scene, {.limits = options.tolerance}, deviation, run);
  Deviations& deviations = inspection.deviations;
  found.summary = inspection.summary;
  found.verdict = std::move(inspection.verdict);
  found.high_mm = kScaleOverTolerance *
                  std::max(std::abs(options.tolerance.lower), std::abs(options.tolerance.upper));
  found.low_mm = -found.high_mm;
  found.histogram = deviation_histogram(
      aligned, deviations.deviation_mm, found.low_mm, found.high_mm, kHistogramBins);
  found.left_out = static_cast<std::size_t>(
      std::count_if(deviations.status.begin(), deviations.status.end(), [](DeviationStatus status) {
        return status != DeviationStatus::Compared;
      }));
  found.deviation_mm = std::move(deviations.deviation_mm);
  return found;
}

}  // namespace frangia
