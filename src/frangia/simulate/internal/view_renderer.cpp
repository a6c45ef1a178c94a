#include "frangia/simulate/internal/view_renderer.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/LU>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/simulate/internal/gather_light.h"
#include "frangia/simulate/internal/projected_light.h"

namespace frangia {
namespace {

constexpr std::uint64_t kSpeckleStream = 11;
constexpr std::uint64_t kFrameStream = 12;
constexpr std::uint64_t kGatherStream = 13;

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t value = 0;
  for (const char letter : text)
    value = hash(value, static_cast<unsigned char>(letter));
  return value;
}

/// Where a sample lies in its pixel, from its middle, px. From three across on the grid is sheared:
/// no two samples have the same x or y, so that an edge along a row or column of pixels darkens
/// them in steps of 1 / across². The marks of boards need that; two across would gain two steps
/// only.
Eigen::Vector2d sample_offset(int column, int row, int across) {
  Eigen::Vector2d cell((column + 0.5) / across - 0.5, (row + 0.5) / across - 0.5);
  if (across < 3) return cell;
  return cell + Eigen::Vector2d(cell.y(), -cell.x()) / across;
}

/// Element `number` of the four-dimensional R sequence, 0 to 1.
/// @source Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"
double filling(int number, int dimension) {
  constexpr double kRoot = 1.1673039782614187;
  const double at = 0.5 + number * std::pow(kRoot, -(dimension + 1));
  return at - std::floor(at);
}

/// Where a sample lies with a lens that blurs: anywhere in the pixel and in its Gaussian, with its
/// mirror image, so that the middle of all samples is that of the pixel.
Eigen::Vector2d blurred_offset(int number, double blur_px) {
  const int pair = number / 2;
  const double radius = blur_px * std::sqrt(-2.0 * std::log(1.0 - filling(pair, 2)));
  const double angle = kTwoPi * filling(pair, 3);
  const Eigen::Vector2d offset(filling(pair, 0) - 0.5 + radius * std::cos(angle),
                               filling(pair, 1) - 0.5 + radius * std::sin(angle));
  return number % 2 == 0 ? offset : Eigen::Vector2d(-offset);
}

/// Rays across a pixel: a blur needs enough for its Gaussian.
int rays_across(const SimulateOptions& options) {
  constexpr int kBlurred = 64;
  const int wanted = options.camera_blur_px > 0.0 ? std::max(kBlurred, options.samples_per_px)
                                                  : options.samples_per_px;
  return static_cast<int>(std::ceil(std::sqrt(wanted)));
}

/// Converts light as a share of white to counts. Electrons are limited to the full well.
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
  const int most =
      shot.clips_at_counts > 0 ? std::min(white_level, shot.clips_at_counts) : white_level;
  return static_cast<int>(std::lround(std::clamp(counts, 0.0, static_cast<double>(most))));
}

}  // namespace

std::uint64_t noise_stream(std::uint64_t seed,
                           std::size_t view,
                           const std::string& pattern,
                           std::size_t frame) {
  // NOLINTNEXTLINE(readability-suspicious-call-argument): the seed begins the stream
  return hash(hash(hash(hash(seed, kFrameStream), view), frame), hash_of(pattern));
}

// Moving an Eigen pose copies it, so it is passed by reference.
ViewRenderer::ViewRenderer(const SimulatedScene& scene,
                           const Eigen::Isometry3d& rig_from_object,  // NOLINT(*-pass-by-value)
                           std::size_t view)
    : scene_(scene),
      options_(scene.options),
      pose_(rig_from_object),
      samples_across_(rays_across(options_)),
      samples_per_px_(static_cast<std::size_t>(samples_across_) *
                      static_cast<std::size_t>(samples_across_)) {
  if (options_.speckle > 0.0) {
    speckle_ =
        speckle_of(scene.rays.width(),
                   scene.rays.height(),
                   hash(hash(options_.seed, kSpeckleStream), view),
                   {options_.speckle, options_.speckle_grain_px, options_.speckle_correlation});
  }
}

