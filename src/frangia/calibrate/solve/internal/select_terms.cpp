#include "frangia/calibrate/solve/internal/select_terms.h"

#include <initializer_list>

#include "frangia/core/matrix_products.h"
#include "frangia/core/solve_symmetric.h"

namespace frangia {
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
