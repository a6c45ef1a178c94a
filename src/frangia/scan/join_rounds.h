#pragma once

#include <map>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/rig/rig.h"
#include "frangia/scan/measure_views.h"
#include "frangia/views/register_views.h"

namespace frangia {

/// The views between two turnings of the part, registered among themselves.
struct Round {
  int number = 0;  ///< in scan.toml
  MeasuredViews measured;
  std::optional<RegistrationReport> registration;
};

/// The views of a scan by their rounds, in the order of their numbers. What belongs to no single
/// view goes with each.
///
/// shape    `numbers`: one a view
[[nodiscard]] std::vector<Round> split_rounds(MeasuredViews all, const std::vector<int>& numbers);

struct JoinRoundsOptions {
  std::map<int, Eigen::Isometry3d> placings;  ///< roughly, of rounds where they are known: what
                                              ///< takes the part from its place in round 0
  bool refine = true;                         ///< all at once, when they are joined
  RegisterOptions registration;
};

/// The rounds put together by the shape of what they saw, or by rough placings, and refined all at
/// once. A round that cannot be joined is named and left out.
///
/// units    the frame of the first round, or of the first of those that fit together
/// missing  `registration` of the round that comes back when it is not refined
[[nodiscard]] Round join_rounds(std::vector<Round> rounds,
                                const Rig& rig,
                                const JoinRoundsOptions& options,
                                const Run& run = {});

}  // namespace frangia
