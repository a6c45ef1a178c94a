#include "frangia/phase/blur/correct_blur.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/phase/blur/internal/phase_neighbours.h"

namespace frangia {
namespace {

bool is_inside(const Image<float>& image, int x, int y) {
  return x >= kBlurReach && y >= kBlurReach && x + kBlurReach < image.width() &&
         y + kBlurReach < image.height();
}

/// The slopes of a modulation at a pixel.
struct BrightnessSlope {
  Eigen::Vector2f sharp;   ///< by five pixels in a row, exact to the fourth order
  Eigen::Vector2f smooth;  ///< of the plane through all pixels around, with 0.15 of its noise
};

BrightnessSlope brightness_slope(const Image<float>& modulation, int x, int y) {
  const auto row = [&](int dx) { return modulation(x + dx, y); };
  const auto column = [&](int dy) { return modulation(x, y + dy); };
  const auto sharp = [](const auto& at) {
    return (8.0F * (at(1) - at(-1)) - (at(2) - at(-2))) / 12.0F;
  };
  BrightnessSlope slope{{sharp(row), sharp(column)}, {0.0F, 0.0F}};
  for (int dy = -kBlurReach; dy <= kBlurReach; ++dy) {
    for (int dx = -kBlurReach; dx <= kBlurReach; ++dx)
      slope.smooth += modulation(x + dx, y + dy) *
                      Eigen::Vector2f(static_cast<float>(dx), static_cast<float>(dy));
  }
  slope.smooth /= 50.0F;  // the sum of the squares of dx over the 25 pixels
  return slope;
}

/// The slope of the phase by the plane through the neighbours on the same surface; zero where they
/// form no plane.
Eigen::Vector2f phase_slope(const PhaseNeighbours& neighbours) {
  Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
  Eigen::Vector3f right = Eigen::Vector3f::Zero();
  for (int dy = -kBlurReach; dy <= kBlurReach; ++dy) {
    for (int dx = -kBlurReach; dx <= kBlurReach; ++dx) {
      const float change = neighbours.change(dx, dy);
      if (std::isnan(change)) continue;
      const Eigen::Vector3f place(1.0F, static_cast<float>(dx), static_cast<float>(dy));
      normal += place * place.transpose();
      right += change * place;
    }
  }
  const Eigen::LDLT<Eigen::Matrix3f> solver(normal);
  constexpr float kPlane = 0.01F;  // neighbours on a line span none
  if (!(solver.vectorD().minCoeff() > kPlane)) return Eigen::Vector2f::Zero();
  return solver.solve(right).tail<2>();
}

/// What the bend of the phase adds to it, by the paraboloid through all neighbours: with slope k
/// and second derivatives H, a normal blur gives s^2 / 2 (tr H - s^2 k . H k). Zero where a
/// neighbour is missing or on another surface.
float bend_error(const PhaseNeighbours& neighbours, float variance_px2) {
  Eigen::Vector2f slope = Eigen::Vector2f::Zero();
  Eigen::Matrix2f bend = Eigen::Matrix2f::Zero();
  for (int dy = -kBlurReach; dy <= kBlurReach; ++dy) {
    for (int dx = -kBlurReach; dx <= kBlurReach; ++dx) {
      const float change = neighbours.change(dx, dy);
      const Eigen::Vector2f place(static_cast<float>(dx), static_cast<float>(dy));
      // Weights of least squares: 50 is the sum of dx^2, 35 half of that of (dx^2 - 2)^2, and 100
      // that of (dx dy)^2.
      slope += change * place / 50.0F;
      bend(0, 0) += change * (place.x() * place.x() - 2.0F) / 35.0F;
      bend(1, 1) += change * (place.y() * place.y() - 2.0F) / 35.0F;
      bend(0, 1) += change * place.x() * place.y() / 100.0F;
    }
  }
  bend(1, 0) = bend(0, 1);
  const float error = 0.5F * variance_px2 * (bend.trace() - variance_px2 * slope.dot(bend * slope));
  return std::isnan(error) ? 0.0F : error;
}

/// How far beside the center of a pixel its light comes from on average, px; zero where the
/// brightness changes by no more than its noise.
Eigen::Vector2f offset_at(
    const AbsolutePhase& phase, const Image<float>& modulation, float variance_px2, int x, int y) {
  constexpr float kSignificant = 4.0F;   // times the noise of a slope
  constexpr float kSharpNoise = 0.95F;   // of the slope by five pixels, over that of a pixel
  constexpr float kSmoothNoise = 0.14F;  // of the slope of the plane
  const float here = modulation(x, y);
  const float noise = phase.sigma_rad(x, y) * here;
  const BrightnessSlope slope = brightness_slope(modulation, x, y);
  const bool is_sharp = (slope.sharp - slope.smooth).norm() > kSignificant * kSharpNoise * noise;
  const Eigen::Vector2f& used = is_sharp ? slope.sharp : slope.smooth;
  if (!(used.norm() > kSignificant * kSmoothNoise * noise)) return Eigen::Vector2f::Zero();
  return variance_px2 / here * used;
}

Image<Eigen::Vector2f> offsets_of(const AbsolutePhase& phase,
                                  const Image<float>& modulation,
                                  float variance_px2) {
  Image<Eigen::Vector2f> offsets(modulation.width(), modulation.height(), Eigen::Vector2f::Zero());
  parallel_rows(modulation.height(), [&](int y) {
    for (int x = 0; x < modulation.width(); ++x) {
      if (is_inside(modulation, x, y) && modulation(x, y) > 0.0F &&
          std::isfinite(phase.phase_rad(x, y)))
        offsets(x, y) = offset_at(phase, modulation, variance_px2, x, y);
    }
  });
  return offsets;
}

Image<float> errors_of(const AbsolutePhase& phase, const Image<Eigen::Vector2f>& offsets) {
  // The slope of the phase has the error itself, which the second round leaves out.
  constexpr int kRounds = 2;
  Image<float> error(offsets.width(), offsets.height(), 0.0F);
  for (int round = 0; round < kRounds; ++round) {
    Image<float> next(offsets.width(), offsets.height(), 0.0F);
    parallel_rows(offsets.height(), [&](int y) {
      for (int x = 0; x < offsets.width(); ++x) {
        if (!offsets(x, y).isZero(0.0F))
          next(x, y) = offsets(x, y).dot(phase_slope({phase.phase_rad, &error, x, y}));
      }
    });
    error = std::move(next);
  }
  return error;
}

/// What is around a pixel.
struct Surroundings {
  float largest_rad = 0.0F;  ///< error at the border of brightness
  bool dark = false;         ///< one of them has no phase
};

Surroundings surroundings(const Image<float>& phase, const Image<float>& error_rad, int x, int y) {
  Surroundings out;
  for (int dy = -kBlurReach; dy <= kBlurReach; ++dy) {
    for (int dx = -kBlurReach; dx <= kBlurReach; ++dx) {
      out.largest_rad = std::max(out.largest_rad, std::abs(error_rad(x + dx, y + dy)));
      out.dark = out.dark || std::isnan(phase(x + dx, y + dy));
    }
  }
  return out;
}

}  // namespace

BlurCorrection correct_blur(AbsolutePhase& phase,
                            const Image<float>& modulation_counts,
                            const ImageBlur& blur) {
  // Shares of a correction, and of the largest one nearby, by which the phase may be wrong: it
  // bends within the blur.
  constexpr float kOwn = 0.3F;
  constexpr float kNearby = 0.05F;
  // The light of a pixel on the very border of a surface comes from 0.8 s beside its center. That
  // of a pixel farther out shows a surface that is not there.
  constexpr float kBeyond = 0.9F;
  const auto variance = static_cast<float>(blur.variance_px2);
  const Image<Eigen::Vector2f> offsets = offsets_of(phase, modulation_counts, variance);
  const Image<float> error = errors_of(phase, offsets);
  const Image<float> before = phase.phase_rad;
  const auto of_own = std::hypot(kOwn, static_cast<float>(blur.u_px2 / blur.variance_px2));
  if (phase.systematic_rad.empty()) {
    phase.systematic_rad = Image<float>(error.width(), error.height(), kMissing);
    for (std::size_t i = 0; i < error.pixels().size(); ++i)
      if (std::isfinite(phase.phase_rad.pixels()[i])) phase.systematic_rad.pixels()[i] = 0.0F;
  }
  parallel_rows(error.height(), [&](int y) {
    for (int x = 0; x < error.width(); ++x) {
      if (!is_inside(error, x, y) || !std::isfinite(phase.phase_rad(x, y))) continue;
      phase.phase_rad(x, y) -= bend_error({before, &error, x, y}, variance) + error(x, y);
      const Surroundings around = surroundings(before, error, x, y);
      if (around.largest_rad == 0.0F) continue;
      if (around.dark && offsets(x, y).norm() > kBeyond * std::sqrt(variance)) {
        phase.phase_rad(x, y) = kMissing;
        phase.sigma_rad(x, y) = kMissing;
        phase.systematic_rad(x, y) = kMissing;
        phase.status(x, y) = PixelStatus::MixedPixel;
        continue;
      }
      const float own = std::hypot(of_own * error(x, y), kNearby * around.largest_rad);
      phase.systematic_rad(x, y) = std::hypot(phase.systematic_rad(x, y), own);
    }
  });
  BlurCorrection done;
  for (const float one : error.pixels()) {
    if (one == 0.0F) continue;
    ++done.pixels;
    done.rms_rad += static_cast<double>(one) * static_cast<double>(one);
  }
  if (done.pixels > 0) done.rms_rad = std::sqrt(done.rms_rad / static_cast<double>(done.pixels));
  return done;
}

}  // namespace frangia
