#include "frangia/calibrate/solve/internal/rig_covariance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "frangia/calibrate/internal/assess_solution.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

/// Standard deviations of terms that are held at their nominal values: ordinary lenses and square
/// pixels. Zero: the parameter is always estimated.
constexpr std::array kHeldSigma = {0.0, 2e-3, 0.0, 0.0, 0.0, 0.1, 1e-3, 1e-3, 0.1};

/// Adds what is known beforehand of the terms of a device that are held.
void add_priors(const RigFreedom& freedom, std::size_t first, Eigen::MatrixXd& normal) {
  for (std::size_t i = 0; i < kHeldSigma.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(first + i);
    if (!freedom.free.at(first + i))
      normal(row, row) += 1.0 / (kHeldSigma.at(i) * kHeldSigma.at(i));
  }
}

}  // namespace

SolvedCovariance covariance_of(std::span<const RigObservation> observations,
                               const RigFreedom& freedom,
                               const RigNoise& noise,
                               const RigParameters& parameters,
                               const std::vector<std::string>& names) {
  constexpr double kOpen = 1e-12;
  const RigLayout& layout = freedom.layout;
  RigFreedom all = freedom;  // a held term is uncertain, too, and correlated with the others
  std::fill_n(all.free.begin(), layout.board(), true);
  const RigLinearization full = linearize_rig(observations, layout, noise, parameters);
  const Eigen::MatrixXd jacobian =
      full.jacobian(Eigen::all, free_columns(all, full.jacobian.cols()));
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  add_priors(freedom, 0, normal);
  if (layout.has_projector) add_priors(freedom, layout.projector(), normal);
  for (std::size_t i = 1; i < layout.cameras; ++i)
    add_priors(freedom, layout.camera(i), normal);
  const NormalInverse inverse = invert_normal(normal, kOpen);
  const auto kept = static_cast<Eigen::Index>(names.size());
  SolvedCovariance out{inverse.covariance.topLeftCorner(kept, kept), {}};
  constexpr double kMuch = 0.1;  // share of a parameter that lies in open directions
  for (Eigen::Index i = 0; i < kept; ++i) {
    if (inverse.open[i] < kMuch) continue;
    out.undetermined.push_back(names[static_cast<std::size_t>(i)]);
    out.covariance(i, i) = std::numeric_limits<double>::infinity();
  }
  return out;
}

namespace {

/// Columns that a term adds to a model.
std::vector<Eigen::Index> new_columns(const ModelTerm& term, const RigFreedom& freedom) {
  std::vector<Eigen::Index> columns;
  for (const std::size_t i : term.parameters)
    if (!freedom.free.at(i)) columns.push_back(static_cast<Eigen::Index>(i));
  return columns;
}

/// Terms of a device whose intrinsics start at `first`.
void add_lens_terms(const std::string& device, std::size_t first, std::vector<ModelTerm>& terms) {
  const auto add = [&](const char* name, std::initializer_list<std::size_t> parameters) {
    ModelTerm& term = terms.emplace_back();
    term.name = name + (" of the " + device);
    for (const std::size_t i : parameters)
      term.parameters.push_back(first + i);
  };
  add("k2", {5});
  add("tangential distortion", {6, 7});
  add("k3", {5, 8});
  add("two focal lengths", {1});
}

}  // namespace

std::vector<ModelTerm> optional_terms(const RigLayout& layout,
                                      std::span<const std::string> cameras,
                                      bool release_board) {
  std::vector<ModelTerm> terms;
  add_lens_terms("camera", 0, terms);
  if (layout.has_projector) add_lens_terms("projector", layout.projector(), terms);
  for (std::size_t i = 0; i < cameras.size(); ++i)
    add_lens_terms("camera \"" + cameras[i] + "\"", layout.camera(i + 1), terms);
  if (!release_board) return terms;
  const auto add = [&](const char* name, std::size_t begin, std::size_t end) {
    ModelTerm& term = terms.emplace_back();
    term.name = name;
    term.of_board = true;
    for (std::size_t i = begin; i < end; ++i)
      term.parameters.push_back(layout.board() + i);
  };
  add("aspect and shear of the board", 0, 2);
  add("bend of the board, second order", 2, 5);
  add("bend of the board, third order", 5, 9);
  add("bend of the board, fourth order", 9, 14);
  return terms;
}

void set_free(const ModelTerm& term, RigFreedom& freedom) {
  for (const std::size_t i : term.parameters)
    freedom.free.at(i) = true;
}

bool is_free(const ModelTerm& term, const RigFreedom& freedom) {
  return new_columns(term, freedom).empty();
}

std::optional<std::size_t> best_term(std::span<const RigObservation> observations,
                                     std::span<const ModelTerm> terms,
                                     const RigFreedom& freedom,
                                     const RigNoise& noise,
                                     const RigParameters& parameters,
                                     double min_gain) {
  const RigLinearization full = linearize_rig(observations, freedom.layout, noise, parameters);
  const Eigen::MatrixXd normal = transposed_product(full.jacobian, full.jacobian);
  const Eigen::VectorXd gradient = transposed_product(full.jacobian, full.residuals);
  const std::vector<Eigen::Index> active = free_columns(freedom, normal.cols());
  const Eigen::MatrixXd own = normal(active, active);
  const Eigen::VectorXd slope_of_own = gradient(active);
  const Eigen::VectorXd settled = solve_symmetric(own, slope_of_own);
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::vector<Eigen::Index> added = new_columns(terms[i], freedom);
    if (added.empty()) continue;
    const Eigen::MatrixXd coupling = normal(active, added);
    const Eigen::MatrixXd free =
        normal(added, added) - transposed_product(coupling, solve_symmetric_columns(own, coupling));
    const Eigen::VectorXd slope = gradient(added) - transposed_product(coupling, settled);
    const double gain =
        slope.dot(solve_symmetric(free, slope)) - min_gain * static_cast<double>(added.size());
    if (gain > most) {
      most = gain;
      best = i;
    }
  }
  return best;
}

}  // namespace frangia
