#include "frangia/simulate/simulated_drivers.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/devices/device_error.h"
#include "frangia/files/read_mesh.h"
#include "frangia/simulate/fault_script.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/simulated_bench.h"

namespace frangia {
namespace {

using BenchPtr = std::shared_ptr<SimulatedBench>;

FaultScript faults_of(const DeviceSettings& settings, const std::vector<std::string>& known) {
  FaultScript script(settings.texts("faults"));
  for (const std::string& kind : script.kinds()) {
    if (std::find(known.begin(), known.end(), kind) != known.end()) continue;
    settings.fail(
        "faults",
        fmt::format("holds \"{}\"; each must begin with one of: {}", kind, fmt::join(known, ", ")));
  }
  return script;
}

SimulateOptions options_of(const DeviceSettings& settings, const Rig& rig) {
  SimulateOptions options;
  options.seed = static_cast<std::uint64_t>(settings.integer_or("seed", 1));
  options.samples_per_px = static_cast<int>(settings.number_in("samples", 1, 1, 64));
  options.bits = static_cast<int>(std::lround(std::log2(rig.camera.white_level + 1)));
  if (rig.camera.noise) {
    const double gain = 1.0 / rig.camera.noise->slope_counts;
    const double read2 = std::max(0.0, rig.camera.noise->floor_counts2 - 1.0 / 12.0);
    options.full_well_e = gain * rig.camera.white_level;
    options.read_e = gain * std::sqrt(read2);
  }
  options.ambient = settings.number_or("ambient", options.ambient);
  options.contrast = settings.number_or("contrast", options.contrast);
  options.gloss = settings.number_or("gloss", options.gloss);
  options.shininess = settings.number_or("shininess", options.shininess);
  options.texture = settings.number_or("texture", options.texture);
  options.speckle = settings.number_or("speckle", options.speckle);
  return options;
}

std::shared_ptr<const SimulatedScene> scene_of(const DeviceSettings& settings, const Rig& rig) {
  const std::string part = settings.text_or("part", "bracket");
  const auto known = part_names();
  const bool built_in = std::find(known.begin(), known.end(), part) != known.end();
  if (!built_in && !std::filesystem::exists(part)) {
    settings.fail("part",
                  fmt::format("is \"{}\"; it must be one of {}, or a .stl, .ply or .obj file",
                              part,
                              fmt::join(known, ", ")));
  }
  // The brightest of a whole turn sets the exposure, whatever views are asked for.
  constexpr std::size_t kStops = 8;
  std::vector<SimulatedView> views;
  for (std::size_t i = 0; i < kStops; ++i)
    views.push_back({i, kTurn * static_cast<double>(i) / kStops});
  return std::make_shared<const SimulatedScene>(make_simulated_scene(
      built_in ? make_part(part) : read_mesh(part), rig, views, options_of(settings, rig)));
}

class SimulatedCamera : public CameraDriver {
 public:
  SimulatedCamera(const DeviceSettings& settings, const Rig& rig, BenchPtr bench)
      : name_(settings.device_name()),
        bench_(std::move(bench)),
        faults_(faults_of(settings, {"lost", "incomplete", "saturated", "motion", "unplugged"})) {
    bench_->reference_exposure_ms = settings.number_in("reference_exposure_ms", 10.0, 1e-3, 1e5);
    bench_->scene = scene_of(settings, rig);
    size_ = fmt::format("{} x {} pixels", rig.camera.lens.width_px, rig.camera.lens.height_px);
  }

  [[nodiscard]] std::string probe(Deadline /*deadline*/) override {
    return "ray-traced camera, " + size_;
  }
  void make_safe() noexcept override {}

