#include "frangia/reconstruct/find_turntable_axis.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/held_messages.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/reconstruct/internal/measure_views.h"
#include "frangia/reconstruct/internal/split_setups.h"
#include "frangia/registration/find_view_poses.h"
#include "frangia/registration/register_poses.h"
#include "frangia/registration/turntable_of_poses.h"

namespace frangia {
namespace {

constexpr std::size_t kFewestViews = 3;

Error shows_no_axis(const Scan& scan, const std::string& why) {
  return {ErrorKind::Numeric,
          fmt::format("{}: the part does not show the axis of the turntable, because {}; stand a "
                      "part without symmetry on the table, or a board",
                      scan.folder.string(),
                      why)};
}

/// Views at different angles whose points need no axis.
void check_scan(const Scan& scan, const ReconstructOptions& options) {
  std::vector<double> angles_rad;
  for (const ScanView& view : scan.views) {
    constexpr double kSame_rad = 1e-3;
    const bool is_known = std::any_of(angles_rad.begin(), angles_rad.end(), [&](double angle) {
      return std::abs(wrap_rad(view.angle_rad - angle)) < kSame_rad;
    });
    if (view.setup == scan.views.front().setup && !is_known) angles_rad.push_back(view.angle_rad);
  }
  if (angles_rad.size() < kFewestViews) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: its views have {} different angles, and an axis needs {}; capture "
                            "six stations or more around the part",
                            scan.folder.string(),
                            angles_rad.size(),
                            kFewestViews));
  }
  if (!is_absolute(plan_decoding(scan.patterns, scan.rig, options.decode))) {
    throw Error(ErrorKind::Input,
                scan.folder.string() +
                    ": its fringe orders rest on the axis that is looked for; capture Gray code or "
                    "coarser fringes, too");
  }
}

/// Removes the points that most views have at the same place: they did not turn.
void remove_what_stays(ViewStore& views) {
  constexpr float kSame = 0.0005F;  // of the distance
  constexpr float kMost = 0.7F;     // of the views that measured the pixel
  constexpr std::uint16_t kFewest = 3;
  Image<float> first;
  Image<std::uint16_t> measured;
  Image<std::uint16_t> same;
  for (std::size_t view = 0; view < views.size(); ++view) {
    const Image<float> depth = views.load_depth_mm(view);
    if (first.width() == 0) {
      first = Image<float>(depth.width(), depth.height(), std::nanf(""));
      measured = Image<std::uint16_t>(depth.width(), depth.height(), 0);
      same = measured;
    }
    for (int y = 0; y < depth.height(); ++y) {
      for (int x = 0; x < depth.width(); ++x) {
        if (std::isnan(depth(x, y))) continue;
        if (std::isnan(first(x, y))) first(x, y) = depth(x, y);
        ++measured(x, y);
        if (std::abs(depth(x, y) - first(x, y)) < kSame * first(x, y)) ++same(x, y);
      }
    }
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    View view = views.load(i);
    const auto stays = [&](int x, int y) {
      return measured(x, y) >= kFewest &&
             static_cast<float>(same(x, y)) >= kMost * static_cast<float>(measured(x, y));
    };
    std::erase_if(view.edge_pixels,
                  [&](const RangePixel& pixel) { return stays(pixel.x, pixel.y); });
    for (int y = 0; y < first.height(); ++y)
      for (int x = 0; x < first.width(); ++x)
        if (stays(x, y)) view.range.remove(x, y);
    views.replace(i, view);
  }
}

/// The middle of the points of all views, in the rig frame.
Eigen::Vector3d middle_of(const std::vector<SurfelMap>& maps) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const SurfelMap& map : maps) {
    for (const SurfelMap::Surfel& surfel : map.surfels.pixels()) {
      if (!(surfel.sigma_mm > 0.0F)) continue;
      sum += surfel.point_mm.cast<double>();
      count += 1.0;
    }
  }
  return sum / std::max(1.0, count);
}

