#include "frangia/decode/explain/internal/covered_part.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "frangia/decode/explain/internal/frame_design.h"
#include "frangia/decode/explain/internal/frame_priors.h"
#include "frangia/decode/explain/internal/log_densities.h"

namespace frangia {
namespace {

constexpr double kLeastPart = 0.03;   ///< of the blocks; less is depth edges
constexpr double kMostPart = 0.6;     ///< beyond it the rest is no evidence of sound frames
constexpr double kMostOfKnown = 0.9;  ///< the same where other patterns tell which are sound
constexpr double kLostFrame = 0.2;    ///< part beyond which a frame counts as lost
constexpr double kWitnesses = 2.0;    ///< that the pixels of a block are at least
constexpr std::size_t kNearest = 6;   ///< blocks around one that tell what it is
constexpr std::size_t kFewest = 4;    ///< blocks of a part
constexpr int kLabelRounds = 5;

/// Pixels `begin` to `end` of a sample.
struct Block {
  Eigen::Index begin = 0;
  Eigen::Index end = 0;

  [[nodiscard]] Eigen::Index size() const { return end - begin; }
};

std::vector<Block> blocks_of(const FrameSample& sample) {
  std::vector<Block> out;
  for (std::size_t i = 0; i < sample.blocks.size(); ++i) {
    if (i == 0 || sample.blocks[i] != sample.blocks[i - 1])
      out.push_back({static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)});
    ++out.back().end;
  }
  return out;
}

/// The nearest blocks of each block.
std::vector<std::vector<std::size_t>> neighbours_of(const FrameSample& sample,
                                                    const std::vector<Block>& blocks) {
  std::vector<std::vector<std::size_t>> out;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      if (k == i) continue;
      const double x = sample.x(blocks[k].begin) - sample.x(blocks[i].begin);
      const double y = sample.y(blocks[k].begin) - sample.y(blocks[i].begin);
      others.emplace_back(x * x + y * y, k);
    }
    std::sort(others.begin(), others.end());
    others.resize(std::min(others.size(), kNearest));
    out.emplace_back();
    for (const auto& [distance, k] : others)
      out.back().push_back(k);
  }
  return out;
}

/// Which blocks are covered.
class Labels {
 public:
  Labels(const FrameSample& sample, std::vector<Block> blocks)
      : blocks_(std::move(blocks)),
        neighbours_(neighbours_of(sample, blocks_)),
        covered_(blocks_.size(), false),
        pixels_(sample.counts.rows()) {}

  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }
  [[nodiscard]] bool is_covered(std::size_t block) const { return covered_[block]; }
  void set(std::vector<bool> covered) { covered_ = std::move(covered); }

  /// Log probability of a block's label by those of its neighbours.
  [[nodiscard]] double log_probability(std::size_t block, bool covered) const {
    double alike = 0.5;
    for (const std::size_t one : neighbours_[block])
      alike += covered_[one] == covered ? 1.0 : 0.0;
    return std::log(alike / (static_cast<double>(neighbours_[block].size()) + 1.0));
  }
  /// 1 for the pixels of blocks that are not covered.
  [[nodiscard]] Eigen::ArrayXd counted() const {
    Eigen::ArrayXd out = Eigen::ArrayXd::Ones(pixels_);
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      if (covered_[b]) out.segment(blocks_[b].begin, blocks_[b].size()).setZero();
    return out;
  }

 private:
  std::vector<Block> blocks_;
  std::vector<std::vector<std::size_t>> neighbours_;
  std::vector<bool> covered_;
  Eigen::Index pixels_;
};

/// Log density of pixels at which an unknown frame shows something else.
Eigen::ArrayXd densities_of_any(const FrameSample& sample, const FrameScore& sound) {
  // As sound ones, but for the residual, which is as large as an outlier's, and other patterns.
  const auto freedom = static_cast<double>(sample.counts.cols() - 3);
  Eigen::ArrayXd out = sound.value_densities;
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const double sigma = kOutlierSize * sample.scale_counts(i);
    out(i) += log_normal(sound.squared_rests(i), sigma * sigma, freedom);
  }
  return out;
}

/// Log density of pixels of which some frames show something else; fitted to the others where no
/// frame does. Empty if the others say nothing about a pixel.
Eigen::ArrayXd densities_of(const FrameSample& sample,
                            const FrameHypothesis& declared,
                            const std::vector<std::size_t>& frames,
                            const Eigen::ArrayXd& counted) {
  FrameHypothesis without = declared;
  for (const std::size_t k : frames)
    without.free[k] = true;
  const FrameDesign design = design_of(without);
  if (design.inverse.size() == 0 || (design.rest.cols() == 0 && !sample.has_reference())) return {};
  Eigen::ArrayXd out = score_frames(sample, without, counted).pixel_densities;
  for (const std::size_t k : frames)
    for (Eigen::Index i = 0; i < out.size(); ++i)
      out(i) += log_density_of_anything(sample.counts(i, static_cast<Eigen::Index>(k)),
                                        sample.scale_counts(i));
  return out;
}