  CameraSettings configure(const CameraSettings& settings, Deadline /*deadline*/) override {
    constexpr double kLongest_ms = 10000.0;
    if (!(settings.exposure_ms > 0.0) || settings.exposure_ms > kLongest_ms) {
      throw DeviceError(name_,
                        DeviceFault::Refused,
                        fmt::format("an exposure of {} ms is out of its limits, 0 to {} ms",
                                    settings.exposure_ms,
                                    kLongest_ms));
    }
    bench_->camera = settings;
    return settings;
  }

  [[nodiscard]] CapturedFrame expose(const FrameId& id, Deadline /*deadline*/) override {
    const auto faulty = [&](const char* kind) {
      return faults_.holds({kind, std::to_string(id.view), id.pattern, std::to_string(id.frame)});
    };
    ++number_;
    if (faulty("unplugged")) {
      throw DeviceError(name_, DeviceFault::Lost, "is unplugged; plug it in and scan again");
    }
    if (faulty("lost") && id.attempt == 0) {
      throw DeviceError(name_, DeviceFault::Silent, "sent no frame in time; check its cable");
    }
    FrameFaults faults;
    if (faulty("saturated")) faults.light = 8.0;
    if (faulty("motion") && id.set_attempt == 0) faults.motion_rad = 0.5;
    CapturedFrame captured{.frame = bench_camera_.expose(*bench_, id, faults),
                           .settings = bench_->camera,
                           .number = number_};
    captured.complete = !(faulty("incomplete") && id.attempt == 0);
    return captured;
  }

 private:
  std::string name_;
  std::string size_;
  BenchPtr bench_;
  FaultScript faults_;
  BenchCamera bench_camera_;
  std::uint64_t number_ = 0;
};

/// A piezo: its place follows the volts with play (hysteresis) and a lag, is off by a share, and
/// drifts. Coming from below the play does not show, which is why sets are approached from there.
class SimulatedPiezo : public PhaseShifter {
 public:
  SimulatedPiezo(const DeviceSettings& settings, BenchPtr bench)
      : name_(settings.device_name()),
        bench_(std::move(bench)),
        rad_per_v_(rad_from_deg(settings.number_in("degrees_per_volt", 36.0, 1e-3, 1e5)) *
                   (1.0 + settings.number_in("gain_error", 0.0, -0.5, 0.5))),
        play_v_(settings.number_in("hysteresis_v", 0.0, 0.0, 100.0)) {
    const auto range = settings.numbers("range_v");
    if (!range.empty()) {
      if (range.size() != 2 || range[0] >= range[1])
        settings.fail("range_v", "must be two rising volts");
      range_ = {range[0], range[1]};
    }
    const double lag_ms = settings.number_in("time_constant_ms", 1.0, 0.0, 1e4);
    const double settle_ms = settings.number_in("settle_ms", 20.0, 0.0, 1e4);
    not_settled_ = lag_ms > 0.0 ? std::exp(-settle_ms / lag_ms) : 0.0;
    bench_->fringes_per_degree = settings.number_in("fringes_per_degree", 1.0, 1e-3, 1e3);
    bench_->drift_rad_per_view = rad_from_deg(settings.number_or("drift_deg_per_view", 0.0));
    bench_->jitter_rad = rad_from_deg(settings.number_in("jitter_deg", 0.0, 0.0, 180.0));
    place_v_ = range_.low_v;
    bench_->piezo_rad = place_v_ * rad_per_v_;
  }

  [[nodiscard]] std::string probe(Deadline /*deadline*/) override {
    return fmt::format("piezo of {} to {} V", range_.low_v, range_.high_v);
  }
  void make_safe() noexcept override { settle_at(range_.low_v, 0.0); }
  [[nodiscard]] Range range() const override { return range_; }

  void drive(double volts, Deadline /*deadline*/) override {
    if (volts < range_.low_v || volts > range_.high_v) {
      throw DeviceError(
          name_,
          DeviceFault::Refused,
          fmt::format("{} V is out of its range, {} to {} V", volts, range_.low_v, range_.high_v));
    }
    settle_at(volts, not_settled_);
  }
  /// At rest it may take its time.
  void rest(Deadline /*deadline*/) override { settle_at(range_.low_v, 0.0); }

