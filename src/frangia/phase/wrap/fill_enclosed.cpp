#include "frangia/phase/wrap/fill_enclosed.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>

namespace frangia {
namespace {

/// Largest unmodulated patch that counts as a dark speck, px: 2 x 2.
constexpr std::size_t kSpeckPx = 4;

/// Safety limit: Gauss-Seidel from a plane converges on a hole of 10 x 10 px in about 100 sweeps.
constexpr int kSweeps = 200;

/// Largest change of a sweep at convergence, far below phase noise.
constexpr float kConverged_rad = 1e-4F;

struct Pixel {
  int x;
  int y;
};

/// An enclosed patch of discarded pixels.
struct Hole {
  std::vector<Pixel> inside;
  std::vector<Pixel> boundary;  ///< adjacent measured pixels, possibly repeated
  std::size_t unmodulated = 0;
};

/// Which discarded pixels a search has reached.
enum Reached : std::uint8_t { No, InThisPatch, InRejectedPatch };

bool is_discarded(PixelStatus status) {
  return status == PixelStatus::Saturated || status == PixelStatus::Residue ||
         status == PixelStatus::Unmodulated;
}

template <typename Visit>
void visit_neighbors(const Image<PixelStatus>& status, Pixel p, const Visit& visit) {
  if (p.x > 0) visit(Pixel{p.x - 1, p.y});
  if (p.x + 1 < status.width()) visit(Pixel{p.x + 1, p.y});
  if (p.y > 0) visit(Pixel{p.x, p.y - 1});
  if (p.y + 1 < status.height()) visit(Pixel{p.x, p.y + 1});
}

/// Collects the discarded pixels that are connected to `start`. Returns false, and stops, when the
/// patch has more than `max_px` pixels or is open: it reaches the border of the image, a pixel of
/// another status, or a patch that an earlier search rejected, which it then belongs to. The
/// background of an image is therefore not collected.
bool collect(const Image<PixelStatus>& status,
             Pixel start,
             std::size_t max_px,
             Image<Reached>& reached,
             Hole& hole) {
  hole.inside.assign(1, start);
  hole.boundary.clear();
  hole.unmodulated = 0;
  reached(start.x, start.y) = InThisPatch;
  bool closed = true;
  for (std::size_t head = 0; closed && head < hole.inside.size(); ++head) {
    const Pixel p = hole.inside[head];
    if (status(p.x, p.y) == PixelStatus::Unmodulated) ++hole.unmodulated;
    if (p.x == 0 || p.y == 0 || p.x + 1 == status.width() || p.y + 1 == status.height())
      closed = false;
    visit_neighbors(status, p, [&](Pixel q) {
      if (status(q.x, q.y) == PixelStatus::Measured) {
        hole.boundary.push_back(q);
      } else if (!is_discarded(status(q.x, q.y)) || reached(q.x, q.y) == InRejectedPatch) {
        closed = false;
      } else if (reached(q.x, q.y) == No) {
        reached(q.x, q.y) = InThisPatch;
        hole.inside.push_back(q);
      }
    });
    closed = closed && hole.inside.size() <= max_px;
  }
  if (!closed) {
    for (const Pixel p : hole.inside)
      reached(p.x, p.y) = InRejectedPatch;
  }
  return closed;
}

struct Plane {
  Eigen::Vector3d coefficients =
      Eigen::Vector3d::Zero();  ///< of 1, x, y relative to the first boundary pixel
  double rms = 0.0;
  double largest = 0.0;
};

Plane fit_plane(const AbsolutePhase& phase, const std::vector<Pixel>& boundary) {
  const Pixel origin = boundary.front();
  Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-9;
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Pixel p : boundary) {
    const Eigen::Vector3d row(1.0, p.x - origin.x, p.y - origin.y);
    normal += row * row.transpose();
    right += row * static_cast<double>(phase.phase_rad(p.x, p.y));
  }
  Plane plane;
  plane.coefficients = normal.inverse() * right;
  for (const Pixel p : boundary) {
    const double error = phase.phase_rad(p.x, p.y) - plane.coefficients.dot(Eigen::Vector3d(
                                                         1.0, p.x - origin.x, p.y - origin.y));
    plane.rms += error * error / static_cast<double>(boundary.size());
    plane.largest = std::max(plane.largest, std::abs(error));
  }
  plane.rms = std::sqrt(plane.rms);
  return plane;
}

void fill(AbsolutePhase& phase, const Hole& hole, const Plane& plane) {
  const auto largest_at_boundary = [&](const Image<float>& sigma_rad) {
    float largest = 0.0F;
    for (const Pixel p : hole.boundary)
      largest = std::max(largest, sigma_rad(p.x, p.y));
    return largest;
  };
  const float boundary_sigma = largest_at_boundary(phase.sigma_rad);
  if (!phase.systematic_rad.empty()) {
    const float systematic_rad = largest_at_boundary(phase.systematic_rad);
    for (const Pixel p : hole.inside)
      phase.systematic_rad(p.x, p.y) = systematic_rad;
  }
  for (const Pixel p : hole.inside) {
    const Eigen::Vector3d row(1.0, p.x - hole.boundary.front().x, p.y - hole.boundary.front().y);
    phase.phase_rad(p.x, p.y) = static_cast<float>(plane.coefficients.dot(row));
    phase.sigma_rad(p.x, p.y) = std::hypot(boundary_sigma, static_cast<float>(plane.rms));
    phase.status(p.x, p.y) = PixelStatus::Filled;
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    float moved = 0.0F;
    for (const Pixel p : hole.inside) {
      float sum = 0.0F;
      visit_neighbors(phase.status, p, [&](Pixel q) { sum += phase.phase_rad(q.x, q.y); });
      moved = std::max(moved, std::abs(0.25F * sum - phase.phase_rad(p.x, p.y)));
      phase.phase_rad(p.x, p.y) = 0.25F * sum;
    }
    if (moved < kConverged_rad) break;
  }
}

}  // namespace

std::size_t fill_enclosed(AbsolutePhase& phase, const FillOptions& options) {
  const Image<PixelStatus>& status = phase.status;
  Image<Reached> reached(status.width(), status.height(), No);
  Hole hole;
  std::size_t filled = 0;
  for (int y = 1; y < status.height(); ++y) {
    const PixelStatus* row = &status(0, y);
    for (int x = 1; x < status.width(); ++x) {
      // The first pixel of an enclosed patch has measured pixels to its left and above it.
      if (row[x] == PixelStatus::Measured || row[x - 1] != PixelStatus::Measured) continue;
      if (!is_discarded(row[x]) || status(x, y - 1) != PixelStatus::Measured) continue;
      if (reached(x, y) != No || !collect(status, {x, y}, options.max_px, reached, hole)) continue;
      const bool may_be_true =
          2 * hole.unmodulated > hole.inside.size() && hole.inside.size() > kSpeckPx;
      if (may_be_true) continue;
      const Plane plane = fit_plane(phase, hole.boundary);
      if (plane.largest > options.max_plane_deviation_rad) continue;
      fill(phase, hole, plane);
      filled += hole.inside.size();
    }
  }
  return filled;
}

}  // namespace frangia
