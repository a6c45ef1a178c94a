#include "frangia/reconstruct/rig_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"
#include "frangia/diagnose/score.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

constexpr double kMostContradict = 0.2;  // share of the pixels
constexpr double kMostWitnesses = 50.0;  // what a cause leaves may be one smooth field

/// A parameter of the rig that may be wrong, and how far.
struct FreeParameter {
  std::string name;
  double sigma = 0.0;
};

/// Parameters of a rig that was moved, changed or copied from another one. Broad: a hypothesis that
/// needs larger changes is not a linear one.
std::vector<FreeParameter> free_parameters(const Rig& rig, double distance_mm) {
  constexpr double kTurn_rad = 0.05;
  constexpr double kShare = 0.05;  // of the working distance, the focal length and the width
  const auto* projector = std::get_if<PinholeModel>(&rig.projector.model);
  if (projector == nullptr) return {};
  const std::vector<std::string> known = rig_parameter_names(rig);
  std::vector<FreeParameter> out;
  const auto add = [&](const char* name, double sigma) {
    if (std::find(known.begin(), known.end(), name) != known.end()) out.push_back({name, sigma});
  };
  for (const char* name :
       {"projector.rotation_x_rad", "projector.rotation_y_rad", "projector.rotation_z_rad"})
    add(name, kTurn_rad);
  for (const char* name : {"projector.x_mm", "projector.y_mm", "projector.z_mm"})
    add(name, kShare * distance_mm);
  add("projector.focal_px", kShare * projector->focal_px.x());
  add("projector.principal_x_px", kShare * projector->focal_px.x());
  add("projector.principal_y_px", kShare * projector->focal_px.y());
  add("camera.focal_px", kShare * rig.reference().model.focal_px.x());
  add("camera.principal_x_px", kShare * rig.reference().model.focal_px.x());
  add("camera.principal_y_px", kShare * rig.reference().model.focal_px.y());
  return out;
}

/// The differences of the samples as a rig would find them, along their rays.
Eigen::VectorXd differences_by(const Rig& rig,
                               std::span<const DepthPair> samples,
                               const Pattern& first,
                               const Pattern& second) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const DepthPair& pair = samples[i];
    const Eigen::Vector2d ray = rig.reference().model.ray({pair.x, pair.y});
    const auto depth = [&](float phase_rad, const Pattern& pattern) {
      return intersect_fringe(ray, static_cast<double>(phase_rad), pattern, rig.projector).depth_mm;
    };
    out[static_cast<Eigen::Index>(i)] =
        ray.homogeneous().norm() * (depth(pair.first_rad, first) - depth(pair.second_rad, second));
  }
  return out;
}

double sigma_of(const DepthPair& pair) {
  return static_cast<double>(std::hypot(pair.sigma_mm, pair.systematic_mm));
}

/// Square of the normalized residuals by their median, which wrong fringe orders do not move.
double chi_squared_of(const Eigen::VectorXd& residuals) {
  std::vector<float> absolute;
  for (const double one : residuals) {
    if (std::isfinite(one)) absolute.push_back(static_cast<float>(std::abs(one)));
  }
  return std::pow(static_cast<double>(median(std::move(absolute))) / kMedianOfNormal, 2);
}

/// What a moved rig leaves of the differences.
struct RigFit {
  Eigen::VectorXd normalized;  ///< residuals over sigma
  std::size_t parameters = 0;
};

