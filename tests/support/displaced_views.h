#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia::testing {

/// Captures every other view of a scan of the bracket again with the part displaced, each time
/// differently: the views then contradict each other.
inline void displace_every_other_view(const Scan& scan) {
  for (std::size_t view = 1; view < scan.views.size(); view += 2) {
    const TemporaryFolder folder;
    Scan plan = scan;
    plan.folder = folder.path();
    plan.views = {scan.views[view]};
    Mesh part = make_part("bracket");
    const double direction_rad = 2.3 * static_cast<double>(view);
    const Eigen::Vector3d shift_mm(
        2.5 * std::cos(direction_rad), 2.5 * std::sin(direction_rad), 1.5);
    for (Eigen::Vector3f& vertex : part.vertices_mm)
      vertex += shift_mm.cast<float>();
    static_cast<void>(simulate_scan(part, plan, {}));
    const std::filesystem::path frames = scan.views[view].folder;
    std::filesystem::copy(plan.folder / frames,
                          scan.folder / frames,
                          std::filesystem::copy_options::overwrite_existing |
                              std::filesystem::copy_options::recursive);
  }
}

}  // namespace frangia::testing
