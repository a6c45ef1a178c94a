#include "frangia/decode/explain/frame_hypothesis.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/internal/frame_design.h"

namespace frangia {
namespace {

/// Frames from which a lamp that stays on differs from harmonics.
constexpr std::size_t kMinFramesOfLamp = 5;

/// Frames from which a movement and uneven steps leave a residual, of which an angular projector,
/// whose steps are estimated, needs one more.
std::size_t min_frames_of_steps(const Pattern& pattern) {
  return pattern.fringes_per_degree == 0.0 ? 4 : 5;
}

FrameHypothesis as_described(const Pattern& pattern) {
  const std::size_t frames = pattern.shifts_rad.size();
  return {.frames = {},
          .shifts_rad = pattern.shifts_rad,
          .gains = std::vector<double>(frames, 1.0),
          .free = std::vector<bool>(frames, false),
          .lamp_on = {},
          .displaced = {},
          .path = {}};
}

/// The numbers of the frames, from `first` on, in alphabetical order, less `first`.
std::vector<std::size_t> alphabetical(std::size_t frames, std::size_t first) {
  std::vector<std::size_t> out(frames);
  std::iota(out.begin(), out.end(), 0);
  std::sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) {
    return std::to_string(a + first) < std::to_string(b + first);
  });
  return out;
}

/// "frame 2", "frames 2 and 3", "some frames".
std::string words_of(const std::vector<std::size_t>& frames) {
  if (frames.empty()) return "some frames";
  if (frames.size() == 1) return fmt::format("frame {}", frames.front());
  return fmt::format("frames {}", fmt::join(frames, " and "));
}

std::string clause_of(FrameCause cause, std::size_t frame, const FrameHypothesis& all) {
  switch (cause) {
    case FrameCause::Lost:
      if (all.in_part)
        return fmt::format("frame {} shows no fringes in {:.0f} % of the lit part of the image",
                           frame,
                           100.0 * all.part);
      return fmt::format("frame {} shows no fringes", frame);
    case FrameCause::Repeated:
      return fmt::format("frame {} repeats frame {}", frame, frame - 1);
    case FrameCause::Late:
      return fmt::format("the frames from {} on are late by one", frame);
    case FrameCause::Gain:
      return fmt::format("frame {} has {:.2f} times the light", frame, all.gains[frame]);
    case FrameCause::Lamp:
      if (all.lamp_off == frame + 1) return fmt::format("another lamp lit frame {} alone", frame);
      return fmt::format("another lamp was switched on or off before frame {}", frame);
    case FrameCause::Moved:
      return frame == 0 ? "the part moved while the frames were taken"
                        : fmt::format("the part moved before frame {}", frame);
    case FrameCause::Steps:
      if (frame == 0)
        return all.has_free_steps
                   ? "the shifts differ from those of scan.toml, or all that is seen moved in depth"
                   : "the steps differ from those of scan.toml by one factor, or all that is seen "
                     "moved evenly in depth";
      return fmt::format(
          "the shifts from frame {} on differ from those of scan.toml, "
          "or all that is seen moved before it",
          frame);
    case FrameCause::Start:
      return "the shifts begin elsewhere";
    case FrameCause::Direction:
      return "the shifts run in the opposite direction";
    case FrameCause::Covered:
    case FrameCause::Displaced:
    case FrameCause::Exchanged:
    case FrameCause::Sorted:
    case FrameCause::Exposure:
    case FrameCause::AsDescribed:
    case FrameCause::Unexplained:
      break;
  }
  return {};
}

}  // namespace

std::string name_of(FrameCause cause) {
  switch (cause) {
    case FrameCause::AsDescribed:
      return "as-described";
    case FrameCause::Lost:
      return "lost";
    case FrameCause::Covered:
      return "covered";
    case FrameCause::Displaced:
      return "displaced";
    case FrameCause::Repeated:
      return "repeated";
    case FrameCause::Exchanged:
      return "exchanged";
    case FrameCause::Sorted:
      return "sorted";
    case FrameCause::Late:
      return "late";
    case FrameCause::Gain:
      return "gain";
    case FrameCause::Exposure:
      return "exposure";
    case FrameCause::Lamp:
      return "lamp";
    case FrameCause::Moved:
      return "moved";
    case FrameCause::Steps:
      return "steps";
    case FrameCause::Start:
      return "start";
    case FrameCause::Direction:
      return "direction";
    case FrameCause::Unexplained:
      break;
  }
  return "unexplained";
}

