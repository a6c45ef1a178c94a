#include "frangia/range/match_by_phase.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/internal/epipolar_rows.h"
#include "frangia/range/internal/phase_sample.h"

namespace frangia {
namespace {

/// Crossings at fewer columns from each other are one, which noise has split.
constexpr int kSameColumns = 3;

/// Calls `found` with the column of each crossing of a phase within columns [0, end) of a row.
template <typename Found>
void for_each_crossing(
    const float* row, int end, float phase_rad, float jump_rad, const Found& found) {
  int last = -2 * kSameColumns;
  for (int i = 0; i + 1 < end; ++i) {
    const float here = row[i] - phase_rad;
    const float next = row[i + 1] - phase_rad;
    // False for NaN, too.
    if (!((here <= 0.0F && next > 0.0F) || (here > 0.0F && next <= 0.0F))) continue;
    if (!(std::abs(next - here) < jump_rad)) continue;
    if (i - last >= kSameColumns)
      found(static_cast<double>(i) + static_cast<double>(here / (here - next)));
    last = i;
  }
}

/// Whether a phase occurs at one place only of a camera's own epipolar line.
bool is_unique(const EpipolarRows& own, double angle, float phase_rad) {
  const float* row = own.row_at(angle);
  int crossings = 0;
  if (row != nullptr) {
    for_each_crossing(
        row, own.phase_rad.width(), phase_rad, own.jump_rad, [&](double) { ++crossings; });
  }
  return crossings <= 1;
}

class Matcher {
 public:
  Matcher(const CameraPhases& first, const CameraPhases& second)
      : first_(first),
        second_(second),
        second_from_first_(second.camera_from_rig * first.camera_from_rig.inverse()),
        planes_(epipolar_planes(second_from_first_)) {
    for (const AbsolutePhase* phase : second.phases)
      samplers_.emplace_back(*phase);
    const PhaseSampler own(*first.phases.front());
    own_ = epipolar_rows(first, Eigen::Isometry3d::Identity(), planes_, own);
    other_ = epipolar_rows(second, second_from_first_, planes_, samplers_.front());
  }

  /// The depth of a pixel; NaN without a unique match.
  [[nodiscard]] float depth_of(int x, int y) const {
    const float phase_rad = first_.phases.front()->phase_rad(x, y);
    if (std::isnan(phase_rad) || other_.phase_rad.empty()) return kMissing;
    const Eigen::Vector3d ray = first_.rays(x, y).cast<double>().homogeneous();
    const Eigen::Vector2d at = planes_.coordinates_of(ray);
    const float* row = other_.row_at(at.x());
    if (row == nullptr) return kMissing;
    // Points in front of both cameras have a smaller cotangent in the second.
    const double end = std::min((at.y() - other_.first_cot) / other_.step + 1.0,
                                static_cast<double>(other_.phase_rad.width()));
    if (!(end >= 2.0)) return kMissing;
    return samplers_.size() == 1 ? by_one_direction(row, static_cast<int>(end), phase_rad, ray, at)
                                 : by_two_directions(row, static_cast<int>(end), {x, y}, ray, at);
  }

 private:
  /// The depth of the crossing at a column; NaN behind the camera.
  [[nodiscard]] double depth_at(double column, const Eigen::Vector3d& ray, double cot) const {
    const double parallax = cot - (other_.first_cot + column * other_.step);
    const Eigen::Vector3d along = planes_.axes * ray;
    const double depth = planes_.baseline_mm / (parallax * std::hypot(along.y(), along.z()));
    return parallax > 0.0 && (second_from_first_ * (depth * ray)).z() > 0.0
               ? depth
               : std::numeric_limits<double>::quiet_NaN();
  }

  [[nodiscard]] float by_one_direction(const float* row,
                                       int end,
                                       float phase_rad,
                                       const Eigen::Vector3d& ray,
                                       const Eigen::Vector2d& at) const {
    int candidates = 0;
    double depth = std::numeric_limits<double>::quiet_NaN();
    for_each_crossing(row, end, phase_rad, other_.jump_rad, [&](double column) {
      const double found = depth_at(column, ray, at.y());
      if (std::isnan(found)) return;
      depth = found;
      ++candidates;
    });
    const bool unique = candidates == 1 && is_unique(own_, at.x(), phase_rad);
    return unique ? static_cast<float>(depth) : kMissing;
  }

  [[nodiscard]] float by_two_directions(const float* row,
                                        int end,
                                        const Eigen::Vector2i& pixel,
                                        const Eigen::Vector3d& ray,
                                        const Eigen::Vector2d& at) const {
    const float phase_rad = first_.phases.front()->phase_rad(pixel.x(), pixel.y());
    const double across_rad =
        static_cast<double>(first_.phases.back()->phase_rad(pixel.x(), pixel.y()));
    if (std::isnan(across_rad)) return kMissing;
    double best = samplers_.back().jump_rad();
    double depth = std::numeric_limits<double>::quiet_NaN();
    for_each_crossing(row, end, phase_rad, other_.jump_rad, [&](double column) {
      const double found = depth_at(column, ray, at.y());
      if (std::isnan(found)) return;
      const Eigen::Vector3d seen = second_from_first_ * (found * ray);
      const double misfit_rad = std::abs(
          samplers_.back().at(second_.rig.reference().model.project(seen)).phase_rad - across_rad);
      if (!(misfit_rad < best)) return;
      best = misfit_rad;
      depth = found;
    });
    return static_cast<float>(depth);
  }

  const CameraPhases& first_;
  const CameraPhases& second_;
  Eigen::Isometry3d second_from_first_;
  EpipolarPlanes planes_;
  std::vector<PhaseSampler> samplers_;  ///< of the second camera
  EpipolarRows own_;
  EpipolarRows other_;
};

}  // namespace

Image<float> match_by_phase(const CameraPhases& first, const CameraPhases& second, const Run& run) {
  require(!first.phases.empty() && first.phases.size() == second.phases.size(),
          "match_by_phase: the cameras differ in the directions of their fringes");
  const Matcher matcher(first, second);
  Image<float> depth_mm(first.rays.width(), first.rays.height(), kMissing);
  parallel_rows(depth_mm.height(), [&](int y) {
    if (run.stop.stop_requested()) return;
    for (int x = 0; x < depth_mm.width(); ++x)
      depth_mm(x, y) = matcher.depth_of(x, y);
  });
  run.check();
  return depth_mm;
}

}  // namespace frangia
