#include "frangia/decode/explain/hypothesis_table.h"

#include <algorithm>
#include <map>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/frame_hypothesis.h"

namespace frangia {
namespace {

constexpr double kSomeGain = 0.7;  // any gain that is not 1

/// The hypotheses about equal steps, "unexplained" among them, with gains that differ from 1.
std::vector<FrameHypothesis> hypotheses_of(int steps) {
  Pattern pattern;
  for (int k = 0; k < steps; ++k)
    pattern.shifts_rad.push_back(kTwoPi * k / steps);
  std::vector<FrameHypothesis> all = frame_hypotheses(pattern);
  for (FrameHypothesis& one : all) {
    if (one.cause == FrameCause::Gain) one.gains[one.frames.front()] = kSomeGain;
    if (one.cause == FrameCause::Exposure) {
      double gain = 1.0;
      for (double& each : one.gains)
        each = gain *= kSomeGain;
    }
  }
  all.push_back(all.front());
  all.back().cause = FrameCause::Unexplained;
  return all;
}

struct Words {
  FrameCause cause;
  const char* model;
  const char* consequence;
};

std::vector<Words> words() {
  return {
      {FrameCause::AsDescribed, "delta_k of scan.toml, g_k = 1, L_k = 0", "all frames are used"},
      {FrameCause::Lost,
       "frame k shows no fringes: black, white, something else",
       "the frame is left out"},
      {FrameCause::Covered,
       "one frame, two that follow each other, or any show something else in a part of the image",
       "the frame or these pixels are left out"},
      {FrameCause::Displaced,
       "the image of frame k is displaced as a whole",
       "the frame is left out, else the view"},
      {FrameCause::Repeated, "frame k shows delta_(k-1)", "the frame is left out"},
      {FrameCause::Gain,
       "g_k differs by more than 10 %; the light of the room does not",
       "the frame is left out"},
      {FrameCause::Exposure,
       "g_k of two frames or more differ by more than 10 %",
       "the view is left out"},
      {FrameCause::Lamp,
       "L_k from frame j on, or in frame k alone",
       "the smaller part is left out"},
      {FrameCause::Moved,
       "frames from j on, or all, are displaced: image, and phase from place to place",
       "the view is left out"},
      {FrameCause::Steps,
       "delta_k + an error of each frame, of those from j on, or of all by one factor",
       "`accept_remedy` decodes with these shifts"},
      {FrameCause::Late, "frames from j on show delta_(k-1)", "`accept_remedy` likewise"},
      {FrameCause::Exchanged, "delta_i and delta_k exchanged", "`accept_remedy` likewise"},
      {FrameCause::Sorted,
       "delta of the frames in the alphabetical order of their numbers",
       "`accept_remedy` likewise"},
      {FrameCause::Start, "delta_k + a constant", "decided by other patterns"},
      {FrameCause::Direction, "-delta_k", "decided by other patterns"},
      {FrameCause::Unexplained, "as described, with a broad density", "what is left is in sigma"},
  };
}

}  // namespace

std::vector<int> tabulated_steps() {
  return {3, 4, 5, 6, 8, 12};
}

std::vector<CauseRow> hypothesis_table() {
  std::vector<CauseRow> rows;
  for (const Words& one : words())
    rows.push_back({name_of(one.cause), one.model, one.consequence, {}});
  for (const int steps : tabulated_steps()) {
    std::map<std::string, std::size_t> counts;
    for (const FrameHypothesis& hypothesis : hypotheses_of(steps))
      ++counts[name_of(hypothesis.cause)];
    for (CauseRow& row : rows)
      row.counts.push_back(counts[row.cause]);
  }
  return rows;
}

std::vector<AlikeCauses> alike_causes() {
  std::vector<AlikeCauses> out;
  for (const int steps : tabulated_steps()) {
    const std::vector<FrameHypothesis> all = hypotheses_of(steps);
    std::vector<std::vector<std::size_t>> classes;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto same = std::find_if(classes.begin(), classes.end(), [&](const auto& one) {
        return predict_alike(all[one.front()], all[i]);
      });
      if (same == classes.end())
        classes.push_back({i});
      else
        same->push_back(i);
    }
    std::map<std::vector<std::string>, std::size_t> by_causes;
    for (const auto& alike : classes) {
      if (alike.size() < 2) continue;
      std::vector<std::string> causes;
      for (const std::size_t i : alike)
        causes.push_back(name_of(all[i].cause));
      std::sort(causes.begin(), causes.end());
      causes.erase(std::unique(causes.begin(), causes.end()), causes.end());
      ++by_causes[causes];
    }
    for (const auto& [causes, count] : by_causes)
      out.push_back({steps, causes, count});
  }
  return out;
}

}  // namespace frangia
