#include "frangia/calibrate/board/internal/read_markers.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "frangia/rig/aruco_dictionary.h"

namespace frangia {
namespace {

using Quad = std::array<cv::Point2f, 4>;

/// Dark convex quadrangles, clockwise as seen in the image.
std::vector<Quad> dark_quads(const cv::Mat& bytes) {
  constexpr std::array kWindows = {13, 31, 73};  // px; a window wider than a cell separates it
  constexpr double kOffset = 5.0;                // counts below the mean of the window
  constexpr double kShortest = 8.0;              // px; a cell then spans a pixel
  constexpr double kTolerance = 0.04;            // of the perimeter
  std::vector<Quad> quads;
  for (const int window : kWindows) {
    cv::Mat dark;
    cv::adaptiveThreshold(
        bytes, dark, 255, cv::ADAPTIVE_THRESH_MEAN_C, cv::THRESH_BINARY_INV, window, kOffset);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(dark, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    for (const std::vector<cv::Point>& contour : contours) {
      if (static_cast<double>(contour.size()) < 4.0 * kShortest) continue;
      std::vector<cv::Point> polygon;
      cv::approxPolyDP(contour, polygon, kTolerance * static_cast<double>(contour.size()), true);
      if (polygon.size() != 4 || !cv::isContourConvex(polygon)) continue;
      double shortest = cv::norm(polygon[3] - polygon[0]);
      for (std::size_t i = 0; i < 3; ++i)
        shortest = std::min(shortest, cv::norm(polygon[i + 1] - polygon[i]));
      if (shortest < kShortest) continue;
      if (cv::contourArea(polygon, true) < 0.0) std::reverse(polygon.begin(), polygon.end());
      Quad quad;
      for (std::size_t i = 0; i < 4; ++i)
        quad.at(i) = polygon[i];
      quads.push_back(quad);
    }
  }
  return quads;
}

/// White cells of a quadrangle, or nothing where its border is not black.
std::optional<std::uint64_t> cells_of(const cv::Mat& bytes, const Quad& quad, int cells) {
  constexpr int kCell = 8;  // px of the rectified marker
  const int all = cells + 2;
  const auto side = static_cast<float>(all * kCell);
  const Quad square = {cv::Point2f(-0.5F, -0.5F),
                       cv::Point2f(side - 0.5F, -0.5F),
                       cv::Point2f(side - 0.5F, side - 0.5F),
                       cv::Point2f(-0.5F, side - 0.5F)};
  cv::Mat flat;
  cv::warpPerspective(bytes,
                      flat,
                      cv::getPerspectiveTransform(quad.data(), square.data()),
                      cv::Size(all * kCell, all * kCell));
  cv::Mat binary;
  cv::threshold(flat, binary, 0.0, 1.0, cv::THRESH_BINARY | cv::THRESH_OTSU);
  std::uint64_t bits = 0;
  int white_border = 0;
  for (int row = 0; row < all; ++row) {
    for (int column = 0; column < all; ++column) {
      constexpr int kEdge = 2;  // px left out around a cell
      const cv::Rect inside(
          column * kCell + kEdge, row * kCell + kEdge, kCell - 2 * kEdge, kCell - 2 * kEdge);
      const bool white = 2 * cv::countNonZero(binary(inside)) > inside.area();
      if (row == 0 || column == 0 || row == all - 1 || column == all - 1) {
        white_border += white ? 1 : 0;
      } else {
        bits = bits << 1U | (white ? 1U : 0U);
      }
    }
  }
  if (4 * white_border > all) return std::nullopt;  // a sixteenth of the border
  return bits;
}

/// The cells turned by a quarter, clockwise.
std::uint64_t turned(std::uint64_t bits, int cells) {
  std::uint64_t out = 0;
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const int from = cells * cells - 1 - ((cells - 1 - column) * cells + row);
      out = out << 1U | (bits >> static_cast<unsigned>(from) & 1U);
    }
  }
  return out;
}

struct Match {
  int id = 0;
  int quarters = 0;  ///< clockwise turns of the printed marker
};

/// The markers of one board in all directions.
class MarkerTable {
 public:
  /// `first` is the id of the first of some markers, which gets the id 0.
  MarkerTable(const ArucoDictionary& dictionary, int first, int markers) {
    for (int id = 0; id < markers; ++id) {
      std::uint64_t bits = aruco_bits(dictionary, first + id);
      for (int quarters = 0; quarters < 4; ++quarters) {
        codes_.push_back({bits, {id, quarters}});
        bits = turned(bits, dictionary.cells);
      }
    }
    int least = dictionary.cells * dictionary.cells;
    for (std::size_t i = 0; i < codes_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        least = std::min(least, std::popcount(codes_[i].bits ^ codes_[k].bits));
    // Half of what a Hamming code can correct, so that other squares are not read as markers.
    correct_ = (least - 1) / 4;
  }

  [[nodiscard]] std::optional<Match> find(std::uint64_t bits) const {
    for (const Code& code : codes_)
      if (std::popcount(code.bits ^ bits) <= correct_) return code.match;
    return std::nullopt;
  }

 private:
  struct Code {
    std::uint64_t bits;
    Match match;
  };
  std::vector<Code> codes_;
  int correct_ = 0;
};

/// The marker of a table that a quadrangle shows.
std::optional<SeenMarker> marker_in(
    const cv::Mat& bytes, Quad quad, const MarkerTable& table, int cells, bool mirrored) {
  if (mirrored) std::reverse(quad.begin(), quad.end());
  const auto bits = cells_of(bytes, quad, cells);
  if (!bits) return std::nullopt;
  const auto match = table.find(*bits);
  if (!match) return std::nullopt;
  // A marker turned clockwise by a quarter shows its first corner at the second of the image.
  std::rotate(quad.begin(), quad.begin() + match->quarters, quad.end());
  return SeenMarker{match->id, quad};
}

/// The markers of a table in some quadrangles of an image, the first one of each id.
std::vector<SeenMarker> markers_in(const cv::Mat& bytes,
                                   const std::vector<Quad>& quads,
                                   const MarkerTable& table,
                                   int cells,
                                   bool mirrored) {
  std::map<int, SeenMarker> seen;
  for (const Quad& quad : quads) {
    if (const auto marker = marker_in(bytes, quad, table, cells, mirrored))
      seen.try_emplace(marker->id, *marker);
  }
  std::vector<SeenMarker> markers;
  for (const auto& [id, marker] : seen)
    markers.push_back(marker);
  return markers;
}

cv::Point2f center_of(const SeenMarker& marker) {
  return 0.25F * (marker.corners[0] + marker.corners[1] + marker.corners[2] + marker.corners[3]);
}

}  // namespace

std::vector<SeenMarker> read_markers(const cv::Mat& bytes, const Board& board, bool mirrored) {
  const ArucoDictionary dictionary = find_aruco_dictionary(board.dictionary).value();
  const MarkerTable table(
      dictionary, board.first_id, static_cast<int>(marker_squares(board).size()));
  return markers_in(bytes, dark_quads(bytes), table, dictionary.cells, mirrored);
}

std::vector<SeenMarker> read_all_markers(const cv::Mat& bytes, const ArucoDictionary& dictionary) {
  const MarkerTable table(dictionary, 0, dictionary.markers);
  std::vector<SeenMarker> markers;
  for (const Quad& quad : dark_quads(bytes)) {
    const auto marker = marker_in(bytes, quad, table, dictionary.cells, false);
    if (!marker) continue;
    const double side_px = cv::norm(marker->corners[1] - marker->corners[0]);
    const bool known = std::any_of(markers.begin(), markers.end(), [&](const SeenMarker& other) {
      return other.id == marker->id &&
             cv::norm(center_of(other) - center_of(*marker)) < 0.5 * side_px;
    });
    if (!known) markers.push_back(*marker);
  }
  return markers;
}

AnyMarkers read_any_markers(const cv::Mat& bytes) {
  constexpr int kAll = 250;  // of the largest dictionaries, whose first ones are the smaller ones
  AnyMarkers most;
  cv::Mat inverse;
  cv::bitwise_not(bytes, inverse);
  for (const bool inverted : {false, true}) {
    const cv::Mat& image = inverted ? inverse : bytes;
    const std::vector<Quad> quads = dark_quads(image);
    for (const int cells : {4, 5, 6, 7}) {
      const MarkerTable table({cells, kAll}, 0, kAll);
      for (const bool mirrored : {false, true}) {
        auto markers = markers_in(image, quads, table, cells, mirrored);
        if (markers.size() > most.markers.size())
          most = {cells, inverted, mirrored, std::move(markers)};
      }
    }
  }
  return most;
}

namespace {

/// DICT_5X5 of "DICT_5X5_100".
std::string family_of(const std::string& dictionary) {
  return dictionary.substr(0, dictionary.rfind('_'));
}

/// What several views show together.
struct SeenBoard {
  OtherCharuco seen;
  std::size_t views = 0;
};

SeenBoard united(std::span<const PoseCapture> poses) {
  using Kind = std::tuple<std::string, bool, bool>;
  std::map<Kind, SeenBoard> kinds;
  std::map<Kind, std::map<std::tuple<int, bool, int>, std::pair<std::size_t, int>>> layouts;
  for (const PoseCapture& pose : poses) {
    if (!pose.other_board) continue;
    const OtherCharuco& one = *pose.other_board;
    const Kind kind{family_of(one.dictionary), one.inverted, one.mirrored};
    auto& [seen, views] = kinds[kind];
    if (views++ == 0) {
      seen = one;
    } else {
      if (one.last_id > seen.last_id) seen.dictionary = one.dictionary;
      seen.first_id = std::min(seen.first_id, one.first_id);
      seen.last_id = std::max(seen.last_id, one.last_id);
    }
    if (one.columns == 0) continue;
    auto& [count, rows] = layouts[kind][{one.columns, one.legacy_layout, one.layout_first_id}];
    ++count;
    rows = std::max(rows, one.rows);
  }
  SeenBoard most;
  for (const auto& [kind, board] : kinds) {
    if (board.views <= most.views) continue;
    most = board;
    most.seen.columns = 0;
    std::size_t agree = 0;
    for (const auto& [layout, seen] : layouts[kind]) {
      if (seen.first <= agree) continue;
      agree = seen.first;
      std::tie(most.seen.columns, most.seen.legacy_layout, most.seen.layout_first_id) = layout;
      most.seen.rows = seen.second;
    }
    if (2 * agree <= board.views) most.seen.columns = 0;
  }
  return most;
}

/// The keys of [board] that differ, in a list.
std::string keys_to_set(const OtherCharuco& seen, const Board& board) {
  std::string keys;
  const auto add = [&keys](const std::string& key) {
    if (!keys.empty()) keys += ", ";
    keys += key;
  };
  const bool other_kind = board.kind != BoardKind::Charuco;
  if (other_kind) add("kind = \"charuco\"");
  if (other_kind || family_of(seen.dictionary) != family_of(board.dictionary))
    add(fmt::format("dictionary = \"{}\"", seen.dictionary));
  const int first = seen.columns > 0 ? seen.layout_first_id : seen.first_id;
  const int end = board.first_id + static_cast<int>(marker_squares(board).size());
  if (seen.columns > 0 ? first != board.first_id
                       : seen.first_id < board.first_id || seen.last_id >= end)
    add(fmt::format("first_id = {}", first));
  if (seen.columns > 0 && (seen.columns != board.columns || seen.rows > board.rows))
    add(fmt::format("corners = [{}, {}]", seen.columns, seen.rows));
  // Both layouts of an odd number of rows of squares are the same.
  const bool even_rows = (std::max(seen.rows, board.rows) + 1) % 2 == 0;
  if (seen.columns > 0 && even_rows && seen.legacy_layout != board.legacy_layout)
    add(fmt::format("legacy_layout = {}", seen.legacy_layout));
  return keys;
}

}  // namespace

std::string describe_other_board(std::span<const PoseCapture> poses, const Board& board) {
  const auto [seen, views] = united(poses);
  const auto unseen = static_cast<std::size_t>(std::count_if(
      poses.begin(), poses.end(), [](const auto& pose) { return pose.view.points.empty(); }));
  if (views < 2 || 2 * views <= unseen) return {};
  const std::string shown = fmt::format("the images of {} views show markers of {}, ids {} to {}",
                                        views,
                                        family_of(seen.dictionary),
                                        seen.first_id,
                                        seen.last_id);
  if (seen.inverted) {
    return fmt::format("{}{}, in white on black: print the board again without inversion",
                       shown,
                       seen.mirrored ? ", mirrored" : "");
  }
  if (seen.mirrored) {
    return fmt::format(
        "{}, mirrored: switch off the camera's mirroring, or print the board again "
        "without mirroring",
        shown);
  }
  const std::string keys = keys_to_set(seen, board);
  return fmt::format(
      "{}{}, which is not the board of scan.toml{}",
      shown,
      seen.columns > 0 ? fmt::format(", in rows of {} inner corners", seen.columns) : std::string(),
      keys.empty() ? "; check corners, first_id and legacy_layout"
                   : fmt::format(": set {} in [board]", keys));
}

}  // namespace frangia
