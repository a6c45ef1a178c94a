#include "frangia/calibrate/board/check_board_views.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/calibrate/board/internal/read_markers.h"
#include "frangia/calibrate/internal/pose_faults.h"
#include "frangia/calibrate/internal/start_values.h"
#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

/// Least number of poses that show the board; Zhang's method needs three.
constexpr std::size_t kMinViews = 3;

/// Least of the largest angles between two poses; below it all boards are parallel.
constexpr double kMinTilt_deg = 5.0;

/// Motion of the board between patterns above which a pose is left out: the reprojection error of
/// good poses.
constexpr double kMaxMotion_px = 0.3;

/// Likeness of a pattern below which it shows the board in another pose; sound ones have 0.95.
constexpr double kMinLikeness = 0.5;

/// Misfit above which the frames are not those of the pattern's shifts; half of what swapped frames
/// give, and twice that of a gamma of 2.2.
constexpr double kWrongFrames = 0.7;

/// Median distance of the projector pixels from a homography of the board above which the phases of
/// a pose are wrong; distortion causes 2 px.
constexpr double kMaxPlane_px = 6.0;

/// Least share of a board's points with projector coordinates.
constexpr double kMinLit = 0.5;

[[noreturn]] void fail(const std::string& sentence) {
  throw Error(ErrorKind::Input, sentence);
}

std::string views(std::size_t count) {
  return fmt::format("{} {}", count, count == 1 ? "view" : "views");
}

/// Numbers of inner corners along the longer and the shorter side of a checkerboard.
using CornerCounts = std::array<int, 2>;

CornerCounts stated_counts(const Board& board) {
  return {std::max(board.columns, board.rows), std::min(board.columns, board.rows)};
}

[[noreturn]] void fail_counts(const Board& board, const CornerCounts& seen, std::size_t count) {
  fail(
      fmt::format("board.corners in scan.toml is [{}, {}], but {} {} a checkerboard of {} x {} "
                  "inner corners; set corners = [{}, {}]",
                  board.columns,
                  board.rows,
                  views(count),
                  count == 1 ? "shows" : "show",
                  seen[0],
                  seen[1],
                  seen[0],
                  seen[1]));
}

std::size_t count_found(std::span<const PoseCapture> poses) {
  return static_cast<std::size_t>(std::count_if(
      poses.begin(), poses.end(), [](const auto& pose) { return !pose.view.points.empty(); }));
}

/// The number of corners that most views show of those that `wanted` accepts, and the number of
/// views; 0 if there is none.
template <typename Wanted>
std::pair<CornerCounts, std::size_t> most_seen(std::span<const PoseCapture> poses,
                                               const Wanted& wanted) {
  std::map<CornerCounts, std::size_t> seen;
  for (const PoseCapture& pose : poses)
    if (pose.counted && wanted(*pose.counted)) ++seen[*pose.counted];
  const auto most = std::max_element(
      seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == seen.end()) return {};
  return {most->first, most->second};
}

/// Fails when views show a larger checkerboard than the expected one, which may be found as a part
/// of it elsewhere: two views suffice if they are not far fewer than those. Where there is no
/// larger one, none is seen.
void check_larger_counts(std::span<const PoseCapture> poses, const Board& board) {
  const CornerCounts stated = stated_counts(board);
  const auto is_larger = [&](const CornerCounts& seen) {
    return seen != stated && seen[0] >= stated[0] && seen[1] >= stated[1];
  };
  const auto all = static_cast<std::size_t>(
      std::count_if(poses.begin(), poses.end(), [&](const PoseCapture& pose) {
        return pose.counted && is_larger(*pose.counted);
      }));
  if (all < 2 || 2 * all <= count_found(poses)) return;
  const auto [counts, count] = most_seen(poses, is_larger);
  fail_counts(board, counts, count);
}

