#include "frangia/scan/capture_scan.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <future>
#include <iterator>
#include <optional>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/devices/device_error.h"
#include "frangia/frames/png.h"
#include "frangia/phase/estimate_noise.h"
#include "frangia/phase/fit_algorithm.h"
#include "frangia/phase/judge_frames.h"
#include "frangia/phase/wrap_phase.h"
#include "frangia/scan/capture_manifest.h"

namespace frangia {
namespace {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  }
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Lays the plan down in the folder, or makes sure that it is the one that lies there.
void claim(const Scan& plan) {
  const std::filesystem::path kept = plan.folder / "plan";
  make_folder(plan.folder);
  if (!std::filesystem::exists(kept) && !std::filesystem::is_empty(plan.folder) &&
      !std::filesystem::exists(plan.folder / "plan.new")) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: is not empty; name a new folder, or empty this one",
                            plan.folder.string()));
  }
  Scan copy = plan;
  copy.folder = plan.folder / "plan.new";
  make_folder(copy.folder);
  write_scan(copy);
  if (!std::filesystem::exists(kept)) {
    std::filesystem::rename(copy.folder, kept);
    return;
  }
  const bool same = text_of(kept / "scan.toml") == text_of(copy.folder / "scan.toml") &&
                    text_of(kept / "rig.toml") == text_of(copy.folder / "rig.toml");
  std::filesystem::remove_all(copy.folder);
  if (same) return;
  throw Error(ErrorKind::Input,
              fmt::format("{}: holds another scan than the one asked for; name a new folder, or "
                          "repeat the options and the rig it was begun with",
                          plan.folder.string()));
}

void check_devices(const Scan& plan, const Devices& devices) {
  require(devices.camera != nullptr, "the rig has no [devices.camera]; add it to rig.toml");
  require(plan.views.size() < 2 || devices.turntable != nullptr,
          "the rig has no [devices.turntable], which several views need; add it to rig.toml");
  for (const Pattern& pattern : plan.patterns) {
    if (pattern.kind == PatternKind::Line) {
      require(devices.line_source != nullptr,
              "the rig has no [devices.line_source], which a line pattern needs; add it");
    } else if (plan.rig.projector.is_angular()) {
      require(devices.phase_shifter != nullptr,
              "the rig has no [devices.phase_shifter], which moves an angular projector's fringes; "
              "add it to rig.toml");
    } else {
      require(devices.pattern_display != nullptr,
              "the rig has no [devices.pattern_display], which shows a digital projector's "
              "patterns; add it to rig.toml");
    }
  }
}

DriveCurve curve_of(const CaptureOptions& options, const Devices& devices) {
  if (!options.curve_rad.empty() || devices.phase_shifter == nullptr) {
    return options.curve_rad.empty() ? DriveCurve({0.0, kTurn}, {0.0, 1.0})
                                     : DriveCurve(options.curve_rad, options.curve_v);
  }
  return {{0.0, kTurn}, {0.0, devices.phase_shifter->range().high_v}};
}

double saturated_share(const Frame& frame, int white_level) {
  return std::visit(
      [&](const auto& image) {
        const auto pixels = image.pixels();
        const auto count = std::count_if(
            pixels.begin(), pixels.end(), [&](auto value) { return value >= white_level; });
        return static_cast<double>(count) / static_cast<double>(pixels.size());
      },
      frame);
}

/// One run of the program over a plan.
class Session {
 public:
  Session(const Scan& plan, const Devices& devices, const CaptureOptions& options, const Run& run)
      : plan_(plan),
        devices_(devices),
        options_(options),
        run_(run),
        curve_(curve_of(options, devices)),
        manifest_(plan.folder) {
    const std::size_t damaged = manifest_.forget_damaged();
    if (damaged > 0) run_.warn(fmt::format("{} frames are gone or damaged: taken again", damaged));
    for (const Pattern& pattern : plan.patterns)
      total_ += static_cast<std::size_t>(pattern.frame_count()) * plan.views.size();
  }

