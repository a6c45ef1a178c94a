#include "frangia/phase/temporal/check_sequence.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/phase/temporal/internal/rank_trials.h"
#include "frangia/phase/temporal/internal/sequence_sample.h"
#include "frangia/phase/temporal/internal/sequence_trials.h"

namespace frangia {
namespace {

constexpr std::size_t kBlocks = 6;        ///< along each side of the image
constexpr double kMinBlockPixels = 12.0;  ///< fewer average no noise
constexpr std::size_t kMinBlocks = 8;     ///< fewer show no scatter

/// Least disagreement, rad. Step errors and scattering below the surface stay below it.
constexpr double kMinResidual_rad = 0.03;
constexpr double kMinStart_rad = 0.17;  ///< 10 degrees: half a pixel of fringes of 18 px

/// Largest scatter of the blocks over the mean: what differs more is no start.
constexpr double kMaxScatter = 0.3;
constexpr double kMinMeanSigmas = 6.0;  ///< of the mean, from the scatter of the blocks

/// Part of the disagreement that the start of a pattern may leave unexplained.
constexpr double kUnexplained = 0.25;

/// Means of the residuals over blocks of the image: one column per block.
Eigen::MatrixXd block_means(const SequenceSample& sample) {
  const std::vector<PlacedResiduals> residuals = sample.residuals();
  const auto maps = static_cast<Eigen::Index>(sample.patterns().size());
  constexpr auto kAll = static_cast<Eigen::Index>(kBlocks * kBlocks);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(maps, kAll);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(kAll);
  for (const PlacedResiduals& pixel : residuals) {
    const auto place = [](double share) {
      return std::min(kBlocks - 1, static_cast<std::size_t>(share * kBlocks));
    };
    const auto block = static_cast<Eigen::Index>(kBlocks * place(pixel.y) + place(pixel.x));
    for (Eigen::Index map = 0; map < maps; ++map)
      sums(map, block) += pixel.residuals_rad[static_cast<std::size_t>(map)];
    counts(block) += 1.0;
  }
  Eigen::Index kept = 0;
  for (Eigen::Index block = 0; block < kAll; ++block) {
    if (counts(block) < kMinBlockPixels) continue;
    sums.col(kept++) = Eigen::VectorXd(sums.col(block) / counts(block));
  }
  return sums.leftCols(kept);
}

/// The starts of single patterns that explain a disagreement of the phases which is the same all
/// over the image, though too small to be seen at one pixel: a start of the finest pattern that is
/// 37 degrees off moves its place by a tenth of a fringe only.
///
/// The residuals of each pattern are averaged over the image. Harmonics, noise and indirect light
/// differ from place to place; a start does not. Patterns that explain the averages equally well
/// are all returned.
std::vector<SequenceTrial> trials_of_start_offset(const SequenceSample& sample) {
  const Eigen::MatrixXd blocks = block_means(sample);
  if (blocks.cols() < static_cast<Eigen::Index>(kMinBlocks)) return {};
  const Eigen::VectorXd mean = blocks.rowwise().mean();
  const auto count = static_cast<double>(blocks.cols());
  const double scatter = std::sqrt((blocks.colwise() - mean).squaredNorm() / (count - 1.0));
  const double size = mean.norm();
  if (size < kMinResidual_rad || scatter > kMaxScatter * size ||
      size < kMinMeanSigmas * scatter / std::sqrt(count))
    return {};
  // A start moves the phases off the curve of one place of the field, across the frequencies.
  Eigen::VectorXd along(mean.size());
  for (Eigen::Index map = 0; map < mean.size(); ++map)
    along(map) = sample.patterns()[static_cast<std::size_t>(map)].fringes_per_unit();
  along.normalize();
  std::vector<std::pair<double, SequenceTrial>> found;
  double least = kUnexplained * size;
  for (Eigen::Index map = 0; map < mean.size(); ++map) {
    const Eigen::VectorXd across = Eigen::VectorXd::Unit(mean.size(), map) - along(map) * along;
    const double start_rad = mean.dot(across) / across.squaredNorm();
    if (std::abs(start_rad) < kMinStart_rad || std::abs(start_rad) > kPi) continue;
    const double left = (mean - start_rad * across).norm();
    least = std::min(least, left);
    const double whole_rad = rad_from_deg(std::round(deg_from_rad(start_rad)));
    found.emplace_back(left,
                       start_trial(sample.patterns(), static_cast<std::size_t>(map), whole_rad));
  }
  // Equal within the uncertainty of the means.
  const double tie = least + 3.0 * scatter / std::sqrt(count);
  std::vector<SequenceTrial> out;
  for (auto& [left, trial] : found)
    if (left <= std::min(tie, kUnexplained * size)) out.push_back(std::move(trial));
  return out;
}

/// Systematic phase error of each pattern, rad RMS, that a sound sequence may have: harmonics of a
/// display, errors of steps. Three frames are blind to the second harmonic, which is 0.29 of the
/// first for gamma 2.2; where their waveform is known it decides.
std::vector<double> largest_systematic(std::span<const SequenceFrames> maps) {
  constexpr double kThreeFrames_rad = 0.2;
  constexpr double kMoreFrames_rad = 0.05;
  std::vector<double> out;
  for (const SequenceFrames& map : maps) {
    const double unknown_rad =
        map.stack->pattern.shifts_rad.size() <= 3 ? kThreeFrames_rad : kMoreFrames_rad;
    out.push_back(map.systematic_rad ? std::clamp(*map.systematic_rad, kMoreFrames_rad, unknown_rad)
                                     : unknown_rad);
  }
  return out;
}

/// Largest expected misfit of a sound sequence, over chance, for which the check decides.
constexpr double kMaxExpected = 0.4;

/// The orders that explain the frames of one pattern by themselves, as trials.
std::vector<SequenceTrial> trials_of(const SequenceSample& sample,
                                     std::size_t map,
                                     const std::vector<std::vector<double>>& orders_rad) {
  constexpr double kSame_rad = 1e-6;
  const auto are_same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double one, double other) {
      return std::abs(wrap_rad(one - other)) < kSame_rad;
    });
  };
  std::vector<SequenceTrial> trials;
  for (SequenceTrial& trial : shift_trials(sample.patterns(), map)) {
    if (std::any_of(orders_rad.begin(), orders_rad.end(), [&](const auto& order) {
          return are_same(order, trial.fault.shifts_rad);
        }))
      trials.push_back(std::move(trial));
  }
  return trials;
}