 private:
  void settle_at(double volts, double lag) noexcept {
    const double target = std::clamp(place_v_, volts, volts + play_v_);
    place_v_ = volts == range_.low_v ? volts : target + lag * (place_v_ - target);
    bench_->piezo_rad = place_v_ * rad_per_v_;
  }

  std::string name_;
  BenchPtr bench_;
  Range range_{-1.0, 12.0};
  double rad_per_v_;
  double play_v_;
  double not_settled_ = 0.0;
  double place_v_ = 0.0;
};

class SimulatedTable : public TableDriver {
 public:
  SimulatedTable(const DeviceSettings& settings, BenchPtr bench)
      : name_(settings.device_name()),
        bench_(std::move(bench)),
        faults_(faults_of(settings, {"stuck", "alarm"})),
        backlash_rad_(rad_from_deg(settings.number_in("backlash_deg", 0.0, 0.0, 30.0))),
        approach_rad_(rad_from_deg(settings.number_in("approach_deg", 2.0, 0.0, 90.0))) {
    const auto limits = settings.numbers("limits_deg");
    if (!limits.empty()) {
      if (limits.size() != 2 || limits[0] >= limits[1]) {
        settings.fail("limits_deg", "must be two rising angles");
      }
      low_rad_ = rad_from_deg(limits[0]);
      high_rad_ = rad_from_deg(limits[1]);
    }
  }

  [[nodiscard]] std::string probe(Deadline /*deadline*/) override {
    return fmt::format("simulated table, {}", homed_ ? "angle known" : "not homed");
  }
  void make_safe() noexcept override { enabled_ = false; }
  void enable(bool on, Deadline /*deadline*/) override { enabled_ = on; }
  void home(Deadline /*deadline*/) override {
    check_enabled();
    homed_ = true;
    turn_to(-approach_rad_);
    turn_to(0.0);
  }

  void move_to(double angle_rad, Deadline /*deadline*/) override {
    constexpr double kRounding = 1e-9;
    if (angle_rad < low_rad_ - kRounding || angle_rad > high_rad_ + kRounding) {
      throw DeviceError(name_,
                        DeviceFault::Refused,
                        fmt::format("an angle of {:.6g} degrees is out of its limits, {:.6g} to "
                                    "{:.6g}; change the plan or limits_deg",
                                    deg_from_rad(angle_rad),
                                    deg_from_rad(low_rad_),
                                    deg_from_rad(high_rad_)));
    }
    check_enabled();
    if (!homed_) {
      throw DeviceError(name_, DeviceFault::Alarm, "its angle is not known; home it first");
    }
    const std::string angle = fmt::format("{:.6g}", deg_from_rad(angle_rad));
    if (happens("alarm", angle)) {
      homed_ = false;
      throw DeviceError(name_, DeviceFault::Alarm, "stopped with an alarm; home it again");
    }
    if (happens("stuck", angle)) {
      throw DeviceError(
          name_,
          DeviceFault::Silent,
          fmt::format("did not arrive at {} degrees in time; see what blocks it", angle));
    }
    if (angle_rad < motor_rad_) turn_to(angle_rad - approach_rad_);
    turn_to(angle_rad);
  }

 private:
  void check_enabled() const {
    if (!enabled_) throw DeviceError(name_, DeviceFault::Refused, "is not enabled");
  }
  /// Once, or at every move to that angle.
  [[nodiscard]] bool happens(const char* kind, const std::string& angle) {
    if (faults_.holds({kind, angle, "always"}) && !faults_.holds({kind, angle})) return true;
    return faults_.holds({kind, angle}) && happened_.insert(kind + angle).second;
  }
  /// The platter lags behind the motor by the backlash when it comes from above.
  void turn_to(double angle_rad) {
    platter_rad_ = std::clamp(platter_rad_, angle_rad, angle_rad + backlash_rad_);
    motor_rad_ = angle_rad;
    bench_->table_rad = platter_rad_;
  }

