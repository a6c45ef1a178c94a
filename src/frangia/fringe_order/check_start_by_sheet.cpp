#include "frangia/fringe_order/check_start_by_sheet.h"

#include <cmath>
#include <complex>
#include <cstddef>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/range/triangulate.h"

namespace frangia {
namespace {

constexpr std::size_t kMinPoints = 20;
constexpr double kScattered = 0.5;     // the same, with the declared direction
constexpr double kReversed = 0.9;      // the same, with the opposite direction
constexpr double kConcentrated = 0.7;  // length of the mean of unit vectors
constexpr double kLargest_rad = kPi / 4.0;
constexpr double kQuarterTolerance_deg = 20.0;

}  // namespace

SequenceCheck check_start_by_sheet(const WrappedPhase& phase,
                                   std::span<const ProfilePoint> profile,
                                   const Projector& projector) {
  SequenceCheck out;
  out.patterns = {phase.pattern.name};
  std::complex<double> forward;
  std::complex<double> backward;
  std::size_t points = 0;
  for (const ProfilePoint& point : profile) {
    const int x = static_cast<int>(std::lround(point.pixel.x()));
    const int y = static_cast<int>(std::lround(point.pixel.y()));
    if (x < 0 || y < 0 || x >= phase.phase_rad.width() || y >= phase.phase_rad.height()) continue;
    const double measured = phase.phase_rad(x, y);
    const double expected = phase_at(point.point_mm, phase.pattern, projector);
    if (std::isnan(measured) || std::isnan(expected)) continue;
    forward += std::polar(1.0, measured - expected);
    backward += std::polar(1.0, -measured - expected);
    ++points;
  }
  if (points < kMinPoints) return out;
  // Where the phase hardly changes along the line, both signs are concentrated: the declared one
  // then stands.
  const std::complex<double> forward_mean = forward / static_cast<double>(points);
  const std::complex<double> backward_mean = backward / static_cast<double>(points);
  const bool reversed = std::abs(backward_mean) > kReversed && std::abs(forward_mean) < kScattered;
  const std::complex<double> mean = reversed ? backward_mean : forward_mean;
  if (std::abs(mean) < kConcentrated) return out;
  out.decided = true;
  out.misfit_rad = std::abs(std::arg(mean));
  out.consistent = !reversed && out.misfit_rad <= kLargest_rad;
  if (out.consistent) return out;
  double start_deg = deg_from_rad(std::arg(mean));
  const double quarter = 90.0 * std::round(start_deg / 90.0);
  if (std::abs(start_deg - quarter) < kQuarterTolerance_deg) start_deg = quarter;
  start_deg = std::round(start_deg - 360.0 * std::floor(start_deg / 360.0));
  const double declared_deg = deg_from_rad(phase.pattern.shifts_rad.front());
  SequenceFault fault{reversed ? SequenceFaultKind::Direction : SequenceFaultKind::Start,
                      {phase.pattern.name},
                      {},
                      {},
                      fmt::format("by the laser sheet, from {} points", points)};
  const std::string start = fmt::format("a start of {:g} degrees, not {:g} degrees",
                                        std::fmod(declared_deg + start_deg, 360.0),
                                        declared_deg);
  fault.what = !reversed          ? start
               : start_deg == 0.0 ? "shifts in the opposite direction"
                                  : "shifts in the opposite direction and " + start;
  out.fits.push_back(std::move(fault));
  return out;
}

}  // namespace frangia