double sum_over(const Eigen::ArrayXd& densities, const Block& block) {
  return densities.segment(block.begin, block.size()).sum();
}

/// The half of the blocks that fits the frames as they are described least.
std::vector<bool> worse_half(const std::vector<Block>& blocks, const FrameScore& all) {
  std::vector<std::pair<double, std::size_t>> ranked;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    ranked.emplace_back(sum_over(all.pixel_densities - all.value_densities, blocks[b]) /
                            static_cast<double>(blocks[b].size()),
                        b);
  std::sort(ranked.begin(), ranked.end());
  std::vector<bool> out(blocks.size(), false);
  for (std::size_t i = 0; i < ranked.size() / 2; ++i)
    out[ranked[i].second] = true;
  return out;
}

/// Labels the blocks by turns with a fit to those that are not covered.
FrameScore label(const FrameSample& sample, const FrameHypothesis& declared, Labels& labels) {
  labels.set(worse_half(labels.blocks(), score_frames(sample, declared)));
  FrameScore sound = score_frames(sample, declared, labels.counted());
  for (int round = 0; round < kLabelRounds; ++round) {
    const Eigen::ArrayXd odds = densities_of_any(sample, sound) - sound.pixel_densities;
    std::vector<bool> covered;
    for (std::size_t b = 0; b < labels.blocks().size(); ++b) {
      const Block& block = labels.blocks()[b];
      double log_odds = kWitnesses / static_cast<double>(block.size()) * sum_over(odds, block);
      if (round > 0) log_odds += labels.log_probability(b, true) - labels.log_probability(b, false);
      covered.push_back(log_odds > 0.0);
    }
    labels.set(std::move(covered));
    sound = score_frames(sample, declared, labels.counted());
  }
  return sound;
}

/// Sum over the covered blocks.
double sum_over_covered(const Labels& labels, const Eigen::ArrayXd& densities) {
  double sum = 0.0;
  for (std::size_t b = 0; b < labels.blocks().size(); ++b)
    if (labels.is_covered(b)) sum += sum_over(densities, labels.blocks()[b]);
  return sum;
}

}  // namespace

std::optional<CoveredPart> find_covered_part(const FrameSample& sample, const Pattern& pattern) {
  if (pattern.shifts_rad.size() <= 3) return {};  // no residual shows it
  std::vector<FrameHypothesis> all = frame_hypotheses(pattern);
  const FrameHypothesis declared = all.front();
  Labels labels(sample, blocks_of(sample));
  if (labels.blocks().size() < 4 * kFewest) return {};
  FrameScore sound = label(sample, declared, labels);
  const Eigen::ArrayXd counted = labels.counted();
  double log_labels = 0.0;
  std::size_t count = 0;
  for (std::size_t b = 0; b < labels.blocks().size(); ++b) {
    log_labels += labels.log_probability(b, labels.is_covered(b));
    if (labels.is_covered(b)) ++count;
  }
  const double part = 1.0 - counted.mean();
  if (count < kFewest || part < kLeastPart ||
      part > (sample.has_reference() ? kMostOfKnown : kMostPart))
    return {};
  std::erase_if(all, [](const FrameHypothesis& one) { return one.cause != FrameCause::Covered; });
  std::vector<double> sums;  // of the covered pixels, by hypothesis
  for (const FrameHypothesis& one : all) {
    const Eigen::ArrayXd densities = one.frames.empty()
                                         ? densities_of_any(sample, sound)
                                         : densities_of(sample, declared, one.frames, counted);
    sums.push_back(densities.size() > 0 ? sum_over_covered(labels, densities)
                                        : -std::numeric_limits<double>::infinity());
  }
  const auto best =
      static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  const double witnesses =
      kWitnesses * static_cast<double>(count) / ((1.0 - counted).sum());  // over the pixels
  std::size_t chosen = best;
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (i != best && witnesses * (sums[best] - sums[i]) < kNamedLogOdds) chosen = 0;
  CoveredPart out{all[chosen], std::move(sound)};
  out.hypothesis.part = part;
  if (out.hypothesis.frames.size() == 1 && part > kLostFrame) {
    out.hypothesis.cause = FrameCause::Lost;
    out.hypothesis.parameters = 2;
  }
  out.score.log_density += sums[chosen] + log_labels;
  return out;
}

}  // namespace frangia
