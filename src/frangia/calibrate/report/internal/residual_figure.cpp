#include "frangia/calibrate/report/internal/residual_figure.h"

#include <algorithm>

#include <fmt/format.h>

#include "frangia/core/text.h"

namespace frangia {

std::string color_of(double share) {
  const double hue = 120.0 * (1.0 - std::clamp(share, 0.0, 1.0));
  return fmt::format("hsl({:.0f},85%,40%)", hue);
}

std::string residual_figure(const ResidualMap& map) {
  constexpr double kArrow = 0.03;  // of the width: length of an arrow of the RMS
  const double scale = kArrow * map.width / std::max(map.rms, 1e-6);
  std::string html =
      fmt::format("<figure><svg viewBox=\"0 0 {0} {1}\" width=\"520\" stroke-width=\"{2:.1f}\">\n",
                  map.width,
                  map.height,
                  map.width / 500.0);
  for (const ResidualArrow& arrow : map.arrows) {
    const Eigen::Vector2d to = arrow.from + scale * arrow.residual;
    html += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n",
        arrow.from.x(),
        arrow.from.y(),
        to.x(),
        to.y(),
        color_of(arrow.residual.norm() / (3.0 * map.rms)));
  }
  return html + fmt::format(
                    "</svg><figcaption>{}: residuals of all points, an arrow of {:.0f} pixels is "
                    "{:.3f} {}, the RMS. Red is three times that or more. Arrows of neighbors that "
                    "agree are a fault of the model; a random pattern is noise.</figcaption>"
                    "</figure>\n",
                    html_escaped(map.title),
                    kArrow * map.width,
                    map.rms,
                    map.unit);
}

}  // namespace frangia
