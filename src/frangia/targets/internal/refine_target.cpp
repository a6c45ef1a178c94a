#include "frangia/targets/internal/refine_target.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

constexpr int kUnknowns = 5;  // centre (two), logarithm of the size, of the blur, turn
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
constexpr int kTones = 6;  // ground, contrast, and the slopes of both

/// The pixels around an outline, and the points of its plane that they see.
struct OutlineWindow {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
  std::vector<Eigen::Vector2d> plane_mm;  ///< of each pixel, along the sides of the plane
  std::vector<std::size_t> used;          ///< pixels that are compared
  double pixel_mm = 0.0;                  ///< side of the square of a pixel's area on the plane

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

Eigen::Vector2d on_plane(const TargetPlane& plane,
                         const Image<Eigen::Vector2f>& rays,
                         const Eigen::Vector3d& origin_mm,
                         int x,
                         int y) {
  const Eigen::Vector2d ray = rays(x, y).cast<double>();
  return plane.sides.transpose() * (plane.meet(ray) - origin_mm);
}

/// Distance inside the outline, in its own axes.
double inside_mm(const TargetOutline& outline, const Eigen::Vector2d& from_center, double half_mm) {
  if (outline.square) return half_mm - from_center.cwiseAbs().maxCoeff();
  return half_mm - from_center.norm();
}

Eigen::Vector2d turned(const Eigen::Vector2d& point, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * point.x() + s * point.y(), c * point.y() - s * point.x()};
}

/// The window of an outline near its start; none where it leaves the image.
std::optional<OutlineWindow> window_of(const Image<Eigen::Vector2f>& rays,
                                       const TargetPlane& plane,
                                       const TargetOutline& outline,
                                       const Eigen::Vector3d& start_mm,
                                       double turn_rad,
                                       const Eigen::Vector2i& near_px) {
  constexpr int kPad_px = 4;     // for the blur of what lies beyond
  constexpr int kMost_px = 400;  // a target that fills the image is none
  const double half_mm = 0.5 * outline.size_mm;
  const auto is_near = [&](int x, int y) {
    const Eigen::Vector2d at = turned(on_plane(plane, rays, start_mm, x, y), turn_rad);
    const double inside = inside_mm(outline, at, half_mm);
    return inside >= -outline.outer_mm && inside <= outline.inner_mm;
  };
  // Grows from the middle until no pixel of its frame sees the outline or its borders.
  int reach = 4;
  const auto frame_is_near = [&](int r) {
    for (int i = -r; i <= r; ++i) {
      for (const auto& [x, y] : {std::pair{i, -r}, {i, r}, {-r, i}, {r, i}}) {
        const int u = near_px.x() + x;
        const int v = near_px.y() + y;
        if (u < 0 || v < 0 || u >= rays.width() || v >= rays.height()) return true;
        const Eigen::Vector2d at = turned(on_plane(plane, rays, start_mm, u, v), turn_rad);
        if (inside_mm(outline, at, half_mm) >= -outline.outer_mm) return true;
      }
    }
    return false;
  };
  while (reach < kMost_px && frame_is_near(reach))
    ++reach;
  reach += kPad_px;
  OutlineWindow window;
  window.left = near_px.x() - reach;
  window.top = near_px.y() - reach;
  window.width = window.height = 2 * reach + 1;
  if (reach >= kMost_px || window.left < 0 || window.top < 0 ||
      window.left + window.width > rays.width() || window.top + window.height > rays.height())
    return std::nullopt;
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      const int u = window.left + x;
      const int v = window.top + y;
      window.plane_mm.push_back(on_plane(plane, rays, start_mm, u, v));
      if (!window.plane_mm.back().allFinite()) return std::nullopt;
      if (is_near(u, v)) window.used.push_back(window.index(x, y));
    }
  }
  const auto at = [&](int x, int y) {
    return on_plane(plane, rays, start_mm, near_px.x() + x, near_px.y() + y);
  };
  const Eigen::Vector2d along = 0.5 * (at(1, 0) - at(-1, 0));
  const Eigen::Vector2d down = 0.5 * (at(0, 1) - at(0, -1));
  window.pixel_mm = std::sqrt(std::abs(along.x() * down.y() - along.y() * down.x()));
  return window;
}

