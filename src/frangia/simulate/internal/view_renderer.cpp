#include "frangia/simulate/internal/view_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <Eigen/LU>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/pattern/gray_code.h"

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

/// Phase of the fringe at a projector coordinate, rad.
double phase_at(const Pattern& pattern, const LightSample& sample) {
  if (pattern.fringes_per_degree > 0.0) {
    return kTwoPi * pattern.fringes_per_degree * static_cast<double>(sample.u);
  }
  const bool vertical = pattern.direction == FringeDirection::Vertical;
  return kTwoPi * static_cast<double>(vertical ? sample.u : sample.v) / pattern.period_px;
}

/// Light of the projector for a nominal light from 0 to 1: corrected by the rig's look-up table,
/// then distorted by the display's gamma.
double displayed_light(double linear, const SimulatedScene& scene) {
  const auto& response = scene.rig.projector.response;
  if (scene.options.display_gamma == 1.0 && !response) return linear;
  const double dark = 1.0 - scene.options.contrast;  // light of a black pixel
  const double span = 2.0 * scene.options.contrast;
  double level = std::clamp((linear - dark) / span, 0.0, 1.0);
  if (response) level = response->level_of(level);
  return dark + span * std::pow(level, scene.options.display_gamma);
}

/// Light of a fringe whose real part is the cosine of the phase.
double fringe_light(const std::complex<double>& fringe, const SimulatedScene& scene) {
  return displayed_light(1.0 + scene.options.contrast * fringe.real(), scene);
}

/// The same, blurred along the phase by a Gaussian (Gauss-Hermite quadrature).
double blurred_light(const std::complex<double>& fringe,
                     double period_px,
                     const SimulatedScene& scene) {
  struct Node {
    double sigmas;
    double weight;
  };
  constexpr std::array<Node, 4> kNodes = {{{0.0, 0.457142857142857},
                                           {1.154405394739968, 0.240123178605013},
                                           {2.366759410734541, 0.0307571239675865},
                                           {3.750439717725742, 0.000548268855972218}}};
  double light = 0.0;
  for (const Node& node : kNodes) {
    const double phase = kTwoPi * node.sigmas * scene.options.projector_blur_px / period_px;
    const double ahead = fringe_light(fringe * std::polar(1.0, phase), scene);
    const double behind = fringe_light(fringe * std::polar(1.0, -phase), scene);
    light += node.weight * (node.sigmas == 0.0 ? ahead : ahead + behind);
  }
  return light;
}

/// Nominal light of one frame that is not a fringe.
double requested_light(const Pattern& pattern,
                       int frame,
                       const LightSample& sample,
                       double contrast) {
  if (pattern.kind == PatternKind::White) return 1.0 + contrast;
  if (pattern.kind == PatternKind::Ambient) return 1.0 - contrast;
  if (pattern.kind == PatternKind::Ramp)
    return 1.0 - contrast + 2.0 * contrast * pattern.levels[static_cast<std::size_t>(frame)];
  const bool vertical = pattern.direction == FringeDirection::Vertical;
  return is_stripe_bright(pattern, frame, static_cast<double>(vertical ? sample.u : sample.v))
             ? 1.0 + contrast
             : 1.0 - contrast;
}

/// Value of a picture at a projector coordinate, bilinearly interpolated.
double light_of(const Image<float>& picture, const LightSample& sample) {
  const double u = std::clamp(static_cast<double>(sample.u), 0.0, picture.width() - 1.0);
  const double v = std::clamp(static_cast<double>(sample.v), 0.0, picture.height() - 1.0);
  const int x = std::min(static_cast<int>(u), picture.width() - 2);
  const int y = std::min(static_cast<int>(v), picture.height() - 2);
  const double s = u - x;
  const double t = v - y;
  const auto at = [&](int dx, int dy) { return static_cast<double>(picture(x + dx, y + dy)); };
  return (1.0 - t) * ((1.0 - s) * at(0, 0) + s * at(1, 0)) +
         t * ((1.0 - s) * at(0, 1) + s * at(1, 1));
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
  return static_cast<int>(std::lround(std::clamp(counts, 0.0, static_cast<double>(white_level))));
}

}  // namespace

std::uint64_t noise_stream(std::uint64_t seed,
                           std::size_t view,
                           const std::string& pattern,
                           std::size_t frame) {
  return hash(hash(hash(hash(seed, kFrameStream), view), frame), hash_of(pattern));
}

