#include "frangia/acquisition/internal/capture_devices.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/pattern/pattern_picture.h"

namespace frangia {
namespace {

/// Adds its lifetime to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  Stopwatch(Stopwatch&&) = delete;
  Stopwatch& operator=(Stopwatch&&) = delete;
  ~Stopwatch() {
    seconds_ += std::chrono::duration<double>(Deadline::Clock::now() - begin_).count();
  }

 private:
  double& seconds_;
  Deadline::Clock::time_point begin_ = Deadline::Clock::now();
};

void check_frame(const Device& device, const Frame& frame, const Camera& camera) {
  const CameraModel& model = camera.model;
  if (width_of(frame) == model.width_px && height_of(frame) == model.height_px) return;
  fail_device(device,
              fmt::format("its frame is {} x {} pixels, but {}size_px in rig.toml is {} x "
                          "{}; correct one of them",
                          width_of(frame),
                          height_of(frame),
                          camera.name.empty() ? "camera." : "its ",
                          model.width_px,
                          model.height_px));
}

}  // namespace

CaptureDevices::CaptureDevices(RigDevices& devices,
                               const Rig& rig,
                               const CaptureOptions& options,
                               const Run& run)
    : devices_(devices), rig_(rig), options_(options), run_(run) {
  if (devices.shifter) shift_.emplace(*devices.shifter);
}

void CaptureDevices::turn_to(double angle_rad) {
  if (!devices_.turntable) return;
  end_set();
  const Stopwatch watch(seconds_);
  TurntableDevice& table = *devices_.turntable;
  if (!enabled_) table.enable(true, deadline(options_.timeout_s));
  warn_of(table, run_);
  enabled_ = true;
  if (!table.angle_rad() && standing_rad_ && !table.info().can_home) {
    // A fault of another device did not turn it.
    table.set_angle(*standing_rad_, deadline(options_.timeout_s));
  } else if (!table.angle_rad()) {
    table.home(motion_deadline(table.home_time_s()));
  }
  standing_rad_.reset();
  table.move_to(angle_rad, motion_deadline(table.move_time_s(angle_rad)));
  standing_rad_ = angle_rad;
  deadline(options_.settle_s + 1.0).sleep(options_.settle_s);
}

Deadline CaptureDevices::motion_deadline(double expected_s) const {
  constexpr double kMargin = 1.5;  // motors and gears of hobby boards are up to a third too slow
  return deadline(options_.timeout_s + kMargin * expected_s);
}

void CaptureDevices::begin_set(const Pattern& pattern, double scale) {
  if (!shift_ || pattern.kind != PatternKind::Fringe) return;
  const Stopwatch watch(seconds_);
  devices_.shifter->set_fringe_frequency(pattern.fringes_per_degree, deadline(options_.timeout_s));
  shift_->set_scale(scale);
  shift_->return_to_start(deadline(options_.timeout_s));
}

void CaptureDevices::show(const Pattern& pattern, int frame) {
  if (shift_ && pattern.kind == PatternKind::Ambient) {
    switch_to(Light::None);
    return;
  }
  switch_to(pattern.kind == PatternKind::Line ? Light::Line : Light::Fringes);
  if (pattern.kind == PatternKind::Line) return;
  if (shift_) {
    const Stopwatch watch(seconds_);
    shift_->shift_to(pattern.shifts_rad[static_cast<std::size_t>(frame)],
                     deadline(options_.timeout_s));
    return;
  }
  const DisplayInfo& info = devices_.display->info();
  const Image<float> picture =
      pattern_picture(pattern, frame, info.width_px, info.height_px, rig_.projector.pixels);
  const Stopwatch watch(seconds_);
  devices_.display->show(picture, deadline(options_.timeout_s));
}

void CaptureDevices::end_set() {
  if (active_light_ == Light::Line) switch_to(Light::None);
}

void CaptureDevices::switch_to(Light wanted) {
  if (wanted == active_light_) return;
  const Stopwatch watch(seconds_);
  const Deadline until = deadline(options_.timeout_s);
  if (devices_.laser_sheet) devices_.laser_sheet->set(wanted == Light::Line, until);
  if (devices_.light) devices_.light->set(wanted == Light::Fringes, until);
  active_light_ = wanted;
}

void CaptureDevices::expose_for(double exposure_ms) {
  if (exposure_ms == exposure_ms_) return;
  const Stopwatch watch(seconds_);
  CameraSettings settings = options_.camera;
  settings.exposure_ms = exposure_ms;
  exposure_ms_ = 0.0;
  for (const auto& camera : devices_.cameras)
    camera->configure(settings, deadline(options_.timeout_s));
  exposure_ms_ = exposure_ms;
}

CompleteFrame CaptureDevices::capture(const FrameLabel& label, std::size_t number) {
  const Stopwatch watch(seconds_);
  CameraDevice& camera = *devices_.cameras.at(number);
  FrameLabel own = label;
  own.setup = options_.setup;
  std::string cause;
  for (int attempts = 1; attempts <= options_.frame_attempts; ++attempts) {
    run_.check();
    const Deadline until = deadline(options_.timeout_s + 1e-3 * exposure_ms_);
    CapturedFrame captured = camera.capture(own, until);
    if (captured.complete) {
      check_frame(camera, captured.frame, rig_.cameras[number].camera);
      return {std::move(captured.frame), attempts, captured.timestamp_s};
    }
    cause = captured.incomplete_cause;
  }
  fail_device(
      camera,
      fmt::format("frame {} of \"{}\" arrived incomplete {} times ({}); check its cable and "
                  "network",
                  label.frame,
                  label.pattern,
                  options_.frame_attempts,
                  cause));
}

void CaptureDevices::make_safe() noexcept {
  devices_.make_dark();
  active_light_ = Light::None;
  enabled_ = enabled_ && devices_.turntable && devices_.turntable->angle_rad();
  exposure_ms_ = 0.0;
}

void CaptureDevices::check_health(const std::string& cause) {
  const std::string fault = find_fault();
  if (fault.empty()) return;
  if (fault == cause) throw Error(ErrorKind::Device, cause);
  throw Error(ErrorKind::Device, fmt::format("{}; consequence: {}", cause, fault));
}

std::string CaptureDevices::find_fault() {
  try {
    for (Device* device : devices_.all())
      static_cast<void>(device->test(deadline(options_.timeout_s)));
    const TurntableDevice* table = devices_.turntable.get();
    if (table != nullptr && !table->info().can_home && !standing_rad_) {
      fail_device(
          *table,
          "its angle was lost and it has no home switch; turn it to 0 by hand and scan again "
          "with `table_at_rad` 0, which continues this scan");
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Device) throw;
    return error.what();
  }
  return {};
}

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