std::vector<FrameHypothesis> frame_hypotheses(const Pattern& pattern) {
  const FrameHypothesis declared = as_described(pattern);
  const std::size_t frames = pattern.shifts_rad.size();
  std::vector<FrameHypothesis> out{declared};
  const auto add = [&](FrameCause cause, std::size_t frame, int parameters, std::size_t choices) {
    FrameHypothesis one = declared;
    one.cause = cause;
    one.frames = {frame};
    one.faults = 1;
    one.parameters = parameters;
    one.choices = choices;
    out.push_back(std::move(one));
  };
  add(FrameCause::Covered, 0, 1, 1);
  out.back().frames.clear();
  out.back().in_part = true;
  for (std::size_t k = 0; k < frames; ++k) {
    add(FrameCause::Lost, k, 2, frames);
    out.back().free[k] = true;
    if (frames > 3) {
      for (const std::size_t last : {k, k + 1}) {  // a hand may be in two frames
        if (last == frames) continue;
        add(FrameCause::Covered, k, 1, 2 * frames - 1);
        out.back().in_part = true;
        if (last > k) out.back().frames.push_back(last);
      }
      add(FrameCause::Displaced, k, 0, frames);
      out.back().displaced = {k};
    }
    if (frames > 3) {
      add(FrameCause::Lamp, k, 0, frames);
      out.back().lamp_on = k;
      out.back().lamp_off = k + 1;
    }
    if (frames > 3) add(FrameCause::Gain, k, 1, frames);
    if (frames >= kMinFramesOfLamp) {  // the light of the room keeps its power
      out.back().lamp_on = k;
      out.back().lamp_off = k + 1;
    }
    if (k == 0) continue;
    add(FrameCause::Repeated, k, 0, frames - 1);
    out.back().shifts_rad[k] = declared.shifts_rad[k - 1];
    if (k + 1 == frames) continue;  // from the last frame on it is a repeated frame
    add(FrameCause::Late, k, 0, frames - 2);
    for (std::size_t l = k; l < frames; ++l)
      out.back().shifts_rad[l] = declared.shifts_rad[l - 1];
    if (frames >= min_frames_of_steps(pattern)) {
      std::vector<double> path(frames, 0.0);
      std::fill(path.begin() + static_cast<std::ptrdiff_t>(k), path.end(), 1.0);
      for (const FrameCause cause : {FrameCause::Steps, FrameCause::Moved, FrameCause::Moved}) {
        const bool again = cause == out.back().cause;  // all that is seen instead of the part
        add(cause, k, 0, frames - 2);
        out.back().path = path;
        out.back().moves_part = cause == FrameCause::Moved && !again;
        out.back().moves_image = again;
      }
    }
    if (frames < kMinFramesOfLamp || k < 2) continue;
    add(FrameCause::Lamp, k, 0, frames - 3);
    out.back().lamp_on = k;
  }
  if (frames >= min_frames_of_steps(pattern)) {
    add(FrameCause::Steps, 0, 0, 1);
    out.back().has_free_steps = true;
    out.back().frames.clear();
    std::vector<double> evenly;
    for (std::size_t k = 0; k < frames; ++k)
      evenly.push_back(static_cast<double>(k) / static_cast<double>(frames - 1));
    add(FrameCause::Steps, 0, 0, 1);  // each by the same factor
    out.back().frames.clear();
    out.back().path = evenly;
    add(FrameCause::Moved, 0, 0, 1);  // all the time
    out.back().frames.clear();
    out.back().moves_part = true;
    out.back().path = evenly;
    add(FrameCause::Moved, 0, 0, 1);  // all that is seen, anyhow
    out.back().frames.clear();
    for (std::size_t k = 0; k < frames; ++k)
      out.back().displaced.push_back(k);
  }
  if (frames > 3) {
    add(FrameCause::Exposure, 0, static_cast<int>(frames) - 1, 1);
    out.back().frames.clear();
  }
  add(FrameCause::Start, 0, 1, 1);
  add(FrameCause::Direction, 0, 0, 1);
  for (double& shift : out.back().shifts_rad)
    shift = -shift;
  for (double& shift : (out.end() - 2)->shifts_rad)
    shift += kPi;
  for (std::size_t i = 0; i < frames; ++i) {
    for (std::size_t k = i + 1; k < frames; ++k) {
      add(FrameCause::Exchanged, i, 0, frames * (frames - 1) / 2);
      out.back().frames.push_back(k);
      std::swap(out.back().shifts_rad[i], out.back().shifts_rad[k]);
    }
  }
  for (const std::size_t first : {0U, 1U}) {
    const std::vector<std::size_t> order = alphabetical(frames, first);
    if (std::is_sorted(order.begin(), order.end())) continue;  // numbers of one digit
    add(FrameCause::Sorted, 0, 0, 2);
    out.back().frames.clear();
    for (std::size_t k = 0; k < frames; ++k)
      out.back().shifts_rad[k] = declared.shifts_rad[order[k]];
  }
  return out;
}

