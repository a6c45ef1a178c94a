#include "frangia/phase/temporal/internal/start_offset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Core>

#include "frangia/core/angles.h"

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

}  // namespace

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

}  // namespace frangia
