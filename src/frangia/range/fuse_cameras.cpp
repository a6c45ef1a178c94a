#include "frangia/range/fuse_cameras.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/range/internal/common_point.h"
#include "frangia/range/internal/phase_sample.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {
namespace {

void check(std::span<const CameraPhases> cameras, std::span<const RangeGrid> ranges) {
  require(cameras.size() >= 2 && cameras.size() == ranges.size(),
          "fuse_cameras: needs two cameras or more, and a range grid for each");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::size_t directions = cameras[i].phases.size();
    require(directions >= 1 && directions <= 2 && directions == cameras.front().phases.size(),
            "fuse_cameras: the cameras differ in the directions of their fringes");
    require(same_size(ranges[i].depth_mm, cameras[i].rays),
            "fuse_cameras: range grid and rays differ in size");
    for (const AbsolutePhase* phase : cameras[i].phases) {
      require(same_size(phase->phase_rad, cameras[i].rays),
              "fuse_cameras: phase and rays differ in size");
    }
  }
}

/// What the differences of the cameras show about the rig.
struct Consistency {
  CameraDisagreement disagreement;
  double typical_mm = 0.0;  ///< standard deviation of the differences
  double excess_mm = 0.0;   ///< its part that the known uncertainties do not explain
};

/// A pixel of a camera that contradicts a point.
struct SeenThrough {
  std::size_t camera;
  int x;
  int y;
};

class CameraFusion {
 public:
  CameraFusion(std::span<const CameraPhases> cameras,
               std::span<RangeGrid> ranges,
               const FuseCamerasOptions& options,
               const Run& run)
      : cameras_(cameras),
        ranges_(ranges),
        options_(options),
        run_(run),
        is_label_(cameras.front().rig.projector.is_label) {
    for (const CameraPhases& camera : cameras) {
      samplers_.emplace_back();
      for (const AbsolutePhase* phase : camera.phases)
        samplers_.back().emplace_back(*phase);
    }
    for (std::size_t i = 0; i < cameras.size(); ++i)
      points_.emplace_back(cameras, samplers_, i);
  }

  CameraDisagreement fuse() {
    if (is_label_) refine_matches();
    Consistency found = compare();
    for (const RangeGrid& range : ranges_)
      depths_.push_back(range.depth_mm);
    for (std::size_t i = 0; i < cameras_.size(); ++i)
      fuse_camera(i, found);
    for (const SeenThrough& pixel : seen_through_) {
      RangeGrid& range = ranges_[pixel.camera];
      if (std::isnan(range.depth_mm(pixel.x, pixel.y))) continue;
      range.remove(pixel.x, pixel.y);
      ++found.disagreement.removed;
    }
    return found.disagreement;
  }

 private:
  [[nodiscard]] Eigen::Vector3d ray_of(std::size_t camera, int x, int y) const {
    return cameras_[camera].rays(x, y).cast<double>().homogeneous();
  }

  /// Whether another camera sees the phases of a pixel near the point: with a label, nothing else
  /// tells which cameras see it.
  [[nodiscard]] bool is_near(
      std::size_t own, int x, int y, std::size_t other, const OtherSight& seen) const {
    if (!seen.visible) return false;
    for (std::size_t i = 0; i < samplers_[other].size(); ++i) {
      const auto phase = static_cast<double>(cameras_[own].phases[i]->phase_rad(x, y));
      if (std::abs(phase - seen.phases[i].phase_rad) > samplers_[other][i].jump_rad()) return false;
    }
    return true;
  }

