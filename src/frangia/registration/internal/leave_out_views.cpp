#include "frangia/registration/internal/leave_out_views.h"

#include <algorithm>

#include <fmt/format.h>

#include "frangia/registration/internal/assess_fit.h"

namespace frangia {

void Registration::optimize_again() {
  bundle.state = bundle.given;
  bundle.gate_mm = reach_mm;
  optimize_bundle(bundle, surfels, options.max_iterations, run);
}

void Registration::leave_out(std::size_t view) {
  views.clear(view);
  surfels[view].clear();
  std::erase_if(bundle.ties,
                [view](const PointTie& tie) { return tie.from == view || tie.to == view; });
  for (auto& surfel : bundle.maps[view].surfels.pixels())
    surfel = {};
}

bool fits_by_table(const Registration& work) {
  const BundleSums sums = sum(work.bundle, work.surfels);
  if (contradiction_of(sums, work.surfels) > work.options.max_contradiction) return false;
  const std::vector<std::size_t> outliers = find_outliers(sums, work.options.outlier_overlap);
  return std::all_of(outliers.begin(), outliers.end(), [&](std::size_t view) {
    return work.surfels[view].empty();  // left out already
  });
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

std::optional<std::size_t> view_at_fault(const RegistrationReport& report,
                                         const Registration& work) {
  if (!report.trustworthy) return work.contradicting;
  if (report.explanation.best != PoseCause::Unexplained) return std::nullopt;
  Bundle as_given = work.bundle;
  as_given.state = work.bundle.given;
  return disagreeing_view(sum(as_given, work.surfels));
}

}  // namespace frangia
