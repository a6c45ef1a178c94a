#include "frangia/calibrate/board/find_charuco.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/board/internal/opencv_image.h"
#include "frangia/calibrate/board/internal/read_markers.h"
#include "frangia/rig/aruco_dictionary.h"
#include "frangia/rig/board.h"

namespace frangia {
namespace {

constexpr std::size_t kFewestMarkers = 6;
constexpr double kPlaced = 0.8;  ///< share of the markers that a layout must explain

/// The smallest dictionary of a size that has a marker.
std::string dictionary_with(int cells, int marker) {
  const int count = marker < 50 ? 50 : marker < 100 ? 100 : 250;
  return fmt::format("DICT_{}X{}_{}", cells, cells, count);
}

/// Markers with ids that count from the first one of a board.
std::vector<SeenMarker> counted_from(std::vector<SeenMarker> markers, int first) {
  for (SeenMarker& marker : markers)
    marker.id -= first;
  return markers;
}

/// How many markers lie where a board has them: those that one homography maps to their squares
/// within a third of a square.
std::size_t count_placed(const std::vector<SeenMarker>& markers, const Board& board) {
  constexpr double kReach = 0.35;  // squares; distortion moves a marker by less
  const std::vector<Eigen::Vector2i> squares = marker_squares(board);
  std::vector<cv::Point2f> pixels;
  std::vector<cv::Point2f> places;
  int lowest = 0;
  int highest = 0;
  for (const SeenMarker& marker : markers) {
    if (marker.id < 0 || static_cast<std::size_t>(marker.id) >= squares.size()) continue;
    const Eigen::Vector2i& square = squares[static_cast<std::size_t>(marker.id)];
    lowest = places.empty() ? square.y() : std::min(lowest, square.y());
    highest = places.empty() ? square.y() : std::max(highest, square.y());
    pixels.push_back(
        0.25F * (marker.corners[0] + marker.corners[1] + marker.corners[2] + marker.corners[3]));
    places.emplace_back(static_cast<float>(square.x()), static_cast<float>(square.y()));
  }
  // Markers of one row or two lie on lines, which many homographies explain.
  if (places.size() < kFewestMarkers || highest - lowest < 2) return 0;
  std::vector<unsigned char> inliers;
  const cv::Mat map = cv::findHomography(pixels, places, cv::RANSAC, kReach, inliers);
  if (map.empty()) return 0;
  return static_cast<std::size_t>(std::count(inliers.begin(), inliers.end(), 1));
}

/// The layout that explains most of the markers: the number of columns, the first id, and which
/// corner is white. The rows follow from the last id that was seen. None where the expected layout
/// explains as many.
void find_layout(const std::vector<SeenMarker>& markers, const Board& expected, OtherCharuco& out) {
  constexpr int kMostColumns = 40;
  constexpr int kManyRows = 99;  // an even number of rows of squares, which the older layout needs
  const std::size_t as_expected = count_placed(counted_from(markers, expected.first_id), expected);
  std::size_t best = std::max(
      static_cast<std::size_t>(kPlaced * static_cast<double>(markers.size())), as_expected + 1);
  for (const int first : {expected.first_id, out.first_id}) {
    if (first > out.first_id) continue;
    const std::vector<SeenMarker> counted = counted_from(markers, first);
    for (int columns = 3; columns <= kMostColumns; ++columns) {
      for (const bool legacy : {false, true}) {
        Board board = expected;
        board.columns = columns;
        board.rows = kManyRows;
        board.legacy_layout = legacy;
        const std::size_t placed = count_placed(counted, board);
        if (placed <= best) continue;
        best = placed;
        const std::vector<Eigen::Vector2i> squares = marker_squares(board);
        out.columns = columns;
        out.rows = squares[static_cast<std::size_t>(out.last_id - first)].y();
        out.legacy_layout = legacy;
        out.layout_first_id = first;
      }
    }
  }
}

/// The ChArUco board that an image shows, if it is clearly another one than the expected one.
///
/// @shape    8-bit image
/// @missing  nullopt: fewer than six markers, or the expected board
std::optional<OtherCharuco> recognize_charuco(const cv::Mat& bytes, const Board& expected) {
  const AnyMarkers seen = read_any_markers(bytes);
  if (seen.markers.size() < kFewestMarkers) return std::nullopt;
  OtherCharuco out;
  out.inverted = seen.inverted;
  out.mirrored = seen.mirrored;
  out.markers = static_cast<int>(seen.markers.size());
  out.first_id = seen.markers.front().id;  // in ascending order
  out.last_id = seen.markers.back().id;
  out.dictionary = dictionary_with(seen.cells, out.last_id);
  const int cells = find_aruco_dictionary(expected.dictionary).value().cells;
  const bool of_its_kind = expected.kind == BoardKind::Charuco && seen.cells == cells &&
                           !seen.inverted && !seen.mirrored;
  if (!seen.mirrored) find_layout(seen.markers, expected, out);
  const auto end = expected.first_id + static_cast<int>(marker_squares(expected).size());
  const auto outside =
      std::count_if(seen.markers.begin(), seen.markers.end(), [&](const SeenMarker& marker) {
        return marker.id < expected.first_id || marker.id >= end;
      });
  // Few markers of the expected board, of which nothing says that it is another one. A square that
  // is read as a marker may have any id.
  const bool other_ids = 5 * static_cast<std::size_t>(outside) >= seen.markers.size();
  if (of_its_kind && !other_ids && out.columns == 0) return std::nullopt;
  return out;
}

/// Corners of the markers in squares of the board, with the first inner corner at (0, 0), and in
/// the image.
struct MarkerCorners {
  std::vector<cv::Point2f> squares;
  std::vector<cv::Point2f> pixels;
};

MarkerCorners corners_of(const std::vector<SeenMarker>& markers, const Board& board) {
  const std::vector<Eigen::Vector2i> squares = marker_squares(board);
  const auto half = static_cast<float>(0.5 * marker_side_mm(board) / board.square_mm);
  MarkerCorners corners;
  for (const SeenMarker& marker : markers) {
    const Eigen::Vector2i& square = squares[static_cast<std::size_t>(marker.id)];
    const cv::Point2f center(static_cast<float>(square.x()) - 0.5F,
                             static_cast<float>(square.y()) - 0.5F);
    const std::array<cv::Point2f, 4> offsets = {
        cv::Point2f(-half, -half), {half, -half}, {half, half}, {-half, half}};
    for (std::size_t i = 0; i < 4; ++i) {
      corners.squares.push_back(center + offsets.at(i));
      corners.pixels.push_back(marker.corners.at(i));
    }
  }
  return corners;
}

/// A corner where the markers around it put it.
struct Prediction {
  int index = 0;
  cv::Point2f pixel;
  cv::Point2f along, across;  ///< steps of one square in x and y of the board, px
  double square_px = 0.0;     ///< length of the shorter step
};

/// The inner corners that touch a marker that was read: its homography maps them to pixels.
std::vector<Prediction> predict(const MarkerCorners& corners, const Board& board) {
  constexpr float kReach = 1.2F;  // squares; the corners of the two markers that touch an inner one
  std::vector<Prediction> predictions;
  for (int index = 0; index < board.columns * board.rows; ++index) {
    const int row = index / board.columns;
    const cv::Point2f at(static_cast<float>(index % board.columns), static_cast<float>(row));
    MarkerCorners near;
    for (std::size_t i = 0; i < corners.squares.size(); ++i) {
      if (cv::norm(corners.squares[i] - at) > kReach) continue;
      near.squares.push_back(corners.squares[i]);
      near.pixels.push_back(corners.pixels[i]);
    }
    if (near.squares.size() < 4) continue;
    const cv::Mat map = cv::findHomography(near.squares, near.pixels);
    if (map.empty()) continue;
    std::vector<cv::Point2f> mapped;
    cv::perspectiveTransform(
        std::vector<cv::Point2f>{at, at + cv::Point2f(1.0F, 0.0F), at + cv::Point2f(0.0F, 1.0F)},
        mapped,
        map);
    const Prediction prediction{
        index,
        mapped[0],
        mapped[1] - mapped[0],
        mapped[2] - mapped[0],
        std::min(cv::norm(mapped[1] - mapped[0]), cv::norm(mapped[2] - mapped[0]))};
    constexpr double kSmallest = 5.0;  // px; a marker would not be read in a smaller square
    if (prediction.square_px > kSmallest) predictions.push_back(prediction);
  }
  return predictions;
}

bool is_inside(const cv::Point2f& pixel, const cv::Mat& image, double margin) {
  return pixel.x >= margin && pixel.y >= margin && pixel.x < image.cols - 1 - margin &&
         pixel.y < image.rows - 1 - margin;
}

float value_at(const cv::Mat& image, const cv::Point2f& pixel) {
  cv::Mat patch;
  cv::getRectSubPix(image, cv::Size(1, 1), pixel, patch);
  return patch.at<float>(0, 0);
}

/// Whether four squares meet at a pixel, the dark ones opposite to each other. An edge of something
/// that hides a part of the board is no corner.
bool is_corner(const cv::Mat& image, const cv::Point2f& pixel, const Prediction& at, double reach) {
  const std::array<cv::Point2f, 4> sides = {
      cv::Point2f(1.0F, 1.0F), {-1.0F, 1.0F}, {-1.0F, -1.0F}, {1.0F, -1.0F}};
  for (const double share : {0.5, 1.0}) {
    const auto step = static_cast<float>(share * reach / at.square_px);
    std::array<float, 4> values{};
    for (std::size_t i = 0; i < 4; ++i) {
      const cv::Point2f& side = sides.at(i);
      const cv::Point2f place = pixel + step * side.x * at.along + step * side.y * at.across;
      if (!is_inside(place, image, 1.0)) return false;
      values.at(i) = value_at(image, place);
    }
    const float one = 0.5F * (values[0] + values[2]);
    const float other = 0.5F * (values[1] + values[3]);
    const float contrast = std::abs(one - other);
    constexpr float kUnequal = 0.4F;  // of the contrast; light that falls off changes less
    if (std::abs(values[0] - values[2]) > kUnequal * contrast ||
        std::abs(values[1] - values[3]) > kUnequal * contrast)
      return false;
  }
  return true;
}

}  // namespace

CharucoSight find_charuco(const Image<float>& counts, const Board& board) {
  check_board(board);
  const cv::Mat linear = opencv_view(counts);
  CharucoSight sight;
  std::vector<SeenMarker> markers = read_markers(display_bytes(linear), board);
  std::vector<SeenMarker> again = read_markers(equalized(linear), board);
  if (again.size() > markers.size()) markers = std::move(again);
  sight.markers = static_cast<int>(markers.size());
  // In a mirrored image some markers of a small dictionary look like others of it.
  const std::size_t half_of_board = marker_squares(board).size() / 2;
  if (markers.size() < half_of_board) {
    const std::size_t mirrored = read_markers(display_bytes(linear), board, true).size();
    if (mirrored > 2 * markers.size()) {
      sight.mirrored_markers = static_cast<int>(mirrored);
      return sight;
    }
  }
  // A board with other ids, or of the older layout, has most of its markers where this board has
  // others, by a shift along its rows: only where rows end they are misplaced.
  constexpr double kPlaced = 0.95;
  const bool misplaced = markers.size() >= 6 && static_cast<double>(count_placed(markers, board)) <
                                                    kPlaced * static_cast<double>(markers.size());
  if (markers.size() < half_of_board || misplaced) {
    sight.other = recognize_charuco(display_bytes(linear), board);
    if (sight.other || markers.empty()) return sight;
  }
  cv::Mat smooth;
  cv::GaussianBlur(linear, smooth, {}, 1.0);
  // The window ends before the marker, whose edges would attract the corner.
  const double gap = 0.5 * (1.0 - marker_side_mm(board) / board.square_mm);
  for (const Prediction& prediction : predict(corners_of(markers, board), board)) {
    const double reach = std::clamp(std::min(0.3, gap) * prediction.square_px, 2.0, 20.0);
    if (!is_inside(prediction.pixel, linear, reach)) continue;
    std::vector<cv::Point2f> corner = {prediction.pixel};
    const int half = static_cast<int>(reach);
    cv::cornerSubPix(smooth,
                     corner,
                     cv::Size(half, half),
                     cv::Size(-1, -1),
                     cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-5));
    constexpr double kFarthest = 0.15;  // of a square; farther away it is another corner
    if (cv::norm(corner[0] - prediction.pixel) > std::max(2.0, kFarthest * prediction.square_px))
      continue;
    if (!is_inside(corner[0], linear, reach) || !is_corner(linear, corner[0], prediction, reach))
      continue;
    BoardPoint point;
    point.index = prediction.index;
    const cv::Point2f place = refine_corner(linear, corner[0], half);
    point.camera_px = {place.x, place.y};
    sight.points.push_back(point);
  }
  return sight;
}

std::optional<OtherCharuco> find_other_charuco(const Image<float>& counts, const Board& board) {
  return recognize_charuco(display_bytes(opencv_view(counts)), board);
}

}  // namespace frangia
