#include "frangia/indirect_light/extrapolate_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// Radius of the neighbourhoods, reach of a face and longest gap, as shares of the image's width.
constexpr double kWindow = 1.0 / 60;
constexpr double kReach = 1.0 / 8;
constexpr double kGap = 1.0 / 40;

/// A plane seen by the camera: its inverse depth is linear in the normalized image coordinates.
using InversePlane = Eigen::Vector3d;

double inverse_depth(const InversePlane& plane, const Eigen::Vector2f& ray) {
  return plane.dot(ray.cast<double>().homogeneous());
}

/// The sums of a fit of a plane to inverse depths.
struct PlaneSums {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0.0;
  int count = 0;

  void add(const Eigen::Vector2f& ray, double depth, double sigma) {
    const double weight = depth * depth / sigma;  // 1 / sigma of the inverse depth
    const Eigen::Vector3d row = weight * ray.cast<double>().homogeneous();
    const double value = weight / depth;
    normal += row * row.transpose();
    right += value * row;
    squares += value * value;
    ++count;
  }
  [[nodiscard]] PlaneSums with(const PlaneSums& other) const {
    return {
        normal + other.normal, right + other.right, squares + other.squares, count + other.count};
  }
  /// The plane, unless its residuals exceed the noise.
  [[nodiscard]] std::optional<InversePlane> plane() const {
    constexpr double kMostChi2 = 2.5;
    const InversePlane out = normal.ldlt().solve(right);
    const double chi2 = (squares - out.dot(right)) / count;
    if (!(chi2 < kMostChi2)) return std::nullopt;
    return out;
  }
};

/// Whether two planes have nearly the same normal. The coefficients of a plane are its normal.
bool are_parallel(const InversePlane& a, const InversePlane& b) {
  constexpr double kParallel = 0.985;  // cosine of 10 degrees
  return a.dot(b) > kParallel * a.norm() * b.norm();
}

/// A face that continues into a pixel.
struct ExtrapolatedFace {
  PlaneSums sums;
  InversePlane plane;
  Eigen::Vector2i source;  ///< nearest reliable pixel
  int distance_px = 0;
};

/// Blocks of an image around which something was measured.
class MeasuredBlocks {
 public:
  MeasuredBlocks(const Image<float>& depth_mm, int size_px)
      : size_px_(size_px),
        blocks_((depth_mm.width() - 1) / size_px + 1, (depth_mm.height() - 1) / size_px + 1, 0) {
    for (int y = 0; y < depth_mm.height(); ++y) {
      for (int x = 0; x < depth_mm.width(); ++x) {
        if (!std::isnan(depth_mm(x, y))) blocks_(x / size_px, y / size_px) = 1;
      }
    }
  }

  /// False where nothing was measured within the size of a block.
  [[nodiscard]] bool may_be_near(int x, int y) const {
    const int column = x / size_px_;
    const int row = y / size_px_;
    for (int v = std::max(0, row - 1); v <= std::min(blocks_.height() - 1, row + 1); ++v) {
      for (int u = std::max(0, column - 1); u <= std::min(blocks_.width() - 1, column + 1); ++u)
        if (blocks_(u, v) != 0) return true;
    }
    return false;
  }

 private:
  int size_px_;
  Image<std::uint8_t> blocks_;
};