  CaptureReport capture() {
    Scan done = plan_;
    done.views.clear();
    std::string last_why;
    for (std::size_t view = 0; view < plan_.views.size(); ++view) {
      const std::string why = capture_view_patiently(view);
      if (why.empty()) {
        done.views.push_back(plan_.views[view]);
      } else {
        last_why = why;
        report_.skipped.push_back(fmt::format("view {}: {}", view, why));
        run_.warn(fmt::format("view {} is skipped: {}", view, why));
      }
    }
    if (done.views.empty()) {
      throw Error(ErrorKind::Device, fmt::format("no view could be captured: {}", last_why));
    }
    write_scan(done);
    return report_;
  }

 private:
  [[nodiscard]] Deadline deadline() const { return Deadline::after(options_.patience); }
  [[nodiscard]] std::string file_of(std::size_t view, const Pattern& pattern, int frame) const {
    return (plan_.views[view].folder / frame_file_name(pattern, frame)).generic_string();
  }
  [[nodiscard]] std::string set_of(std::size_t view, const Pattern& pattern) const {
    return (plan_.views[view].folder / pattern.name).generic_string();
  }
  [[nodiscard]] bool has_set(std::size_t view, const Pattern& pattern) const {
    for (int frame = 0; frame < pattern.frame_count(); ++frame) {
      if (manifest_.find(file_of(view, pattern, frame)) == nullptr) return false;
    }
    return true;
  }

  /// Why the view was given up; empty when it was captured.
  std::string capture_view_patiently(std::size_t view) {
    const bool complete =
        std::all_of(plan_.patterns.begin(), plan_.patterns.end(), [&](const Pattern& pattern) {
          return has_set(view, pattern) && !judgement_is_due(view, pattern);
        });
    std::string why;
    for (int attempt = 0; attempt < options_.view_attempts; ++attempt) {
      try {
        if (!complete) {
          make_folder(plan_.folder / plan_.views[view].folder);
          point_table(view);
        }
        std::string verdict;
        for (const Pattern& pattern : plan_.patterns)
          capture_set(view, pattern, verdict);
        if (!complete) say_verdict(view, verdict);
        return {};
      } catch (const DeviceError& error) {
        devices_.make_safe();
        lit_ = Light::None;
        homed_ = homed_ && error.fault() != DeviceFault::Alarm;
        enabled_ = false;
        if (error.fault() == DeviceFault::Lost || error.fault() == DeviceFault::Refused) throw;
        why = error.what();
        if (attempt + 1 < options_.view_attempts) {
          run_.warn(fmt::format("view {} is tried again: {}", view, why));
        }
      }
    }
    return why;
  }

  void point_table(std::size_t view) {
    if (!devices_.turntable) return;
    if (!enabled_) devices_.turntable->enable(true, deadline());
    enabled_ = true;
    if (!homed_) devices_.turntable->home(deadline());
    homed_ = true;
    devices_.turntable->move_to(plan_.views[view].angle_rad, deadline());
    std::this_thread::sleep_for(options_.settle);
  }

  enum class Light { None, Fringes, Line };

  void light_for(const Pattern& pattern) {
    const Light wanted = pattern.kind == PatternKind::Line ? Light::Line : Light::Fringes;
    if (wanted == lit_) return;
    if (devices_.line_source) devices_.line_source->switch_line(wanted == Light::Line, deadline());
    if (devices_.laser) devices_.laser->enable(wanted == Light::Fringes, deadline());
    if (devices_.lamp) devices_.lamp->enable(wanted == Light::Fringes, deadline());
    lit_ = wanted;
  }

  void set_exposure(std::size_t view) {
    if (exposure_set_) return;
    CameraSettings settings = options_.camera;
    if (options_.auto_exposure) {
      if (!manifest_.exposure_ms()) manifest_.choose_exposure(find_exposure(view));
      settings.exposure_ms = *manifest_.exposure_ms();
    }
    devices_.camera->configure(settings, deadline());
    exposure_set_ = true;
  }