/// Fits the parameters by Gauss-Newton with weights that wrong orders do not pull.
RigFit fit_rig(std::span<const DepthPair> samples,
               const Rig& rig,
               const Pattern& first,
               const Pattern& second) {
  constexpr int kIterations = 6;
  constexpr double kStep = 1e-4;  // of the prior
  std::vector<float> distances;
  Eigen::ArrayXd sigma(static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    distances.push_back(samples[i].point_mm.z());
    sigma[static_cast<Eigen::Index>(i)] = sigma_of(samples[i]);
  }
  const auto free = free_parameters(rig, static_cast<double>(median(std::move(distances))));
  RigFit out;
  out.parameters = free.size();
  if (free.empty()) return out;
  std::vector<std::string> names;
  Eigen::VectorXd prior(static_cast<Eigen::Index>(free.size()));
  for (const FreeParameter& one : free) {
    prior[static_cast<Eigen::Index>(names.size())] = one.sigma;
    names.push_back(one.name);
  }
  const auto normalized = [&](const Eigen::VectorXd& units) -> Eigen::VectorXd {
    const Rig changed = change_parameters(rig, names, units.cwiseProduct(prior));
    return (differences_by(changed, samples, first, second).array() / sigma).matrix();
  };
  Eigen::VectorXd units = Eigen::VectorXd::Zero(prior.size());
  Eigen::VectorXd residuals = normalized(units);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::MatrixXd slopes(residuals.size(), units.size());
    for (Eigen::Index k = 0; k < units.size(); ++k)
      slopes.col(k) =
          (normalized(units + kStep * Eigen::VectorXd::Unit(units.size(), k)) - residuals) / kStep;
    // Cauchy's weights about the median scale.
    const double scale2 = std::max(1.0, chi_squared_of(residuals));
    Eigen::ArrayXd weights = 1.0 / (1.0 + residuals.array().square() / (4.0 * scale2));
    for (Eigen::Index i = 0; i < residuals.size(); ++i) {
      if (slopes.row(i).allFinite() && std::isfinite(residuals[i])) continue;
      weights[i] = 0.0;
      slopes.row(i).setZero();
    }
    const Eigen::VectorXd safe = (weights > 0.0).select(residuals.array(), 0.0).matrix();
    const Eigen::MatrixXd weighted = weights.matrix().asDiagonal() * slopes;
    Eigen::MatrixXd normal = transposed_product(slopes, weighted) / scale2;
    normal.diagonal().array() += 1.0;
    const Eigen::VectorXd step =
        solve_symmetric(normal, -transposed_product(weighted, safe) / scale2 - units);
    const Eigen::VectorXd next = normalized(units + step);
    if (!(chi_squared_of(next) <= chi_squared_of(residuals))) break;
    units += step;
    residuals = next;
  }
  out.normalized = residuals;
  return out;
}

/// The number of independent witnesses among residuals: neighbours share theirs.
double witnesses_of(const Eigen::VectorXd& normalized) {
  constexpr int kBlock = 4;  // neighbouring samples
  std::vector<double> residuals;
  std::vector<int> blocks;
  for (Eigen::Index i = 0; i < normalized.size(); ++i) {
    if (!std::isfinite(normalized[i])) continue;
    residuals.push_back(normalized[i]);
    blocks.push_back(static_cast<int>(i) / kBlock);
  }
  return std::min(kMostWitnesses,
                  static_cast<double>(residuals.size()) * effective_share(residuals, blocks));
}

/// Log evidence of residuals of a variance of `chi_squared` that is free where it exceeds 1.
double free_evidence(double chi_squared, double witnesses) {
  return -0.5 * witnesses * std::log(std::max(1.0, chi_squared));
}

const double kPriceOfFault = std::log(100.0);

/// The samples of all views side by side.
std::vector<DepthPair> samples_of(std::span<const DepthAgreement> views) {
  constexpr std::size_t kMost = 1000;
  std::vector<DepthPair> all;
  for (const DepthAgreement& view : views)
    all.insert(all.end(), view.samples.begin(), view.samples.end());
  const std::size_t every = all.size() / kMost + 1;
  std::vector<DepthPair> some;
  for (std::size_t i = 0; i < all.size(); i += every)
    some.push_back(all[i]);
  return some;
}

std::optional<RigAgreement> pooled(std::span<const DepthAgreement> views, MeasuredTwiceBy by) {
  std::vector<float> apart;
  std::vector<float> over_sigma;
  std::vector<float> chi_squared;
  double beyond = 0.0;
  double pixels = 0.0;
  for (const DepthAgreement& view : views) {
    if (view.pixels == 0) continue;
    const auto count = static_cast<double>(view.pixels);
    apart.push_back(static_cast<float>(view.median_mm));
    over_sigma.push_back(static_cast<float>(view.median_over_sigma));
    chi_squared.push_back(static_cast<float>(view.chi_squared));
    beyond += count * view.beyond;
    pixels += count;
  }
  if (apart.empty()) return {};
  RigAgreement out;
  out.by = by;
  out.median_mm = static_cast<double>(median(std::move(apart)));
  out.over_noise = static_cast<double>(median(std::move(over_sigma))) / kMedianOfNormal;
  out.chi_squared = static_cast<double>(median(std::move(chi_squared)));
  out.beyond = beyond / pixels;
  return out;
}

