#include "frangia/decode/internal/check_code.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/gray/check_gray_code.h"
#include "frangia/phase/wrap/wrap_phase.h"
#include "frangia/range/check_orientation.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// Uses the rig where the frames do not decide between shifts in the opposite direction and other
/// hypotheses: the direction in which the measured phase rises shows which it is.
void decide_by_orientation(const WrappedPhase& fringes,
                           const Rig& rig,
                           const Image<Eigen::Vector2f>& rays,
                           SequenceCheck& check) {
  if (check.fits.size() < 2 || !has_geometry(rig)) return;
  const OrientationCheck found = check_orientation(
      {fringes.pattern, fringes.phase_rad, fringes.sigma_rad, fringes.status}, rig, rays);
  if (!found.decided) return;
  const auto contradicts = [&](const SequenceFault& fault) {
    return (fault.kind == SequenceFaultKind::Direction) == found.consistent;
  };
  if (!std::all_of(check.fits.begin(), check.fits.end(), contradicts))
    std::erase_if(check.fits, contradicts);
}

/// Of several orders of the frames of one pattern that fit, keeps those with which the Gray code
/// agrees: orders that reverse or delay the fringes leave the same residual.
void decide_by_code(const DirectionInput& input,
                    const FrameStack& gray,
                    const DecodedDirection& wrapped,
                    SequenceCheck& check) {
  const Pattern& pattern = wrapped.wrapped.front().pattern;
  const auto stack = std::find_if(input.stacks.begin(), input.stacks.end(), [&](const auto& one) {
    return one.pattern.name == pattern.name;
  });
  if (check.consistent || check.fits.size() < 2 || stack == input.stacks.end()) return;
  const auto contradicts = [&](const SequenceFault& fault) {
    if (fault.patterns != std::vector{pattern.name} ||
        fault.shifts_rad.size() != pattern.shifts_rad.size())
      return false;
    FrameStack changed = *stack;
    changed.pattern.shifts_rad = fault.shifts_rad;
    const WrappedPhase map =
        wrap_phase(changed, least_squares(fault.shifts_rad), wrapped.noise, input.options.wrap);
    const SequenceCheck code = check_gray_code(gray, map);
    return code.decided && !code.consistent;
  };
  std::vector<SequenceFault> fits;
  std::copy_if(
      check.fits.begin(), check.fits.end(), std::back_inserter(fits), [&](const auto& one) {
        return !contradicts(one);
      });
  if (!fits.empty()) check.fits = std::move(fits);
}

}  // namespace

SequenceCheck check_code(const DirectionInput& input,
                         const FrameStack& gray,
                         const DecodedDirection& wrapped) {
  SequenceCheck out = *wrapped.check;
  if (out.consistent) {
    out = check_gray_code(gray, wrapped.wrapped.front());
    decide_by_orientation(wrapped.wrapped.front(), input.rig, input.rays, out);
  }
  decide_by_code(input, gray, wrapped, out);
  return out;
}

}  // namespace frangia