  /// Replaces the start values of a label by the points of all cameras that see them.
  void refine_matches() {
    for (std::size_t own = 0; own < cameras_.size(); ++own) {
      RangeGrid& range = ranges_[own];
      parallel_rows(range.depth_mm.height(), [&](int y) {
        if (run_.stop.stop_requested()) return;
        std::vector<std::size_t> others;
        for (int x = 0; x < range.depth_mm.width(); ++x) {
          float& depth = range.depth_mm(x, y);
          if (std::isnan(depth)) continue;
          others.clear();
          for (std::size_t other = 0; other < cameras_.size(); ++other) {
            if (other == own) continue;
            const OtherSight seen =
                points_[own].sight(other, ray_of(own, x, y), static_cast<double>(depth));
            if (is_near(own, x, y, other, seen)) others.push_back(other);
          }
          const std::vector<double> equal(others.size(), 1.0);
          depth =
              others.empty()
                  ? kMissing
                  : static_cast<float>(points_[own]
                                           .solve(x, y, static_cast<double>(depth), others, equal)
                                           .depth_mm);
        }
      });
      run_.check();
    }
  }

  /// What one camera compares with another one.
  struct PairOfCameras {
    std::size_t own;
    std::size_t other;
    std::vector<DepthPair> pairs;
  };

  /// Compares with the uncertainty of the calibration, too: the two cameras that agree worst
  /// decide.
  void ask_calibration(std::span<const PairOfCameras> by_cameras, Consistency& out) const {
    std::optional<DepthAgreement> worst;
    for (const auto& [own, other, pairs] : by_cameras) {
      if (pairs.empty()) continue;
      const DifferenceUncertainty calibration = options_.calibration(own, other);
      if (!calibration) return;
      DepthAgreement known = measure_agreement(pairs, calibration);
      if (!worst || known.chi_squared > worst->chi_squared) worst = std::move(known);
    }
    if (!worst) return;
    out.disagreement.chi_squared = worst->chi_squared;
    out.disagreement.beyond = worst->beyond;
    out.disagreement.by_calibration = worst->by_calibration;
  }

  /// Compares the cameras on every fourth row.
  [[nodiscard]] Consistency compare() const {
    constexpr int kRows = 4;
    std::vector<DepthPair> pairs;
    std::vector<PairOfCameras> by_cameras;
    for (std::size_t own = 0; own < cameras_.size(); ++own) {
      const Image<float>& depth = ranges_[own].depth_mm;
      const int rows = depth.height() / kRows;
      std::vector<std::vector<DepthPair>> found(static_cast<std::size_t>(rows));
      std::vector<std::vector<std::size_t>> others(static_cast<std::size_t>(rows));
      parallel_rows(rows, [&](int row) {
        const int y = kRows * row;
        for (int x = 0; x < depth.width(); ++x) {
          const auto start = static_cast<double>(depth(x, y));
          if (std::isnan(start)) continue;
          for (std::size_t other = 0; other < cameras_.size(); ++other) {
            if (other == own) continue;
            const OtherSight seen = points_[own].sight(other, ray_of(own, x, y), start);
            const DepthDifference apart = points_[own].compare(x, y, start, seen);
            if (std::isnan(apart.mm)) continue;
            const DepthPair pair{.x = x,
                                 .y = y,
                                 .point_mm = (start * ray_of(own, x, y)).cast<float>(),
                                 .apart_mm = static_cast<float>(apart.mm),
                                 .sigma_mm = static_cast<float>(apart.sigma_mm),
                                 .systematic_mm = static_cast<float>(apart.systematic_mm)};
            found[static_cast<std::size_t>(row)].push_back(pair);
            others[static_cast<std::size_t>(row)].push_back(other);
          }
        }
      });
      run_.check();
      for (std::size_t other = own + 1; other < cameras_.size(); ++other)
        by_cameras.push_back({own, other, {}});
      for (std::size_t row = 0; row < found.size(); ++row) {
        pairs.insert(pairs.end(), found[row].begin(), found[row].end());
        for (std::size_t i = 0; i < found[row].size(); ++i) {
          for (PairOfCameras& two : by_cameras)
            if (two.own == own && two.other == others[row][i]) two.pairs.push_back(found[row][i]);
        }
      }
    }
    Consistency out;
    static_cast<DepthAgreement&>(out.disagreement) = measure_agreement(pairs);
    if (pairs.empty()) return out;
    out.typical_mm = out.disagreement.median_mm / kMedianOfNormal;
    const double ratio2 = out.disagreement.chi_squared;
    if (options_.calibration && ratio2 >= kConsistent) ask_calibration(by_cameras, out);
    if (ratio2 > 1.0 && !out.disagreement.by_calibration)
      out.excess_mm = out.typical_mm * std::sqrt(1.0 - 1.0 / ratio2);
    return out;
  }

