#include "frangia/diagnose/score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "frangia/core/error.h"

namespace frangia {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

double log_of_sum(double a, double b) {
  const double larger = std::max(a, b);
  if (larger == kNone) return kNone;
  return larger + std::log(std::exp(a - larger) + std::exp(b - larger));
}

/// The members of a class, the most likely first.
struct HypothesisClass {
  std::vector<const ScoredHypothesis*> members;
  double log_evidence = kNone;
};

std::vector<HypothesisClass> classes_of(std::span<const ScoredHypothesis> hypotheses) {
  std::map<std::size_t, HypothesisClass> by_prediction;
  for (const ScoredHypothesis& one : hypotheses) {
    HypothesisClass& alike = by_prediction[one.prediction];
    alike.members.push_back(&one);
    alike.log_evidence = log_of_sum(alike.log_evidence, one.log_evidence);
  }
  std::vector<HypothesisClass> classes;
  for (auto& [prediction, alike] : by_prediction) {
    std::stable_sort(alike.members.begin(), alike.members.end(), [](const auto* a, const auto* b) {
      return a->log_evidence > b->log_evidence;
    });
    classes.push_back(std::move(alike));
  }
  std::stable_sort(classes.begin(), classes.end(), [](const auto& a, const auto& b) {
    return a.log_evidence > b.log_evidence;
  });
  return classes;
}

std::vector<std::string> texts_of(const HypothesisClass& alike) {
  std::vector<std::string> texts;
  for (const ScoredHypothesis* one : alike.members)
    if (std::find(texts.begin(), texts.end(), one->text) == texts.end()) texts.push_back(one->text);
  return texts;
}

}  // namespace

double effective_share(std::span<const double> residuals, std::span<const int> blocks) {
  require(residuals.size() == blocks.size(), "effective_share: one block number per residual");
  double square = 0.0;
  double pairs = 0.0;     // sum over pairs of different samples of one block
  double possible = 0.0;  // number of such pairs
  double squares_of_sizes = 0.0;
  for (std::size_t begin = 0; begin < residuals.size();) {
    double sum = 0.0;
    double own = 0.0;
    std::size_t end = begin;
    for (; end < residuals.size() && blocks[end] == blocks[begin]; ++end) {
      sum += residuals[end];
      own += residuals[end] * residuals[end];
    }
    const auto size = static_cast<double>(end - begin);
    square += own;
    pairs += sum * sum - own;
    possible += size * (size - 1.0);
    squares_of_sizes += size * size;
    begin = end;
  }
  const auto count = static_cast<double>(residuals.size());
  if (count == 0.0 || possible == 0.0 || square == 0.0) return 1.0;
  const double correlation = std::clamp(pairs / possible / (square / count), 0.0, 1.0);
  const double size = squares_of_sizes / count;
  return 1.0 / (1.0 + (size - 1.0) * correlation);
}

double price_of_parameter(double effective_samples) {
  return 0.5 * std::log(std::max(1.0, effective_samples));
}

double price_of_choice(std::size_t count) {
  return std::log(static_cast<double>(std::max<std::size_t>(1, count)));
}

Explanation choose(std::span<const ScoredHypothesis> hypotheses) {
  require(!hypotheses.empty(), "choose: no hypothesis");
  const std::vector<HypothesisClass> classes = classes_of(hypotheses);
  Explanation out;
  out.best = texts_of(classes.front());
  out.unexplained = classes.front().members.front()->unexplained;
  out.remedy = classes.front().members.front()->remedy;
  out.likeliest = static_cast<std::size_t>(classes.front().members.front() - hypotheses.data());
  out.log_odds = std::numeric_limits<double>::infinity();
  if (classes.size() == 1) return out;
  out.second = texts_of(classes[1]);
  double others = kNone;
  for (std::size_t i = 1; i < classes.size(); ++i)
    others = log_of_sum(others, classes[i].log_evidence);
  out.log_odds = classes.front().log_evidence - others;
  return out;
}

}  // namespace frangia
