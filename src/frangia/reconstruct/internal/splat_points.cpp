#include "frangia/reconstruct/internal/splat_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Cholesky>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// Depths within this many spacings belong to one surface, as the longest edge of a range grid.
constexpr double kSameSurface = 6.0;

/// A point in the image.
struct Landed {
  Eigen::Vector2d at_px = Eigen::Vector2d::Zero();
  double depth_mm = 0.0;
  std::uint32_t point = 0;

  [[nodiscard]] int column() const { return static_cast<int>(std::lround(at_px.x())); }
  [[nodiscard]] int row() const { return static_cast<int>(std::lround(at_px.y())); }
};

/// The points by the pixel that they project onto: row by row, and from left to right in each.
class PointsOfPixels {
 public:
  PointsOfPixels(const Mesh& mesh, const VirtualCamera& camera, const CameraModel& model)
      : rows_(static_cast<std::size_t>(model.height_px)) {
    for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
      const Eigen::Vector3d seen = camera.rig_from_scan * mesh.vertices_mm[i].cast<double>();
      const Eigen::Vector2d pixel = model.project(seen);
      const bool inside = pixel.x() > -0.5 && pixel.y() > -0.5 &&
                          pixel.x() < model.width_px - 0.5 && pixel.y() < model.height_px - 0.5;
      if (!inside) continue;
      const Landed landed{pixel, seen.z(), static_cast<std::uint32_t>(i)};
      rows_[static_cast<std::size_t>(landed.row())].push_back(landed);
    }
    for (std::vector<Landed>& row : rows_) {
      std::stable_sort(row.begin(), row.end(), [](const Landed& a, const Landed& b) {
        return a.column() < b.column();
      });
    }
  }

  [[nodiscard]] std::span<const Landed> row(int y) const {
    if (y < 0 || y >= static_cast<int>(rows_.size())) return {};
    return rows_[static_cast<std::size_t>(y)];
  }
  /// Those of the pixels `first` to `last` of a row.
  [[nodiscard]] std::span<const Landed> between(int first, int last, int y) const {
    const std::span<const Landed> all = row(y);
    const auto before = [](const Landed& one, int column) { return one.column() < column; };
    const auto begin = std::lower_bound(all.begin(), all.end(), first, before);
    return {begin, std::lower_bound(begin, all.end(), last + 1, before)};
  }

 private:
  std::vector<std::vector<Landed>> rows_;
};

using Vector6 = Eigen::Matrix<double, 6, 1>;

Vector6 quadratic_at(const Eigen::Vector2d& from_middle) {
  const double x = from_middle.x();
  const double y = from_middle.y();
  Vector6 row;
  row << 1.0, x, y, x * x, x * y, y * y;
  return row;
}

/// The depth of the front surface in the middle of a pixel that has points.
double depth_at(const PointsOfPixels& points, int x, int y, double same_mm) {
  constexpr double kFewest = 5.0;  // points of a plane; a bend needs points on all sides
  const auto less = [](const Landed& a, const Landed& b) { return a.depth_mm < b.depth_mm; };
  const std::span<const Landed> own = points.between(x, x, y);
  const double front_mm = std::min_element(own.begin(), own.end(), less)->depth_mm;
  const Eigen::Vector2d middle(x, y);
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6 sum = Vector6::Zero();
  std::array<bool, 9> filled{};
  for (int row = y - 1; row <= y + 1; ++row) {
    for (const Landed& near : points.between(x - 1, x + 1, row)) {
      if (std::abs(near.depth_mm - front_mm) > same_mm) continue;
      const Vector6 at = quadratic_at(near.at_px - middle);
      filled.at(static_cast<std::size_t>(3 * (row - y + 1) + near.column() - x + 1)) = true;
      squares += at * at.transpose();
      sum += at * (near.depth_mm - front_mm);
    }
  }
  // Bends at a border and, of few points, slopes are held at 0; none rests on points that lie
  // nearly in a line.
  constexpr double kHeld = 1e6;
  constexpr double kLoose = 0.01;
  const double count = squares(0, 0);
  squares.diagonal().array() += kLoose;
  const bool inside = std::all_of(filled.begin(), filled.end(), [](bool one) { return one; });
  if (!inside) squares.diagonal().tail<3>().array() += kHeld;
  if (count < kFewest) squares.diagonal().segment<2>(1).array() += kHeld;
  const Vector6 surface = squares.ldlt().solve(sum);
  double depths_mm = 0.0;
  double used = 0.0;
  for (const Landed& one : own) {
    if (one.depth_mm - front_mm > same_mm) continue;
    const Vector6 at = quadratic_at(one.at_px - middle);
    depths_mm += one.depth_mm - surface.tail<5>().dot(at.tail<5>());
    used += 1.0;
  }
  return depths_mm / used;
}

}  // namespace

void splat_points(const Mesh& mesh,
                  const VirtualCamera& camera,
                  const CameraModel& model,
                  Image<float>& depth_mm,
                  Image<PixelColor>& color) {
  const PointsOfPixels points(mesh, camera, model);
  const auto less = [](const Landed& a, const Landed& b) { return a.depth_mm < b.depth_mm; };
  parallel_rows(depth_mm.height(), [&](int y) {
    const std::span<const Landed> row = points.row(y);
    for (std::size_t first = 0; first < row.size();) {
      const int x = row[first].column();
      const std::span<const Landed> own = points.between(x, x, y);
      first += own.size();
      depth_mm(x, y) = static_cast<float>(depth_at(points, x, y, kSameSurface * camera.spacing_mm));
      if (!color.empty())
        color(x, y) = mesh.colors[std::min_element(own.begin(), own.end(), less)->point];
    }
  });
}

}  // namespace frangia
