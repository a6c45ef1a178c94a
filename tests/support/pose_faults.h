#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "frangia/core/missing.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/range/triangulate.h"
#include "frangia/registration/register_views.h"
#include "frangia/rig/rig.h"
#include "frangia/simulate/parts.h"
#include "frangia/views/view_store.h"

#include "support/faulty_scan.h"

namespace frangia::testing {

/// How far a registered scan is from the part.
struct SurfaceError {
  double rms_mm = 0.0;              ///< of blocks
  double over_sigma = kMissing;     ///< root mean square of the blocks' errors over their sigma
  double share_beyond = 0.0;        ///< of the blocks with an error above 3 sigma
  double largest_mm = 0.0;          ///< error that 1 % of the blocks exceed
  double largest_over_sigma = 0.0;  ///< error over sigma that 1 % of the blocks exceed
};

/// What the points of a scan are compared with.
enum class ErrorFrom : std::uint8_t {
  SamePoint,  ///< of the part that the pixel saw
  Surface     ///< the nearest point of the part, which may be another one of a round part
};

/// The errors of a registered scan along the part's normals, as means over blocks of pixels, so
/// that noise does not count, after the rigid motion that fits the points best. Their sigma is that
/// of the poses, but for a rigid motion of all, of 2 um that views have by themselves, and of the
/// noise of the mean of a block.
class SurfaceErrors {
 public:
  SurfaceErrors(const FaultyScan& scan,
                const RayScene& part,
                const ViewStore& store,
                int block_px = 12,
                ErrorFrom from = ErrorFrom::SamePoint)
      : block_px_(block_px), from_(from) {
    for (std::size_t view = 0; view < store.size(); ++view)
      add_view(scan, part, store, view);
    fit();
  }

  [[nodiscard]] SurfaceError over(const ViewMotions& motions) const {
    constexpr double kSystematic_mm = 0.002;
    SurfaceError error;
    double squares = 0.0;
    double ratios = 0.0;
    double beyond = 0.0;
    std::vector<double> errors_mm;
    std::vector<double> over_sigma;
    const bool known = !motions.empty();
    Matrix6X rigid;
    if (known) {
      rigid = Matrix6X::Zero(6, motions.front().cols());
      for (const Block& block : blocks_)
        rigid += block.row * (block.row.transpose() * motions[block.view]);
      const Matrix6 regular = squares_ + 1e-9 * Matrix6::Identity();
      rigid = regular.ldlt().solve(rigid).eval();
    }
    for (const Block& block : blocks_) {
      const double e = block.error_mm + block.row.dot(motion_);
      squares += e * e;
      double variance = std::pow(kSystematic_mm, 2) + block.variance_mm2;
      if (known) variance += (block.row.transpose() * (motions[block.view] - rigid)).squaredNorm();
      ratios += e * e / variance;
      beyond += e * e > 9.0 * variance ? 1.0 : 0.0;
      errors_mm.push_back(std::abs(e));
      over_sigma.push_back(std::abs(e) / std::sqrt(variance));
    }
    error.largest_mm = all_but_a_hundredth(std::move(errors_mm));
    error.largest_over_sigma = all_but_a_hundredth(std::move(over_sigma));
    const double count = std::max<double>(1.0, static_cast<double>(blocks_.size()));
    error.rms_mm = std::sqrt(squares / count);
    error.over_sigma = std::sqrt(ratios / count);
    error.share_beyond = beyond / count;
    return error;
  }

 private:
  using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Row6 = Eigen::Matrix<double, 6, 1>;

  struct Block {
    std::size_t view = 0;
    Row6 row = Row6::Zero();  ///< displacement along the normal by a rigid motion
    double error_mm = 0.0;
    double variance_mm2 = 0.0;
    double count = 0.0;
  };

  static double all_but_a_hundredth(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
    std::nth_element(values.begin(), at, values.end());
    return *at;
  }

  void add_view(const FaultyScan& scan,
                const RayScene& part,
                const ViewStore& store,
                std::size_t view) {
    const double fewest = 0.2 * block_px_ * block_px_;  // points of a block
    const CameraModel& camera = scan.stated.reference().model;
    const auto rays = rays_of(camera);
    const auto true_rays = rays_of(scan.views[view].rig.reference().model);
    const View own = store.load(view);
    const Isometry part_from_rig = scan.rig_from_part(view).inverse();
    const Isometry object_from_rig = store.rig_from_object(view).inverse();
    const int columns = camera.width_px / block_px_ + 1;
    std::vector<Block> blocks(
        static_cast<std::size_t>(columns * (camera.height_px / block_px_ + 1)));
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const float depth = own.range.depth_mm(x, y);
        if (std::isnan(depth)) continue;
        const Eigen::Vector3d along =
            part_from_rig.linear() * true_rays(x, y).cast<double>().homogeneous();
        const auto hit = part.first_hit(part_from_rig.translation(), along);
        if (!hit) continue;
        const Eigen::Vector3d point = object_from_rig * (static_cast<double>(depth) *
                                                         rays(x, y).cast<double>().homogeneous());
        const Eigen::Vector3d truth = part_from_rig.translation() + hit->distance * along;
        Block& block = blocks[static_cast<std::size_t>(y / block_px_ * columns + x / block_px_)];
        Row6 row;
        row << point.cross(hit->normal), hit->normal;
        block.row += row;
        block.error_mm += from_ == ErrorFrom::SamePoint ? hit->normal.dot(point - truth)
                                                        : part.nearest(point)->signed_distance_mm;
        block.variance_mm2 += std::pow(static_cast<double>(own.range.sigma_mm(x, y)), 2);
        block.count += 1.0;
      }
    }
    for (Block& block : blocks) {
      if (block.count < fewest) continue;
      block.view = view;
      block.row /= block.count;
      block.error_mm /= block.count;
      block.variance_mm2 /= block.count * block.count;
      blocks_.push_back(block);
    }
  }

  /// Point to plane: the scan as a whole may be anywhere.
  void fit() {
    Row6 sum = Row6::Zero();
    for (const Block& block : blocks_) {
      squares_ += block.row * block.row.transpose();
      sum += block.error_mm * block.row;
    }
    const Matrix6 regular = squares_ + 1e-9 * Matrix6::Identity();
    motion_ = -regular.ldlt().solve(sum);
  }

  using Isometry = Eigen::Isometry3d;
  int block_px_;  ///< side of a block
  ErrorFrom from_;
  std::vector<Block> blocks_;
  Matrix6 squares_ = Matrix6::Zero();
  Row6 motion_ = Row6::Zero();
};

/// A registration of a faulty scan.
struct Registered {
  RegistrationReport report;
  SurfaceError error;
  std::vector<std::string> warnings;
  double error_mm = 0.0;
};

inline Registered registered(const FaultyScan& scan,
                             const RayScene& part,
                             bool with_error = true,
                             const RegisterOptions& options = {}) {
  Registered out;
  ViewStore views = scan.take(part);
  const auto stations = scan.stations();
  Run run;
  run.on_warning = [&](const std::string& sentence) { out.warnings.push_back(sentence); };
  out.report =
      register_views(views, scan.stated.reference().model, scan.given(stations), options, run);
  if (with_error) out.error = SurfaceErrors(scan, part, views).over(out.report.motions);
  out.error_mm = out.error.rms_mm;
  return out;
}

inline const RayScene& bracket() {
  static const RayScene kPart(make_part("bracket"));
  return kPart;
}

inline const RayScene& ball_bar() {
  static const RayScene kPart(make_part("ball-bar"));
  return kPart;
}

}  // namespace frangia::testing
