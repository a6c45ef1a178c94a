#include "frangia/calibrate/internal/fit_sheet.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/random.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/fit_primitives.h"

namespace frangia {
namespace {

LaserSheet sheet_through(const std::vector<Eigen::Vector3d>& points) {
  const auto plane = fit_plane(points);
  return {plane.normal(), -plane.offset()};
}

double distance_from(const LaserSheet& sheet, const Eigen::Vector3d& point) {
  return std::abs(sheet.normal.dot(point) - sheet.offset_mm);
}

}  // namespace

SheetFit fit_sheet(std::span<const Eigen::Vector3d> points, const LaserSheet& start) {
  constexpr std::size_t kFewestPoints = 10;
  constexpr std::uint64_t kTries = 500;
  constexpr int kRefinements = 5;
  constexpr double kGate = 3.0 * 1.4826;  // medians
  SheetFit fit{start, 0.0, 0};
  if (points.size() < kFewestPoints) return fit;
  const auto median_from = [&](const LaserSheet& sheet) {
    std::vector<double> distances;
    for (const Eigen::Vector3d& point : points)
      distances.push_back(distance_from(sheet, point));
    return median(distances);
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::uint64_t attempt = 0; attempt < kTries; ++attempt) {
    std::vector<Eigen::Vector3d> some;
    for (std::uint64_t k = 0; k < 3; ++k) {
      const double share = uniform_from(hash(hash(1, attempt), k));
      some.push_back(points[static_cast<std::size_t>(share * static_cast<double>(points.size()))]);
    }
    const LaserSheet sheet = sheet_through(some);
    const double middle = median_from(sheet);
    if (middle < least) {
      least = middle;
      fit.sheet = sheet;
    }
  }
  for (int i = 0; i < kRefinements; ++i) {
    const double gate = std::max(kGate * median_from(fit.sheet), 1e-9);
    std::vector<Eigen::Vector3d> near;
    double squares = 0.0;
    for (const Eigen::Vector3d& point : points) {
      const double distance = distance_from(fit.sheet, point);
      if (distance > gate) continue;
      near.push_back(point);
      squares += distance * distance;
    }
    fit.points = near.size();
    if (near.size() < kFewestPoints) return {start, 0.0, 0};
    fit.rms_mm = std::sqrt(squares / static_cast<double>(near.size()));
    fit.sheet = sheet_through(near);
  }
  if (fit.sheet.normal.dot(start.normal) < 0.0)
    fit.sheet = {-fit.sheet.normal, -fit.sheet.offset_mm};
  return fit;
}

}  // namespace frangia
