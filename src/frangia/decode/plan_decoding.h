#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/phase/temporal/unwrap_sequence.h"
#include "frangia/rig/rig.h"

namespace frangia {

struct DecodeOptions;
struct DirectionPlan;

// The sources of fringe orders. Each states a name, whether the phase that it gives is absolute,
// and what it does, in a clause. A new one is a struct here, its case in `plan_decoding`, the
// function that executes it in internal/decode_direction.cpp, and a row of tests/decode/
// plan_decoding_test.cpp.

/// `OwnStages::unwrap` or files with an absolute phase.
struct FromCallers {
  static constexpr const char* kName = "callers";  ///< in JSON
  static constexpr bool kIsAbsolute = true;        ///< relative to the projector
  /// What it does, as a clause.
  [[nodiscard]] std::string text(const DirectionPlan& plan) const;
};

/// A Gray code gives the orders of the coarsest fringes, which give those of the finer ones.
struct FromGrayCode {
  static constexpr const char* kName = "gray-code";  ///< in JSON
  static constexpr bool kIsAbsolute = true;          ///< relative to the projector
  /// What it does, as a clause.
  [[nodiscard]] std::string text(const DirectionPlan& plan) const;
};

/// There are no fringes: a Gray code gives the projector's columns or rows.
struct FromGrayCodeAlone {
  static constexpr const char* kName = "gray-code-alone";  ///< in JSON
  static constexpr bool kIsAbsolute = true;                ///< relative to the projector
  /// What it does, as a clause.
  [[nodiscard]] std::string text(const DirectionPlan& plan) const;
};

/// The coarsest fringes are absolute; each map gives the orders of the next finer one.
struct FromCoarserMaps {
  static constexpr const char* kName = "coarser-maps";  ///< in JSON
  static constexpr bool kIsAbsolute = true;             ///< relative to the projector
  /// What it does, as a clause.
  [[nodiscard]] std::string text(const DirectionPlan& plan) const;
};

/// All maps give the phase, as the slope of phase over frequency.
struct FromSlope {
  static constexpr const char* kName = "slope";  ///< in JSON
  static constexpr bool kIsAbsolute = true;      ///< relative to the projector

  SequenceMethod method = SequenceMethod::Levels;  ///< how the orders are found
  /// Every level is safe for each single pixel that wrapping keeps.
  bool safe_for_every_pixel = false;

  /// What it does, as a clause.
  [[nodiscard]] std::string text(const DirectionPlan& plan) const;
};

/// The coarsest fringes are unwrapped in space; the laser sheet gives the orders of the regions.
struct FromLaserSheet {
  static constexpr const char* kName = "laser-sheet";  ///< in JSON
  static constexpr bool kIsAbsolute = true;            ///< relative to the projector
  /// What it does, as a clause.
  [[nodiscard]] std::string text(const DirectionPlan& plan) const;
};

/// The coarsest fringes are unwrapped in space; their orders are those at the distance at which the
/// axes of camera and projector cross.
struct FromDistance {
  static constexpr const char* kName = "distance";  ///< in JSON
  static constexpr bool kIsAbsolute = false;        ///< relative to the projection axis
  /// What it does, as a clause.
  [[nodiscard]] std::string text(const DirectionPlan& plan) const;
};

/// The coarsest fringes are unwrapped in space, and nothing gives their orders.
struct Unresolved {
  static constexpr const char* kName = "unresolved";  ///< in JSON
  static constexpr bool kIsAbsolute = false;          ///< each region has an offset of its own
  /// What it does, as a clause.
  [[nodiscard]] std::string text(const DirectionPlan& plan) const;
};

/// Where the fringe orders of one direction come from.
using OrderSource = std::variant<FromCallers,
                                 FromGrayCode,
                                 FromGrayCodeAlone,
                                 FromCoarserMaps,
                                 FromSlope,
                                 FromLaserSheet,
                                 FromDistance,
                                 Unresolved>;

/// How one direction of fringes is decoded.
struct DirectionPlan {
  FringeDirection direction = FringeDirection::Vertical;  ///< of fringes or stripes
  std::vector<Pattern> maps;  ///< fringe patterns, coarse to fine; none for a Gray code alone
  OrderSource orders;         ///< where the orders of the maps come from
  /// The maps by themselves determine the absolute phase of the finest one.
  bool maps_determine_orders = false;
};

/// How the views of a scan are decoded: one or two directions, the one that later stages refer to
/// first.
struct DecodePlan {
  std::vector<DirectionPlan> directions;  ///< two only if both have an absolute phase
};

/// Decides from the patterns of a scan how its frames are decoded.
///
/// A function of the caller that unwraps takes precedence. Then come, in this order: Gray code, all
/// maps where their levels are safe for every pixel that `options.wrap` keeps, a coarsest map of
/// one fringe over the field, and any other combination of maps that determines the order.
/// Otherwise the coarsest fringes are unwrapped in space, with orders from the laser sheet or the
/// distance if the rig has geometry. A scan without fringes is decoded from its Gray code.
///
/// @errors   Error(Input) when no pattern holds fringes or a Gray code, or none in the direction
///           that `options` choose
[[nodiscard]] DecodePlan plan_decoding(std::span<const Pattern> patterns,
                                       const Rig& rig,
                                       const DecodeOptions& options);

/// Where maps of one direction take their orders from if they have nothing but each other:
/// FromSlope, FromCoarserMaps or Unresolved.
///
/// @shape    coarse to fine, at least one
/// @units    `max_sigma_rad`: largest noise of a pixel that wrapping keeps
[[nodiscard]] OrderSource plan_maps(std::span<const Pattern> maps,
                                    const Projector& projector,
                                    float max_sigma_rad);

/// Whether the phase of every direction is absolute. Otherwise a reconstruction is relative to the
/// fringe through the projection axis.
[[nodiscard]] bool is_absolute(const DecodePlan& plan);

/// The name of a source of orders, as in JSON.
[[nodiscard]] std::string name_of(const OrderSource& orders);

/// "vertical fringes of 1280, 160 and 20 px: each map gives the orders of the next finer one, ...".
[[nodiscard]] std::string describe(const DirectionPlan& plan);

/// One line for each direction, without a line feed after the last.
[[nodiscard]] std::string describe(const DecodePlan& plan);

}  // namespace frangia
