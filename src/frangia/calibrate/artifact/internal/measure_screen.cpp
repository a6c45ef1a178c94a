#include <cmath>
#include <utility>
#include <variant>

#include <Eigen/LU>
#include <fmt/format.h>

#include "frangia/calibrate/artifact/internal/measure_sites.h"
#include "frangia/calibrate/internal/artifact_sites.h"

namespace frangia {
namespace {

/// Sites along the longer side of the image.
constexpr int kScreenSites = 40;

}  // namespace

std::vector<ScreenView> measure_screen(const Scan& scan, const Run& run) {
  const auto& screen = std::get<Screen>(*scan.artifact);
  bool vertical = false;
  bool horizontal = false;
  for (const Pattern& pattern : scan.patterns) {
    if (pattern.kind != PatternKind::Fringe) continue;
    if (pattern.source != PatternSource::Screen) {
      fail_artifact(scan,
                    fmt::format("pattern \"{}\" is not shown by the screen; add source = "
                                "\"screen\" to it",
                                pattern.name));
    }
    (pattern.direction == FringeDirection::Vertical ? vertical : horizontal) = true;
  }
  if (!vertical || !horizontal) {
    const char* name = vertical ? "horizontal" : "vertical";
    fail_artifact(scan,
                  fmt::format("there are no {} fringes; a screen needs both directions, so add "
                              "patterns with direction = \"{}\" and capture the poses again",
                              name,
                              name));
  }
  Rig display = scan.rig;
  display.projector = Projector{};
  display.projector.model =
      PinholeModel{.width_px = screen.width_px, .height_px = screen.height_px};
  const int step = site_step(scan.rig.reference().model, kScreenSites);
  auto measured = measure_sites(scan, display, site_options(step), run);
  std::vector<ScreenView> views;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    ScreenView view{scan.views[i].folder.generic_string(), {}};
    for (const LightSite& site : measured[i]) {
      const bool usable = site.light.allFinite() && site.sigma.minCoeff() > 0.0 &&
                          std::abs(site.by_camera.determinant()) > 1e-6;
      if (usable) view.points.push_back(site);
    }
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace frangia
