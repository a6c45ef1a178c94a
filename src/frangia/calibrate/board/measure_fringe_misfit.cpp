#include "frangia/calibrate/board/measure_fringe_misfit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/least_squares.h"
#include "frangia/core/median.h"

namespace frangia {
namespace {

struct SinusoidFit {
  double mean = 0.0;
  double modulation = 0.0;
  double residual = 0.0;  ///< standard deviation of one frame
};

}  // namespace

double measure_fringe_misfit(const FrameStack& stack, std::span<const BoardPoint> points) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr int kParameters = 3;
  const auto frames = static_cast<Eigen::Index>(stack.frames.size());
  if (frames <= kParameters || points.empty()) return kNone;
  Eigen::MatrixXd terms(frames, kParameters);
  for (Eigen::Index i = 0; i < frames; ++i) {
    const double shift = stack.pattern.shifts_rad[static_cast<std::size_t>(i)];
    terms.row(i) << 1.0, std::cos(shift), std::sin(shift);
  }
  const Eigen::MatrixXd fit_of_counts =
      least_squares(terms, Eigen::MatrixXd::Identity(frames, frames));
  Eigen::AlignedBox2d box;
  for (const BoardPoint& point : points)
    box.extend(point.camera_px);
  const Frame& first = stack.frames.front();
  const int left = std::max(0, static_cast<int>(box.min().x()));
  const int top = std::max(0, static_cast<int>(box.min().y()));
  const int right = std::min(width_of(first), static_cast<int>(box.max().x()));
  const int bottom = std::min(height_of(first), static_cast<int>(box.max().y()));
  constexpr int kStride = 4;  // every sixteenth pixel is enough for a median
  std::vector<SinusoidFit> fits;
  Eigen::VectorXd counts(frames);
  for (int y = top; y < bottom; y += kStride) {
    for (int x = left; x < right; x += kStride) {
      for (Eigen::Index i = 0; i < frames; ++i)
        counts[i] = counts_at(stack.frames[static_cast<std::size_t>(i)], x, y);
      if (counts.maxCoeff() >= stack.white_level) continue;
      const Eigen::Vector3d fit = fit_of_counts * counts;
      const double squares = (counts - terms * fit).squaredNorm();
      fits.push_back({fit[0],
                      std::hypot(fit[1], fit[2]),
                      std::sqrt(squares / static_cast<double>(frames - kParameters))});
    }
  }
  if (fits.empty()) return kNone;
  // The light squares, by their mean: that of swapped frames is the same, their modulation is not.
  constexpr double kBright = 0.75;
  const auto bright =
      fits.begin() + static_cast<std::ptrdiff_t>(kBright * static_cast<double>(fits.size() - 1));
  std::nth_element(fits.begin(), bright, fits.end(), [](const auto& a, const auto& b) {
    return a.mean < b.mean;
  });
  std::vector<double> residuals;
  std::vector<double> modulations;
  for (auto fit = bright; fit != fits.end(); ++fit) {
    residuals.push_back(fit->residual);
    modulations.push_back(fit->modulation);
  }
  const double modulation = median(modulations);
  return modulation > 0.0 ? median(residuals) / modulation : kNone;
}

}  // namespace frangia
