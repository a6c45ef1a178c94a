#include "frangia/reconstruct/internal/scan_silhouettes.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <variant>

#include "frangia/core/error.h"
#include "frangia/dataset/read_frames.h"

namespace frangia {
namespace {

/// The frame of the ambient light of a view.
Image<float> ambient_of(const Scan& scan, std::size_t view, const Run& run) {
  for (const FrameStack& stack : read_frames(scan, view, run)) {
    if (stack.pattern.kind != PatternKind::Ambient) continue;
    return std::visit(
        [](const auto& frame) {
          Image<float> counts(frame.width(), frame.height(), Uninitialized{});
          std::transform(frame.pixels().begin(),
                         frame.pixels().end(),
                         counts.pixels().begin(),
                         [](auto count) { return static_cast<float>(count); });
          return counts;
        },
        stack.frames.front());
  }
  throw Error(ErrorKind::Input, "scan.toml has no pattern of kind \"ambient\"");
}

}  // namespace

std::optional<SilhouetteReport> silhouettes_of(const Scan& scan,
                                               const MeasuredViews& measured,
                                               const Mesh& mesh,
                                               const Run& run) {
  const bool has_ambient =
      std::any_of(scan.patterns.begin(), scan.patterns.end(), [](const Pattern& pattern) {
        return pattern.kind == PatternKind::Ambient;
      });
  if (!has_ambient || mesh.triangles.empty()) return std::nullopt;
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < scan.views.size(); ++i)
    numbers[scan.views[i].folder.string()] = i;
  const ViewStore& views = measured.reference();
  const auto load = [&](std::size_t i) {
    return BacklitView{ambient_of(scan, numbers.at(measured.stations[i].name), run),
                       views.load_depth_mm(i),
                       views.rig_from_object(i)};
  };
  run.stage("silhouettes");
  const RayScene surface(mesh, run);
  const CameraModel& camera = scan.rig.reference().model;
  // The background of a scan is lit in all views or in none.
  if (check_silhouettes(surface, std::min<std::size_t>(1, views.size()), load, camera, run).views ==
      0)
    return std::nullopt;
  SilhouetteReport report = check_silhouettes(surface, views.size(), load, camera, run);
  if (report.rims == 0) return std::nullopt;
  run.note(report.text());
  return report;
}

}  // namespace frangia
