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

}  // namespace

double phase_at(const Pattern& pattern, const Eigen::Vector2d& at) {
  if (pattern.fringes_per_degree > 0.0) {
    return kTwoPi * pattern.fringes_per_degree * at.x();
  }
  const bool vertical = pattern.direction == FringeDirection::Vertical;
  return kTwoPi * (vertical ? at.x() : at.y()) / pattern.period_px;
}

double fringe_light(const std::complex<double>& fringe, const SimulatedScene& scene) {
  return displayed_light(1.0 + scene.options.contrast * fringe.real(), scene);
}

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

double frame_light(const Pattern& pattern,
                   int frame,
                   const Eigen::Vector2d& at,
                   const Image<float>* picture,
                   const SimulatedScene& scene) {
  const double contrast = scene.options.contrast;
  const double nominal = picture != nullptr
                             ? 1.0 - contrast + 2.0 * contrast * light_of(*picture, at)
                             : requested_light(pattern, frame, at, contrast);
  return displayed_light(nominal, scene);
}

}  // namespace frangia