class FaceExtrapolation {
 public:
  FaceExtrapolation(const RangeGrid& range,
                    const Image<float>& most_mm,
                    const Image<Eigen::Vector2f>& rays)
      : range_(range),
        most_mm_(most_mm),
        rays_(rays),
        width_(range.depth_mm.width()),
        height_(range.depth_mm.height()),
        window_(std::max(5, static_cast<int>(kWindow * width_))),
        reach_(std::max(16, static_cast<int>(kReach * width_))),
        gap_(std::max(4, static_cast<int>(kGap * width_))),
        near_(range.depth_mm, gap_),
        reliable_(width_, height_, 0),
        stride_(std::max(1, window_ / 4)),
        columns_((width_ - 1) / stride_ + 1) {
    // The predicted shift crosses zero here and there within a shifted area.
    constexpr double kMostUnreliable = 0.05;  // of the pixels around a reliable one
    parallel_rows(height_, [&](int y) {
      for (int x = 0; x < width_; ++x)
        reliable_(x, y) =
            most_mm_(x, y) == 0.0F && unreliable_around(x, y) <= kMostUnreliable ? 1 : 0;
    });
    const int rows = (height_ - 1) / stride_ + 1;
    windows_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns_));
    parallel_rows(rows, [&](int row) {
      for (int column = 0; column < columns_; ++column)
        windows_[static_cast<std::size_t>(row * columns_ + column)] =
            flat_window(column * stride_, row * stride_);
    });
  }

  [[nodiscard]] Image<float> depths() const {
    Image<float> out = range_.depth_mm;
    parallel_rows(height_, [&](int y) {
      for (int x = 0; x < width_; ++x) {
        if (is_reliable(x, y) || !near_.may_be_near(x, y)) continue;
        if (const auto depth = depth_at(x, y)) out(x, y) = static_cast<float>(*depth);
      }
    });
    return out;
  }

 private:
  [[nodiscard]] bool is_inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_;
  }
  [[nodiscard]] bool is_reliable(int x, int y) const { return reliable_(x, y) != 0; }
  /// Share of the points in the window around a pixel that are not reliable.
  [[nodiscard]] double unreliable_around(int x, int y) const {
    const int stride = std::max(1, window_ / 8);
    int points = 0;
    int unreliable = 0;
    for (int v = std::max(0, y - window_); v <= std::min(height_ - 1, y + window_); v += stride) {
      for (int u = std::max(0, x - window_); u <= std::min(width_ - 1, x + window_); u += stride) {
        points += std::isnan(most_mm_(u, v)) ? 0 : 1;
        unreliable += most_mm_(u, v) > 0.0F ? 1 : 0;
      }
    }
    return points > 0 ? static_cast<double>(unreliable) / points : 0.0;
  }

  /// The reliable pixels around one, unless they are few or not flat.
  [[nodiscard]] std::optional<PlaneSums> flat_window(int x, int y) const {
    constexpr double kLeastShare = 0.35;  // of the window
    const int stride = std::max(1, window_ / 8);
    PlaneSums sums;
    int all = 0;
    for (int v = y - window_; v <= y + window_; v += stride) {
      for (int u = x - window_; u <= x + window_; u += stride) {
        ++all;
        if (is_inside(u, v) && is_reliable(u, v)) {
          sums.add(rays_(u, v),
                   static_cast<double>(range_.depth_mm(u, v)),
                   static_cast<double>(range_.sigma_mm(u, v)));
        }
      }
    }
    if (sums.count < kLeastShare * all || !sums.plane()) return std::nullopt;
    return sums;
  }

  [[nodiscard]] const std::optional<PlaneSums>& window_near(const Eigen::Vector2i& at) const {
    const int column = std::min((at.x() + stride_ / 2) / stride_, columns_ - 1);
    const int row = std::min((at.y() + stride_ / 2) / stride_, (height_ - 1) / stride_);
    return windows_[static_cast<std::size_t>(row * columns_ + column)];
  }

  /// The face that begins at a pixel and goes on in a direction: up to three windows.
  [[nodiscard]] std::optional<ExtrapolatedFace> face_from(const Eigen::Vector2i& at,
                                                          const Eigen::Vector2d& direction,
                                                          int distance_px) const {
    constexpr int kFurther = 2;
    auto sums = window_near(at);
    if (!sums) return std::nullopt;
    for (int i = 1; i <= kFurther; ++i) {
      const Eigen::Vector2i next =
          at + (2.0 * i * window_ * direction).array().round().matrix().cast<int>();
      if (!is_inside(next.x(), next.y()) || !is_reliable(next.x(), next.y())) break;
      const auto& further = window_near(next);
      if (!further || !sums->with(*further).plane()) break;
      *sums = sums->with(*further);
    }
    return ExtrapolatedFace{*sums, *sums->plane(), at, distance_px};
  }

  /// What begins in each direction from a pixel, the nearest first; none for a pixel outside of the
  /// surface.
  [[nodiscard]] std::vector<ExtrapolatedFace> beginnings(int x, int y) const {
    constexpr std::size_t kDirections = 16;
    std::vector<ExtrapolatedFace> out;
    std::array<bool, kDirections> near{};
    const bool missing = std::isnan(range_.depth_mm(x, y));
    for (std::size_t k = 0; k < kDirections; ++k) {
      const double angle = kTwoPi * static_cast<double>(k) / kDirections;
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      for (int step = 1; step <= reach_; ++step) {
        const Eigen::Vector2i at =
            Eigen::Vector2i(x, y) + (step * direction).array().round().matrix().cast<int>();
        if (!is_inside(at.x(), at.y())) break;
        if (!std::isnan(range_.depth_mm(at.x(), at.y())) && step <= gap_) near.at(k) = true;
        if (missing && step > gap_ && !near.at(k)) break;
        if (!is_reliable(at.x(), at.y())) continue;
        if (const auto face = face_from(at, direction, step)) out.push_back(*face);
        break;
      }
    }
    if (missing) {
      std::size_t enclosed = 0;
      for (std::size_t k = 0; k < kDirections / 2; ++k)
        enclosed += near.at(k) && near.at(k + kDirections / 2) ? 1U : 0U;
      if (enclosed < kDirections / 4) return {};
    }
    std::stable_sort(
        out.begin(), out.end(), [](const ExtrapolatedFace& a, const ExtrapolatedFace& b) {
          return a.distance_px < b.distance_px;
        });
    return out;
  }

  /// The faces around a pixel, the nearest first: beginnings on the same plane are one face.
  [[nodiscard]] std::vector<ExtrapolatedFace> faces_around(int x, int y) const {
    std::vector<ExtrapolatedFace> out;
    for (const ExtrapolatedFace& one : beginnings(x, y)) {
      bool joined = false;
      for (ExtrapolatedFace& face : out) {
        if (!are_parallel(face.plane, one.plane)) continue;
        const PlaneSums both = face.sums.with(one.sums);
        const auto plane = both.plane();
        if (!plane) continue;
        face.sums = both;
        face.plane = *plane;
        joined = true;
        break;
      }
      if (!joined) out.push_back(one);
    }
    return out;
  }

  /// How far a plane lies behind what was seen at the source of a face, as a share of the depth.
  [[nodiscard]] double behind(const InversePlane& plane, const ExtrapolatedFace& face) const {
    const double seen = inverse_depth(face.plane, rays_(face.source.x(), face.source.y()));
    return seen / inverse_depth(plane, rays_(face.source.x(), face.source.y())) - 1.0;
  }

  [[nodiscard]] std::optional<double> depth_at(int x, int y) const {
    const std::vector<ExtrapolatedFace> faces = faces_around(x, y);
    if (faces.empty()) return std::nullopt;
    ExtrapolatedFace chosen = faces.front();
    const Eigen::Vector2f& ray = rays_(x, y);
    const auto take_if = [&](const ExtrapolatedFace& face, bool nearer) {
      if ((inverse_depth(face.plane, ray) > inverse_depth(chosen.plane, ray)) == nearer)
        chosen = face;
    };
    for (const bool concave : {true, false}) {
      for (const ExtrapolatedFace& face : faces) {
        const double a = behind(chosen.plane, face);
        const double b = behind(face.plane, chosen);
        if (concave && a > 0.0 && b > 0.0) take_if(face, true);
        if (!concave && a < 0.0 && b < 0.0) take_if(face, false);
      }
    }
    const double inverse = inverse_depth(chosen.plane, ray);
    if (!(inverse > 0.0)) return std::nullopt;
    const double depth = 1.0 / inverse;
    const auto measured = static_cast<double>(range_.depth_mm(x, y));
    if (std::isnan(measured)) return depth;
    const auto most = static_cast<double>(most_mm_(x, y));
    if (most > 0.0 && std::abs(depth - measured) > most) return std::nullopt;
    return depth;
  }

  const RangeGrid& range_;
  const Image<float>& most_mm_;
  const Image<Eigen::Vector2f>& rays_;
  int width_;
  int height_;
  int window_;
  int reach_;
  int gap_;
  MeasuredBlocks near_;
  Image<std::uint8_t> reliable_;
  int stride_;  ///< of the windows
  int columns_;
  std::vector<std::optional<PlaneSums>> windows_;  ///< row by row
};

}  // namespace

Image<float> extrapolate_faces(const RangeGrid& range,
                               const Image<float>& most_mm,
                               const Image<Eigen::Vector2f>& rays) {
  return FaceExtrapolation(range, most_mm, rays).depths();
}

}  // namespace frangia
