#include "frangia/calibrate/internal/start_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

/// The points of one view as one device sees them.
struct SeenPoints {
  std::vector<cv::Point3f> board_mm;
  std::vector<cv::Point2f> pixels;
};

SeenPoints seen_points(const Board& board,
                       const std::vector<BoardPoint>& points,
                       bool by_projector) {
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(board);
  const Eigen::Vector2d center = 0.5 * (nominal.front() + nominal.back());
  SeenPoints seen;
  for (const BoardPoint& point : points) {
    const Eigen::Vector2d& pixel = by_projector ? point.projector_px : point.camera_px;
    if (!pixel.allFinite()) continue;
    const Eigen::Vector2d place = nominal[static_cast<std::size_t>(point.index)] - center;
    seen.board_mm.emplace_back(static_cast<float>(place.x()), static_cast<float>(place.y()), 0.0F);
    seen.pixels.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
  }
  return seen;
}

constexpr std::size_t kFewestPoints = 6;

/// Focal length and principal point, without distortion.
cv::Mat start_matrix(const std::vector<SeenPoints>& views, int width_px, int height_px) {
  std::vector<std::vector<cv::Point3f>> board;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const SeenPoints& seen : views) {
    if (seen.pixels.size() < kFewestPoints) continue;
    board.push_back(seen.board_mm);
    pixels.push_back(seen.pixels);
  }
  cv::Mat matrix = cv::initCameraMatrix2D(board, pixels, cv::Size(width_px, height_px), 1.0);
  const double focal = matrix.at<double>(0, 0);
  const double longest = std::max(width_px, height_px);
  // Views without tilt leave the focal length open; an ordinary lens is a better start then.
  constexpr double kShortest = 0.2;
  constexpr double kLongest = 20.0;
  constexpr double kOrdinary = 1.5;
  if (!(focal > kShortest * longest && focal < kLongest * longest))
    matrix.at<double>(0, 0) = matrix.at<double>(1, 1) = kOrdinary * longest;
  return matrix;
}

RigParameters::Intrinsics intrinsics_of(const cv::Mat& matrix) {
  return {matrix.at<double>(0, 0),
          1.0,
          matrix.at<double>(0, 2),
          matrix.at<double>(1, 2),
          0.0,
          0.0,
          0.0,
          0.0,
          0.0};
}

RigParameters::Pose pose_of(const SeenPoints& seen, const cv::Mat& matrix) {
  cv::Mat rotation;
  cv::Mat translation;
  cv::solvePnP(seen.board_mm,
               seen.pixels,
               matrix,
               cv::noArray(),
               rotation,
               translation,
               false,
               cv::SOLVEPNP_IPPE);
  cv::solvePnP(seen.board_mm, seen.pixels, matrix, cv::noArray(), rotation, translation, true);
  RigParameters::Pose pose{};
  for (int i = 0; i < 3; ++i) {
    pose.at(static_cast<std::size_t>(i)) = rotation.at<double>(i);
    pose.at(static_cast<std::size_t>(i) + 3) = translation.at<double>(i);
  }
  return pose;
}

/// Mean squared reprojection error of the views with the poses that fit best, px².
double mean_square(const std::vector<SeenPoints>& views, const cv::Mat& matrix) {
  double sum = 0.0;
  double count = 0.0;
  for (const SeenPoints& seen : views) {
    if (seen.pixels.size() < kFewestPoints) continue;
    const RigParameters::Pose pose = pose_of(seen, matrix);
    std::vector<cv::Point2f> projected;
    cv::projectPoints(seen.board_mm,
                      cv::Vec3d(pose[0], pose[1], pose[2]),
                      cv::Vec3d(pose[3], pose[4], pose[5]),
                      matrix,
                      cv::noArray(),
                      projected);
    for (std::size_t i = 0; i < projected.size(); ++i) {
      const cv::Point2f error = projected[i] - seen.pixels[i];
      sum += static_cast<double>(error.dot(error));
      count += 1.0;
    }
  }
  return sum / count;
}

