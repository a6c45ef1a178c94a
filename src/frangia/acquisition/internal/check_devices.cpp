#include "frangia/acquisition/internal/check_devices.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

[[noreturn]] void refuse(const Pattern& pattern, const std::string& why) {
  throw Error(ErrorKind::Input, fmt::format("the pattern \"{}\" {}", pattern.name, why));
}

/// A phase shifter shows fringes only.
void check_on_shifter(const Pattern& pattern, const PhaseShifter& shifter) {
  if (pattern.kind == PatternKind::Ramp) {
    refuse(
        pattern,
        fmt::format("is a grey ramp, which {} cannot show; scan without `ramp`, or use a digital "
                    "projector",
                    shifter.name()));
  }
  if (pattern.kind == PatternKind::Gray) {
    refuse(pattern,
           fmt::format("is a Gray code, which {} cannot show; choose another `sequence`, or use a "
                       "digital projector",
                       shifter.name()));
  }
  if (pattern.kind == PatternKind::Ambient) return;  // its light is switched off
  const ShifterInfo& info = shifter.info();
  if (!(pattern.fringes_per_degree > 0.0))
    refuse(pattern, fmt::format("has no fringes_per_degree, which {} needs", shifter.name()));
  constexpr double kRounding = 1e-6;
  if (info.fringes_per_degree > 0.0 &&
      std::abs(pattern.fringes_per_degree / info.fringes_per_degree - 1.0) > kRounding) {
    refuse(pattern,
           fmt::format("has {:g} fringes per degree, but {} shows {:g}; scan with patterns of its "
                       "own pitch",
                       pattern.fringes_per_degree,
                       shifter.name(),
                       info.fringes_per_degree));
  }
  for (const double shift_rad : pattern.shifts_rad) {
    try {
      static_cast<void>(info.curve.command_for(info.curve.phases_rad.front() + shift_rad));
    } catch (const Error& error) {
      refuse(pattern,
             fmt::format("has a shift of {:.6g} degrees, which {} cannot show: {}",
                         deg_from_rad(shift_rad),
                         shifter.name(),
                         error.what()));
    }
  }
}

void check_on_display(const Pattern& pattern, const PatternDisplay& display) {
  if (pattern.kind == PatternKind::Fringe && !(pattern.period_px > 0.0))
    refuse(pattern, fmt::format("has no period_px above 0, which {} needs", display.name()));
  if (pattern.kind == PatternKind::Gray && !(pattern.stripe_px > 0.0))
    refuse(pattern, fmt::format("has no stripe_px above 0, which {} needs", display.name()));
  for (const double level : pattern.levels) {
    if (!(level >= 0.0 && level <= 1.0))
      refuse(pattern, fmt::format("has the level {:g}; levels are from 0 to 1", level));
  }
}

void check_pattern(const RigDevices& devices, const Rig& rig, const Pattern& pattern) {
  if (pattern.frame_count() < 1)
    refuse(pattern, "has no frames; give it shifts, bits or levels, or leave it out");
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(pattern.shifts_rad.begin(), pattern.shifts_rad.end(), finite))
    refuse(pattern, "has a shift that is not a finite number; correct it");
  if (pattern.kind == PatternKind::Line) {
    require(devices.laser_sheet != nullptr,
            "the rig has no [devices.line], which the laser sheet needs; add it to rig.toml");
  } else if (rig.projector.is_angular()) {
    require(devices.shifter != nullptr,
            "the rig has no [devices.fringes], which moves an interferometer's fringes; add it "
            "to rig.toml");
    check_on_shifter(pattern, *devices.shifter);
  } else {
    require(devices.display != nullptr,
            "the rig has no [devices.fringes], which shows a digital projector's patterns; add "
            "it to rig.toml");
    check_on_display(pattern, *devices.display);
  }
}

void check_exposure(const CameraDevice& camera, double exposure_ms) {
  const CameraInfo& info = camera.info();
  if (exposure_ms >= info.min_exposure_ms && exposure_ms <= info.max_exposure_ms) return;
  throw Error(ErrorKind::Input,
              fmt::format("the exposure {:.6g} ms is outside the range of {}, {:.6g} to {:.6g} ms",
                          exposure_ms,
                          camera.name(),
                          info.min_exposure_ms,
                          info.max_exposure_ms));
}

void check_angles(const TurntableDevice& table, const std::vector<ScanView>& views) {
  const TurntableInfo& info = table.info();
  constexpr double kRounding = 1e-9;
  for (const ScanView& view : views) {
    const double angle_rad = view.angle_rad;
    if (angle_rad >= info.min_rad - kRounding && angle_rad <= info.max_rad + kRounding) continue;
    throw Error(ErrorKind::Input,
                fmt::format("{}: the view at {:.6g} degrees is outside its limits, {:.6g} to "
                            "{:.6g}; take other views, or correct min_deg and max_deg in rig.toml",
                            table.name(),
                            deg_from_rad(angle_rad),
                            deg_from_rad(info.min_rad),
                            deg_from_rad(info.max_rad)));
  }
}

}  // namespace

void check_devices(const RigDevices& devices, const Scan& plan, const CaptureOptions& options) {
  require(devices.reference() != nullptr, "the rig has no [devices.camera]; add it to rig.toml");
  for (std::size_t i = 1; i < plan.rig.cameras.size(); ++i) {
    const std::string& name = plan.rig.cameras[i].camera.name;
    if (i < devices.cameras.size() && devices.cameras[i] != nullptr) continue;
    throw Error(ErrorKind::Input,
                fmt::format("the rig has no [devices.camera-{0}], which takes the frames of its "
                            "camera \"{0}\"; add it to rig.toml",
                            name));
  }
  for (const Pattern& pattern : plan.patterns) {
    check_pattern(devices, plan.rig, pattern);
    for (const double exposure_ms : pattern.exposures_ms)
      check_exposure(*devices.reference(), exposure_ms);
  }
  const auto has_exposures = [](const Pattern& pattern) { return !pattern.exposures_ms.empty(); };
  if (options.exposure == ExposureChoice::Given &&
      std::none_of(plan.patterns.begin(), plan.patterns.end(), has_exposures))
    check_exposure(*devices.reference(), options.camera.exposure_ms);
  if (devices.turntable) return check_angles(*devices.turntable, plan.views);
  require(plan.views.size() < 2 || options.before_view != nullptr,
          "the rig has no [devices.turntable], which several views need; add it to rig.toml, or "
          "set `views` to 1");
}

}  // namespace frangia