/// Fails when most of the views in which corners can be counted, at least two and more than show
/// the expected board, show a checkerboard of one other size. Noise may look like a small one.
void check_counts(std::span<const PoseCapture> poses, const Board& board) {
  const CornerCounts stated = stated_counts(board);
  const auto counted = static_cast<std::size_t>(std::count_if(
      poses.begin(), poses.end(), [](const auto& pose) { return pose.counted.has_value(); }));
  const std::size_t expected = count_found(poses);
  const auto [counts, count] = most_seen(poses, [](const CornerCounts&) { return true; });
  if (count < 2 || count <= expected || 2 * count <= counted || counts == stated) return;
  // Where the expected board is seen at all, a much smaller one is a part of it or noise.
  const bool is_much_smaller = 2 * counts[0] * counts[1] < stated[0] * stated[1];
  if (expected > 0 && is_much_smaller) return;
  fail_counts(board, counts, count);
}

/// Fails when only mirrored images show the markers of the board.
void check_markers(std::span<const PoseCapture> poses) {
  std::size_t mirrored = 0;
  for (const PoseCapture& pose : poses)
    if (pose.mirrored_markers > 1) ++mirrored;
  if (mirrored < 2 || 2 * mirrored <= poses.size()) return;
  fail(
      fmt::format("the images of {} show the markers of the board mirrored: switch off the "
                  "camera's mirroring, or print the board again without mirroring",
                  views(mirrored)));
}

/// Fails when the light explains why a board is not found.
void check_light(std::span<const PoseCapture> poses, const PoseCheckOptions& options) {
  const auto dark =
      names_of(poses, [&](const PoseCapture& pose) { return pose.brightness < options.dim; });
  if (!dark.empty()) fail(describe_dark(dark, options));
  const auto bright =
      names_of(poses, [&](const PoseCapture& pose) { return pose.saturated > options.saturated; });
  if (!bright.empty()) fail(describe_overexposed(bright, options));
}

std::size_t lit_points(const BoardView& view) {
  return static_cast<std::size_t>(
      std::count_if(view.points.begin(), view.points.end(), [](const BoardPoint& point) {
        return point.projector_px.allFinite();
      }));
}

bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether enough points of a pose have projector coordinates.
bool is_lit(const PoseCapture& pose) {
  return static_cast<double>(lit_points(pose.view)) >=
         kMinLit * static_cast<double>(pose.view.points.size());
}

/// The affine map from camera pixels to projector pixels over one board.
Eigen::Matrix2d camera_to_projector(const BoardView& view) {
  const auto count = static_cast<Eigen::Index>(lit_points(view));
  Eigen::MatrixXd terms(count, 3);
  Eigen::MatrixXd pixels(count, 2);
  Eigen::Index row = 0;
  for (const BoardPoint& point : view.points) {
    if (!point.projector_px.allFinite()) continue;
    terms.row(row) << 1.0, point.camera_px.x(), point.camera_px.y();
    pixels.row(row) = point.projector_px.transpose();
    ++row;
  }
  const Eigen::MatrixXd solution = least_squares(terms, pixels);
  return solution.bottomRows(2).transpose();
}

/// Fails when camera and projector see the board in opposite handedness.
void check_handedness(std::span<const PoseCapture> poses) {
  std::size_t mirrored = 0;
  std::size_t exchanged = 0;
  for (const PoseCapture& pose : poses) {
    const Eigen::Matrix2d map = camera_to_projector(pose.view);
    if (map.determinant() >= 0.0) continue;
    ++mirrored;
    const double along = std::abs(map(0, 0)) + std::abs(map(1, 1));
    const double across = std::abs(map(0, 1)) + std::abs(map(1, 0));
    if (across > along) ++exchanged;
  }
  if (2 * mirrored <= poses.size()) return;
  if (2 * exchanged > mirrored) {
    fail(
        "rows and columns of the projector are exchanged: exchange the values \"vertical\" and "
        "\"horizontal\" of the key direction in scan.toml");
  }
  fail(
      "one fringe direction runs backwards, so that the projector's or the camera's image is "
      "mirrored: switch off their mirroring (a ChArUco board tells which), or reverse the sign of "
      "shifts_deg of that direction");
}

