#include "frangia/decode/internal/correct_view_orders.h"

#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "frangia/decode/select_stacks.h"
#include "frangia/phase/temporal/correct_order_jumps.h"
#include "frangia/phase/waveform/frame_samples.h"
#include "frangia/phase/wrap/merge_exposures.h"
#include "frangia/phase/wrap/wrap_phase.h"

namespace frangia {

void correct_view_orders(std::span<const FrameStack* const> fringes,
                         std::span<const FittedAlgorithm> fits,
                         const DecodeOptions& options,
                         const Run& run,
                         DecodedDirection& out) {
  const auto coarse = [&](std::span<const std::uint32_t> pixels) {
    std::vector<WrappedPhase> maps;
    for (std::size_t m = 0; m + 1 < fringes.size(); ++m) {
      std::vector<FrameStack> some;
      for (const FrameStack& stack : exposures_of(fringes[m]))
        some.push_back(sample_pixels(stack, pixels));
      maps.push_back(some.size() > 1
                         ? merge_exposures(some, fits[m].shifts_rad, out.noise, options.wrap)
                         : wrap_phase(some.front(), fits[m].algorithm, out.noise, options.wrap));
    }
    return maps;
  };
  const OrderJumpResult found = correct_order_jumps(coarse, out.phase, options.order_jumps);
  if (found.corrected + found.discarded == 0) return;
  run.note(
      fmt::format("fringe orders of {} pixels corrected and of {} discarded, at whose border "
                  "the order jumps although all phases are smooth, as indirect light causes it",
                  found.corrected,
                  found.discarded));
}

}  // namespace frangia