/// The start from the homographies or that of the given model, whichever fits better.
cv::Mat better_matrix(const std::vector<SeenPoints>& views, const CameraModel& given) {
  cv::Mat estimated = start_matrix(views, given.width_px, given.height_px);
  if (!given.focal_px.allFinite()) return estimated;
  cv::Mat known = estimated.clone();
  known.at<double>(0, 0) = known.at<double>(1, 1) = given.focal_px.mean();
  if (given.principal_point_px.allFinite()) {
    known.at<double>(0, 2) = given.principal_point_px.x();
    known.at<double>(1, 2) = given.principal_point_px.y();
  }
  return mean_square(views, known) < mean_square(views, estimated) ? known : estimated;
}

RigParameters::Pose pose_from(const Eigen::Isometry3d& isometry) {
  const Eigen::AngleAxisd turn(isometry.rotation());
  const Eigen::Vector3d rotation = turn.angle() * turn.axis();
  const Eigen::Vector3d& translation = isometry.translation();
  return {
      rotation.x(), rotation.y(), rotation.z(), translation.x(), translation.y(), translation.z()};
}

/// The relative pose that most views agree on: the median of each coordinate.
RigParameters::Pose median_pose(const std::vector<RigParameters::Pose>& poses) {
  RigParameters::Pose result{};
  for (std::size_t i = 0; i < result.size(); ++i) {
    std::vector<double> values;
    for (const RigParameters::Pose& pose : poses)
      values.push_back(pose.at(i));
    result.at(i) = median(values);
  }
  return result;
}

/// Throws for a view whose points cannot fix its pose.
void require_enough_points(const BoardView& view, const SeenPoints& by_camera) {
  if (by_camera.pixels.size() >= kFewestPoints) return;
  throw Error(ErrorKind::Input,
              fmt::format("{}: only {} points of the board are seen; leave the view out",
                          view.name,
                          by_camera.pixels.size()));
}

/// Intrinsics of a device, and its pose relative to the reference camera from its pose relative to
/// the board in each view that it sees.
void start_device(const std::vector<SeenPoints>& seen,
                  const CameraModel& known,
                  const std::vector<RigParameters::Pose>& camera_from_board,
                  RigParameters::Intrinsics& intrinsics,
                  RigParameters::Pose& from_camera) {
  const cv::Mat matrix = better_matrix(seen, known);
  intrinsics = intrinsics_of(matrix);
  std::vector<RigParameters::Pose> relative;
  for (std::size_t view = 0; view < seen.size(); ++view) {
    if (seen[view].pixels.size() < kFewestPoints) continue;
    const Eigen::Isometry3d from_board = isometry_of(pose_of(seen[view], matrix));
    relative.push_back(pose_from(from_board * isometry_of(camera_from_board[view]).inverse()));
  }
  from_camera = median_pose(relative);
}

/// Throws where a further camera sees the board in too few poses.
void require_enough_views(const std::vector<SeenPoints>& seen, const std::string& camera) {
  constexpr std::ptrdiff_t kFewestViews = 3;
  const auto enough = std::count_if(seen.begin(), seen.end(), [](const SeenPoints& points) {
    return points.pixels.size() >= kFewestPoints;
  });
  if (enough >= kFewestViews) return;
  throw Error(ErrorKind::Input,
              fmt::format("camera \"{}\" sees the board in {} of the poses, and {} are needed; "
                          "capture poses that all cameras see",
                          camera,
                          enough,
                          kFewestViews));
}

RigParameters start_by_opencv(const Board& board,
                              std::span<const BoardView> views,
                              const Rig& known) {
  std::vector<SeenPoints> by_camera;
  std::vector<SeenPoints> by_projector;
  for (const BoardView& view : views) {
    by_camera.push_back(seen_points(board, view.points, false));
    by_projector.push_back(seen_points(board, view.points, true));
    require_enough_points(view, by_camera.back());
  }
  RigParameters parameters;
  const cv::Mat camera = better_matrix(by_camera, known.reference().model);
  parameters.cameras.front().intrinsics = intrinsics_of(camera);
  for (const SeenPoints& seen : by_camera)
    parameters.camera_from_board.push_back(pose_of(seen, camera));
  if (!known.projector.is_label) {
    start_device(by_projector,
                 std::get<PinholeModel>(known.projector.model),
                 parameters.camera_from_board,
                 parameters.projector,
                 parameters.projector_from_camera);
  }
  for (std::size_t i = 1; i < known.cameras.size(); ++i) {
    std::vector<SeenPoints> seen;
    for (const BoardView& view : views) {
      seen.push_back(i <= view.more.size() ? seen_points(board, points_of(view, i), false)
                                           : SeenPoints{});
    }
    const Camera& further = known.cameras[i].camera;
    require_enough_views(seen, further.name);
    RigParameters::PosedIntrinsics& start = parameters.cameras.emplace_back();
    start_device(
        seen, further.model, parameters.camera_from_board, start.intrinsics, start.from_reference);
  }
  return parameters;
}

}  // namespace