SequenceCheck with_fits(SequenceCheck check, std::vector<RankedTrial> found) {
  if (!found.empty()) check.fitted_rad = found.front().misfit_rad;
  for (RankedTrial& one : found)
    check.fits.push_back(std::move(one.trial.fault));
  return check;
}

/// The result for a pattern whose frames have one of several orders: the other patterns decide
/// which.
SequenceCheck misordered(const SequenceSample& sample,
                         std::size_t map,
                         const std::vector<SequenceTrial>& orders,
                         SequenceCheck out,
                         const SequenceCheckOptions& options,
                         bool absolute) {
  std::vector<RankedTrial> found;
  if (out.decided) {
    found = plausible(
        sample, fitting(sample, orders, options.max_misfit * out.chance_rad, options), absolute);
  }
  if (found.empty()) {
    for (const SequenceTrial& trial : orders)
      found.push_back({trial, 0.0});
  }
  out.decided = true;
  out.consistent = false;
  out.patterns = {sample.patterns()[map].name};
  return with_fits(std::move(out), std::move(found));
}

}  // namespace

SequenceCheck check_sequence(std::span<const SequenceFrames> coarse_to_fine,
                             const NoiseModel& noise,
                             const Projector& projector,
                             bool determines_orders,
                             const WrapOptions& wrap,
                             const SequenceCheckOptions& options) {
  SequenceCheck out;
  for (const SequenceFrames& map : coarse_to_fine)
    out.patterns.push_back(map.stack->pattern.name);
  if (coarse_to_fine.empty()) return out;
  const SequenceSample sample(coarse_to_fine, noise, projector, wrap, options);
  if (sample.size() < options.min_pixels) return out;
  if (coarse_to_fine.size() > 1) {
    for (std::size_t map = 0; map < coarse_to_fine.size(); ++map)
      out.ripples_rad.push_back(sample.ripple(map));
    out.misfit_rad = sample.misfit();
    out.chance_rad = sample.chance();
    out.decided =
        out.misfit_rad <= options.max_misfit * out.chance_rad ||
        sample.expected_misfit(largest_systematic(coarse_to_fine)) <= kMaxExpected * out.chance_rad;
  }
  for (std::size_t map = 0; map < coarse_to_fine.size(); ++map) {
    const auto orders = trials_of(sample, map, coarse_to_fine[map].orders_rad);
    if (!orders.empty())
      return misordered(sample, map, orders, std::move(out), options, determines_orders);
  }
  const bool disagree = out.decided && out.misfit_rad > options.max_misfit * out.chance_rad;
  if (out.decided && !disagree && determines_orders) out.split_rows = sample.split_lines();
  if (!disagree && out.split_rows <= options.max_split_rows) {
    if (!out.decided || !determines_orders) return out;
    for (SequenceTrial& trial : trials_of_start_offset(sample))
      out.fits.push_back(std::move(trial.fault));
    out.consistent = out.fits.empty();
    return out;
  }
  out.consistent = false;
  constexpr double kNotWorse = 1.3;  // misfit of a declaration that does not split the surface
  const double limit = out.misfit_rad * (disagree ? options.max_fitted : kNotWorse);
  std::vector<RankedTrial> fits = fitting(sample, all_trials(sample), limit, options);
  if (disagree) fits = ranked(sample, with_free_starts(sample, std::move(fits)), limit, options);
  return with_fits(std::move(out), plausible(sample, std::move(fits), determines_orders));
}

