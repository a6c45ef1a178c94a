#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/phase/algorithm/algorithm_errors.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/algorithm/published_algorithms.h"

#include "print_text.h"
#include "verbs.h"

namespace frangia {
namespace {

/// Ripple at step errors from -10 to 10 %, for plots.
std::vector<double> ripples(const PublishedAlgorithm& published, bool step_known) {
  const auto shifts = example_shifts(published);
  std::vector<double> values;
  for (int percent = -10; percent <= 10; ++percent) {
    const double error = 0.01 * percent;
    values.push_back(
        ripple(make_algorithm(published.name, shifts, step_known ? error : 0.0), shifts, error));
  }
  return values;
}

/// The frames of an algorithm of the user, in words.
std::string frames_of(const LinearAlgorithm& own) {
  const double step = common_step(own.shifts_rad);
  if (std::isnan(step)) return fmt::format("{} frames, unequal steps", own.shifts_rad.size());
  return fmt::format(
      "{} frames {:g} degrees apart", own.shifts_rad.size(), std::abs(deg_from_rad(step)));
}

void print_algorithms(const std::string& own_path, Terminal& terminal) {
  std::optional<LinearAlgorithm> own;
  if (!own_path.empty()) own = read_algorithm(own_path, terminal.run());
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  if (!terminal.json) {
    print_text("{:<14}{:<36}{:>11}{:>8}{:>7}{:>7}  {}\n",
               "algorithm",
               "frames",
               "ripple/rad",
               "noise",
               "h2",
               "h3",
               "source");
  }
  for (const PublishedAlgorithm& published : published_algorithms()) {
    const auto shifts = example_shifts(published);
    const bool step_known =
        published.rule == ShiftRule::ManyEqual || published.rule == ShiftRule::ManyUneven;
    const AlgorithmErrors errors =
        algorithm_errors(make_algorithm(published.name, shifts), shifts, step_known);
    if (terminal.json) {
      json.push_back({{"name", published.name},
                      {"frames", describe_frames(published)},
                      {"ripple_rad", errors.ripple_rad},
                      {"ripple_by_percent", ripples(published, step_known)},
                      {"noise_gain", errors.noise_gain},
                      {"second_harmonic", errors.second_harmonic},
                      {"third_harmonic", errors.third_harmonic},
                      {"source", published.source}});
      continue;
    }
    print_text("{:<14}{:<36}{:>11.6f}{:>8.3f}{:>7.2f}{:>7.2f}  {}\n",
               published.name,
               describe_frames(published),
               errors.ripple_rad,
               errors.noise_gain,
               errors.second_harmonic,
               errors.third_harmonic,
               published.source);
  }
  if (own) {
    const AlgorithmErrors errors = algorithm_errors(own->algorithm, own->shifts_rad);
    if (terminal.json) {
      json.push_back({{"name", own->algorithm.name},
                      {"frames", frames_of(*own)},
                      {"ripple_rad", errors.ripple_rad},
                      {"noise_gain", errors.noise_gain},
                      {"second_harmonic", errors.second_harmonic},
                      {"third_harmonic", errors.third_harmonic},
                      {"source", own_path}});
    } else {
      print_text("{:<14}{:<36}{:>11.6f}{:>8.3f}{:>7.2f}{:>7.2f}  {}\n",
                 own->algorithm.name,
                 frames_of(*own),
                 errors.ripple_rad,
                 errors.noise_gain,
                 errors.second_harmonic,
                 errors.third_harmonic,
                 own_path);
    }
  }
  if (terminal.json) {
    print_json(json);
    return;
  }
  print_text(
      "\nripple: peak-to-valley phase error at a step error of 5 %; noise: c in sigma_phi = c "
      "sigma_I "
      "/ B;\nh2, h3: phase error per relative amplitude of the second or third harmonic. N = 6 "
      "where "
      "N is free,\n4 frames for global-carre.\n");
}

}  // namespace

void add_algorithms_verb(CLI::App& program, Terminal& terminal) {
  CLI::App* verb =
      program.add_subcommand("algorithms", "list the phase-shift algorithms and their errors");
  verb->footer("example:\n  frangia algorithms\n  frangia algorithms my-algorithm.toml");
  auto own = std::make_shared<std::string>();
  verb->add_option("FILE", *own, "an algorithm of yours, which becomes the last row");
  verb->callback([own, &terminal] { print_algorithms(*own, terminal); });
}

}  // namespace frangia
