#include "frangia/decode/check_view.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>

#include "frangia/range/check_orientation.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// Whether one direction's phase fits.
struct DirectionFit {
  bool decided = false;
  std::string reason{};  ///< what does not fit; empty if it fits
};

DirectionFit check_direction(const DecodedDirection& direction,
                             const Rig& rig,
                             const Image<Eigen::Vector2f>& rays) {
  DirectionFit out;
  std::string& reason = out.reason;
  const std::optional<SequenceCheck>& sequence = direction.check;
  if (sequence) {
    out.decided = sequence->decided;
    if (!sequence->consistent) reason = describe(*sequence);
  }
  // Rows that are exchanged with columns look like missing frames of a code.
  const bool unexplained =
      sequence && !sequence->consistent && sequence->finding.empty() &&
      std::all_of(sequence->fits.begin(), sequence->fits.end(), [](const SequenceFault& fault) {
        return fault.kind == SequenceFaultKind::Missing;
      });
  if ((reason.empty() || unexplained) && has_geometry(rig)) {
    const OrientationCheck orientation = check_orientation(direction.phase, rig, rays);
    out.decided = out.decided || orientation.decided;
    constexpr double kExchanged = 3.0;  // change across the direction of the rig over that along it
    if (reason.empty() || orientation.across > kExchanged) {
      if (!orientation.fits.empty()) reason = orientation.fits;
    }
  }
  return out;
}

}  // namespace

ViewFit check_view(const DecodedView& decoded,
                   const Rig& rig,
                   const Image<Eigen::Vector2f>& rays,
                   bool accept_inconsistent) {
  ViewFit out;
  for (std::size_t i = 0; i < decoded.directions.size(); ++i) {
    const DirectionFit fit = check_direction(decoded.directions[i], rig, rays);
    out.decided = out.decided || fit.decided;
    if (fit.reason.empty()) out.used.push_back(i);
    if (!fit.reason.empty()) out.reason += (out.reason.empty() ? "" : "; ") + fit.reason;
  }
  out.accepted = accept_inconsistent && out.used.empty();
  if (out.accepted) {
    out.used.resize(decoded.directions.size());
    std::iota(out.used.begin(), out.used.end(), 0U);
  }
  return out;
}

}  // namespace frangia
