#include "frangia/simulate/internal/projected_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/pattern/gray_code.h"

namespace frangia {
namespace {

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

/// Nominal light of one frame that is not a fringe.
double requested_light(const Pattern& pattern,
                       int frame,
                       const Eigen::Vector2d& at,
                       double contrast) {
  if (pattern.kind == PatternKind::White) return 1.0 + contrast;
  if (pattern.kind == PatternKind::Ambient) return 1.0 - contrast;
  if (pattern.kind == PatternKind::Ramp)
    return 1.0 - contrast + 2.0 * contrast * pattern.levels[static_cast<std::size_t>(frame)];
  const bool vertical = pattern.direction == FringeDirection::Vertical;
  return is_stripe_bright(pattern, frame, vertical ? at.x() : at.y()) ? 1.0 + contrast
                                                                      : 1.0 - contrast;
}

/// Value of a picture at a projector coordinate, bilinearly interpolated.
double light_of(const Image<float>& picture, const Eigen::Vector2d& at) {
  const double u = std::clamp(at.x(), 0.0, picture.width() - 1.0);
  const double v = std::clamp(at.y(), 0.0, picture.height() - 1.0);
  const int x = std::min(static_cast<int>(u), picture.width() - 2);
  const int y = std::min(static_cast<int>(v), picture.height() - 2);
  const double s = u - x;
  const double t = v - y;
  const auto value = [&](int dx, int dy) { return static_cast<double>(picture(x + dx, y + dy)); };
  return (1.0 - t) * ((1.0 - s) * value(0, 0) + s * value(1, 0)) +
         t * ((1.0 - s) * value(0, 1) + s * value(1, 1));
}

/// Light of a fringe whose real part is the cosine of the phase, relative to the mean light.
double fringe_light(const std::complex<double>& fringe, const SimulatedScene& scene) {
  return displayed_light(1.0 + scene.options.contrast * fringe.real(), scene);
}

/// The same, blurred along the phase by the projector's Gaussian (Gauss-Hermite quadrature).
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

/// Light of black and white stripes, blurred by a sigma of their phase: the Fourier series of a
/// square wave after a Gaussian.
double binary_light(const std::complex<double>& fringe,
                    double blur_rad,
                    const SimulatedScene& scene) {
  constexpr double kNothing = 30.0;  // exponent beyond which a harmonic is none
  constexpr int kMost = 401;         // of a wave that is hardly blurred
  const double contrast = scene.options.contrast;
  if (blur_rad == 0.0)
    return displayed_light(fringe.real() >= 0.0 ? 1.0 + contrast : 1.0 - contrast, scene);
  const double phase = std::arg(fringe);
  double wave = 0.0;
  for (int n = 1; n <= kMost; n += 2) {
    const double exponent = 0.5 * n * n * blur_rad * blur_rad;
    if (exponent > kNothing) break;
    wave += (n % 4 == 1 ? 4.0 : -4.0) / (kPi * n) * std::exp(-exponent) * std::cos(n * phase);
  }
  const double dark = displayed_light(1.0 - contrast, scene);
  const double bright = displayed_light(1.0 + contrast, scene);
  return dark + (bright - dark) * std::clamp(0.5 + 0.5 * wave, 0.0, 1.0);
}

/// Rank of a pixel in the ordered dither of 8 x 8 pixels, 0 to 63 (Bayer 1973).
int dither_rank(int x, int y) {
  int rank = 0;
  for (int bit = 0; bit < 3; ++bit) {
    const int high = (x >> bit & 1) ^ (y >> bit & 1);
    const int low = y >> bit & 1;
    rank |= (2 * high + low) << (2 * (2 - bit));
  }
  return rank;
}

}  // namespace

double phase_at(const Pattern& pattern, const Eigen::Vector2d& at) {
  if (pattern.fringes_per_degree > 0.0) {
    return kTwoPi * pattern.fringes_per_degree * at.x();
  }
  const bool vertical = pattern.direction == FringeDirection::Vertical;
  return kTwoPi * (vertical ? at.x() : at.y()) / pattern.period_px;
}

double shown_fringe(const std::complex<double>& fringe,
                    double period_px,
                    const SimulatedScene& scene) {
  const SimulateOptions& options = scene.options;
  const bool blurred = options.projector_blur_px > 0.0 && period_px > 0.0;
  if (options.waveform == DisplayedWaveform::Binary)
    return binary_light(
        fringe, blurred ? kTwoPi * options.projector_blur_px / period_px : 0.0, scene);
  return blurred ? blurred_light(fringe, period_px, scene) : fringe_light(fringe, scene);
}

double dithered_light(const Pattern& pattern,
                      const Eigen::Vector2d& at,
                      const std::complex<double>& shift,
                      const SimulatedScene& scene) {
  constexpr double kReach = 3.0;  // sigmas
  constexpr int kSide = 8;
  const double sigma = scene.options.projector_blur_px;
  const int reach = static_cast<int>(std::ceil(kReach * sigma));
  const int column = static_cast<int>(std::lround(at.x()));
  const int row = static_cast<int>(std::lround(at.y()));
  double sum = 0.0;
  double weights = 0.0;
  for (int y = row - reach; y <= row + reach; ++y) {
    for (int x = column - reach; x <= column + reach; ++x) {
      const Eigen::Vector2d pixel(x, y);
      const double weight =
          sigma > 0.0 ? std::exp(-0.5 * (pixel - at).squaredNorm() / (sigma * sigma)) : 1.0;
      const double level = 0.5 + 0.5 * (std::polar(1.0, phase_at(pattern, pixel)) * shift).real();
      const double threshold =
          (dither_rank((x % kSide + kSide) % kSide, (y % kSide + kSide) % kSide) + 0.5) /
          (kSide * kSide);
      sum += level > threshold ? weight : 0.0;
      weights += weight;
    }
  }
  const double contrast = scene.options.contrast;
  return displayed_light(1.0 - contrast, scene) +
         sum / weights *
             (displayed_light(1.0 + contrast, scene) - displayed_light(1.0 - contrast, scene));
}

double frame_light(const Pattern& pattern,
                   int frame,
                   const Eigen::Vector2d& at,
                   const Shot& shot,
                   const SimulatedScene& scene) {
  const double contrast = scene.options.contrast;
  if (shot.picture == nullptr)
    return displayed_light(requested_light(pattern, frame, at, contrast), scene);
  const auto shown = [&](const Image<float>& picture) {
    return displayed_light(1.0 - contrast + 2.0 * contrast * light_of(picture, at), scene);
  };
  double light = shown(*shot.picture);
  for (const auto& [picture, share] : shot.before)
    light += share * (shown(*picture) - shown(*shot.picture));
  return light;
}

}  // namespace frangia