void check_range(std::span<const PoseCapture> poses, const CameraModel& projector) {
  std::size_t outside = 0;
  std::size_t all = 0;
  constexpr double kMargin = 0.02;  // of the side; distortion of the fit at the edge
  for (const PoseCapture& pose : poses) {
    for (const BoardPoint& point : pose.view.points) {
      if (!point.projector_px.allFinite()) continue;
      const Eigen::Vector2d share(point.projector_px.x() / projector.width_px,
                                  point.projector_px.y() / projector.height_px);
      ++all;
      if (share.minCoeff() < -kMargin || share.maxCoeff() > 1.0 + kMargin) ++outside;
    }
  }
  if (10 * outside <= all) return;
  fail(
      fmt::format("{} of {} points of the board lie outside of the projector of {} x {} pixels; "
                  "check projector.size_px and the periods and directions of the patterns",
                  outside,
                  all,
                  projector.width_px,
                  projector.height_px));
}

/// Fails because the board is found in too few views, and says why it is not in the others.
[[noreturn]] void fail_too_few(std::span<const PoseCapture> poses,
                               std::size_t found,
                               const Board& board,
                               const PoseCheckOptions& options) {
  const auto unseen =
      names_of(poses, [](const PoseCapture& pose) { return pose.view.points.empty(); });
  if (!unseen.empty()) {
    check_markers(poses);
    if (const std::string other = describe_other_board(poses, board); !other.empty()) fail(other);
    check_counts(poses, board);
  }
  check_light(poses, options);
  if (unseen.empty()) {
    fail(fmt::format("the scan has {}; capture at least {} poses, each tilted another way",
                     views(found),
                     kMinViews));
  }
  fail(
      fmt::format("the board is found in {} of {}, and {} are needed; it is not found in {}: "
                  "show all of it, flat, sharp and lit",
                  found,
                  views(poses.size()),
                  kMinViews,
                  list_of(unseen)));
}

/// Largest angle between the normals of two poses.
double largest_tilt_rad(std::span<const BoardView> found, const Board& board, const Rig& known) {
  const RigParameters start = start_values(board, found, known);
  std::vector<Eigen::Vector3d> normals;
  for (const RigParameters::Pose& pose : start.camera_from_board)
    normals.emplace_back(isometry_of(pose).linear().col(2));
  double largest = 0.0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      largest = std::max(largest, std::acos(std::min(1.0, normals[i].dot(normals[k]))));
  }
  return largest;
}

/// Fails when all poses are nearly parallel.
void check_tilt(const std::vector<PoseCapture>& seen, const Board& board, const Rig& known) {
  std::vector<BoardView> found;
  found.reserve(seen.size());
  for (const PoseCapture& pose : seen)
    found.push_back(pose.view);
  const double tilt_rad = largest_tilt_rad(found, board, known);
  if (deg_from_rad(tilt_rad) >= kMinTilt_deg) return;
  fail(
      fmt::format("all poses of the board are parallel within {:.1f} degrees, which leaves the "
                  "focal lengths open; tilt the board by 20 to 40 degrees, each time another way",
                  deg_from_rad(tilt_rad)));
}

/// The poses that passed so far. Those of a fault are left out until too few would be left; then
/// the fault is an error.
class PassedPoses {
 public:
  PassedPoses(std::span<const PoseCapture> poses, std::size_t fewest) : fewest_(fewest) {
    for (const PoseCapture& pose : poses)
      if (!pose.view.points.empty()) seen.push_back(pose);
  }

  std::vector<PoseCapture> seen;
  PoseChecks checks;

  [[noreturn]] void fail_by(const std::string& reason) const { fail(earlier_ + reason); }

  void leave_out(const std::vector<std::string>& names, const std::string& reason) {
    if (names.empty()) return;
    if (seen.size() - names.size() < fewest_) fail_by(reason);
    earlier_ += reason + "; besides, ";
    std::erase_if(seen, [&](const PoseCapture& pose) { return is_among(pose.view.name, names); });
    checks.left_out.insert(checks.left_out.end(), names.begin(), names.end());
    checks.warnings.push_back(fmt::format(
        "{}; {} left out", reason, names.size() == 1 ? "this view is" : "these views are"));
  }

