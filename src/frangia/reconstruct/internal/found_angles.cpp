#include "frangia/reconstruct/internal/found_angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// Whether the registration of a setup explains its views by angles that are not those stated.
bool finds_angles(const MeasuredSetup& setup) {
  if (!setup.registration || !setup.registration->untrusted_reason().empty()) return false;
  const PoseExplanation& found = setup.registration->explanation;
  return found.decided &&
         (found.best == PoseCause::AnglesWrong || found.best == PoseCause::AnglesScaled ||
          found.best == PoseCause::Turned);
}

bool orders_rest_on_views(const MeasuredSetup& setup) {
  return setup.measured.unwrapped_spatially || !setup.measured.unresolved.empty();
}

}  // namespace

std::optional<ScanWithAngles> with_found_angles(const Scan& scan,
                                                std::span<const MeasuredSetup> setups) {
  constexpr double kFar_rad = rad_from_deg(1.0);  // nearer ones hide no fringe order
  ScanWithAngles found{scan, {}};
  bool is_far = false;
  for (const MeasuredSetup& setup : setups) {
    const bool matters = setups.size() > 1 || orders_rest_on_views(setup);
    if (!matters || !finds_angles(setup)) continue;
    const RegistrationReport& report = *setup.registration;
    found.explanation = report.explanation;
    for (std::size_t view = 0; view < setup.measured.stations.size(); ++view) {
      const auto own =
          std::find_if(found.scan.views.begin(), found.scan.views.end(), [&](const ScanView& one) {
            return one.folder.string() == setup.measured.stations[view].name;
          });
      if (own == found.scan.views.end()) continue;
      is_far = is_far || std::abs(wrap_rad(report.angles_rad[view] - own->angle_rad)) > kFar_rad;
      own->angle_rad = report.angles_rad[view];
    }
  }
  if (!is_far) return std::nullopt;
  return found;
}

bool may_hide_angles(std::span<const MeasuredSetup> setups) {
  return std::any_of(setups.begin(), setups.end(), [](const MeasuredSetup& setup) {
    return orders_rest_on_views(setup) && setup.registration &&
           (!setup.registration->outliers.empty() ||
            !setup.registration->untrusted_reason().empty());
  });
}

}  // namespace frangia