  std::string name_;
  BenchPtr bench_;
  FaultScript faults_;
  double backlash_rad_;
  double approach_rad_;
  double low_rad_ = -10.0 * kTurn;
  double high_rad_ = 10.0 * kTurn;
  double motor_rad_ = 0.0;
  double platter_rad_ = 0.0;
  bool enabled_ = false;
  bool homed_ = false;
  std::set<std::string> happened_;
};

class SimulatedDisplay : public PatternDisplay {
 public:
  explicit SimulatedDisplay(BenchPtr bench) : bench_(std::move(bench)) {}
  [[nodiscard]] std::string probe(Deadline /*deadline*/) override {
    return "simulated digital projector";
  }
  void make_safe() noexcept override { bench_->shown.reset(); }
  void show(const Pattern& pattern, int frame, Deadline /*deadline*/) override {
    require(pattern.period_px > 0.0, "a digital projector's pattern needs a period_px above 0");
    bench_->shown = pattern;
    bench_->shown_frame = frame;
  }
  void show_black(Deadline /*deadline*/) override { bench_->shown.reset(); }

 private:
  BenchPtr bench_;
};

class SimulatedLine : public LineSource {
 public:
  explicit SimulatedLine(BenchPtr bench) : bench_(std::move(bench)) {}
  [[nodiscard]] std::string probe(Deadline /*deadline*/) override {
    return "simulated plane of light";
  }
  void make_safe() noexcept override { bench_->line_light = false; }
  void switch_line(bool on, Deadline /*deadline*/) override { bench_->line_light = on; }

 private:
  BenchPtr bench_;
};

class SimulatedSwitch : public EnableSwitch {
 public:
  explicit SimulatedSwitch(BenchPtr bench) : bench_(std::move(bench)) {
    bench_->fringe_light = false;
  }
  [[nodiscard]] std::string probe(Deadline /*deadline*/) override { return "simulated light"; }
  void make_safe() noexcept override { bench_->fringe_light = false; }
  void enable(bool on, Deadline /*deadline*/) override { bench_->fringe_light = on; }

 private:
  BenchPtr bench_;
};

}  // namespace

void add_simulated_drivers(DriverRegistry& registry) {
  const auto bench = std::make_shared<SimulatedBench>();
  const auto none = [] { return std::vector<std::string>{}; };
  registry.cameras["simulated"] = {"a ray-traced camera before a part",
                                   [bench](const DeviceSettings& settings, const Rig& rig) {
                                     return std::make_unique<SimulatedCamera>(settings, rig, bench);
                                   },
                                   none};
  registry.phase_shifters["simulated"] = {"a piezo with gain error, hysteresis, lag and drift",
                                          [bench](const DeviceSettings& settings, const Rig&) {
                                            return std::make_unique<SimulatedPiezo>(settings,
                                                                                    bench);
                                          },
                                          none};
  registry.turntables["simulated"] = {"a table with backlash",
                                      [bench](const DeviceSettings& settings, const Rig&) {
                                        return std::make_unique<SimulatedTable>(settings, bench);
                                      },
                                      none};
  registry.pattern_displays["simulated"] = {"a digital projector",
                                            [bench](const DeviceSettings&, const Rig&) {
                                              return std::make_unique<SimulatedDisplay>(bench);
                                            },
                                            none};
  registry.line_sources["simulated"] = {
      "a plane of light",
      [bench](const DeviceSettings&, const Rig&) { return std::make_unique<SimulatedLine>(bench); },
      none};
  registry.enable_switches["simulated"] = {"a lamp's or a laser's enable",
                                           [bench](const DeviceSettings&, const Rig&) {
                                             return std::make_unique<SimulatedSwitch>(bench);
                                           },
                                           none};
}

}  // namespace frangia