namespace {

std::string clause_of(const SequenceFault& fault) {
  const bool one = fault.patterns.size() == 1;
  std::string text =
      one ? fmt::format("pattern \"{}\" fits {}", fault.patterns.front(), fault.what)
          : fmt::format("patterns \"{}\" fit {}", fmt::join(fault.patterns, "\", \""), fault.what);
  if (!fault.same_as.empty())
    text += fmt::format(", which is the same as {}", fmt::join(fault.same_as, ", or "));
  return text + fmt::format(" ({})", fault.keys);
}

}  // namespace

std::string describe(const SequenceCheck& check) {
  if (!check.finding.empty()) return check.finding;
  const std::string names = fmt::format("\"{}\"", fmt::join(check.patterns, "\", \""));
  if (check.fits.size() == 1) return clause_of(check.fits.front());
  if (!check.fits.empty()) {
    std::vector<std::string> clauses;
    for (const SequenceFault& fault : check.fits)
      clauses.push_back(clause_of(fault));
    return fmt::format("the frames do not fit scan.toml, and they do not decide what does: {}",
                       fmt::join(clauses, ", or "));
  }
  if (check.patterns.size() == 1) {
    return fmt::format(
        "the frames of pattern {} do not fit its shifts, and no exchange of two frames does; "
        "check shifts_deg and the order of the frames",
        names);
  }
  if (check.split_rows > 0.0) {
    return fmt::format(
        "the patterns {} place both ends of the projector's field next to each other on the "
        "object; check their starts and periods",
        names);
  }
  return fmt::format(
      "the patterns {} disagree, and no change of one start, period, direction or order of frames "
      "makes them agree; check scan.toml against what was projected",
      names);
}

std::string describe(std::span<const SequenceCheck> checks) {
  std::string text;
  for (const SequenceCheck& check : checks)
    if (!check.consistent) text += (text.empty() ? "" : "; ") + describe(check);
  return text;
}

}  // namespace frangia