/// Blurs an image by a normal curve along its rows and then along its columns.
void blur(std::vector<double>& image, int width, int height, double sigma_px) {
  const int reach = static_cast<int>(std::ceil(3.5 * sigma_px));
  if (reach < 1 || sigma_px < 0.15) return;
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += weights.back();
  }
  std::vector<double> line;
  const auto pass = [&](int count, int length, std::size_t step, std::size_t stride) {
    for (int k = 0; k < count; ++k) {
      const std::size_t first = static_cast<std::size_t>(k) * stride;
      line.assign(static_cast<std::size_t>(length), 0.0);
      for (int i = 0; i < length; ++i) {
        double total = 0.0;
        for (int j = -reach; j <= reach; ++j) {
          const int from = std::clamp(i + j, 0, length - 1);
          total += weights[static_cast<std::size_t>(j + reach)] *
                   image[first + static_cast<std::size_t>(from) * step];
        }
        line[static_cast<std::size_t>(i)] = total / sum;
      }
      for (int i = 0; i < length; ++i)
        image[first + static_cast<std::size_t>(i) * step] = line[static_cast<std::size_t>(i)];
    }
  };
  const auto columns = static_cast<std::size_t>(width);
  pass(height, width, 1, columns);
  pass(width, height, columns, 1);
}

/// Share of each pixel that is inside of the outline, blurred.
std::vector<double> covered(const OutlineWindow& window,
                            const TargetOutline& outline,
                            const Unknowns& at) {
  constexpr int kFine = 3;  // samples along each side of a pixel, each with its own share
  const int width = window.width * kFine;
  const int height = window.height * kFine;
  const double half_mm = 0.5 * outline.size_mm * std::exp(at[2]);
  const double ramp_mm = window.pixel_mm / kFine;
  std::vector<double> fine(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    // Between pixels the plane is seen nearly evenly.
    const double v = (y + 0.5) / kFine - 0.5;
    const int y0 = std::clamp(static_cast<int>(std::floor(v)), 0, window.height - 2);
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) / kFine - 0.5;
      const int x0 = std::clamp(static_cast<int>(std::floor(u)), 0, window.width - 2);
      const double a = u - x0;
      const double b = v - y0;
      const Eigen::Vector2d point = (1.0 - b) * ((1.0 - a) * window.plane_mm[window.index(x0, y0)] +
                                                 a * window.plane_mm[window.index(x0 + 1, y0)]) +
                                    b * ((1.0 - a) * window.plane_mm[window.index(x0, y0 + 1)] +
                                         a * window.plane_mm[window.index(x0 + 1, y0 + 1)]);
      const double depth = inside_mm(outline, turned(point - at.head<2>(), at[4]), half_mm);
      fine[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x)] = std::clamp(0.5 + depth / ramp_mm, 0.0, 1.0);
    }
  }
  blur(fine, width, height, kFine * std::exp(at[3]));
  std::vector<double> shares;
  shares.reserve(window.plane_mm.size());
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      double sum = 0.0;
      for (int j = 0; j < kFine; ++j)
        for (int i = 0; i < kFine; ++i)
          sum += fine[static_cast<std::size_t>(y * kFine + j) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x * kFine + i)];
      shares.push_back(sum / (kFine * kFine));
    }
  }
  return shares;
}

/// Residuals with the tones that fit best.
struct Comparison {
  Eigen::VectorXd residual;
  Eigen::VectorXd tones = Eigen::VectorXd::Zero(kTones);
};

Comparison compare(const Eigen::VectorXd& counts,
                   const OutlineWindow& window,
                   const TargetOutline& outline,
                   const Unknowns& at) {
  const std::vector<double> shares = covered(window, outline, at);
  Eigen::MatrixXd terms(counts.size(), kTones);
  for (Eigen::Index i = 0; i < counts.size(); ++i) {
    const std::size_t pixel = window.used[static_cast<std::size_t>(i)];
    const Eigen::Vector2d place = window.plane_mm[pixel] / outline.size_mm;
    const double share = shares[pixel];
    terms.row(i) << 1.0, share, place.x(), place.y(), share * place.x(), share * place.y();
  }
  Eigen::MatrixXd normal = transposed_product(terms, terms);
  normal.diagonal() *= 1.0 + 1e-9;
  Comparison out;
  out.tones = solve_symmetric(normal, transposed_product(terms, counts));
  out.residual = counts - product(terms, out.tones);
  return out;
}

}  // namespace