/// The axis about which the views turned that fit together by their shape. The others are emptied.
Turntable axis_by_shape(ViewStore& views,
                        const std::vector<Station>& stations,
                        const Scan& scan,
                        std::vector<std::string>& left_out,
                        const Run& run) {
  const CameraModel& camera = scan.rig.reference().model;
  std::vector<SurfelMap> maps = make_surfel_maps(views, camera, kSurfelsPerView, run);
  const Eigen::Vector3d middle = middle_of(maps);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < stations.size(); ++i)
    names.push_back("view " + stations[i].label(i));
  HeldMessages unused;  // they advise on scans that are merged
  const Run quiet = unused.in_place_of(run);
  FoundPoses found;
  try {
    found = find_view_poses(views, maps, camera, names, quiet);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Input) throw;
    throw shows_no_axis(scan, "its views do not fit together in exactly one pose");
  }
  static_cast<void>(
      register_poses(views,
                     maps,
                     camera,
                     {.reach_mm = found.accuracy_mm, .prior_mm = 100.0 * found.accuracy_mm},
                     quiet));
  std::vector<std::size_t> posed;
  std::vector<Eigen::Isometry3d> poses;
  std::vector<double> angles_rad;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (std::find(found.left_out.begin(), found.left_out.end(), i) != found.left_out.end())
      continue;
    posed.push_back(i);
    poses.push_back(views.rig_from_object(i));
    angles_rad.push_back(stations[i].angle_rad);
  }
  TurntableOfPoses turned = turntable_of_poses(poses, angles_rad);
  if (turned.views.size() < kFewestViews)
    throw shows_no_axis(scan, "its views fit together in no turn about one axis");
  std::vector<bool> agrees(stations.size(), false);
  for (const std::size_t i : turned.views)
    agrees[posed[i]] = true;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (agrees[i]) continue;
    left_out.push_back(stations[i].label(i));
    views.clear(i);
  }
  Turntable table = turned.table;
  table.point_mm += table.axis.dot(middle - table.point_mm) * table.axis;
  return table;
}

}  // namespace

AxisOfPart find_turntable_axis(const Scan& scan,
                               const ReconstructOptions& options,
                               const Run& run) {
  check_scan(scan, options);
  Scan untabled = scan;
  untabled.rig.turntable.reset();
  untabled.rig.cameras.resize(1);
  const CameraModel& camera = untabled.rig.reference().model;
  std::vector<MeasuredSetup> setups = split_setups(measure_views(
      untabled, rays_of(camera), options.decode, options.mixed_pixels, run, options.decoded));
  MeasuredViews& measured = setups.front().measured;
  ViewStore& views = measured.reference();
  remove_what_stays(views);
  run.stage("views");
  AxisOfPart out{};
  const Turntable start = axis_by_shape(views, measured.stations, untabled, out.left_out, run);
  const RegistrationReport report =
      register_views(views, camera, {start, measured.stations}, options.registration, run);
  const std::string untrusted = report.untrusted_reason();
  if (!untrusted.empty()) throw shows_no_axis(scan, untrusted);
  for (const std::string& open : report.undetermined) {
    if (open != kAnglesOfViews)
      throw shows_no_axis(scan, fmt::format("its shape leaves open {}", open));
  }
  for (const std::size_t view : report.outliers)
    out.left_out.push_back(measured.stations[view].label(view));
  out.table = report.table;
  out.views = measured.stations.size() - out.left_out.size();
  out.rms_mm = report.rms_after_mm;
  // The noise of the points averages out; of what the surfaces disagree by, each view is a witness.
  out.table.point_sigma_mm =
      std::hypot(report.axis_sigma_mm, out.rms_mm / std::sqrt(static_cast<double>(out.views)));
  out.table.axis_sigma_rad =
      report.axis_sigma_rad * out.table.point_sigma_mm / std::max(1e-9, report.axis_sigma_mm);
  double squares = 0.0;
  for (std::size_t i = 0; i < report.angles_rad.size(); ++i)
    squares += std::pow(wrap_rad(report.angles_rad[i] - report.given_angles_rad[i]), 2);
  const auto angles = static_cast<double>(report.angles_rad.size() - 1);
  // Angles that are kept as commanded are known about as well as the tilt of the axis.
  out.table.angle_sigma_rad = std::hypot(std::sqrt(squares / angles), out.table.axis_sigma_rad);
  return out;
}

}  // namespace frangia
