#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/features/internal/filtered_range.h"
#include "frangia/features/internal/minimum_zone.h"

namespace frangia {

/// The width of a form and half the width of its 95 % interval, mm.
struct FormWidth {
  double value = 0.0;
  double u95 = 0.0;
};

/// The shape whose minimum zone is wanted, and what it may choose.
struct WantedZone {
  const Shape* shape = nullptr;  ///< null: the range of the values as they are
  ZoneFreedom freedom = ZoneFreedom::All;
};

/// The range of values without their noise. Of the distances from a shape whose minimum zone is
/// wanted, the width of that zone of the points without noise.
///
/// @errors   as filtered_range and minimum_zone_width
[[nodiscard]] FormWidth form_width(std::vector<SurfaceValue> values, const WantedZone& zone = {});

/// The largest such width in sections normal to an axis; few points in a section do not count.
[[nodiscard]] FormWidth largest_section_width(const std::vector<SurfaceValue>& values,
                                              const Eigen::Vector3d& center_mm,
                                              const Eigen::Vector3d& axis,
                                              const WantedZone& zone = {});

}  // namespace frangia