 private:
  std::size_t fewest_;
  std::string earlier_;  ///< what is wrong with the poses that were left out
};

/// Leaves out copies of other views, and views in the wrong light.
void check_light(PassedPoses& passed, const PoseCheckOptions& options) {
  const std::vector<PoseCapture>& seen = passed.seen;
  const auto copies = copies_of_others(seen);
  passed.leave_out(copies, describe_copies(copies));
  const auto bright =
      names_of(seen, [&](const PoseCapture& pose) { return pose.saturated > options.saturated; });
  passed.leave_out(bright, describe_overexposed(bright, options));
  const auto dark = names_of(seen, [&](const PoseCapture& pose) {
    return pose.brightness < options.dim && !is_lit(pose);
  });
  passed.leave_out(dark, describe_dark(dark, options));
}

/// Leaves out views whose frames do not belong together or show no fringes. `count`: all views.
void check_frames(PassedPoses& passed, std::size_t count, const PoseCheckOptions& options) {
  const std::vector<PoseCapture>& seen = passed.seen;
  // Coarse blur lets the fringes about the points look like those of other frames, or vanish.
  const auto blurred = names_of(seen, [&](const PoseCapture& pose) {
    const bool unusable = pose.misfit > kWrongFrames || !is_lit(pose);
    return unusable && is_blurred(pose, options);
  });
  passed.leave_out(blurred, describe_blurred(seen, blurred));
  const auto swapped =
      names_of(seen, [&](const PoseCapture& pose) { return pose.misfit > kWrongFrames; });
  // Most poses: not a slip of one capture, and the phases of the others say nothing either.
  if (2 * swapped.size() > count) passed.fail_by(describe_swapped(seen, swapped));
  passed.leave_out(swapped, describe_swapped(seen, swapped));
  const auto exchanged =
      names_of(seen, [&](const PoseCapture& pose) { return pose.likeness < kMinLikeness; });
  passed.leave_out(exchanged, describe_exchanged(seen, exchanged));
  // The detected position of a blurred corner depends on the fringes around it. Such a pose is not
  // left out: a warning names it.
  const auto moved = names_of(seen, [&](const PoseCapture& pose) {
    return pose.motion_px > kMaxMotion_px && !is_blurred(pose, options);
  });
  passed.leave_out(moved, describe_moved(seen, moved));
  const auto without_phase = names_of(seen, [&](const PoseCapture& pose) { return !is_lit(pose); });
  passed.leave_out(
      without_phase,
      fmt::format("the fringes cannot be measured on the board in {}: light the whole board "
                  "by the projector, in focus and out of bright room light",
                  list_of(without_phase)));
}

}  // namespace

PoseChecks check_board_views(std::span<const PoseCapture> poses,
                             const Board& board,
                             const Rig& known,
                             const PoseCheckOptions& options) {
  const auto& projector = std::get<PinholeModel>(known.projector.model);
  PassedPoses passed(poses, kMinViews);
  const std::vector<PoseCapture>& seen = passed.seen;
  check_larger_counts(poses, board);
  if (seen.size() < kMinViews) fail_too_few(poses, seen.size(), board, options);
  const auto unfocused = blurred_unseen(poses);
  if (!unfocused.empty()) {
    passed.checks.warnings.push_back(
        fmt::format("the image is out of focus or moving in {}, so that the board is not found "
                    "there; close the aperture or place the board nearer to the focus",
                    list_of(unfocused)));
  }
  check_light(passed, options);
  check_frames(passed, poses.size(), options);
  check_handedness(seen);
  check_range(seen, projector);
  const auto uneven = names_of(seen, [&](const PoseCapture& pose) {
    return plane_misfit_px(board, pose.view) > kMaxPlane_px;
  });
  passed.leave_out(
      uneven,
      fmt::format("the phases on the board in {} are not those of a plane: frames are "
                  "swapped, missing or out of step, or shifts_deg or period_px are wrong",
                  list_of(uneven)));
  warn_of_quality(seen, options, passed.checks);
  check_tilt(seen, board, known);
  return std::move(passed.checks);
}

}  // namespace frangia