/// What all comparisons have: as described, and unexplained.
std::vector<ScoredHypothesis> without_cause(double chi_squared,
                                            double unexplained,
                                            double witnesses) {
  return {{.text = "as described",
           .log_evidence = -0.5 * witnesses * std::max(0.0, chi_squared / kConsistent - 1.0),
           .unexplained = unexplained,
           .prediction = 0},
          {.text = "unexplained",
           .log_evidence = free_evidence(chi_squared, witnesses) - 2.0 * kPriceOfFault -
                           price_of_parameter(witnesses),
           .unexplained = unexplained,
           .remedy = "calibrate the rig again, and check the fringes of both with `frangia decode`",
           .prediction = 1}};
}

const char* subject_of(MeasuredTwiceBy by) {
  return by == MeasuredTwiceBy::Directions ? "the two directions of fringes" : "the cameras";
}

}  // namespace

bool RigAgreement::contradicts() const {
  return beyond > kMostContradict && !is_consistent();
}

std::string RigAgreement::text() const {
  std::string out = fmt::format("{} are {:.4g} mm apart (median), {:.1f} times their noise",
                                subject_of(by),
                                median_mm,
                                over_noise);
  if (is_consistent()) return out + ": the rig is consistent";
  if (!contradicts()) {
    out += ": more than noise and calibration explain; the difference is in sigma";
    if (!explanation.remedy.empty()) out += "; " + explanation.remedy;
    return out;
  }
  out = fmt::format(
      "{} contradict each other: they are {:.4g} mm apart (median), {:.1f} times their noise, and "
      "{:.0f} % of the pixels are beyond {:.0f} standard deviations of all that is known; {}",
      subject_of(by),
      median_mm,
      over_noise,
      100.0 * beyond,
      kContradiction,
      explanation.is_decided() ? describe(explanation) : "what causes it is not decided");
  if (!explanation.remedy.empty()) out += "; " + explanation.remedy;
  return out;
}

std::optional<RigAgreement> agreement_of_directions(std::span<const DepthAgreement> views,
                                                    const Rig& rig,
                                                    const Pattern& first,
                                                    const Pattern& second) {
  std::optional<RigAgreement> out = pooled(views, MeasuredTwiceBy::Directions);
  if (!out) return {};
  const std::vector<DepthPair> samples = samples_of(views);
  if (samples.empty()) return out;
  Eigen::VectorXd normalized(static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i)
    normalized[static_cast<Eigen::Index>(i)] =
        static_cast<double>(samples[i].apart_mm) / sigma_of(samples[i]);
  const double sigmas = std::sqrt(out->chi_squared);
  if (out->is_consistent()) {
    out->explanation = choose(without_cause(out->chi_squared, sigmas, witnesses_of(normalized)));
    return out;
  }
  const RigFit fit = fit_rig(samples, rig, first, second);
  const double witnesses =
      fit.normalized.size() > 0 ? witnesses_of(fit.normalized) : witnesses_of(normalized);
  auto hypotheses = without_cause(out->chi_squared, sigmas, witnesses);
  if (fit.normalized.size() > 0) {
    const double left = chi_squared_of(fit.normalized);
    hypotheses.push_back(
        {.text = "the projector or the camera is not what rig.toml states",
         .log_evidence = free_evidence(left, witnesses) - kPriceOfFault -
                         static_cast<double>(fit.parameters) * price_of_parameter(witnesses),
         .unexplained = std::sqrt(left),
         .remedy = "calibrate the rig again, or set `refine_rig`",
         .prediction = 2});
  }
  out->explanation = choose(hypotheses);
  return out;
}

std::optional<RigAgreement> agreement_of_cameras(std::span<const DepthAgreement> views) {
  std::optional<RigAgreement> out = pooled(views, MeasuredTwiceBy::Cameras);
  if (!out) return {};
  out->explanation =
      choose(without_cause(out->chi_squared, std::sqrt(out->chi_squared), kMostWitnesses));
  return out;
}

}  // namespace frangia
