#include "frangia/registration/internal/leave_out_views.h"

#include <fmt/format.h>

#include "frangia/registration/internal/assess_fit.h"
#include "frangia/registration/internal/find_moved_view.h"

namespace frangia {

void Registration::optimize_again() {
  bundle.state = bundle.given;
  bundle.gate_mm = reach_mm;
  optimize_bundle(bundle, surfels, options.max_iterations, run);
}

void Registration::leave_out(std::size_t view) {
  views.clear(view);
  surfels[view].clear();
  for (auto& surfel : bundle.maps[view].surfels.pixels())
    surfel = {};
}

void leave_out_outliers(RegistrationReport& report, Registration& work) {
  const std::vector<std::size_t> outliers =
      find_outliers(sum(work.bundle, work.surfels), work.options.outlier_overlap);
  bool some = false;
  for (const std::size_t view : outliers) {
    if (work.surfels[view].empty()) continue;  // left out already
    some = true;
    report.outliers.push_back(view);
    work.run.warn(
        fmt::format("view {} fits no other view and is left out: check whether the part moved "
                    "before it was taken",
                    work.name_of(view)));
    work.leave_out(view);
  }
  if (some) work.optimize_again();
}

void leave_out_moved(RegistrationReport& report, Registration& work) {
  if (!work.bundle.state.part_poses.empty()) return;  // done for each setup by itself
  const MovedViewOptions how{.reach_mm = work.reach_mm,
                             .max_iterations = work.options.max_iterations};
  while (2 * (report.outliers.size() + 1) < work.views.size()) {
    const auto moved = find_moved_view(work.bundle, work.surfels, how, work.run);
    if (!moved) return;
    const std::string name = work.name_of(moved->view);
    work.run.warn(
        moved->alternative
            ? fmt::format(
                  "views {} and {} contradict each other, and the other views fit either: "
                  "{} is left out; the part moved between the two, or fringe orders are wrong",
                  name,
                  work.name_of(*moved->alternative),
                  name)
            : fmt::format(
                  "view {} contradicts the others, which agree better without it, and is "
                  "left out; the part moved before it was taken, or its fringe orders are wrong",
                  name));
    report.outliers.push_back(moved->view);
    work.leave_out(moved->view);
    work.optimize_again();
  }
}

}  // namespace frangia
