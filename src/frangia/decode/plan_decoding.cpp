#include "frangia/decode/plan_decoding.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/decode/decode_options.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

constexpr auto kVertical = FringeDirection::Vertical;
constexpr auto kHorizontal = FringeDirection::Horizontal;

bool has_kind(std::span<const Pattern> patterns, PatternKind kind) {
  return std::any_of(
      patterns.begin(), patterns.end(), [&](const Pattern& one) { return one.kind == kind; });
}

std::vector<Pattern> patterns_in(std::span<const Pattern> patterns,
                                 PatternKind kind,
                                 FringeDirection direction) {
  std::vector<Pattern> out;
  std::copy_if(
      patterns.begin(), patterns.end(), std::back_inserter(out), [&](const Pattern& pattern) {
        return pattern.kind == kind && pattern.direction == direction;
      });
  return out;
}

std::vector<Pattern> fringes_in(std::span<const Pattern> patterns, FringeDirection direction) {
  std::vector<Pattern> maps = patterns_in(patterns, PatternKind::Fringe, direction);
  std::stable_sort(maps.begin(), maps.end(), [](const Pattern& a, const Pattern& b) {
    return a.fringes_per_unit() < b.fringes_per_unit();
  });
  return maps;
}

bool is_unresolved(const OrderSource& orders) {
  return std::holds_alternative<Unresolved>(orders);
}

/// Where the orders of fringes that are unwrapped in space come from.
OrderSource spatial_orders(std::span<const Pattern> patterns, const Rig& rig) {
  if (!has_geometry(rig)) return Unresolved{};
  if (has_kind(patterns, PatternKind::Line)) return FromLaserSheet{};
  return FromDistance{};
}

/// What the patterns of one direction give by themselves; orders are Unresolved where they give
/// none.
std::optional<DirectionPlan> plan_direction(std::span<const Pattern> patterns,
                                            FringeDirection direction,
                                            const Projector& projector,
                                            const DecodeOptions& options) {
  const bool gray = !patterns_in(patterns, PatternKind::Gray, direction).empty();
  DirectionPlan plan{direction, fringes_in(patterns, direction)};
  if (plan.maps.empty()) {
    if (!gray || has_kind(patterns, PatternKind::Fringe)) return std::nullopt;
    plan.orders = FromGrayCodeAlone{};
    return plan;
  }
  plan.maps_determine_orders = find_sequence_method(plan.maps, projector).has_value();
  plan.orders = gray ? OrderSource(FromGrayCode{})
                     : plan_maps(plan.maps, projector, options.wrap.max_sigma_rad);
  return plan;
}

/// The direction that the caller chose.
DirectionPlan chosen_direction(std::vector<DirectionPlan> found,
                               FringeDirection direction,
                               std::span<const Pattern> patterns) {
  for (DirectionPlan& plan : found)
    if (plan.direction == direction) return std::move(plan);
  throw Error(ErrorKind::Input,
              fmt::format("scan.toml has no {} {}; choose other `directions`",
                          direction == kVertical ? "vertical" : "horizontal",
                          has_kind(patterns, PatternKind::Fringe) ? "fringes" : "Gray code"));
}

/// Both directions where both have orders; of two others, the vertical one unless the horizontal
/// one alone has orders.
std::vector<DirectionPlan> choose_directions(std::vector<DirectionPlan> found) {
  if (found.size() < 2) return found;
  const bool vertical = !is_unresolved(found.front().orders);
  const bool horizontal = !is_unresolved(found.back().orders);
  if (vertical && horizontal) return found;
  found.erase(horizontal ? found.begin() : found.begin() + 1);
  return found;
}

/// "1280, 160 and 20 px"
std::string sizes_of(std::span<const Pattern> maps) {
  std::vector<std::string> sizes;
  const bool angular = maps.front().fringes_per_degree > 0.0;
  for (const Pattern& map : maps)
    sizes.push_back(fmt::format("{:.4g}", angular ? map.fringes_per_degree : map.period_px));
  std::string text = sizes.front();
  for (std::size_t i = 1; i < sizes.size(); ++i)
    text += (i + 1 == sizes.size() ? " and " : ", ") + sizes[i];
  return text + (angular ? " per degree" : " px");
}

const char* finer_ones(const DirectionPlan& plan) {
  return plan.maps.size() > 1 ? " of the coarsest map, each map those of the next finer one" : "";
}

}  // namespace

std::string FromCallers::text(const DirectionPlan& /*plan*/) const {
  return "your own function or files give the absolute phase";
}

