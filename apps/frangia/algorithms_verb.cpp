#include <vector>

#include <nlohmann/json.hpp>

#include "frangia/phase/algorithm_errors.h"
#include "frangia/phase/published_algorithms.h"

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

void print_algorithms(const Terminal& terminal) {
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
  verb->footer("example:\n  frangia algorithms");
  verb->callback([&terminal] { print_algorithms(terminal); });
}

}  // namespace frangia