  /// Pixels of another camera along a pixel of this one, as the square root of the ratio of areas;
  /// 1 at the boundary of the measured points.
  [[nodiscard]] double px_per_px(
      std::size_t own, int x, int y, std::size_t other, const OtherSight& seen) const {
    constexpr double kMost = 4.0;
    const Image<float>& depth = depths_[own];
    Eigen::Matrix2d moved;
    for (const int axis : {0, 1}) {
      const int dx = axis == 0 ? (x + 1 < depth.width() ? 1 : -1) : 0;
      const int dy = axis == 1 ? (y + 1 < depth.height() ? 1 : -1) : 0;
      const auto next = static_cast<double>(depth(x + dx, y + dy));
      if (std::isnan(next)) return 1.0;
      moved.col(axis) =
          points_[own].pixel_of(other, ray_of(own, x + dx, y + dy), next) - seen.pixel;
    }
    const double ratio = std::sqrt(std::abs(moved.determinant()));
    return std::isnan(ratio) ? 1.0 : std::clamp(ratio, 1.0 / kMost, kMost);
  }

  /// Whether another camera sees a surface behind a point: it sees through the point.
  [[nodiscard]] bool sees_through(std::size_t other,
                                  const OtherSight& seen,
                                  double tolerance_mm) const {
    const Image<float>& depth = depths_[other];
    const Eigen::Vector2d at = seen.pixel;
    if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() < depth.width() - 1.0 &&
          at.y() < depth.height() - 1.0))
      return false;
    const int left = static_cast<int>(at.x());
    const int top = static_cast<int>(at.y());
    const auto is_behind = [&](int x, int y) {
      return static_cast<double>(depth(x, y)) > seen.point.z() + tolerance_mm;
    };
    return is_behind(left, top) && is_behind(left + 1, top) && is_behind(left, top + 1) &&
           is_behind(left + 1, top + 1);
  }

  struct Outcome {
    RangePixel pixel;
    bool fused = false;
    bool removed = false;
  };

  [[nodiscard]] Outcome fuse_pixel(std::size_t own,
                                   int x,
                                   int y,
                                   const Consistency& found,
                                   std::vector<SeenThrough>& contradictions) const {
    const double start = static_cast<double>(depths_[own](x, y));
    const Eigen::Vector3d ray = ray_of(own, x, y);
    Outcome out{ranges_[own].pixel(x, y)};
    std::vector<std::size_t> others;
    std::vector<double> densities;
    double shared = 1.0;
    double mm_per_mm = 1.0;  // of depth, over the distance that is compared
    for (std::size_t other = 0; other < cameras_.size(); ++other) {
      if (other == own) continue;
      const OtherSight seen = points_[own].sight(other, ray, start);
      if (is_label_ && !is_near(own, x, y, other, seen)) continue;
      const DepthDifference apart = points_[own].compare(x, y, start, seen);
      const double limit =
          options_.max_sigmas *
          std::hypot(apart.sigma_mm, std::max(apart.systematic_mm, found.typical_mm));
      const bool compared = !std::isnan(apart.mm);
      if (seen.visible && (compared ? std::abs(apart.mm) <= limit : is_label_)) {
        others.push_back(other);
        densities.push_back(px_per_px(own, x, y, other, seen));
        shared += densities.back() * densities.back();
        if (is_label_) {
          const CameraModel& model = cameras_[other].rig.reference().model;
          mm_per_mm =
              model.focal_px.mean() / (seen.point.z() * std::max(seen.px_per_mm.norm(), 1e-12));
        }
      } else if (!is_label_ && compared && sees_through(other, seen, limit)) {
        out.removed = true;
        contradictions.push_back({other,
                                  static_cast<int>(std::lround(seen.pixel.x())),
                                  static_cast<int>(std::lround(seen.pixel.y()))});
      }
    }
    if (out.removed) return out;
    const double along_ray = ray.norm();
    const double excess_mm = found.excess_mm * (is_label_ ? mm_per_mm : 1.0);
    if (!others.empty()) {
      const CommonDepth common = points_[own].solve(x, y, start, others, densities);
      if (!std::isnan(common.depth_mm)) {
        out.fused = true;
        out.pixel.depth_mm = static_cast<float>(common.depth_mm);
        out.pixel.sigma_mm = static_cast<float>(along_ray * common.sigma_mm * std::sqrt(shared));
        out.pixel.systematic_mm = static_cast<float>(along_ray * common.systematic_mm);
      }
    }
    if (is_label_) {
      out.removed = !out.fused;
      out.pixel.phase_rad = cameras_[own].phases.front()->phase_rad(x, y);
    }
    if (std::isnan(out.pixel.systematic_mm)) out.pixel.systematic_mm = 0.0F;
    out.pixel.systematic_mm =
        combined_sigma(out.pixel.systematic_mm, static_cast<float>(excess_mm));
    return out;
  }

  void fuse_camera(std::size_t own, Consistency& found) {
    RangeGrid& range = ranges_[own];
    const int width = range.depth_mm.width();
    const int height = range.depth_mm.height();
    const bool has_systematic =
        found.excess_mm > 0.0 ||
        std::any_of(cameras_.begin(), cameras_.end(), [](const CameraPhases& camera) {
          return !camera.phases.front()->systematic_rad.empty();
        });
    for (Image<float>* image : {&range.sigma_mm, &range.phase_rad}) {
      if (image->empty()) *image = Image<float>(width, height, kMissing);
    }
    if (has_systematic && range.systematic_mm.empty())
      range.systematic_mm = Image<float>(width, height, kMissing);
    struct Row {
      std::size_t fused = 0;
      std::size_t removed = 0;
      std::vector<SeenThrough> contradictions{};
    };
    std::vector<Row> rows(static_cast<std::size_t>(height));
    parallel_rows(height, [&](int y) {
      if (run_.stop.stop_requested()) return;
      Row& row = rows[static_cast<std::size_t>(y)];
      for (int x = 0; x < width; ++x) {
        if (std::isnan(depths_[own](x, y))) continue;
        const Outcome out = fuse_pixel(own, x, y, found, row.contradictions);
        if (out.removed) {
          range.remove(x, y);
          ++row.removed;
        } else {
          range.set(out.pixel);
          if (out.fused) ++row.fused;
        }
      }
    });
    run_.check();
    for (const Row& row : rows) {
      found.disagreement.fused += row.fused;
      found.disagreement.removed += row.removed;
      seen_through_.insert(
          seen_through_.end(), row.contradictions.begin(), row.contradictions.end());
    }
  }

  std::span<const CameraPhases> cameras_;
  std::span<RangeGrid> ranges_;
  const FuseCamerasOptions& options_;
  const Run& run_;
  bool is_label_;
  std::vector<std::vector<PhaseSampler>> samplers_;  ///< by camera and direction
  std::vector<CommonPoint> points_;                  ///< by camera
  std::vector<Image<float>> depths_;                 ///< before fusion, by camera
  std::vector<SeenThrough> seen_through_;
};

}  // namespace

CameraDisagreement fuse_cameras(std::span<const CameraPhases> cameras,
                                std::span<RangeGrid> ranges,
                                const FuseCamerasOptions& options,
                                const Run& run) {
  check(cameras, ranges);
  return CameraFusion(cameras, ranges, options, run).fuse();
}

}  // namespace frangia
