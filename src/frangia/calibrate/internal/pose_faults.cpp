#include "frangia/calibrate/internal/pose_faults.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/calib3d.hpp>

#include "frangia/core/statistics.h"

namespace frangia {
namespace {

/// Blur of an image without the board, relative to images with it, above which it explains why the
/// board is not found: a ChArUco board is lost at 2.5 px, and sharp images have 0.7 px.
constexpr double kUnseenBlur = 1.7;

/// The first of some poses.
const PoseCapture& pose_named(std::span<const PoseCapture> poses, const std::string& name) {
  return *std::find_if(
      poses.begin(), poses.end(), [&](const auto& pose) { return pose.view.name == name; });
}

}  // namespace

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 6;
  if (names.size() <= kMost) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format(
      "{} and {} more", fmt::join(std::span(names).first(kMost), ", "), names.size() - kMost);
}

std::string describe_dark(const std::vector<std::string>& names, const PoseCheckOptions& options) {
  return fmt::format(
      "the board is too dark in {}: its light squares reach less than {:.0f} % of white; expose "
      "longer or open the aperture",
      list_of(names),
      100.0 * options.dim);
}

std::string describe_overexposed(const std::vector<std::string>& names,
                                 const PoseCheckOptions& options) {
  return fmt::format(
      "the board is overexposed in {}: more than {:.0f} % of its pixels are saturated; expose "
      "shorter",
      list_of(names),
      100.0 * options.saturated);
}

std::string describe_swapped(std::span<const PoseCapture> poses,
                             const std::vector<std::string>& names) {
  if (names.empty()) return {};
  return fmt::format(
      "the frames of pattern \"{}\" in {} do not follow its shifts: frames are swapped or out of "
      "step, or shifts_deg in scan.toml is wrong",
      pose_named(poses, names.front()).misfit_in,
      list_of(names));
}

std::string describe_blurred(std::span<const PoseCapture> poses,
                             const std::vector<std::string>& names) {
  if (names.empty()) return {};
  return fmt::format(
      "the board is out of focus or moving in {}: its edges are blurred by {:.1f} px; close the "
      "aperture or place the board nearer to the focus",
      list_of(names),
      pose_named(poses, names.front()).blur_px);
}

std::string describe_exchanged(std::span<const PoseCapture> poses,
                               const std::vector<std::string>& names) {
  if (names.empty()) return {};
  return fmt::format(
      "pattern \"{}\" in {} shows the board at another place than the other frames of the view: "
      "frames of two views are exchanged, or the board was moved between the patterns",
      pose_named(poses, names.front()).least_like,
      list_of(names));
}

std::string describe_moved(std::span<const PoseCapture> poses,
                           const std::vector<std::string>& names) {
  if (names.empty()) return {};
  const PoseCapture& first = pose_named(poses, names.front());
  return fmt::format(
      "the board or the camera moved during the capture of {}, by {:.1f} px up to "
      "pattern \"{}\"; fix both while a pose is captured",
      list_of(names),
      first.motion_px,
      first.moved_in);
}

double plane_misfit_px(const Board& board, const BoardView& view) {
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(board);
  std::vector<cv::Point2d> plane;
  std::vector<cv::Point2d> pixels;
  for (const BoardPoint& point : view.points) {
    if (!point.projector_px.allFinite()) continue;
    const Eigen::Vector2d& place = nominal[static_cast<std::size_t>(point.index)];
    plane.emplace_back(place.x(), place.y());
    pixels.emplace_back(point.projector_px.x(), point.projector_px.y());
  }
  constexpr std::size_t kFewest = 6;
  if (plane.size() < kFewest) return 0.0;
  const cv::Mat map = cv::findHomography(plane, pixels);
  if (map.empty()) return std::numeric_limits<double>::infinity();
  std::vector<cv::Point2d> mapped;
  cv::perspectiveTransform(plane, mapped, map);
  std::vector<double> distances;
  for (std::size_t i = 0; i < mapped.size(); ++i)
    distances.push_back(cv::norm(mapped[i] - pixels[i]));
  return median(distances);
}

std::vector<std::string> copies_of_others(std::span<const PoseCapture> poses) {
  const auto alike = [](const PoseCapture& a, const PoseCapture& b) {
    return std::equal(a.view.points.begin(),
                      a.view.points.end(),
                      b.view.points.begin(),
                      b.view.points.end(),
                      [](const BoardPoint& one, const BoardPoint& other) {
                        return one.index == other.index && one.camera_px == other.camera_px;
                      });
  };
  std::vector<std::string> copies;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const bool known = std::any_of(poses.begin(),
                                   poses.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const PoseCapture& one) { return alike(one, poses[i]); });
    if (known) copies.push_back(poses[i].view.name);
  }
  return copies;
}

std::string describe_copies(const std::vector<std::string>& names) {
  return fmt::format(
      "{} {} the very image of another view: copied files are no further poses; capture the board "
      "in another place",
      list_of(names),
      names.size() == 1 ? "holds" : "hold");
}

std::vector<std::string> blurred_unseen(std::span<const PoseCapture> poses) {
  std::vector<double> blurs;
  std::vector<double> contrasts;
  for (const PoseCapture& pose : poses) {
    if (pose.view.points.empty() || !(pose.image.contrast > 0.0)) continue;
    blurs.push_back(pose.image.blur_px);
    contrasts.push_back(pose.image.contrast);
  }
  if (blurs.empty()) return {};
  const double most_blur = kUnseenBlur * median(blurs);
  const double least_contrast = 0.5 * median(contrasts);
  return names_of(poses, [&](const PoseCapture& pose) {
    return pose.view.points.empty() && pose.image.blur_px > most_blur &&
           pose.image.contrast > least_contrast;
  });
}

void warn_of_quality(std::span<const PoseCapture> poses,
                     const PoseCheckOptions& options,
                     PoseChecks& checks) {
  std::vector<double> misfits;
  for (const PoseCapture& pose : poses)
    if (pose.misfit > 0.0) misfits.push_back(pose.misfit);
  if (!misfits.empty() && median(misfits) > options.max_misfit) {
    checks.warnings.push_back(
        fmt::format("the projector is not linear: its fringes deviate from a sinusoid by {:.0f} % "
                    "of their modulation; switch off its gamma and image enhancement, or measure "
                    "its response",
                    100.0 * median(misfits)));
  }
  const auto blurred =
      names_of(poses, [&](const PoseCapture& pose) { return is_blurred(pose, options); });
  if (!blurred.empty()) checks.warnings.push_back(describe_blurred(poses, blurred));
}

}  // namespace frangia
