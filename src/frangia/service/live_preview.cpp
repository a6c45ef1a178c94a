#include "frangia/service/live_preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/decode/check_view.h"
#include "frangia/decode/triangulate_view.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/waveform/assess_frames.h"
#include "frangia/phase/wrap/wrap_phase.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// Events a second over the last ones; forgets all but those of the last three seconds.
double rate_of(std::vector<std::chrono::steady_clock::time_point>& times,
               std::chrono::steady_clock::time_point now) {
  times.push_back(now);
  std::erase_if(times, [&](auto time) { return now - time > std::chrono::seconds(3); });
  if (times.size() < 2) return 0.0;
  const std::chrono::duration<double> span = times.back() - times.front();
  return static_cast<double>(times.size() - 1) / std::max(span.count(), 1e-6);
}

Pattern uniform_light(LivePattern wanted) {
  Pattern pattern;
  pattern.kind = wanted == LivePattern::White ? PatternKind::White : PatternKind::Ambient;
  pattern.name = wanted == LivePattern::White ? "white" : "dark";
  return pattern;
}

std::string finding_of(const DecodedView& view, const ViewFit& fit) {
  if (!fit.fits()) return fit.reason;
  for (const FrameAssessment& assessment : assessments_of(view)) {
    const auto found = findings(assessment);
    if (!found.empty() && needs_attention(assessment)) return found.front();
  }
  return {};
}

bool is_fringe(const FrameStack& stack) {
  return stack.pattern.kind == PatternKind::Fringe;
}

/// The wrapped map of the finest fringes, which two layers show.
WrappedPhase finest_map(std::span<const FrameStack> stacks,
                        const NoiseModel& noise,
                        const DecodeOptions& options) {
  const auto finer = [](const FrameStack& a, const FrameStack& b) {
    return is_fringe(b) &&
           (!is_fringe(a) || a.pattern.fringes_per_unit() < b.pattern.fringes_per_unit());
  };
  const FrameStack& finest = *std::max_element(stacks.begin(), stacks.end(), finer);
  if (!is_fringe(finest)) return {};
  const FittedAlgorithm fitted = fit_algorithm(options.algorithm, finest, noise);
  return wrap_phase(finest, fitted.algorithm, noise, options.wrap);
}

}  // namespace

LiveDecode decode_live(std::span<const FrameStack> stacks,
                       const Rig& rig,
                       const Image<Eigen::Vector2f>& rays,
                       const LiveSettings& settings) {
  const auto begin = std::chrono::steady_clock::now();
  DecodeOptions options;
  options.algorithm = settings.capture.algorithm;
  // One pass over the frames where that is possible: their maps serve reports, not a preview.
  options.keep_maps = std::count_if(stacks.begin(), stacks.end(), is_fringe) < 2;
  LiveDecode decode;
  decode.angle_rad = settings.table_rad;
  decode.view = decode_view(stacks, rig, rays, options);
  DecodedDirection& leading = decode.view.directions.front();
  if (leading.wrapped.empty())
    leading.wrapped.push_back(finest_map(stacks, leading.noise, options));
  const ViewFit fit = check_view(decode.view, rig, rays, false);
  decode.finding = finding_of(decode.view, fit);
  if (fit.fits()) {
    decode.range = triangulate_view(decode.view, fit, rig, rays, DirectionChoice::Fused).range;
    const auto depths = decode.range.depth_mm.pixels();
    decode.points = static_cast<std::size_t>(std::count_if(
        depths.begin(), depths.end(), [](float depth) { return !std::isnan(depth); }));
  }
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
  decode.decode_ms = spent.count();
  return decode;
}

LivePreview::LivePreview(Rig rig, LiveSettings settings, std::function<void()> on_change)
    : rig_(std::move(rig)),
      calibrated_(has_geometry(rig_)),
      rays_(calibrated_ ? rays_of(rig_.reference().model) : Image<Eigen::Vector2f>()),
      on_change_(std::move(on_change)),
      settings_(std::move(settings)) {}

void LivePreview::set(const LiveSettings& settings) {
  const std::lock_guard lock(mutex_);
  settings_ = settings;
  changed_ = true;
}

LiveSettings LivePreview::settings() const {
  const std::lock_guard lock(mutex_);
  return settings_;
}

std::shared_ptr<const LiveSnapshot> LivePreview::snapshot() const {
  const std::lock_guard lock(mutex_);
  watched_ = Clock::now();
  return snapshot_;
}

std::optional<PreviewSettings> LivePreview::next_settings() {
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(changed_, false)) return std::nullopt;
    active_ = settings_;
  }
  PreviewSettings wanted;
  wanted.camera = active_.capture.camera;
  active_.capture.exposures_ms.clear();  // of the scan
  wanted.table_rad = active_.table_rad;
  wanted.patterns = active_.pattern == LivePattern::Fringes
                        ? patterns_of(active_.capture, rig_)
                        : std::vector<Pattern>{uniform_light(active_.pattern)};
  stacks_.clear();
  missing_ = 0;
  for (const Pattern& pattern : wanted.patterns) {
    FrameStack stack;
    stack.pattern = pattern;
    stack.frames.resize(static_cast<std::size_t>(pattern.frame_count()));
    missing_ += stack.frames.size();
    stacks_.push_back(std::move(stack));
  }
  return wanted;
}

void LivePreview::take(PreviewFrame captured, int white_level) {
  Frame& place = stacks_.at(captured.pattern).frames.at(static_cast<std::size_t>(captured.number));
  if (width_of(place) == 0) --missing_;
  place = captured.frame;
  auto next = std::make_shared<LiveSnapshot>();
  next->white_level = white_level;
  next->frame = std::make_shared<const Frame>(std::move(captured.frame));
  next->frames_per_s = rate_of(frame_times_, Clock::now());
  {
    const std::lock_guard lock(mutex_);
    next->revision = snapshot_ ? snapshot_->revision + 1 : 1;
    if (snapshot_ && captured.generation > 0 && active_.pattern == LivePattern::Fringes) {
      next->decode = snapshot_->decode;
      next->decodes_per_s = snapshot_->decodes_per_s;
    }
  }
  if (missing_ == 0 && active_.pattern == LivePattern::Fringes && calibrated_) {
    // Each frame replaces its predecessor, so that every one gives a new decoded view.
    for (FrameStack& stack : stacks_)
      stack.white_level = white_level;
    next->decode = std::make_shared<const LiveDecode>(decode_live(stacks_, rig_, rays_, active_));
    next->decodes_per_s = rate_of(decode_times_, Clock::now());
  }
  {
    const std::lock_guard lock(mutex_);
    snapshot_ = std::move(next);
  }
  on_change_();
}

void LivePreview::run(RigDevices& devices, const Run& run) {
  struct Unwatched {};
  {
    const std::lock_guard lock(mutex_);
    watched_ = Clock::now();
    changed_ = true;
  }
  const int white_level =
      devices.reference() != nullptr ? devices.reference()->info().white_level : 0;
  PreviewEvents events;
  events.next_settings = [this] {
    {
      const std::lock_guard lock(mutex_);
      if (Clock::now() - watched_ > kPatience) throw Unwatched();
    }
    return next_settings();
  };
  events.on_frame = [&](PreviewFrame frame) { take(std::move(frame), white_level); };
  try {
    preview(devices, rig_, events, run);
  } catch (const Unwatched&) {
    run.note("the preview ended because nobody watched it");
  }
}

}  // namespace frangia
