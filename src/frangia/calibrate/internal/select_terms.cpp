#include "frangia/calibrate/internal/select_terms.h"

#include <Eigen/Cholesky>

namespace frangia {
namespace {

constexpr int kProjector = kIntrinsics;
constexpr int kBoard = 2 * kIntrinsics + kPose;
constexpr int kPoses = kBoard + kShape;

RigFreedom all_free() {
  RigFreedom freedom;
  freedom.camera.fill(true);
  freedom.projector.fill(true);
  freedom.board.fill(true);
  return freedom;
}

/// Columns of the full Jacobian that a model estimates.
std::vector<Eigen::Index> columns_of(const RigFreedom& freedom, Eigen::Index count) {
  std::vector<Eigen::Index> columns;
  const auto add = [&](std::size_t column) {
    columns.push_back(static_cast<Eigen::Index>(column));
  };
  for (std::size_t i = 0; i < kIntrinsics; ++i)
    if (freedom.camera.at(i)) add(i);
  for (std::size_t i = 0; i < kIntrinsics; ++i)
    if (freedom.projector.at(i)) add(kProjector + i);
  for (std::size_t i = 0; i < kPose; ++i)
    add(2 * kIntrinsics + i);
  for (std::size_t i = 0; i < kShape; ++i)
    if (freedom.board.at(i)) add(kBoard + i);
  for (auto i = static_cast<Eigen::Index>(kPoses); i < count; ++i)
    columns.push_back(i);
  return columns;
}

/// Columns that a term adds to a model.
std::vector<Eigen::Index> new_columns(const ModelTerm& term, const RigFreedom& freedom) {
  std::vector<Eigen::Index> columns;
  for (const std::size_t i : term.camera)
    if (!freedom.camera.at(i)) columns.push_back(static_cast<Eigen::Index>(i));
  for (const std::size_t i : term.projector)
    if (!freedom.projector.at(i)) columns.push_back(static_cast<Eigen::Index>(kProjector + i));
  for (const std::size_t i : term.board)
    if (!freedom.board.at(i)) columns.push_back(static_cast<Eigen::Index>(kBoard + i));
  return columns;
}

}  // namespace

std::vector<ModelTerm> optional_terms(bool release_board) {
  std::vector<ModelTerm> terms = {
      {"k2 of the camera", {5}, {}, {}},
      {"tangential distortion of the camera", {6, 7}, {}, {}},
      {"k3 of the camera", {5, 8}, {}, {}},
      {"two focal lengths of the camera", {1}, {}, {}},
      {"k2 of the projector", {}, {5}, {}},
      {"tangential distortion of the projector", {}, {6, 7}, {}},
      {"k3 of the projector", {}, {5, 8}, {}},
      {"two focal lengths of the projector", {}, {1}, {}},
  };
  if (release_board) {
    terms.push_back({"aspect and shear of the board", {}, {}, {0, 1}});
    terms.push_back({"bend of the board, second order", {}, {}, {2, 3, 4}});
    terms.push_back({"bend of the board, third order", {}, {}, {5, 6, 7, 8}});
    terms.push_back({"bend of the board, fourth order", {}, {}, {9, 10, 11, 12, 13}});
  }
  return terms;
}

void set_free(const ModelTerm& term, RigFreedom& freedom) {
  for (const std::size_t i : term.camera)
    freedom.camera.at(i) = true;
  for (const std::size_t i : term.projector)
    freedom.projector.at(i) = true;
  for (const std::size_t i : term.board)
    freedom.board.at(i) = true;
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
  const RigLinearization full = linearize_rig(observations, all_free(), noise, parameters);
  const Eigen::MatrixXd normal = full.jacobian.transpose() * full.jacobian;
  const Eigen::VectorXd gradient = full.jacobian.transpose() * full.residuals;
  const std::vector<Eigen::Index> active = columns_of(freedom, normal.cols());
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal(active, active));
  const Eigen::VectorXd settled = solver.solve(gradient(active));
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::vector<Eigen::Index> added = new_columns(terms[i], freedom);
    if (added.empty()) continue;
    const Eigen::MatrixXd coupling = normal(active, added);
    const Eigen::MatrixXd free =
        normal(added, added) - coupling.transpose() * solver.solve(coupling);
    const Eigen::VectorXd slope = gradient(added) - coupling.transpose() * settled;
    const double gain =
        slope.dot(free.ldlt().solve(slope)) - min_gain * static_cast<double>(added.size());
    if (gain > most) {
      most = gain;
      best = i;
    }
  }
  return best;
}

}  // namespace frangia
