#pragma once

#include <map>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/pipeline/internal/measure_views.h"
#include "frangia/registration/register_views.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The views between two turnings of the part, registered among themselves.
struct MeasuredSetup {
  int number = 0;  ///< in scan.toml
  MeasuredViews measured;
  std::optional<RegistrationReport> registration;
};

/// The views of a scan by their setups, in the order of their numbers. What belongs to no single
/// view goes with each.
///
/// shape    `numbers`: one a view
[[nodiscard]] std::vector<MeasuredSetup> split_setups(MeasuredViews all,
                                                      const std::vector<int>& numbers);

struct RegisterSetupsOptions {
  std::map<int, Eigen::Isometry3d> part_poses;  ///< roughly, of setups where they are known: what
                                                ///< takes the part from its place in setup 0
  bool refine = true;                           ///< all at once, when they are joined
  RegisterOptions registration;
};

/// The setups put together by the shape of what they saw, or by rough part poses, and refined all
/// at once. A setup that cannot be joined is named and left out.
///
/// units    the frame of the first setup, or of the first of those that fit together
/// missing  `registration` of the setup that comes back when it is not refined
[[nodiscard]] MeasuredSetup register_setups(std::vector<MeasuredSetup> setups,
                                            const Rig& rig,
                                            const RegisterSetupsOptions& options,
                                            const Run& run = {});

}  // namespace frangia
