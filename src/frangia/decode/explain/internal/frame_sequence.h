#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/frames/frame_stack.h"

namespace frangia {

inline constexpr std::size_t kFewestFrames = 3;  ///< that determine a pixel

/// A frame of the sequence.
struct Shown {
  const Frame* frame;
  const FrameStack* stack;
};

[[nodiscard]] std::vector<Shown> sequence_of(std::span<const FrameStack> stacks);

/// Whether all frames have one size; those that do not are refused where they are decoded.
[[nodiscard]] bool are_alike(const std::vector<Shown>& sequence);

[[nodiscard]] bool has_fringes(const FrameStack& stack);

/// The counts of all frames at lit pixels, from the first row of the image to the last.
struct LitCounts {
  Eigen::ArrayXXd counts;  ///< pixels x frames of the sequence
  Eigen::ArrayXd rows_px;  ///< row of the image of each pixel
};

[[nodiscard]] LitCounts lit_counts(const std::vector<Shown>& sequence);

/// Mean, modulation and residual variance of all pixels by the frames of one pattern.
struct Fitted {
  Eigen::ArrayXd mean;
  Eigen::ArrayXd modulation;
  Eigen::ArrayXd rest;  ///< variance of the residual; empty for three frames
};

/// The frames of a pattern: their places in the sequence, and the shifts that they show.
struct Placed {
  std::vector<Eigen::Index> places;
  std::vector<double> shifts_rad;
};

/// `pattern` has three frames or more.
[[nodiscard]] Fitted fit(const Eigen::ArrayXXd& counts, const Placed& pattern);

[[nodiscard]] std::vector<Fitted> fit_all(const Eigen::ArrayXXd& counts,
                                          const std::vector<Placed>& patterns);

/// What the patterns leave together: the median over the pixels of the mean square of residuals,
/// and of how the patterns differ in mean and modulation, over the modulation. Nothing if no two
/// patterns tell.
[[nodiscard]] std::optional<double> misfit_of(const std::vector<Fitted>& fits);

/// The fringe patterns whose frames are late by `lag`, without those of fewer than three frames.
[[nodiscard]] std::vector<Placed> placed_at(std::span<const FrameStack> stacks,
                                            std::ptrdiff_t frames,
                                            std::ptrdiff_t lag);

}  // namespace frangia