  /// The longest exposure that saturates less than the limit, within a few percent: brackets it by
  /// halving and doubling, then by bisection of its logarithm.
  double find_exposure(std::size_t view) {
    constexpr double kSaturatedLimit = 0.002;
    constexpr double kLongest_ms = 2000.0;
    const auto too_bright = [&](double exposure_ms) {
      CameraSettings settings = options_.camera;
      settings.exposure_ms = exposure_ms;
      devices_.camera->configure(settings, deadline());
      const Pattern& pattern = plan_.patterns.front();
      double worst = 0.0;
      for (int frame = 0; frame < pattern.frame_count(); ++frame) {
        point_light(pattern, frame, 1.0);
        const FrameId id{.view = view, .pattern = pattern.name, .frame = frame};
        worst = std::max(worst, saturated_share(expose(id), plan_.rig.camera.white_level));
      }
      return worst > kSaturatedLimit;
    };
    double low = options_.camera.exposure_ms;
    double high = low;
    if (too_bright(low)) {
      do {
        high = low;
        low *= 0.5;
      } while (low > 1e-3 && too_bright(low));
    } else {
      do {
        low = high;
        high *= 2.0;
      } while (high < kLongest_ms && !too_bright(high));
    }
    while (high / low > 1.05) {
      const double middle = std::sqrt(low * high);
      (too_bright(middle) ? high : low) = middle;
    }
    run_.note(fmt::format("exposure: {:.3g} ms chosen", low));
    return low;
  }

  /// Brings the fringes of one frame. Frame 0 is approached from rest, always.
  void point_light(const Pattern& pattern, int frame, double scale) {
    light_for(pattern);
    if (pattern.kind == PatternKind::Line) return;
    if (!plan_.rig.projector.is_angular()) {
      devices_.pattern_display->show(pattern, frame, deadline());
      return;
    }
    if (frame == 0) devices_.phase_shifter->rest(deadline());
    const double phase = scale * pattern.shifts_rad[static_cast<std::size_t>(frame)];
    devices_.phase_shifter->drive(curve_.volts_at(phase), deadline());
  }

  /// One frame, taken again when it is lost or incomplete.
  Frame expose(FrameId id) {
    const auto exposure = std::chrono::milliseconds(
        static_cast<std::int64_t>(std::ceil(options_.camera.exposure_ms)));
    for (id.attempt = 0;; ++id.attempt) {
      run_.check();
      const bool last = id.attempt + 1 >= options_.frame_attempts;
      try {
        CapturedFrame captured =
            devices_.camera->expose(id, Deadline::after(options_.patience + exposure));
        if (captured.complete) {
          check_frame(captured.frame);
          return std::move(captured.frame);
        }
        if (last) {
          throw DeviceError(
              "camera",
              DeviceFault::Garbled,
              fmt::format("frame {} of pattern \"{}\" came incomplete {} times; check "
                          "its cable and network",
                          id.frame,
                          id.pattern,
                          options_.frame_attempts));
        }
      } catch (const DeviceError& error) {
        const bool passing =
            error.fault() == DeviceFault::Silent || error.fault() == DeviceFault::Garbled;
        if (last || !passing) throw;
      }
      ++report_.frame_retries;
    }
  }

  void check_frame(const Frame& frame) const {
    const Lens& lens = plan_.rig.camera.lens;
    if (width_of(frame) == lens.width_px && height_of(frame) == lens.height_px) return;
    throw Error(ErrorKind::Input,
                fmt::format("the camera gives {} x {} pixels, but camera.size_px in rig.toml is {} "
                            "x {}; correct the one or the other",
                            width_of(frame),
                            height_of(frame),
                            lens.width_px,
                            lens.height_px));
  }

  [[nodiscard]] bool is_controlled(const Pattern& pattern) const {
    return options_.control_steps && devices_.phase_shifter &&
           pattern.kind == PatternKind::Fringe && plan_.rig.projector.is_angular();
  }

  /// A complete set whose frames have not been looked at in this session, and that could still be
  /// found to show motion: the last one only, since a later frame tells that it was found good.
  [[nodiscard]] bool judgement_is_due(std::size_t view, const Pattern& pattern) const {
    bool after = false;
    for (std::size_t v = view; v < plan_.views.size(); ++v) {
      for (const Pattern& other : plan_.patterns) {
        if (after && manifest_.find(file_of(v, other, 0)) != nullptr) return false;
        after = after || (v == view && other.name == pattern.name);
      }
    }
    return true;
  }