std::optional<FrameHypothesis> both_of(const FrameHypothesis& a, const FrameHypothesis& b) {
  const bool common = std::any_of(a.frames.begin(), a.frames.end(), [&](std::size_t frame) {
    return std::find(b.frames.begin(), b.frames.end(), frame) != b.frames.end();
  });
  const auto ordered = [](const FrameHypothesis& one) {
    return one.cause == FrameCause::Late || one.cause == FrameCause::Exchanged;
  };
  // The order of what is late and exchanged would matter.
  if (common || (ordered(a) && ordered(b))) return std::nullopt;
  for (const FrameHypothesis* one : {&a, &b})
    if (one->lamp_on || !one->path.empty() || one->has_free_steps || one->in_part ||
        !one->displaced.empty() || one->cause == FrameCause::Exposure ||
        one->cause == FrameCause::Sorted)
      return std::nullopt;
  FrameHypothesis out = ordered(b) ? b : a;
  const FrameHypothesis& other = ordered(b) ? a : b;
  out.frames.insert(out.frames.end(), other.frames.begin(), other.frames.end());
  for (const std::size_t k : other.frames) {
    if (other.cause == FrameCause::Repeated) out.shifts_rad[k] = out.shifts_rad[k - 1];
    out.gains[k] = other.gains[k];
    out.free[k] = other.free[k];
  }
  out.faults += other.faults;
  out.parameters += other.parameters;
  out.choices *= other.choices;
  return out;
}

std::string describe(const FrameHypothesis& hypothesis) {
  switch (hypothesis.cause) {
    case FrameCause::AsDescribed:
      return "the frames are as described";
    case FrameCause::Unexplained:
      return "the frames differ from fringes of these shifts, and no known cause explains it";
    case FrameCause::Covered:
      return fmt::format("{:.0f} % of the lit part of the image is covered or lost in {}",
                         100.0 * hypothesis.part,
                         words_of(hypothesis.frames));
    case FrameCause::Displaced:
      return fmt::format(
          "frame {} is displaced by {:.1f} px against the others, as where the camera or all that "
          "is seen shook",
          hypothesis.frames.front(),
          hypothesis.displacement_px);
    case FrameCause::Exchanged: {
      std::string text =
          fmt::format("frames {} and {} are exchanged", hypothesis.frames[0], hypothesis.frames[1]);
      for (std::size_t i = 2; i < hypothesis.frames.size(); ++i)
        text += fmt::format(", and frame {} differs, too", hypothesis.frames[i]);
      return text;
    }
    case FrameCause::Sorted:
      return "the frames are in the alphabetical order of their numbers, 10 before 2";
    case FrameCause::Exposure: {
      const auto [least, most] =
          std::minmax_element(hypothesis.gains.begin(), hypothesis.gains.end());
      return fmt::format(
          "the light differs from frame to frame, from {:.2f} to {:.2f} of its middle, as where "
          "the camera sets its exposure by itself",
          *least,
          *most);
    }
    default:
      break;
  }
  const std::size_t first = hypothesis.frames.empty() ? 0 : hypothesis.frames.front();
  std::string text = clause_of(hypothesis.cause, first, hypothesis);
  for (std::size_t i = 1; i < hypothesis.frames.size(); ++i) {
    const std::size_t frame = hypothesis.frames[i];
    const FrameCause cause = hypothesis.free[frame]           ? FrameCause::Lost
                             : hypothesis.gains[frame] != 1.0 ? FrameCause::Gain
                                                              : FrameCause::Repeated;
    text += ", and " + clause_of(cause, frame, hypothesis);
  }
  return text;
}

std::optional<std::size_t> displaced_alone(const FrameHypothesis& hypothesis) {
  if (hypothesis.displaced.size() == 1) return hypothesis.displaced.front();
  if (hypothesis.cause != FrameCause::Moved || hypothesis.frames.size() != 1) return std::nullopt;
  const std::size_t last = hypothesis.shifts_rad.size() - 1;
  if (hypothesis.frames.front() == 1) return 0;
  if (hypothesis.frames.front() == last) return last;
  return std::nullopt;
}

bool is_lit_by_lamp(const FrameHypothesis& hypothesis, std::size_t frame) {
  return hypothesis.lamp_on && frame >= *hypothesis.lamp_on && frame < hypothesis.lamp_off;
}

bool predict_alike(const FrameHypothesis& a, const FrameHypothesis& b) {
  const std::optional<std::size_t> alone = displaced_alone(a);
  if (alone && alone == displaced_alone(b)) return true;
  if (a.in_part != b.in_part || (a.in_part && a.frames != b.frames) || a.displaced != b.displaced)
    return false;
  if (a.free != b.free || a.path != b.path || a.moves_part != b.moves_part ||
      a.moves_image != b.moves_image || a.has_free_steps != b.has_free_steps ||
      a.lamp_on.has_value() != b.lamp_on.has_value() ||
      (a.lamp_on && (a.cause == FrameCause::Gain) != (b.cause == FrameCause::Gain)) ||
      (a.cause == FrameCause::Unexplained) != (b.cause == FrameCause::Unexplained))
    return false;
  constexpr double kSame = 1e-6;
  return (explained_space(a) - explained_space(b)).cwiseAbs().maxCoeff() < kSame;
}

}  // namespace frangia
