#include "frangia/acquisition/measure_display.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "frangia/acquisition/internal/choose_exposures.h"
#include "frangia/acquisition/internal/display_probe.h"
#include "frangia/acquisition/internal/room_light.h"
#include "frangia/core/angles.h"
#include "frangia/phase/waveform/fringe_response.h"

namespace frangia {
namespace {

constexpr double kLongestDelay_s = 0.5;  ///< of the slowest projectors with image enhancement
constexpr double kMinContrast = 0.15;    ///< of white, as of a grey ramp
constexpr std::size_t kMinLit = 100;     ///< pixels
constexpr double kLow = 0.5;             ///< of white: least light of the brightest pixels
constexpr double kAim = 0.65;            ///< what is looked for
constexpr double kHigh = 0.75;           ///< most
constexpr double kBrightest = 0.94;      ///< most, where a raster of exposures wants it
/// Share of a flash's light that is taken for none in a steady room: noise stays below.
constexpr double kLeft = 0.03;
constexpr double kFollowed = 0.15;  ///< largest residual of flashes that are followed

[[noreturn]] void fail(const std::string& why) {
  throw Error(ErrorKind::Numeric, why);
}

/// A level of counts that a share of all pixels exceeds.
int counts_above(const Frame& frame, double share) {
  std::vector<int> counts;
  for (int y = 0; y < height_of(frame); ++y)
    for (int x = 0; x < width_of(frame); ++x)
      counts.push_back(counts_at(frame, x, y));
  const auto place =
      static_cast<std::ptrdiff_t>((1.0 - share) * static_cast<double>(counts.size() - 1));
  std::nth_element(counts.begin(), counts.begin() + place, counts.end());
  return counts[static_cast<std::size_t>(place)];
}

class Measurer {
 public:
  Measurer(RigDevices& devices, const Rig& rig, const CaptureOptions& options, const Run& run)
      : devices_(devices), rig_(rig), run_(run), probe_(devices, rig, options, run) {
    found_.exposure_ms = options.camera.exposure_ms;
    found_.white_level = rig.reference().white_level;
  }

  DisplayMeasurement measure() {
    run_.stage("exposure");
    probe_.set_delay(kLongestDelay_s);
    probe_.set_skipped(kMostUnderWay);
    expose();
    run_.report(0.1);
    find_white_level();
    run_.report(0.2);
    run_.stage("light");
    look_at_room();
    run_.report(0.4);
    run_.stage("latency");
    find_latency();
    run_.report(0.8);
    run_.stage("response");
    find_frame_rate();
    find_response();
    find_sharpness();
    judge_black();
    run_.report(1.0);
    return std::move(found_);
  }

 private:
  /// Looks for an exposure at which the brightest pixels are at about 65 % of white.
  void expose() {
    constexpr double kMost = 0.005;  // share of the pixels
    constexpr int kTries = 14;
    const CameraInfo& camera = devices_.reference()->info();
    const double white = rig_.reference().white_level;
    for (int i = 0; i < kTries; ++i) {
      probe_.expose_for(found_.exposure_ms);
      const double share = counts_above(probe_.take(flash_, 1).frame, kMost) / white;
      if (share > kLow && share < kHigh) break;
      const double factor = share >= kHigh ? 0.4 : std::min(8.0, kAim / std::max(share, 0.01));
      const double next =
          std::clamp(found_.exposure_ms * factor, camera.min_exposure_ms, camera.max_exposure_ms);
      if (next == found_.exposure_ms) break;
      found_.exposure_ms = next;
    }
    find_lit();
  }

  void find_lit() {
    const Frame bright = probe_.take(flash_, 1).frame;
    const Frame dark = probe_.take(flash_, 0).frame;
    lit_ = LitPixels(dark, bright, rig_.reference().white_level, kMinContrast);
    if (lit_.size() < kMinLit) {
      fail(
          "the display lights too few pixels of the camera; put a white sheet of paper where both "
          "look, and make it brighter than the room");
    }
    found_.dark_zeros = lit_.zeros_of(dark);
  }

