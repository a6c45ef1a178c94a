#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "frangia/decode/explain/explain_lag.h"
#include "frangia/decode/explain/internal/frame_priors.h"
#include "frangia/decode/select_stacks.h"
#include "frangia/diagnose/score.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/gray/check_gray_code.h"
#include "frangia/phase/wrap/estimate_noise.h"
#include "frangia/phase/wrap/wrap_phase.h"

namespace frangia {
namespace {

/// Share of pixels and borders at which any code agrees with any fringes.
constexpr double kAgreesByChance = 0.5;

/// A Gray code some of whose frames are beyond the sequence. Without the last ones, it is one
/// without inverted frames, or of wider stripes. Nothing if what is left is no code.
std::optional<FrameStack> with_frames_left(FrameStack gray, int lag) {
  Pattern& code = gray.pattern;
  const int lacking = code.frame_count() - static_cast<int>(gray.frames.size());
  if (lacking == 0) return gray;
  if (lag < 0) return std::nullopt;  // it lacks the first ones
  if (code.inverted == InvertedFrames::After) {
    if (lacking > code.bits) return std::nullopt;
    code.inverted = InvertedFrames::None;
  } else {
    const int of_bit = code.inverted == InvertedFrames::Alternating ? 2 : 1;
    const int bits = (lacking + of_bit - 1) / of_bit;
    if (code.order != BitOrder::MostSignificantFirst || bits >= code.bits) return std::nullopt;
    code.bits -= bits;
    code.stripe_px = std::ldexp(code.stripe_px, bits);
  }
  gray.frames.resize(static_cast<std::size_t>(code.frame_count()));
  return gray;
}

/// How well a code agrees with the coarsest fringes.
struct CodeAgreement {
  double share = kAgreesByChance;
  bool consistent = false;
  /// Of what may be wrong with one pattern instead, over that of a lag; none without such a fault.
  std::optional<double> log_odds_of_fault{};
};

double evidence_of(double share) {
  return kFieldWitnesses * std::log(std::max(share, kAgreesByChance));
}

/// Log of the prior probability of a fault of one pattern, over that of a lag. A period is one of
/// many, and rarely far from the one that is declared.
double log_prior_of(const SequenceFault& fault) {
  constexpr double kPeriods = 100.0;
  constexpr double kSpread = 0.2;  // of the logarithm of the period
  if (fault.kind != SequenceFaultKind::Period) return 0.0;
  return -std::log(kPeriods) - 0.5 * std::pow(std::log(fault.scale) / kSpread, 2);
}

/// The same of stacks that were moved by a lag. Nothing for a direction without a code beside
/// fringes.
std::optional<CodeAgreement> agreement_of(std::span<const FrameStack> stacks,
                                          int lag,
                                          FringeDirection direction) {
  const auto fringes = fringes_of(stacks, direction);
  const auto gray = gray_of(stacks, direction);
  if (fringes.empty() || gray.empty()) return std::nullopt;
  const FrameStack& coarsest = *fringes.front();
  const std::optional<FrameStack> code = with_frames_left(gray.front(), lag);
  constexpr std::size_t kFewest = 3;
  if (!code || coarsest.frames.size() < kFewest) return CodeAgreement{};
  const WrappedPhase phase = wrap_phase(coarsest,
                                        least_squares(coarsest.pattern.shifts_rad),
                                        estimate_noise(std::span(&coarsest, 1)));
  const SequenceCheck check = check_gray_code(*code, phase);
  if (!check.decided) return CodeAgreement{};
  CodeAgreement out{std::max(check.agreement, kAgreesByChance), check.consistent};
  for (const SequenceFault& fault : check.fits)
    out.log_odds_of_fault =
        std::max(out.log_odds_of_fault.value_or(log_prior_of(fault)), log_prior_of(fault));
  if (out.log_odds_of_fault) *out.log_odds_of_fault += evidence_of(check.fitted_agreement);
  return out;
}

/// The same of all directions, by the worst of them.
std::optional<CodeAgreement> agreement_of(std::span<const FrameStack> stacks, int lag) {
  std::optional<CodeAgreement> out;
  for (const FringeDirection direction : {FringeDirection::Vertical, FringeDirection::Horizontal}) {
    const std::optional<CodeAgreement> one = agreement_of(stacks, lag, direction);
    if (!one) continue;
    if (!out) out = CodeAgreement{1.0, true};
    out->share = std::min(out->share, one->share);
    out->consistent = out->consistent && one->consistent;
    if (one->log_odds_of_fault)
      out->log_odds_of_fault =
          std::min(out->log_odds_of_fault.value_or(0.0), *one->log_odds_of_fault);
  }
  return out;
}

}  // namespace

std::optional<FrameLag> explain_lag_by_code(std::span<const FrameStack> stacks) {
  if (are_bracketed(stacks)) return std::nullopt;
  const std::optional<CodeAgreement> described = agreement_of(stacks, 0);
  if (!described || described->consistent) return std::nullopt;
  // Shares of pixels that are one smooth field each. What another order of the frames of one
  // pattern explains, a lag does not: it moves the code against the fringes.
  const double price = price_of_choice(kFrameLags.size()) - std::log(kPriorFault);
  std::vector<FrameLag> lags{{}};
  std::vector<ScoredHypothesis> scored{
      {"the frames are as described", evidence_of(described->share), 1.0 - described->share}};
  if (described->log_odds_of_fault) {
    lags.push_back({});
    scored.push_back({.text = "one pattern is not as described",
                      .log_evidence = *described->log_odds_of_fault - price,
                      .prediction = lags.size() - 1});
  }
  for (const int frames : kFrameLags) {
    const std::optional<CodeAgreement> moved = agreement_of(moved_by(stacks, frames), frames);
    if (!moved || !moved->consistent) continue;
    lags.push_back({frames});
    scored.push_back({describe(lags.back()),
                      evidence_of(moved->share) - price,
                      1.0 - moved->share,
                      {},
                      lags.size() - 1});
  }
  const Explanation found = choose(scored);
  if (!found.is_decided() || lags[found.likeliest].frames == 0) return std::nullopt;
  FrameLag best = lags[found.likeliest];
  best.explanation = found;
  return best;
}

}  // namespace frangia
