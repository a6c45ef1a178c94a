#include "frangia/acquisition/internal/view_assessor.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/decode/plan_decoding.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

constexpr const char* kGood = "good";
constexpr const char* kNothingMeasured = "nothing measured, check light and exposure";

/// The result in a few words, with the remedy.
std::string word_for(const FrameAssessment& frames, std::size_t points) {
  constexpr double kOverexposed = 0.02;
  constexpr double kLowContrast = 0.2;
  if (points == 0) return kNothingMeasured;
  if (frames.exceeds_noise)
    return "frames differ beyond their noise, check the mounting and the light";
  if (frames.saturated_fraction > kOverexposed)
    return "overexposed, shorten or bracket the exposure";
  if (frames.contrast < kLowContrast) return "low contrast, reduce ambient light";
  return kGood;
}

}  // namespace

ViewAssessor::ViewAssessor(const Scan& plan, const CaptureOptions& options, const Run& run)
    : plan_(plan),
      check_view_(options.check_view),
      on_view_(options.on_view),
      keep_(options.decoded),
      scan_(keep_ ? keep_->scan() : plan),
      run_(run) {
  if (has_geometry(scan_.rig)) rays_ = rays_of(scan_.rig.reference().model);
}

void ViewAssessor::begin(std::size_t view, std::vector<std::shared_ptr<const Frame>> frames) {
  report(true);
  if (keep_) keep_->forget(view);
  view_ = view;
  decoding_ = std::async(std::launch::async,
                         [this, view, all = std::move(frames)] { return decode(view, all); });
}

void ViewAssessor::report(bool wait) {
  if (!decoding_.valid()) return;
  if (!wait && decoding_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const Answer answer = decoding_.get();
  const std::string sentence = fmt::format("view {} of {} at {:.6g} degrees: {}",
                                           view_ + 1,
                                           plan_.views.size(),
                                           deg_from_rad(plan_.views[view_].angle_rad),
                                           answer.text);
  if (answer.good) {
    run_.note(sentence);
  } else {
    run_.warn(sentence);
  }
}

void ViewAssessor::pass_on(ViewAssessment& found) const {
  if (check_view_ && found.good && found.decoded != nullptr) {
    const std::string finding = check_view_(found);
    if (!finding.empty()) {
      found.verdict = finding;
      found.good = false;
    }
  }
  if (on_view_) on_view_(found);
}

ToldView ViewAssessor::decode_stacks(std::size_t view,
                                     const std::vector<FrameStack>& stacks) const {
  const DecodeOptions options = keep_ ? keep_->options() : DecodeOptions{};
  const DecodePlan plan = plan_decoding(scan_.patterns, scan_.rig, options);
  return decode_told(scan_, view, stacks, plan, rays_, options, run_.stop);
}

ViewAssessor::Answer ViewAssessor::decode(
    std::size_t view, const std::vector<std::shared_ptr<const Frame>>& frames) const {
  std::vector<FrameStack> stacks;
  std::size_t next = 0;
  for (const Pattern& pattern : scan_.patterns) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      FrameStack stack{pattern, {}, scan_.rig.reference().white_level, exposure};
      for (int frame = 0; frame < pattern.frame_count(); ++frame)
        stack.frames.push_back(*frames.at(next++));
      stacks.push_back(std::move(stack));
    }
  }
  ViewAssessment found;
  found.view = view;
  try {
    ToldView told = decode_stacks(view, stacks);
    const DecodedView& decoded = told.view;
    const DecodedDirection& leading = decoded.directions.front();
    const auto phase = leading.phase.phase_rad.pixels();
    found.points = static_cast<std::size_t>(
        std::count_if(phase.begin(), phase.end(), [](float value) { return !std::isnan(value); }));
    for (const UnresolvedRegion& region : leading.unresolved)
      found.points += region.pixel.size();
    found.decoded = &decoded;
    const std::vector<FrameAssessment> assessments = assessments_of(decoded);
    if (assessments.empty()) {  // Gray code alone has no fringes to assess
      found.verdict = found.points == 0 ? kNothingMeasured : kGood;
      found.good = found.points != 0;
      pass_on(found);
      if (keep_) keep_->put(view, std::move(told));
      return {fmt::format("{}: {} points", found.verdict, found.points), found.good};
    }
    const FrameAssessment& finest = assessments.back();
    found.verdict = word_for(finest, found.points);
    for (const DecodedDirection& direction : decoded.directions) {
      for (const FrameVerdict& verdict : direction.frames)
        if (!verdict.finding.empty()) found.verdict = verdict.finding + "; capture the view again";
    }
    found.good = found.verdict == kGood;
    found.contrast = finest.contrast;
    found.saturated_fraction = finest.saturated_fraction;
    pass_on(found);
    if (keep_) keep_->put(view, std::move(told));
    return {fmt::format("{}: contrast {:.2f}, {:.1f} % saturated, {} points",
                        found.verdict,
                        found.contrast,
                        100.0 * found.saturated_fraction,
                        found.points),
            found.good};
  } catch (const Error& error) {
    found.verdict = fmt::format("cannot be decoded: {}", error.what());
    found.decoded = nullptr;
    pass_on(found);
    return {found.verdict, false};
  }
}

}  // namespace frangia