std::string FromGrayCode::text(const DirectionPlan& plan) const {
  return fmt::format("the Gray code gives the orders{}", finer_ones(plan));
}

std::string FromGrayCodeAlone::text(const DirectionPlan& plan) const {
  return fmt::format("the Gray code gives the projector's {}",
                     plan.direction == kVertical ? "columns" : "rows");
}

std::string FromCoarserMaps::text(const DirectionPlan& plan) const {
  if (plan.maps.size() == 1) return "one fringe covers the field";
  return "each map gives the orders of the next finer one, from one fringe over the field on";
}

std::string FromSlope::text(const DirectionPlan& /*plan*/) const {
  if (method == SequenceMethod::Search)
    return "all maps give the phase, with the most likely of all orders";
  return fmt::format(
      "all maps give the phase, with orders level by level over maps and their beats{}",
      safe_for_every_pixel ? ", safe for every pixel" : "");
}

std::string FromLaserSheet::text(const DirectionPlan& plan) const {
  return fmt::format("unwrapped in space; the laser sheet gives the orders{}", finer_ones(plan));
}

std::string FromDistance::text(const DirectionPlan& plan) const {
  return fmt::format(
      "unwrapped in space; the distance at which the axes of camera and projector cross gives the "
      "orders{}",
      finer_ones(plan));
}

std::string Unresolved::text(const DirectionPlan& /*plan*/) const {
  return "unwrapped in space; nothing gives the orders, and each region has an offset of its own";
}

OrderSource plan_maps(std::span<const Pattern> maps,
                      const Projector& projector,
                      float max_sigma_rad) {
  constexpr double kMaxWrongOrder = 1e-6;  // probability per pixel
  if (maps.size() > 1 &&
      is_safe(find_unwrap_levels(maps, projector), max_sigma_rad, kMaxWrongOrder)) {
    return FromSlope{SequenceMethod::Levels, true};
  }
  if (is_absolute(maps.front(), projector)) return FromCoarserMaps{};
  const auto method = find_sequence_method(maps, projector);
  if (maps.size() > 1 && method) return FromSlope{*method, false};
  return Unresolved{};
}

DecodePlan plan_decoding(std::span<const Pattern> patterns,
                         const Rig& rig,
                         const DecodeOptions& options) {
  std::vector<DirectionPlan> found;
  for (const FringeDirection direction : {kVertical, kHorizontal}) {
    if (auto plan = plan_direction(patterns, direction, rig.projector, options))
      found.push_back(*std::move(plan));
  }
  require(!found.empty(), "scan.toml has no pattern of kind \"fringe\" or \"gray\"; add one");
  DecodePlan out;
  if (options.directions == DirectionChoice::Vertical) {
    out.directions = {chosen_direction(std::move(found), kVertical, patterns)};
  } else if (options.directions == DirectionChoice::Horizontal) {
    out.directions = {chosen_direction(std::move(found), kHorizontal, patterns)};
  } else {
    out.directions = choose_directions(std::move(found));
  }
  const bool callers = options.own.unwrap ||
                       (options.phase_files && options.phase_files->kind == PhaseKind::Absolute);
  for (DirectionPlan& plan : out.directions) {
    if (is_unresolved(plan.orders)) plan.orders = spatial_orders(patterns, rig);
    if (callers && !plan.maps.empty()) plan.orders = FromCallers{};
  }
  return out;
}

bool is_absolute(const DecodePlan& plan) {
  return std::all_of(
      plan.directions.begin(), plan.directions.end(), [](const DirectionPlan& direction) {
        return std::visit([](const auto& source) { return source.kIsAbsolute; }, direction.orders);
      });
}

std::string name_of(const OrderSource& orders) {
  return std::visit([](const auto& source) -> std::string { return source.kName; }, orders);
}

std::string describe(const DirectionPlan& plan) {
  const char* direction = plan.direction == kVertical ? "vertical" : "horizontal";
  const std::string what = plan.maps.empty()
                               ? fmt::format("{} Gray code", direction)
                               : fmt::format("{} fringes of {}", direction, sizes_of(plan.maps));
  return fmt::format(
      "{}: {}",
      what,
      std::visit([&](const auto& source) { return source.text(plan); }, plan.orders));
}

std::string describe(const DecodePlan& plan) {
  std::vector<std::string> lines;
  for (const DirectionPlan& direction : plan.directions)
    lines.push_back(describe(direction));
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace frangia
