#include "frangia/reconstruct/targets_report.h"

#include <fmt/format.h>

namespace frangia {

std::string TargetsReport::text() const {
  std::string text = fmt::format("{} target{}, {} of them seen by several views",
                                 targets.size(),
                                 targets.size() == 1 ? "" : "s",
                                 tying);
  if (tying_setups > 0) text += fmt::format(" and {} by several setups", tying_setups);
  if (tying > 0)
    text += fmt::format(
        ", whose places agree to {:.4f} mm, {:.2g} times their sigma", rms_mm, over_sigma);
  if (scale) {
    text += fmt::format(
        "; {} known distance{} scale{} the surface by {:.6f} with a standard "
        "uncertainty of {:.6f}",
        scale->distances,
        scale->distances == 1 ? "" : "s",
        scale->distances == 1 ? "s" : "",
        scale->factor,
        scale->sigma);
  }
  return text;
}

}  // namespace frangia
