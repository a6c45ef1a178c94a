#include "frangia/decode/check_view.h"

#include <algorithm>
#include <cstddef>

#include "frangia/range/check_orientation.h"
#include "frangia/rig/has_geometry.h"

namespace frangia {
namespace {

/// Whether one direction's phase is to be triangulated; adds the reason if it is not.
bool check_direction(const AbsolutePhase& phase,
                     const SequenceCheck* sequence,
                     const Rig& rig,
                     const Image<Eigen::Vector2f>& rays,
                     ViewFit& out) {
  std::string reason;
  if (sequence != nullptr) {
    out.decided = out.decided || sequence->decided;
    if (!sequence->consistent) reason = describe(*sequence);
  }
  // Rows that are exchanged with columns look like missing frames of a code.
  const bool unexplained =
      sequence != nullptr && !sequence->consistent && sequence->finding.empty() &&
      std::all_of(sequence->fits.begin(), sequence->fits.end(), [](const SequenceFault& fault) {
        return fault.kind == SequenceFaultKind::Missing;
      });
  if ((reason.empty() || unexplained) && has_geometry(rig)) {
    const OrientationCheck orientation = check_orientation(phase, rig, rays);
    out.decided = out.decided || orientation.decided;
    constexpr double kExchanged = 3.0;  // change across the direction of the rig over that along it
    if (reason.empty() || orientation.across > kExchanged) {
      if (!orientation.fits.empty()) reason = orientation.fits;
    }
  }
  if (reason.empty()) return true;
  out.reason += (out.reason.empty() ? "" : "; ") + reason;
  return false;
}

}  // namespace

ViewFit check_view(const DecodedView& decoded,
                   const Rig& rig,
                   const Image<Eigen::Vector2f>& rays,
                   bool accept_inconsistent) {
  ViewFit out;
  const auto sequence = [&](std::size_t direction) {
    return direction < decoded.checks.size() ? &decoded.checks[direction] : nullptr;
  };
  const bool first = check_direction(decoded.phase, sequence(0), rig, rays, out);
  const bool second =
      decoded.second_phase && check_direction(*decoded.second_phase, sequence(1), rig, rays, out);
  out.accepted = accept_inconsistent && !first && !second;
  out.uses_first = first || out.accepted;
  out.uses_second = second || (out.accepted && decoded.second_phase);
  return out;
}

}  // namespace frangia
