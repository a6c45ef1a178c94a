#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "frangia/decode/explain/explain_lag.h"
#include "frangia/decode/explain/internal/frame_priors.h"
#include "frangia/decode/explain/internal/frame_sequence.h"
#include "frangia/decode/select_stacks.h"
#include "frangia/diagnose/score.h"

namespace frangia {
namespace {

constexpr Eigen::Index kFewestTorn = 200;  ///< lit pixels
constexpr Eigen::Index kEdgePixels = 20;   ///< of a strip of rows at least
constexpr Eigen::Index kMostStrips = 32;   ///< of rows, between which the tear may be
/// RMS over the modulation of what blur, texture and harmonics leave of frames in step, and what
/// frames out of step leave at least.
constexpr double kRestOfSound = 0.03;
constexpr double kTorn = 0.1;
/// What the lag leaves of the mean square at most.
constexpr double kMostOfTorn = 0.25;

/// What the patterns leave as described and with each lag, in parts of the image.
class TornSequence {
 public:
  TornSequence(std::span<const FrameStack> stacks, const LitCounts& lit) : stacks_(stacks) {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(lit.rows_px.size()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return lit.rows_px(a) < lit.rows_px(b);
    });
    counts_ = lit.counts(order, Eigen::all);
    rows_px_ = lit.rows_px(order);
  }
  [[nodiscard]] Eigen::Index pixels() const { return counts_.rows(); }
  /// The row of the image between two pixels.
  [[nodiscard]] int row_px(Eigen::Index pixel) const {
    return static_cast<int>(std::lround(0.5 * (rows_px_(pixel - 1) + rows_px_(pixel))));
  }
  /// The misfit of the pixels from `begin` up to `end`; infinite where no patterns tell.
  [[nodiscard]] double misfit(int lag, Eigen::Index begin, Eigen::Index end) const {
    const Eigen::ArrayXXd part = counts_.middleRows(begin, end - begin);
    return misfit_of(fit_all(part, placed_at(stacks_, counts_.cols(), lag))).value_or(INFINITY);
  }

 private:
  std::span<const FrameStack> stacks_;
  Eigen::ArrayXXd counts_;
  Eigen::ArrayXd rows_px_;
};

/// The evidence of each strip of rows with a lag: Gaussian rests of unknown size.
std::vector<double> evidence_of_strips(const TornSequence& torn, int lag, Eigen::Index strips) {
  std::vector<double> out;
  for (Eigen::Index i = 0; i < strips; ++i) {
    const double misfit =
        torn.misfit(lag, i * torn.pixels() / strips, (i + 1) * torn.pixels() / strips);
    out.push_back(-0.5 * kFieldWitnesses / static_cast<double>(strips) *
                  std::log(misfit + kRestOfSound * kRestOfSound));
  }
  return out;
}

/// The most likely tear where the part above or below it has this lag.
std::optional<std::pair<FrameLag, ScoredHypothesis>> find_tear(const TornSequence& torn,
                                                               int frames,
                                                               bool above,
                                                               const std::vector<double>& in_step) {
  const Eigen::Index all = torn.pixels();
  const Eigen::Index strips = std::ssize(in_step);
  const std::vector<double> late = evidence_of_strips(torn, frames, strips);
  double evidence = std::accumulate(in_step.begin(), in_step.end(), 0.0);
  double most = evidence;
  Eigen::Index torn_strips = 0;
  for (Eigen::Index i = 0; i + 1 < strips; ++i) {  // from the edge that is out of step
    const auto strip = static_cast<std::size_t>(above ? i : strips - 1 - i);
    evidence += late[strip] - in_step[strip];
    if (evidence <= most) continue;
    most = evidence;
    torn_strips = i + 1;
  }
  if (torn_strips == 0) return std::nullopt;
  const Eigen::Index place = (above ? torn_strips : strips - torn_strips) * all / strips;
  const Eigen::Index begin = above ? 0 : place;
  const Eigen::Index end = above ? place : all;
  const double misfit = torn.misfit(frames, begin, end);
  const double rest = above ? torn.misfit(0, place, all) : torn.misfit(0, 0, place);
  if (rest > kTorn * kTorn ||
      misfit > std::min(kTorn * kTorn, kMostOfTorn * torn.misfit(0, begin, end)))
    return std::nullopt;
  const FrameLag lag{.frames = frames,
                     .part = above ? LagPart::Above : LagPart::Below,
                     .row_px = torn.row_px(place)};
  const double price =
      price_of_choice(2 * static_cast<std::size_t>(strips)) - std::log(kPriorFault);
  return std::pair{lag, ScoredHypothesis{describe(lag), most - price, std::sqrt(misfit)}};
}

}  // namespace

std::optional<FrameLag> explain_torn_frames(std::span<const FrameStack> stacks) {
  const auto fringes = std::count_if(stacks.begin(), stacks.end(), has_fringes);
  const std::vector<Shown> sequence = sequence_of(stacks);
  if (fringes < 2 || are_bracketed(stacks) || !are_alike(sequence)) return std::nullopt;
  const LitCounts lit = lit_counts(sequence);
  if (lit.counts.rows() < kFewestTorn) return std::nullopt;
  const TornSequence torn(stacks, lit);
  const Eigen::Index all = torn.pixels();
  const auto out_of_step = [&](Eigen::Index begin, Eigen::Index end) {
    return torn.misfit(0, begin, end) > kTorn * kTorn;
  };
  const Eigen::Index edge = std::max(kEdgePixels, all / kMostStrips);
  const bool above = out_of_step(0, edge);
  if (above == out_of_step(all - edge, all)) return std::nullopt;  // none, or all
  const std::vector<double> in_step =
      evidence_of_strips(torn, 0, std::min(kMostStrips, all / kEdgePixels));
  std::vector<FrameLag> lags{{}};
  std::vector<ScoredHypothesis> scored{
      {"the frames are as described", std::accumulate(in_step.begin(), in_step.end(), 0.0)}};
  for (const int frames : {1, -1}) {
    const auto tear = find_tear(torn, frames, above, in_step);
    if (!tear) continue;
    lags.push_back(tear->first);
    scored.push_back(tear->second);
    scored.back().prediction = lags.size() - 1;
  }
  if (lags.size() == 1) return std::nullopt;
  Explanation found = choose(scored);
  if (!found.is_decided() || found.likeliest == 0) return std::nullopt;
  FrameLag best = lags[found.likeliest];
  best.explanation = std::move(found);
  return best;
}

}  // namespace frangia
