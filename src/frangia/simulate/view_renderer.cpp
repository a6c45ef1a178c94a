#include "frangia/simulate/view_renderer.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/LU>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

constexpr std::uint64_t kSpeckleStream = 11;
constexpr std::uint64_t kFrameStream = 12;

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t value = 0;
  for (const char letter : text)
    value = hash(value, static_cast<unsigned char>(letter));
  return value;
}

/// Turns of the fringe at a place on the projector, in radians.
double phase_at(const Pattern& pattern, const LightSample& sample) {
  if (pattern.fringes_per_degree > 0.0) {
    return kTurn * pattern.fringes_per_degree * static_cast<double>(sample.u);
  }
  const bool vertical = pattern.direction == FringeDirection::Vertical;
  return kTurn * static_cast<double>(vertical ? sample.u : sample.v) / pattern.period_px;
}

/// What the projector makes of a fringe's cosine: 1 + gamma0 cos, bent by the display's gamma about
/// the brightest value.
double shown(double cosine, const SimulateOptions& options) {
  const double linear = 1.0 + options.contrast * cosine;
  if (options.display_gamma == 1.0) return linear;
  const double peak = 1.0 + options.contrast;
  return peak * std::pow(std::max(linear, 0.0) / peak, options.display_gamma);
}

/// A share of white as the camera counts it. A pixel holds a full well of electrons and no more.
int counts_of(double light,
              int white_level,
              std::uint64_t pixel,
              const Shot& shot,
              const SimulateOptions& options) {
  if (options.noise) {
    const double electrons = std::max(light, 0.0) * options.full_well_e;
    const double sigma = std::sqrt(electrons + options.read_e * options.read_e);
    light = (electrons + sigma * normal_from(hash(shot.stream, pixel))) / options.full_well_e;
  }
  const double counts = std::min(light, 1.0) * shot.gain * white_level + shot.black_counts;
  return static_cast<int>(std::lround(std::clamp(counts, 0.0, static_cast<double>(white_level))));
}

}  // namespace

std::uint64_t noise_stream(std::uint64_t seed,
                           std::size_t view,
                           const std::string& pattern,
                           std::size_t frame) {
  return hash(hash(hash(hash(seed, kFrameStream), view), frame), hash_of(pattern));
}

ViewRenderer::ViewRenderer(const SimulatedScene& scene,
                           const Eigen::Isometry3d& rig_from_object,
                           std::size_t view)
    : scene_(scene),
      options_(scene.options),
      pose_(rig_from_object),
      across_(static_cast<int>(std::ceil(std::sqrt(options_.samples_per_px)))),
      samples_per_px_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(across_)) {
  if (options_.speckle > 0.0) {
    speckle_ =
        speckle_of(scene.rays.width(),
                   scene.rays.height(),
                   hash(hash(options_.seed, kSpeckleStream), view),
                   {options_.speckle, options_.speckle_grain_px, options_.speckle_correlation});
  }
}

std::vector<LightSample> ViewRenderer::row_of_samples(int y) const {
  std::vector<LightSample> samples;
  samples.reserve(static_cast<std::size_t>(scene_.rays.width()) * samples_per_px_);
  const Lens& lens = scene_.rig.camera.lens;
  for (int x = 0; x < scene_.rays.width(); ++x) {
    const Eigen::Vector2d center = scene_.rays(x, y).cast<double>();
    // Within a pixel the lens is linear: its slope spares an undistortion for each sample.
    Eigen::Matrix2d ray_from_px = Eigen::Matrix2d::Zero();
    if (across_ > 1) {
      ray_from_px =
          lens.distort_jacobian(center).inverse() * lens.focal_px.cwiseInverse().asDiagonal();
    }
    for (int row = 0; row < across_; ++row) {
      for (int column = 0; column < across_; ++column) {
        const Eigen::Vector2d offset((column + 0.5) / across_ - 0.5, (row + 0.5) / across_ - 0.5);
        samples.push_back(sample_light(scene_, pose_, center + ray_from_px * offset));
      }
    }
  }
  return samples;
}

template <typename T>
void ViewRenderer::fill_row(int y,
                            const std::vector<LightSample>& samples,
                            const std::vector<Shot>& shots,
                            FrameStack& stack) const {
  std::vector<double> light(shots.size());
  for (int x = 0; x < scene_.rays.width(); ++x) {
    const std::size_t first = static_cast<std::size_t>(x) * samples_per_px_;
    gather(
        stack.pattern, {samples.data() + first, samples_per_px_}, shots, speckle_at(x, y), light);
    const auto pixel = (static_cast<std::uint64_t>(y) << 32U) | static_cast<std::uint64_t>(x);
    for (std::size_t i = 0; i < shots.size(); ++i) {
      std::get<Image<T>>(stack.frames[i])(x, y) =
          static_cast<T>(counts_of(light[i], stack.white_level, pixel, shots[i], options_));
    }
  }
}

/// The mean light of a pixel's samples in each frame, as a share of white.
void ViewRenderer::gather(const Pattern& pattern,
                          std::span<const LightSample> samples,
                          const std::vector<Shot>& shots,
                          const Speckle& speckle,
                          std::vector<double>& light) const {
  std::fill(light.begin(), light.end(), 0.0);
  for (const LightSample& sample : samples) {
    if (sample.albedo == 0.0F) continue;
    const double other = options_.ambient * static_cast<double>(sample.albedo);
    const double lit = scene_.exposure * static_cast<double>(sample.lit() * speckle.gain);
    if (pattern.kind == PatternKind::Line) {
      const double peak = 1.0 + options_.contrast;
      light[0] += other + shots[0].projector * lit * peak *
                              std::max(static_cast<double>(sample.line), options_.line_spill);
      continue;
    }
    const double phase = phase_at(pattern, sample);
    const std::complex<double> fringe = std::complex<double>(speckle.fringe) *
                                        std::complex<double>(std::cos(phase), std::sin(phase));
    for (std::size_t i = 0; i < shots.size(); ++i) {
      const double cosine = fringe.real() * shots[i].cos_shift - fringe.imag() * shots[i].sin_shift;
      light[i] += other + shots[i].projector * lit * shown(cosine, options_);
    }
  }
  for (std::size_t i = 0; i < shots.size(); ++i)
    light[i] *= shots[i].exposure / static_cast<double>(samples.size());
}

template void ViewRenderer::fill_row<std::uint8_t>(int,
                                                   const std::vector<LightSample>&,
                                                   const std::vector<Shot>&,
                                                   FrameStack&) const;
template void ViewRenderer::fill_row<std::uint16_t>(int,
                                                    const std::vector<LightSample>&,
                                                    const std::vector<Shot>&,
                                                    FrameStack&) const;

}  // namespace frangia
