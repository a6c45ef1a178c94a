#include "frangia/calibrate/internal/assess_solution.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/median.h"

namespace frangia {
namespace {

/// Poses whose error exceeds this multiple of the median are named.
constexpr double kOutlierRms = 3.0;

/// Reprojection error below which a pose is never named: corners of sharp images have up to this.
constexpr double kOutlierFloor_px = 0.3;

double median_rms_px(const std::vector<ResidualSummary>& by_view) {
  std::vector<double> errors;
  for (const ResidualSummary& summary : by_view)
    if (summary.points > 0) errors.push_back(summary.rms_px);
  return errors.empty() ? 0.0 : median(errors);
}

void warn_of_poses(const std::vector<BoardView>& views,
                   const std::vector<ResidualSummary>& by_view,
                   const std::string& device,
                   const Run& run) {
  const double typical = median_rms_px(by_view);
  for (const std::size_t i : outlier_views(by_view)) {
    run.warn(fmt::format(
        "{}: the reprojection error of {} is {:.2f} px, {:.1f} times the median of all poses; "
        "the board or the camera moved during its capture, or its corners are blurred or badly lit",
        views[i].name,
        device,
        by_view[i].rms_px,
        by_view[i].rms_px / typical));
  }
}

std::string in_words(const SolvedCamera& camera) {
  return camera.name.empty() ? "the camera" : "camera \"" + camera.name + "\"";
}

std::string worst_view(const std::vector<BoardView>& views,
                       const std::vector<ResidualSummary>& by_view) {
  const auto worst =
      std::max_element(by_view.begin(), by_view.end(), [](const auto& a, const auto& b) {
        return a.rms_px < b.rms_px;
      });
  return views[static_cast<std::size_t>(worst - by_view.begin())].name;
}

/// Fails where a camera contradicts the board.
void check_camera(const std::string& device,
                  const ResidualSummary& residuals,
                  const std::vector<ResidualSummary>& by_view,
                  const std::vector<BoardView>& views,
                  double max_rms_px) {
  if (residuals.rms_px <= max_rms_px) return;
  throw Error(ErrorKind::Input,
              fmt::format("the poses contradict each other: the reprojection error of {} is {:.1f} "
                          "px, largest in {}; check board.corners and that the board is stiff",
                          device,
                          residuals.rms_px,
                          worst_view(views, by_view)));
}

/// Fails where the phases that a camera reads contradict the board.
void check_fringes(const std::string& device,
                   const ResidualSummary& residuals,
                   const std::vector<ResidualSummary>& by_view,
                   const std::vector<BoardView>& views,
                   double max_rms_px) {
  if (residuals.rms_px <= max_rms_px) return;
  throw Error(ErrorKind::Input,
              fmt::format("the fringes contradict the board: the projector's reprojection error, "
                          "seen by {}, is {:.1f} px, largest in {}; check the order of the frames, "
                          "shifts_deg and that nothing moved during the capture",
                          device,
                          residuals.rms_px,
                          worst_view(views, by_view)));
}

/// Compares the distance of a device from the reference camera with the one that was stated.
/// Returns whether it was stated.
bool compare_distance(const char* device,
                      const char* key,
                      const Eigen::Vector3d& stated_mm,
                      double found_mm,
                      const Board& board,
                      double max_error,
                      const Run& run) {
  if (!stated_mm.allFinite() || stated_mm.norm() == 0.0) return false;
  const double ratio = stated_mm.norm() / found_mm;
  if (std::abs(ratio - 1.0) < max_error) return true;
  const bool circles = board.kind == BoardKind::Circles;
  run.warn(
      fmt::format("{} is {:.1f} mm from the camera, but {} in rig.toml states {:.1f} mm: if that "
                  "is right, board.{} is {:.3g} mm, not {:g} mm",
                  device,
                  found_mm,
                  key,
                  stated_mm.norm(),
                  circles ? "spacing_mm" : "square_mm",
                  ratio * board.square_mm,
                  board.square_mm));
  return true;
}

}  // namespace

std::vector<std::size_t> outlier_views(const std::vector<ResidualSummary>& by_view) {
  const double limit = std::max(kOutlierRms * median_rms_px(by_view), kOutlierFloor_px);
  std::vector<std::size_t> outliers;
  for (std::size_t i = 0; i < by_view.size(); ++i)
    if (by_view[i].rms_px > limit) outliers.push_back(i);
  return outliers;
}

void warn_of_outliers(const std::vector<BoardView>& views,
                      const RigSolution& solution,
                      const Run& run) {
  for (const SolvedCamera& camera : solution.cameras) {
    const std::string device = in_words(camera);
    const std::string projector =
        camera.name.empty() ? "the projector" : "the projector, seen by " + device + ",";
    warn_of_poses(views, camera.by_view, device, run);
    warn_of_poses(views, camera.projector_by_view, projector, run);
  }
}

void warn_of_scale(const Scan& scan,
                   const RigSolution& solution,
                   double max_error,
                   const Run& run) {
  const double projector_mm = solution.projector_from_camera.translation().norm();
  if (solution.has_projector && compare_distance("the projector",
                                                 "projector.position_mm",
                                                 scan.rig.projector.position_mm,
                                                 projector_mm,
                                                 *scan.board,
                                                 max_error,
                                                 run))
    return;
  for (std::size_t i = 1; i < solution.cameras.size(); ++i) {
    const bool stated = compare_distance(in_words(solution.cameras[i]).c_str(),
                                         fmt::format("more_cameras[{}].position_mm", i - 1).c_str(),
                                         scan.rig.cameras[i].position_mm,
                                         solution.cameras[i].camera_from_rig.translation().norm(),
                                         *scan.board,
                                         max_error,
                                         run);
    if (stated) return;
  }
}

void check_solution(const RigSolution& solution,
                    const std::vector<BoardView>& views,
                    double max_rms_px) {
  if (!solution.undetermined.empty()) {
    throw Error(
        ErrorKind::Input,
        fmt::format("the poses do not determine {}; capture more poses that fill the image and "
                    "are tilted by 20 to 40 degrees, each another way",
                    fmt::join(solution.undetermined, ", ")));
  }
  for (const SolvedCamera& camera : solution.cameras) {
    const std::string device = in_words(camera);
    check_camera(device, camera.residuals, camera.by_view, views, max_rms_px);
    check_fringes(device, camera.projector_residuals, camera.projector_by_view, views, max_rms_px);
  }
}

}  // namespace frangia
