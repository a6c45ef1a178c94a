#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/calibrate/check/check_kinds.h"
#include "frangia/calibrate/check/internal/check_limits.h"
#include "frangia/calibrate/check/internal/compare_views.h"
#include "frangia/core/error.h"
#include "frangia/dataset/scan_of_camera.h"

namespace frangia {
namespace {

/// Views in which several cameras are compared with each other, spread over the scan.
constexpr std::size_t kComparedViews = 3;

/// Views of one camera, each compared with the same view of another.
std::vector<PartView> views_of(const Scan& scan,
                               std::size_t camera,
                               const CheckRigOptions& options,
                               const Run& run) {
  const Scan own = scan_of_camera(scan, camera);
  const std::size_t count = own.views.size();
  const std::size_t used = std::min(count, kComparedViews);
  std::vector<PartView> views;
  for (std::size_t i = 0; i < used; ++i) {
    run.check();
    views.push_back(measure_part_view(own, i * count / used, options.part_sites, run));
    views.back().camera_from_zero = scan.rig.cameras[camera].camera_from_rig();
  }
  return views;
}

}  // namespace

RigCheck check_cameras_of(const Scan& scan, const CheckRigOptions& options, const Run& run) {
  RigCheck all;
  const std::vector<PartView> reference = views_of(scan, 0, options, run);
  for (std::size_t camera = 1; camera < scan.rig.cameras.size(); ++camera) {
    const std::string& name = scan.rig.cameras[camera].camera.name;
    const std::vector<PartView> views = views_of(scan, camera, options, run);
    PatchDistances patches;
    std::vector<Eigen::Vector3d> points;  // in the frame of the camera
    for (std::size_t i = 0; i < views.size(); ++i) {
      compare_views(views[i], reference[i], options.match_share, patches);
      compare_views(reference[i], views[i], options.match_share, patches);
      for (const Eigen::Vector3d& point : views[i].points)
        if (point.allFinite()) points.push_back(point);
    }
    constexpr std::size_t kFewest = 5;
    if (points.empty() || patches.mean_mm.size() < kFewest) {
      throw Error(ErrorKind::Numeric,
                  fmt::format("camera \"{}\" and the reference camera share {} patches within "
                              "{:.2g} of their distance, too few to compare them: one of them is "
                              "far off, or they see different sides of the part",
                              name,
                              patches.mean_mm.size(),
                              options.match_share));
    }
    CheckLimits limits({scan.rig, camera}, points, options);
    limits.add_spread("against the reference", patches);
    all = joined(std::move(all), limits.result());
  }
  return all;
}

}  // namespace frangia