// Moving an Eigen pose copies it, so it is passed by reference.
ViewRenderer::ViewRenderer(const SimulatedScene& scene,
                           const Eigen::Isometry3d& rig_from_object,  // NOLINT(*-pass-by-value)
                           std::size_t view)
    : scene_(scene),
      options_(scene.options),
      pose_(rig_from_object),
      samples_across_(static_cast<int>(std::ceil(std::sqrt(options_.samples_per_px)))),
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

std::vector<LightSample> ViewRenderer::sample_row(int y) const {
  std::vector<LightSample> samples;
  samples.reserve(static_cast<std::size_t>(scene_.rays.width()) * samples_per_px_);
  const CameraModel& model = scene_.rig.camera.model;
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
        const Eigen::Vector2d offset((column + 0.5) / samples_across_ - 0.5,
                                     (row + 0.5) / samples_across_ - 0.5);
        samples.push_back(sample_light(scene_, pose_, center + ray_from_px * offset));
      }
    }
  }
  return samples;
}

template <typename T>
void ViewRenderer::fill_row(int y,
                            std::span<const LightSample> samples,
                            const std::vector<Shot>& shots,
                            FrameStack& stack) const {
  std::vector<double> light(shots.size());
  for (int x = 0; x < scene_.rays.width(); ++x) {
    const std::size_t first = static_cast<std::size_t>(x) * samples_per_px_;
    mean_light(
        stack.pattern, samples.subspan(first, samples_per_px_), shots, speckle_at(x, y), light);
    const auto pixel = (static_cast<std::uint64_t>(y) << 32U) | static_cast<std::uint64_t>(x);
    for (std::size_t i = 0; i < shots.size(); ++i) {
      std::get<Image<T>>(stack.frames[i])(x, y) =
          static_cast<T>(counts_of(light[i], stack.white_level, pixel, shots[i], options_));
    }
  }
}

/// Light of a digital projector on a sample in one frame.
double ViewRenderer::projected(const Pattern& pattern,
                               std::size_t frame,
                               const LightSample& sample,
                               const Shot& shot) const {
  const double dark = 1.0 - options_.contrast;  // light of a black pixel
  if (shot.picture != nullptr)
    return displayed_light(dark + 2.0 * options_.contrast * light_of(*shot.picture, sample),
                           scene_);
  return displayed_light(
      requested_light(pattern, static_cast<int>(frame), sample, options_.contrast), scene_);
}

/// The mean light of a pixel's samples in each frame, as a share of white.
void ViewRenderer::mean_light(const Pattern& pattern,
                              std::span<const LightSample> samples,
                              const std::vector<Shot>& shots,
                              const Speckle& speckle,
                              std::vector<double>& light) const {
  std::fill(light.begin(), light.end(), 0.0);
  for (const LightSample& sample : samples) {
    if (sample.albedo == 0.0F) continue;
    const double other = options_.ambient * static_cast<double>(sample.albedo);
    const double reflected =
        scene_.exposure * static_cast<double>(sample.reflected() * speckle.gain);
    if (pattern.kind == PatternKind::Line) {
      const double peak = (1.0 + options_.contrast) * shots.front().projector;
      light[0] += other + reflected * peak *
                              std::max(static_cast<double>(sample.line), options_.line_spill);
      continue;
    }
    if (pattern.kind != PatternKind::Fringe || shots.front().picture != nullptr) {
      for (std::size_t i = 0; i < light.size(); ++i)
        light[i] +=
            other + shots[i].projector * reflected * projected(pattern, i, sample, shots[i]);
      continue;
    }
    const double phase = phase_at(pattern, sample);
    const std::complex<double> fringe = std::complex<double>(speckle.fringe) *
                                        std::complex<double>(std::cos(phase), std::sin(phase));
    const bool blurred = options_.projector_blur_px > 0.0 && pattern.period_px > 0.0;
    for (std::size_t i = 0; i < shots.size(); ++i) {
      const std::complex<double> shift(shots[i].cos_shift, shots[i].sin_shift);
      const double shown = blurred ? blurred_light(fringe * shift, pattern.period_px, scene_)
                                   : fringe_light(fringe * shift, scene_);
      light[i] += other + shots[i].projector * reflected * shown;
    }
  }
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] *= shots[i].light / static_cast<double>(samples.size());
}

template void ViewRenderer::fill_row<std::uint8_t>(int,
                                                   std::span<const LightSample>,
                                                   const std::vector<Shot>&,
                                                   FrameStack&) const;
template void ViewRenderer::fill_row<std::uint16_t>(int,
                                                    std::span<const LightSample>,
                                                    const std::vector<Shot>&,
                                                    FrameStack&) const;

}  // namespace frangia
