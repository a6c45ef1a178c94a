#include "frangia/phase/waveform/correct_response.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr std::size_t kProjectedPhases =
    2880;  ///< projected phases per fringe at which the error is computed
constexpr std::size_t kTableIntervals = 1024;  ///< intervals of the table

/// The table for fringes whose light over the phase is `light_of`; empty where two phases measure
/// alike.
template <typename Light>
std::optional<ResponseTable> table_of(const Light& light_of,
                                      const PhaseAlgorithm& algorithm,
                                      const std::vector<double>& shifts_rad) {
  std::vector<double> light(shifts_rad.size());
  const auto measured_phase = [&](double phase) {
    for (std::size_t k = 0; k < light.size(); ++k)
      light[k] = light_of(phase + shifts_rad[k]);
    return phase_of(algorithm, light);
  };
  // The measured phase is unwrapped, so that it rises over the whole fringe.
  std::vector<double> true_phase;
  std::vector<double> found;
  for (std::size_t i = 0; i <= kProjectedPhases; ++i) {
    const double phase = -kPi + kTwoPi * static_cast<double>(i) / kProjectedPhases;
    const double seen = measured_phase(phase);
    true_phase.push_back(phase);
    found.push_back(found.empty() ? phase + wrap_rad(seen - phase)
                                  : found.back() + wrap_rad(seen - found.back()));
    if (found.size() > 1 && !(found.back() > found[found.size() - 2])) return {};
  }
  ResponseTable table;
  for (std::size_t i = 0; i <= kTableIntervals; ++i) {
    double seen = -kPi + kTwoPi * static_cast<double>(i) / kTableIntervals;
    while (seen < found.front())
      seen += kTwoPi;
    while (seen > found.back())
      seen -= kTwoPi;
    const auto above = std::lower_bound(found.begin() + 1, found.end() - 1, seen);
    const auto k = static_cast<std::size_t>(above - found.begin());
    const double within = (seen - found[k - 1]) / (found[k] - found[k - 1]);
    table.correction_rad.push_back(
        static_cast<float>(std::lerp(true_phase[k - 1], true_phase[k], within) - seen));
  }
  return table;
}

ResponseTable required(std::optional<ResponseTable> table) {
  require(table.has_value(),
          "the projector's response is too nonlinear for its fringes to determine the phase; "
          "correct the projected patterns instead");
  return *std::move(table);
}

}  // namespace

ResponseTable response_table(const ResponseCurve& response,
                             const PhaseAlgorithm& algorithm,
                             const std::vector<double>& shifts_rad) {
  return required(
      table_of([&](double phase) { return response.light_of(0.5 + 0.5 * std::cos(phase)); },
               algorithm,
               shifts_rad));
}

ResponseTable response_table(const FringeWaveform& waveform,
                             const PhaseAlgorithm& algorithm,
                             const std::vector<double>& shifts_rad) {
  return required(find_response_table(waveform, algorithm, shifts_rad));
}

std::optional<ResponseTable> find_response_table(const FringeWaveform& waveform,
                                                 const PhaseAlgorithm& algorithm,
                                                 const std::vector<double>& shifts_rad) {
  return table_of([&](double phase) { return waveform.light_at(phase); }, algorithm, shifts_rad);
}

double correction_at(const ResponseTable& table, double phase_rad) {
  const auto intervals = static_cast<double>(table.correction_rad.size() - 1);
  const double position =
      std::clamp((wrap_rad(phase_rad) + kPi) / kTwoPi * intervals, 0.0, intervals - 0.5);
  const auto k = static_cast<std::size_t>(position);
  return std::lerp(static_cast<double>(table.correction_rad[k]),
                   static_cast<double>(table.correction_rad[k + 1]),
                   position - static_cast<double>(k));
}

void correct_response(const ResponseTable& table, WrappedPhase& phase) {
  const auto intervals = static_cast<float>(table.correction_rad.size() - 1);
  const auto step = static_cast<float>(kTwoPi) / intervals;
  parallel_rows(phase.phase_rad.height(), [&](int y) {
    for (int x = 0; x < phase.phase_rad.width(); ++x) {
      float& value = phase.phase_rad(x, y);
      if (std::isnan(value)) continue;
      const float position =
          std::clamp((value + static_cast<float>(kPi)) / step, 0.0F, intervals - 0.5F);
      const auto k = static_cast<std::size_t>(position);
      const float rise = table.correction_rad[k + 1] - table.correction_rad[k];
      value = static_cast<float>(wrap_rad(static_cast<double>(
          value + table.correction_rad[k] + rise * (position - static_cast<float>(k)))));
      phase.sigma_rad(x, y) *= 1.0F + rise / step;
      if (!phase.systematic_rad.empty()) phase.systematic_rad(x, y) *= 1.0F + rise / step;
    }
  });
}

}  // namespace frangia