  /// Pixels that would have half as much again as white, had they room, show where they stop.
  void find_white_level() {
    constexpr double kOver = 1.5;
    constexpr double kFirm = 0.02;  // of white, from the first percentile to the median
    const double white = rig_.reference().white_level;
    const double longest_ms = devices_.reference()->info().max_exposure_ms;
    const double factor = std::min(6.0, longest_ms / found_.exposure_ms);
    const Frame below = probe_.take(flash_, 1).frame;
    probe_.expose_for(factor * found_.exposure_ms);
    const Frame above = probe_.take(flash_, 1).frame;
    probe_.expose_for(found_.exposure_ms);
    std::vector<int> clipped;
    for (int y = 0; y < height_of(below); ++y)
      for (int x = 0; x < width_of(below); ++x)
        if (factor * counts_at(below, x, y) > kOver * white)
          clipped.push_back(counts_at(above, x, y));
    if (clipped.size() < kMinLit) {
      found_.findings.emplace_back(
          "no pixel could be saturated to find the level of white; come closer, or open the "
          "aperture");
      return;
    }
    std::sort(clipped.begin(), clipped.end());
    const int level = clipped[clipped.size() / 100];
    const int median = clipped[clipped.size() / 2];
    if (2 * level <= devices_.reference()->info().white_level || median - level > kFirm * white) {
      found_.findings.push_back(
          fmt::format("saturated pixels have {} to {} of {} counts: the camera has fewer bits than "
                      "its numbers, "
                      "or changes them; correct its pixel format and switch its enhancements off",
                      level,
                      clipped.back(),
                      devices_.reference()->info().white_level));
      return;
    }
    found_.white_level = level;
  }

  void look_at_room() {
    static_cast<void>(probe_.take(flash_, 0));
    probe_.set_skipped(0);
    const RoomLight room = measure_room_light(
        probe_, lit_, lit_.light_counts() / found_.exposure_ms, found_.exposure_ms);
    probe_.set_delay(kLongestDelay_s);
    probe_.set_skipped(kMostUnderWay);
    found_.mains_hz = room.mains_hz;
    found_.room_flicker = room.amplitude;
    if (room.flickers && room.mains_hz == 0.0) {
      found_.findings.emplace_back(
          "the light of the room flickers, but with neither 50 nor 60 Hz; switch it off");
    }
    room_hz_ = 2.0 * room.mains_hz;
    choose_step(devices_.display->info().refresh_period_ms,
                room.mains_hz > 0.0 ? 1000.0 / (2.0 * room.mains_hz) : 0.0);
    probe_.expose_for(found_.exposure_ms);
    find_lit();
  }

  /// Amplitude of the room's flicker in frames, over the full light of the display.
  [[nodiscard]] double flicker_of_frames() const {
    return found_.room_flicker * flicker_left(found_.exposure_ms, room_hz_);
  }

  /// Share of a flash's light that may be none.
  [[nodiscard]] double least_share() const { return kLeft + flicker_of_frames(); }

  /// Names the flicker of the room where it is the likely cause of what cannot be measured.
  [[noreturn]] void fail_in_room(const std::string& why) const {
    constexpr double kHarmful = 0.02;
    if (flicker_of_frames() < kHarmful) fail(why);
    fail(fmt::format(
        "the light of the room flickers in the frames by {:.0f} % of the display's light, "
        "too much to see its flashes; darken the room",
        100.0 * flicker_of_frames()));
  }

  /// The raster of exposures: of both lights where such an exposure is not too bright.
  void choose_step(double refresh_ms, double room_ms) {
    const double longest_ms = found_.exposure_ms * kBrightest / kHigh;
    const double common_ms = common_period_ms(refresh_ms, room_ms);
    for (const double step_ms : {common_ms, refresh_ms, room_ms}) {
      if (step_ms <= 0.0 || step_ms > longest_ms) continue;
      found_.exposure_step_ms = step_ms;
      break;
    }
    const double step_ms = found_.exposure_step_ms;
    if (common_ms > 0.0 && step_ms != common_ms) {
      found_.findings.push_back(fmt::format(
          "exposures of {:.1f} ms, whole periods of the light of {}, would be too bright: {}",
          common_ms,
          refresh_ms <= 0.0 ? "the room"
          : room_ms <= 0.0  ? "the display"
                            : "display and room",
          room_ms > 0.0 ? "darken the room, or close the aperture"
                        : "close the aperture, or make the display darker"));
    }
    if (step_ms > 0.0)
      found_.exposure_ms = std::max(step_ms, on_raster(found_.exposure_ms, step_ms));
  }