std::optional<OutlineFit> refine_target(const Image<float>& counts,
                                        const Image<Eigen::Vector2f>& rays,
                                        const TargetPlane& plane,
                                        const TargetOutline& outline,
                                        const Eigen::Vector3d& start_mm,
                                        double turn_rad) {
  // The pixel that sees the start, by Newton steps over the rays.
  Eigen::Vector2d pixel(0.5 * rays.width(), 0.5 * rays.height());
  for (int i = 0; i < 20; ++i) {
    const int x = std::clamp(static_cast<int>(std::lround(pixel.x())), 1, rays.width() - 2);
    const int y = std::clamp(static_cast<int>(std::lround(pixel.y())), 1, rays.height() - 2);
    const Eigen::Vector2d want(start_mm.x() / start_mm.z(), start_mm.y() / start_mm.z());
    Eigen::Matrix2d slope;
    slope.col(0) = 0.5 * (rays(x + 1, y) - rays(x - 1, y)).cast<double>();
    slope.col(1) = 0.5 * (rays(x, y + 1) - rays(x, y - 1)).cast<double>();
    const Eigen::Vector2d next =
        Eigen::Vector2d(x, y) + slope.inverse() * (want - rays(x, y).cast<double>());
    if (!next.allFinite()) return std::nullopt;
    const bool done = (next - pixel).norm() < 0.5;
    pixel = next;
    if (done) break;
  }
  const Eigen::Vector2i near_px(static_cast<int>(std::lround(pixel.x())),
                                static_cast<int>(std::lround(pixel.y())));
  if (near_px.minCoeff() < 0 || near_px.x() >= rays.width() || near_px.y() >= rays.height())
    return std::nullopt;
  const auto window = window_of(rays, plane, outline, start_mm, turn_rad, near_px);
  constexpr std::size_t kFewest = 30;  // pixels for the unknowns and the tones
  if (!window || window->used.size() < kFewest) return std::nullopt;
  Eigen::VectorXd seen(static_cast<Eigen::Index>(window->used.size()));
  for (Eigen::Index i = 0; i < seen.size(); ++i) {
    const auto at = static_cast<int>(window->used[static_cast<std::size_t>(i)]);
    seen[i] = static_cast<double>(
        counts(window->left + at % window->width, window->top + at / window->width));
  }
  if (!seen.allFinite()) return std::nullopt;
  const Eigen::Index free = outline.square ? kUnknowns : kUnknowns - 1;
  constexpr double kStartBlur_px = 0.6;
  Unknowns at = Unknowns::Zero();
  at[3] = std::log(kStartBlur_px);
  at[4] = turn_rad;
  Comparison now = compare(seen, *window, outline, at);
  Eigen::MatrixXd normal;
  double damping = 1e-3;
  const std::array<double, kUnknowns> steps = {
      0.02 * window->pixel_mm, 0.02 * window->pixel_mm, 0.003, 0.03, 0.003};
  bool converged = false;
  for (int iteration = 0; iteration < 30 && !converged; ++iteration) {
    Eigen::MatrixXd jacobian(seen.size(), free);
    for (Eigen::Index k = 0; k < free; ++k) {
      const double step = steps.at(static_cast<std::size_t>(k));
      Unknowns more = at;
      Unknowns less = at;
      more[k] += step;
      less[k] -= step;
      jacobian.col(k) = (compare(seen, *window, outline, more).residual -
                         compare(seen, *window, outline, less).residual) /
                        (2.0 * step);
    }
    normal = transposed_product(jacobian, jacobian);
    const Eigen::VectorXd gradient = transposed_product(jacobian, now.residual);
    for (int trial = 0; trial < 8; ++trial) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() *= 1.0 + damping;
      // The blur of an edge that is sharper than a pixel is not determined: it keeps its value.
      damped(3, 3) += 1e-6 * normal.diagonal().head(2).sum() * window->pixel_mm * window->pixel_mm;
      Unknowns next = at;
      const Eigen::VectorXd step = solve_symmetric(damped, -gradient);
      next.head(free) += step;
      next[3] = std::clamp(next[3], std::log(0.1), std::log(3.0));
      const Comparison then = compare(seen, *window, outline, next);
      if (then.residual.squaredNorm() <= now.residual.squaredNorm()) {
        converged = step.head<2>().norm() < 1e-4 * window->pixel_mm;
        at = next;
        now = then;
        damping = std::max(1e-9, 0.2 * damping);
        break;
      }
      damping *= 10.0;
      converged = trial == 7;  // nothing nearby is better
    }
  }
  const double most_mm = 0.35 * outline.size_mm;
  if (!(at.head<2>().norm() < most_mm)) return std::nullopt;
  OutlineFit fit;
  fit.center_mm = start_mm + plane.sides * at.head<2>();
  const double freedom =
      std::max(1.0, static_cast<double>(seen.size()) - static_cast<double>(free) - kTones);
  const double variance = now.residual.squaredNorm() / freedom;
  normal.diagonal() *= 1.0 + 1e-9;
  const Eigen::MatrixXd covariance =
      variance * solve_symmetric_columns(normal, Eigen::MatrixXd::Identity(free, free));
  fit.covariance_mm2 = covariance.topLeftCorner<2, 2>();
  fit.size_ratio = std::exp(at[2]);
  fit.blur_px = std::exp(at[3]);
  fit.contrast = now.tones[1];
  fit.misfit = std::sqrt(variance) / std::max(1e-12, std::abs(fit.contrast));
  return fit;
}

}  // namespace frangia
