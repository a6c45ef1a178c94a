#include "frangia/calibrate/board/internal/recognize_charuco.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

#include "frangia/rig/aruco_dictionary.h"

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

}  // namespace

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

}  // namespace frangia
