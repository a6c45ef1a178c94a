#include "frangia/calibrate/board/internal/describe_other_board.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace frangia {
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