  void capture_set(std::size_t view, const Pattern& pattern, std::string& verdict) {
    if (has_set(view, pattern) && !judgement_is_due(view, pattern)) {
      count(pattern.frame_count());
      controlled_ = is_controlled(pattern) ? std::pair(view, &pattern) : controlled_;
      scale_.reset();
      return;
    }
    for (;;) {
      FrameStack stack = take_set(view, pattern);
      if (pattern.kind == PatternKind::Line) return;
      const double scale = manifest_.find(file_of(view, pattern, 0))->drive_scale;
      const NoiseModel noise = noise_of(stack);
      const FittedAlgorithm fitted = fit_algorithm("auto", stack, noise);
      const FrameVerdict judged =
          judge_frames(stack, fitted, wrap_phase(stack, fitted.algorithm, noise), noise);
      const int attempt = manifest_.attempt_of(set_of(view, pattern)) + 1;
      if (judged.vibration_suspected && attempt < options_.set_attempts && can_show_motion()) {
        ++report_.set_retakes;
        run_.warn(fmt::format(
            "view {}: the frames of \"{}\" show motion and are taken again", view, pattern.name));
        manifest_.retake(set_of(view, pattern), attempt);
        counted_ -= static_cast<std::size_t>(pattern.frame_count());
        continue;
      }
      if (is_controlled(pattern)) scale_ = corrected(scale, fitted.step);
      add_words(judged, verdict);
      return;
    }
  }

  /// Only the camera's own noise tells motion: noise that is estimated from the frames hides it.
  [[nodiscard]] bool can_show_motion() const { return plan_.rig.camera.noise.has_value(); }

  [[nodiscard]] NoiseModel noise_of(const FrameStack& stack) const {
    return plan_.rig.camera.noise ? *plan_.rig.camera.noise : estimate_noise({&stack, 1});
  }

  [[nodiscard]] static double corrected(double scale, const StepEstimate& step) {
    // A step that is far off was not found rightly: a fringe too few, something in the way.
    constexpr double kBelievable = 0.3;
    const bool good = step.found && std::abs(step.gain_error()) < kBelievable;
    return good ? scale / (1.0 + step.gain_error()) : scale;
  }

  /// The factor on the commands for the next set: from the last set that is complete, looked up on
  /// the disk when this session has not taken it itself.
  double command_scale(const Pattern& pattern) {
    if (!is_controlled(pattern)) return 1.0;
    if (!scale_ && controlled_.second != nullptr) {
      const FrameStack stack = stored_set(controlled_.first, *controlled_.second);
      const double before =
          manifest_.find(file_of(controlled_.first, *controlled_.second, 0))->drive_scale;
      scale_ = corrected(before, fit_algorithm("auto", stack, noise_of(stack)).step);
    }
    return scale_.value_or(1.0);
  }

  [[nodiscard]] FrameStack stored_set(std::size_t view, const Pattern& pattern) const {
    FrameStack stack{pattern, {}, plan_.rig.camera.white_level};
    for (int frame = 0; frame < pattern.frame_count(); ++frame)
      stack.frames.push_back(read_png(plan_.folder / file_of(view, pattern, frame)));
    return stack;
  }

  FrameStack take_set(std::size_t view, const Pattern& pattern) {
    const int attempt = manifest_.attempt_of(set_of(view, pattern));
    if (attempt > 0) set_aside(view, pattern, attempt - 1);
    const ManifestFrame* first = manifest_.find(file_of(view, pattern, 0));
    const double scale = first != nullptr ? first->drive_scale : command_scale(pattern);
    if (!has_set(view, pattern)) set_exposure(view);  // which moves the fringes: before the first
    FrameStack stack{pattern, {}, plan_.rig.camera.white_level};
    // Looked up first: while a frame is being stored the manifest is not ours to read.
    std::vector<bool> stored;
    for (int frame = 0; frame < pattern.frame_count(); ++frame)
      stored.push_back(manifest_.find(file_of(view, pattern, frame)) != nullptr);
    const bool all_stored = std::find(stored.begin(), stored.end(), false) == stored.end();
    std::future<void> storing;
    for (int frame = 0; frame < pattern.frame_count(); ++frame) {
      const std::string file = file_of(view, pattern, frame);
      if (stored[static_cast<std::size_t>(frame)]) {
        // Taken by an earlier session: the light still goes the whole way, as it did then.
        if (!all_stored) point_light(pattern, frame, scale);
        stack.frames.push_back(read_png(plan_.folder / file));
        ++report_.resumed;
      } else {
        point_light(pattern, frame, scale);
        stack.frames.push_back(expose(
            {.view = view, .pattern = pattern.name, .frame = frame, .set_attempt = attempt}));
        if (storing.valid()) storing.get();
        const Frame copy = stack.frames.back();
        storing = std::async(std::launch::async, [this, file, copy, scale] {
          manifest_.store(file, encode_png(copy), scale);
        });
        ++report_.taken;
      }
      count(1);
    }
    if (storing.valid()) storing.get();
    return stack;
  }