LitRow ViewRenderer::sample_row(int y) const {
  LitRow row_light;
  std::vector<LightSample>& samples = row_light.samples;
  const bool gathers = options_.bounces > 0 || options_.subsurface_mm > 0.0;
  if (gathers) row_light.gathered.resize(static_cast<std::size_t>(scene_.rays.width()));
  samples.reserve(static_cast<std::size_t>(scene_.rays.width()) * samples_per_px_);
  const CameraModel& model = scene_.rig.reference().model;
  for (int x = 0; x < scene_.rays.width(); ++x) {
    const Eigen::Vector2d center = scene_.rays(x, y).cast<double>();
    // The undistortion is linear within a pixel: its slope replaces one undistortion per sample.
    Eigen::Matrix2d ray_from_px = Eigen::Matrix2d::Zero();
    if (samples_across_ > 1) {
      ray_from_px =
          model.distort_jacobian(center).inverse() * model.focal_px.cwiseInverse().asDiagonal();
    }
    for (int row = 0; row < samples_across_; ++row) {
      for (int column = 0; column < samples_across_; ++column) {
        const Eigen::Vector2d offset =
            options_.camera_blur_px > 0.0
                ? blurred_offset(row * samples_across_ + column, options_.camera_blur_px)
                : sample_offset(column, row, samples_across_);
        samples.push_back(sample_light(scene_, pose_, center + ray_from_px * offset));
      }
    }
    if (!gathers) continue;
    const std::uint64_t pixel = hash(static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x));
    row_light.gathered[static_cast<std::size_t>(x)] =
        gather_light(scene_, pose_, center, uniform_from(hash(kGatherStream, pixel)));
  }
  return row_light;
}

template <typename T>
void ViewRenderer::fill_row(int y,
                            const LitRow& row,
                            const std::vector<Shot>& shots,
                            FrameStack& stack) const {
  std::vector<double> light(shots.size());
  const std::span<const LightSample> samples(row.samples);
  const GatheredLightSum gathered(stack.pattern, shots, scene_);
  for (int x = 0; x < scene_.rays.width(); ++x) {
    const std::size_t first = static_cast<std::size_t>(x) * samples_per_px_;
    mean_light(
        stack.pattern, samples.subspan(first, samples_per_px_), shots, speckle_at(x, y), light);
    if (!row.gathered.empty()) gathered.add_to(light, row.gathered[static_cast<std::size_t>(x)]);
    for (std::size_t i = 0; i < light.size(); ++i)
      light[i] *= shots[i].light;
    const auto pixel = (static_cast<std::uint64_t>(y) << 32U) | static_cast<std::uint64_t>(x);
    for (std::size_t i = 0; i < shots.size(); ++i) {
      std::get<Image<T>>(stack.frames[i])(x, y) =
          static_cast<T>(counts_of(light[i], stack.white_level, pixel, shots[i], options_));
    }
  }
}

/// The mean light of a pixel in each frame, as a share of white.
void ViewRenderer::mean_light(const Pattern& pattern,
                              std::span<const LightSample> samples,
                              const std::vector<Shot>& shots,
                              const Speckle& speckle,
                              std::vector<double>& light) const {
  std::fill(light.begin(), light.end(), 0.0);
  // Scattered light holds the diffuse light of the point itself.
  const bool scatters = options_.subsurface_mm > 0.0;
  for (const LightSample& sample : samples) {
    if (sample.albedo == 0.0F) {
      for (double& one : light)
        one += options_.backdrop;
      continue;
    }
    const auto other = [&](const Shot& shot) {
      return (options_.ambient + shot.lamp) * static_cast<double>(sample.albedo);
    };
    const float direct = scatters ? sample.glossy : sample.reflected();
    const double reflected = scene_.exposure * static_cast<double>(direct * speckle.gain);
    if (pattern.kind == PatternKind::Line) {
      const double peak = (1.0 + options_.contrast) * shots.front().projector;
      light[0] +=
          other(shots.front()) +
          reflected * peak * std::max(static_cast<double>(sample.line), options_.line_spill);
      continue;
    }
    const Eigen::Vector2d at(sample.u, sample.v);
    if (pattern.kind != PatternKind::Fringe || shots.front().picture != nullptr) {
      for (std::size_t i = 0; i < light.size(); ++i) {
        const double shown = frame_light(pattern, static_cast<int>(i), at, shots[i], scene_);
        light[i] += other(shots[i]) + shots[i].projector * reflected * shown;
      }
      continue;
    }
    const std::complex<double> fringe =
        std::complex<double>(speckle.fringe) * std::polar(1.0, phase_at(pattern, at));
    for (std::size_t i = 0; i < shots.size(); ++i) {
      const std::complex<double> shift(shots[i].cos_shift, shots[i].sin_shift);
      const double shown =
          options_.waveform == DisplayedWaveform::Dithered
              ? dithered_light(pattern, at, shift * std::complex<double>(speckle.fringe), scene_)
              : shown_fringe(fringe * shift, pattern.period_px, scene_);
      light[i] += other(shots[i]) + shots[i].projector * reflected * shown;
    }
  }
  for (double& one : light)
    one /= static_cast<double>(samples.size());
}

template void ViewRenderer::fill_row<std::uint8_t>(int,
                                                   const LitRow&,
                                                   const std::vector<Shot>&,
                                                   FrameStack&) const;
template void ViewRenderer::fill_row<std::uint16_t>(int,
                                                    const LitRow&,
                                                    const std::vector<Shot>&,
                                                    FrameStack&) const;

}  // namespace frangia
