#include "frangia/phase/gray/internal/gray_trials.h"

#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/pattern/gray_code.h"

namespace frangia {
namespace {

void add_code_trials(const Pattern& code, std::vector<GrayTrial>& out) {
  for (const bool other_order : {false, true}) {
    for (const bool other_code : {false, true}) {
      if (!other_order && !other_code) continue;
      GrayTrial trial = declared_trial(code);
      std::vector<std::string> keys;
      if (other_order) {
        const bool msb = code.order == BitOrder::MostSignificantFirst;
        trial.code.order = msb ? BitOrder::LeastSignificantFirst : BitOrder::MostSignificantFirst;
        keys.emplace_back(msb ? "order = \"lsb-first\"" : "order = \"msb-first\"");
      }
      if (other_code) {
        trial.code.is_binary = !code.is_binary;
        keys.emplace_back(code.is_binary ? "code = \"gray\"" : "code = \"binary\"");
      }
      trial.fault.kind = other_order ? SequenceFaultKind::Order : SequenceFaultKind::Code;
      trial.fault.what = other_order ? "its bits in the opposite order" : "the other code";
      trial.fault.keys = keys.front() + (keys.size() > 1 ? ", " + keys.back() : "");
      out.push_back(std::move(trial));
    }
  }
  if (code.inverted == InvertedFrames::None) return;
  const bool after = code.inverted == InvertedFrames::After;
  GrayTrial trial = declared_trial(code);
  trial.code.inverted = after ? InvertedFrames::Alternating : InvertedFrames::After;
  trial.fault.kind = SequenceFaultKind::Order;
  trial.fault.what = after ? "inverted frames that alternate" : "inverted frames after the others";
  trial.fault.keys = after ? "inverted = \"alternating\"" : "inverted = \"after\"";
  out.push_back(std::move(trial));
}

void add_frame_trials(const Pattern& code, std::vector<GrayTrial>& out) {
  const GrayTrial declared = declared_trial(code);
  const std::size_t frames = declared.frame_of.size();
  for (std::size_t a = 0; a < frames; ++a) {
    for (std::size_t b = a + 1; b < frames; ++b) {
      GrayTrial trial = declared;
      std::swap(trial.frame_of[a], trial.frame_of[b]);
      trial.fault.kind = SequenceFaultKind::Order;
      trial.fault.what = fmt::format("frames {} and {} exchanged", a, b);
      trial.fault.keys = fmt::format("exchange {0}-{1}.png and {0}-{2}.png", code.name, a, b);
      out.push_back(std::move(trial));
    }
    GrayTrial trial = declared;
    trial.inverted[a] = true;
    trial.fault.kind = SequenceFaultKind::Inversion;
    trial.fault.what = fmt::format("frame {} inverted", a);
    trial.fault.keys = fmt::format("invert {}-{}.png", code.name, a);
    out.push_back(std::move(trial));
  }
  GrayTrial trial = declared;
  trial.inverted.assign(frames, true);
  trial.fault.kind = SequenceFaultKind::Inversion;
  trial.fault.what = "all frames inverted";
  trial.fault.keys = "invert all frames";
  out.push_back(std::move(trial));
}

void add_fringe_trials(const Pattern& code, const Pattern& fringes, std::vector<GrayTrial>& out) {
  const double declared_deg = deg_from_rad(fringes.shifts_rad.front());
  for (const bool reversed : {false, true}) {
    for (const double start_deg : {0.0, 90.0, 180.0, 270.0}) {
      if (!reversed && start_deg == 0.0) continue;
      GrayTrial trial = declared_trial(code, fringes);
      trial.start_rad = rad_from_deg(start_deg);
      trial.reversed = reversed;
      trial.fault.patterns = {fringes.name};
      trial.fault.kind = reversed ? SequenceFaultKind::Direction : SequenceFaultKind::Start;
      const std::string start = fmt::format("a start of {:g} degrees, not {:g} degrees",
                                            std::fmod(declared_deg + start_deg, 360.0),
                                            declared_deg);
      trial.fault.what = reversed ? "shifts in the opposite direction" : start;
      if (reversed && start_deg != 0.0) trial.fault.what += " and " + start;
      trial.fault.keys = "by the Gray code";
      for (const double shift : fringes.shifts_rad)
        trial.fault.shifts_rad.push_back(reversed ? trial.start_rad - shift
                                                  : trial.start_rad + shift);
      out.push_back(std::move(trial));
    }
  }
}

}  // namespace

GrayTrial declared_trial(const Pattern& code) {
  GrayTrial trial;
  trial.fault.patterns = {code.name};
  trial.code = code;
  trial.frame_of.resize(static_cast<std::size_t>(code.frame_count()));
  std::iota(trial.frame_of.begin(), trial.frame_of.end(), std::size_t{0});
  trial.inverted.assign(trial.frame_of.size(), false);
  return trial;
}

GrayTrial declared_trial(const Pattern& code, const Pattern& fringes) {
  GrayTrial trial = declared_trial(code);
  trial.period_px = fringes.period_px;
  return trial;
}

std::vector<GrayTrial> code_trials(const Pattern& code) {
  std::vector<GrayTrial> trials;
  add_code_trials(code, trials);
  add_frame_trials(code, trials);
  return trials;
}

std::vector<GrayTrial> gray_trials(const Pattern& code, const Pattern& fringes) {
  std::vector<GrayTrial> trials = code_trials(code);
  for (GrayTrial& trial : trials)
    trial.period_px = fringes.period_px;
  add_fringe_trials(code, fringes, trials);
  return trials;
}

std::uint32_t shown_stripe(const GrayTrial& trial, std::uint64_t bright) {
  std::uint32_t code = 0;
  for (int bit = 0; bit < trial.code.bits; ++bit) {
    const auto declared = static_cast<std::size_t>(frame_of_bit(trial.code, bit, false));
    const std::size_t frame = trial.frame_of[declared];
    const bool is_bright = ((bright >> frame & 1U) != 0) != trial.inverted[frame];
    code = 2 * code + (is_bright ? 1U : 0U);
  }
  return stripe_of_code(trial.code, code);
}

}  // namespace frangia