  /// Light of the flashes of `codes` codes with a delay, after those that fill what is under way.
  FlashLag flashes(double delay_s, int codes) {
    probe_.set_delay(delay_s);
    std::vector<double> light;
    const std::size_t length = kFlashCode.size();
    double first_s = 0.0;
    const std::size_t first = length - kMostUnderWay;
    for (std::size_t k = first; k < length * static_cast<std::size_t>(codes + 1); ++k) {
      const CompleteFrame taken = probe_.take(flash_, kFlashCode[k % length] ? 1 : 0);
      if (k < length) continue;
      if (k == length) first_s = taken.timestamp_s;
      light.push_back(lit_.share_of(taken.frame));
      found_.patterns_per_s =
          static_cast<double>(light.size() - 1) / std::max(taken.timestamp_s - first_s, 1e-9);
    }
    return flash_lag(light);
  }

  void find_latency() {
    probe_.set_skipped(0);
    const FlashLag slowest = flashes(kLongestDelay_s, 1);
    if (slowest.residual > kFollowed || std::abs(slowest.share) > least_share()) {
      fail_in_room(
          fmt::format("the camera does not follow the flashes of the display, even {} s "
                      "after each; show it the lit sheet, fix its exposure, and keep still",
                      kLongestDelay_s));
    }
    found_.late_frames = static_cast<int>(slowest.frames);
    if (slowest.frames > 0) {
      const std::optional<int> skipped = devices_.reference()->info().skip_frames;
      if (slowest.frames > kMostUnderWay || !skipped) {
        fail(fmt::format("{}: its frames are {} flashes late; correct its driver",
                         devices_.reference()->name(),
                         slowest.frames));
      }
      found_.skip_frames = *skipped + found_.late_frames;
      probe_.set_skipped(slowest.frames);
      found_.findings.push_back(
          fmt::format("frames are late by {}: the camera has them under way when it is asked; "
                      "skip_frames drops them",
                      slowest.frames));
    }
    const auto in_time = [&](const FlashLag& lag) {
      return lag.frames == 0 && lag.share < least_share() && lag.residual < kFollowed;
    };
    found_.latency_s = least_delay_s(in_time);
    // A display that shows a picture at its next refresh may take one more.
    const double refresh_s = 1e-3 * devices_.display->info().refresh_period_ms;
    double margin_s = std::max(0.001, 0.1 * refresh_s);
    constexpr int kTries = 4;
    for (int i = 0;; ++i, margin_s *= 3.0) {
      found_.delay_s = std::ceil(1e3 * (found_.latency_s + margin_s)) / 1e3;
      if (in_time(flashes(found_.delay_s, 3))) break;
      if (i == kTries) {
        fail_in_room(
            "the latency of display and camera changes from flash to flash; switch off the image "
            "enhancement of the projector, and all that is automatic in the camera");
      }
    }
  }

  /// Halves the interval of delays. Where an exposure saw both pictures, its share of the one
  /// before tells how much longer it has to wait.
  double least_delay_s(const std::function<bool(const FlashLag&)>& in_time) {
    constexpr double kResolution_s = 0.0005;
    double late_s = 0.0;
    double good_s = kLongestDelay_s;
    double next_s = 0.0;
    bool told = false;
    while (good_s - late_s > kResolution_s) {
      const FlashLag lag = flashes(next_s, 1);
      const bool good = in_time(lag);
      (good ? good_s : late_s) = next_s;
      const double told_s = next_s + 1e-3 * found_.exposure_ms * lag.share + 0.5 * kResolution_s;
      if (good && told) break;
      told = !good && lag.frames == 0 && lag.share > least_share() && lag.residual < kFollowed &&
             told_s < good_s;
      next_s = told ? told_s : 0.5 * (late_s + good_s);
    }
    return good_s;
  }

