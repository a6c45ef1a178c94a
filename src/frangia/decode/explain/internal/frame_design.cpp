#include "frangia/decode/explain/internal/frame_design.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "frangia/core/linear_algebra.h"

namespace frangia {

FrameDesign design_of(const FrameHypothesis& hypothesis) {
  FrameDesign out;
  for (std::size_t k = 0; k < hypothesis.shifts_rad.size(); ++k)
    if (!hypothesis.free[k]) out.shown.push_back(static_cast<Eigen::Index>(k));
  const Eigen::Index rows = std::ssize(out.shown);
  out.design = Eigen::MatrixXd::Zero(rows, 3);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto k = static_cast<std::size_t>(out.shown[static_cast<std::size_t>(row)]);
    const double shift = hypothesis.shifts_rad[k];
    out.design.row(row).head<3>() << 1.0, std::cos(shift), -std::sin(shift);
    out.design.row(row) *= hypothesis.gains[k];
  }
  constexpr double kSingular = 1e-6;  // of the largest pivot: shifts that differ by less are equal
  ColumnSpace space = column_space(out.design, kSingular);
  out.span = std::move(space.span);
  out.rest = std::move(space.rest);
  if (out.span.cols() < out.design.cols()) return out;
  out.inverse =
      solve_symmetric_columns(transposed_product(out.design, out.design), out.design.transpose());
  return out;
}

Eigen::MatrixXd explained_space(const FrameHypothesis& hypothesis) {
  const FrameDesign design = design_of(hypothesis);
  const Eigen::Index frames = std::ssize(hypothesis.shifts_rad);
  Eigen::MatrixXd shown = product_transposed(design.span, design.span);
  if (hypothesis.lamp_on) {
    Eigen::VectorXd lamp(shown.rows());
    for (Eigen::Index row = 0; row < lamp.size(); ++row) {
      const auto k = static_cast<std::size_t>(design.shown[static_cast<std::size_t>(row)]);
      lamp(row) = is_lit_by_lamp(hypothesis, k) ? 1.0 : 0.0;
    }
    lamp -= product(shown, lamp);
    constexpr double kNone = 1e-6;  // the lamp is part of the fringes
    if (lamp.norm() > kNone) shown += product_transposed(lamp.normalized(), lamp.normalized());
  }
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(frames, frames);
  for (std::size_t row = 0; row < design.shown.size(); ++row) {
    for (std::size_t col = 0; col < design.shown.size(); ++col) {
      out(design.shown[row], design.shown[col]) =
          shown(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(col));
    }
  }
  return out;
}

bool determine_phase(const std::vector<double>& shifts_rad) {
  constexpr std::size_t kLeast = 3;
  constexpr double kMostNoise = 2.0;
  if (shifts_rad.size() < kLeast) return false;
  const auto frames = shifts_rad.size();
  const FrameDesign design = design_of({.frames = {},
                                        .shifts_rad = shifts_rad,
                                        .gains = std::vector<double>(frames, 1.0),
                                        .free = std::vector<bool>(frames, false),
                                        .lamp_on = {},
                                        .displaced = {},
                                        .path = {}});
  if (design.inverse.size() == 0) return false;
  const double noise = std::sqrt(0.5 * design.inverse.bottomRows(2).squaredNorm());
  return noise <= kMostNoise * std::sqrt(2.0 / static_cast<double>(frames));
}

}  // namespace frangia
