#include "frangia/rig/fringe_waveform.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace frangia {

double FringeWaveform::light_at(double phase_rad) const {
  double light = std::cos(phase_rad);
  for (std::size_t i = 0; i < harmonics.size(); ++i)
    light += (harmonics[i] * std::polar(1.0, static_cast<double>(i + 2) * phase_rad)).real();
  return light;
}

double FringeWaveform::amplitude(int order) const {
  const auto i = static_cast<std::size_t>(order - 2);
  return order < 2 || i >= harmonics.size() ? 0.0 : std::abs(harmonics[i]);
}

const FringeWaveform* find_waveform(const std::vector<FringeWaveform>& waveforms,
                                    const Pattern& pattern) {
  const FringeWaveform* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const FringeWaveform& waveform : waveforms) {
    if (waveform.direction != pattern.direction) continue;
    const bool comparable = waveform.period_px > 0.0 && pattern.period_px > 0.0;
    const double apart =
        comparable ? std::abs(std::log(waveform.period_px / pattern.period_px)) : 0.0;
    if (nearest != nullptr && apart >= least) continue;
    nearest = &waveform;
    least = apart;
  }
  return nearest;
}

}  // namespace frangia