RigParameters start_values(const Board& board, std::span<const BoardView> views, const Rig& known) {
  try {
    return start_by_opencv(board, views, known);
  } catch (const cv::Exception& error) {
    throw Error(ErrorKind::Input,
                fmt::format("the points of the board do not give a pose; check board.corners and "
                            "capture the poses again (OpenCV: {})",
                            error.err));
  }
}

namespace {

/// Drop of the weighted squares for each term: far above what noise gives (1), because the errors
/// of neighbouring sites are not quite independent.
constexpr double kLeastGain = 20.0;
/// Share of a term that the other parameters leave free; below, its value would be chance.
constexpr double kLeastFree = 1e-6;

/// Drop of the weighted squares for each of the added columns.
double gain_of(const ArtifactLinearization& full,
               const std::vector<Eigen::Index>& active,
               const std::vector<Eigen::Index>& added) {
  if (added.empty()) return 0.0;
  const Eigen::MatrixXd own = full.normal(active, active);
  const Eigen::VectorXd slope_of_own = full.gradient(active);
  const Eigen::MatrixXd coupling = full.normal(active, added);
  const Eigen::MatrixXd alone = full.normal(added, added);
  const Eigen::VectorXd scale = alone.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd free =
      scale.asDiagonal() * (alone - coupling.transpose() * solve_symmetric_columns(own, coupling)) *
      scale.asDiagonal();
  if (symmetric_eigen(free).values[0] < kLeastFree) return 0.0;
  const Eigen::VectorXd slope =
      scale.asDiagonal() *
      (full.gradient(added) - coupling.transpose() * solve_symmetric(own, slope_of_own));
  return slope.dot(solve_symmetric(free, slope)) / static_cast<double>(added.size());
}

}  // namespace

std::array<bool, Wavefront::kTerms> missing_wavefront_terms(const ArtifactProblem& problem,
                                                            const ArtifactNoise& noise,
                                                            const ArtifactParameters& parameters) {
  std::array<bool, Wavefront::kTerms> missing{};
  if (!problem.start.projector.is_angular()) return missing;
  ArtifactProblem whole = problem;
  whole.free_wavefront.fill(true);
  const ArtifactLinearization full = linearize_artifacts(whole, noise, parameters);
  std::vector<Eigen::Index> active;
  std::vector<Eigen::Index> second;
  std::vector<Eigen::Index> third;
  for (std::size_t i = 0; i < full.names.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    std::size_t term = 0;
    while (term < Wavefront::kTerms && full.names[i] != Wavefront::parameter_name(term))
      ++term;
    if (term == Wavefront::kTerms || problem.free_wavefront.at(term)) {
      active.push_back(column);
    } else {
      (term < Wavefront::kSecondOrder ? second : third).push_back(column);
    }
  }
  const bool has_second = gain_of(full, active, second) > kLeastGain;
  std::vector<Eigen::Index> with_second = active;
  with_second.insert(with_second.end(), second.begin(), second.end());
  const bool has_third = gain_of(full, second.empty() ? active : with_second, third) > kLeastGain;
  for (std::size_t term = 0; term < Wavefront::kTerms; ++term) {
    const bool is_second = term < Wavefront::kSecondOrder;
    missing.at(term) = !problem.free_wavefront.at(term) && (is_second ? has_second : has_third);
  }
  return missing;
}

}  // namespace frangia