  /// Raw frames are never changed or thrown away.
  void set_aside(std::size_t view, const Pattern& pattern, int attempt) const {
    const std::filesystem::path folder = plan_.folder / plan_.views[view].folder;
    const std::filesystem::path rejected = folder / "rejected";
    make_folder(rejected);
    for (int frame = 0; frame < pattern.frame_count(); ++frame) {
      const std::string name = frame_file_name(pattern, frame);
      const std::filesystem::path to = rejected / fmt::format("{}-{}", attempt, name);
      const bool counts = manifest_.find(file_of(view, pattern, frame)) != nullptr;
      if (!counts && std::filesystem::exists(folder / name) && !std::filesystem::exists(to)) {
        std::filesystem::rename(folder / name, to);
      }
    }
  }

  void count(int frames) {
    counted_ += static_cast<std::size_t>(frames);
    run_.report(std::min(1.0, static_cast<double>(counted_) / static_cast<double>(total_)));
  }

  void add_words(const FrameVerdict& judged, std::string& verdict) const {
    const Lens& lens = plan_.rig.camera.lens;
    const double points = judged.measured_share * lens.width_px * lens.height_px;
    verdict = fmt::format("contrast {:.2f}, {:.2f} % saturated, {:.0f} points{}",
                          judged.contrast,
                          100.0 * judged.saturated_share,
                          points,
                          judged.vibration_suspected && can_show_motion() ? ", shows motion" : "");
  }

  void say_verdict(std::size_t view, const std::string& verdict) const {
    run_.note(fmt::format("view {} at {:.6g} degrees: {}",
                          view,
                          deg_from_rad(plan_.views[view].angle_rad),
                          verdict.empty() ? "captured" : verdict));
  }

  const Scan& plan_;
  const Devices& devices_;
  const CaptureOptions& options_;
  const Run& run_;
  DriveCurve curve_;
  CaptureManifest manifest_;
  CaptureReport report_;
  std::size_t total_ = 0;
  std::size_t counted_ = 0;
  Light lit_ = Light::None;
  bool enabled_ = false;
  bool homed_ = false;
  bool exposure_set_ = false;
  std::optional<double> scale_;
  std::pair<std::size_t, const Pattern*> controlled_{0, nullptr};
};

/// Leaves the devices safe, however the session ends.
class SafeAtTheEnd {
 public:
  explicit SafeAtTheEnd(const Devices& devices) : devices_(devices) { devices_.make_safe(); }
  SafeAtTheEnd(const SafeAtTheEnd&) = delete;
  SafeAtTheEnd& operator=(const SafeAtTheEnd&) = delete;
  SafeAtTheEnd(SafeAtTheEnd&&) = delete;
  SafeAtTheEnd& operator=(SafeAtTheEnd&&) = delete;
  ~SafeAtTheEnd() { devices_.make_safe(); }

 private:
  const Devices& devices_;
};

}  // namespace

CaptureReport capture_scan(const Scan& plan,
                           const Devices& devices,
                           const CaptureOptions& options,
                           const Run& run) {
  require(!plan.patterns.empty() && !plan.views.empty(),
          "a scan needs at least one pattern and one view");
  const SafeAtTheEnd safe(devices);
  check_devices(plan, devices);
  claim(plan);
  return Session(plan, devices, options, run).capture();
}

}  // namespace frangia