  void find_response() {
    constexpr double kMostFlicker = 0.005;  // of the full light: as much as the noise of a ramp
    if (flicker_of_frames() > kMostFlicker) {
      found_.findings.push_back(fmt::format(
          "the response was not measured, as the light of the room flickers in the frames "
          "by {:.1f} % of the display's light; darken the room and measure again",
          100.0 * flicker_of_frames()));
      return;
    }
    constexpr int kLevels = 17;
    Pattern ramp{.name = "ramp", .kind = PatternKind::Ramp};
    for (int i = 0; i < kLevels; ++i)
      ramp.levels.push_back(static_cast<double>(i) / (kLevels - 1));
    const FrameStack stack = probe_.stack_of(ramp);
    const ResponseCurve left = measure_response({&stack, 1});
    const auto& known = rig_.projector.response;
    found_.response = known ? compose(*known, left) : left;
  }

  void find_frame_rate() {
    constexpr int kFrames = 6;
    const double first_s = probe_.again(flash_.name).timestamp_s;
    double last_s = first_s;
    for (int i = 1; i < kFrames; ++i)
      last_s = probe_.again(flash_.name).timestamp_s;
    const double frames = (kFrames - 1) * (1.0 + found_.late_frames);  // with those it drops
    if (last_s > first_s) found_.camera_fps = frames / (last_s - first_s);
  }

  /// Contrast of fine fringes over that of coarse ones, which no blur reaches.
  void find_sharpness() {
    constexpr double kFine_px = 12.0;
    constexpr double kCoarse_px = 120.0;
    constexpr double kSoft = 0.4;
    const std::vector<double> fine = modulations(kFine_px);
    const std::vector<double> coarse = modulations(kCoarse_px);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < fine.size(); ++i)
      if (coarse[i] > 0.5 * kMinContrast * rig_.reference().white_level)
        ratios.push_back(fine[i] / coarse[i]);
    if (ratios.size() < kMinLit) fail("coarse fringes are not seen; give the display more light");
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    found_.sharpness = std::min(*middle, 1.0);
    if (found_.sharpness < kSoft) {
      found_.findings.push_back(
          fmt::format("fringes of {} px keep {:.0f} % of their contrast; focus the projector, then "
                      "the camera",
                      kFine_px,
                      100.0 * found_.sharpness));
    }
  }

  void judge_black() {
    constexpr double kMostZeros = 0.05;
    if (found_.dark_zeros <= kMostZeros) return;
    found_.findings.push_back(fmt::format(
        "{:.0f} % of the lit pixels have 0 counts in the dark, where noise is cut off; raise "
        "the camera's level of black",
        100.0 * found_.dark_zeros));
  }

  /// Amplitude of fringes at each pixel, counts.
  std::vector<double> modulations(double period_px) {
    Pattern pattern{.name = fmt::format("fringes-{}", period_px)};
    pattern.period_px = period_px;
    pattern.shifts_rad = {0.0, kPi / 2.0, kPi, 1.5 * kPi};
    const FrameStack stack = probe_.stack_of(pattern);
    const auto at = [&](std::size_t i, int x, int y) {
      return static_cast<double>(counts_at(stack.frames[i], x, y));
    };
    std::vector<double> out;
    for (int y = 0; y < height_of(stack.frames[0]); ++y)
      for (int x = 0; x < width_of(stack.frames[0]); ++x)
        out.push_back(0.5 * std::hypot(at(0, x, y) - at(2, x, y), at(1, x, y) - at(3, x, y)));
    return out;
  }

  RigDevices& devices_;
  const Rig& rig_;
  const Run& run_;
  DisplayProbe probe_;
  Pattern flash_ = dark_and_bright();
  LitPixels lit_;
  double room_hz_ = 0.0;  ///< of the flicker of the room's light
  DisplayMeasurement found_;
};

}  // namespace

DisplayMeasurement measure_display(RigDevices& devices,
                                   const Rig& rig,
                                   const CaptureOptions& options,
                                   const Run& run) {
  require(devices.reference() != nullptr && devices.display,
          "measuring a display needs [devices.camera] and a digital projector in "
          "[devices.fringes]; add them to rig.toml");
  const SafeStateGuard safe(devices);
  return Measurer(devices, rig, options, run).measure();
}

}  // namespace frangia
