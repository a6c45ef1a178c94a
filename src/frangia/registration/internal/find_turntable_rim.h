#pragma once

#include <optional>

#include "frangia/registration/find_turntable_top.h"
#include "frangia/registration/internal/table_cloud.h"

namespace frangia {

/// The edge of a turntable top that is seen edge-on.
struct TurntableRim {
  double radius_mm = 0.0;
  double top_mm = 0.0;  ///< height of its upper edge, object frame
};

/// Finds a cylinder about the axis that lies below everything else, apart from it, and not above
/// the origin of the object frame.
///
/// @missing  none when no cylinder meets all criteria
[[nodiscard]] std::optional<TurntableRim> find_turntable_rim(const TableCloud& cloud,
                                                             const TurntableTopOptions& options);

}  // namespace frangia
