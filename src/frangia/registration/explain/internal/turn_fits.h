#pragma once

#include <cstddef>
#include <vector>

#include "frangia/registration/internal/optimize_bundle.h"

namespace frangia {

/// Turns of a view against another one that are compared: multiples of a step to either side.
struct TurnGrid {
  double step_rad = 0.0;
  int steps = 0;            ///< to either side
  std::size_t surfels = 0;  ///< of a view
  double gate_mm = 0.0;     ///< surfaces farther apart do not agree
  double margin_mm = 0.0;   ///< in front of another surface, from which on a point contradicts it
};

/// Compares all surfels of some views with those of others by the turn between the views, about the
/// axis of a state.
class TurnFits {
 public:
  /// @shape    turns are counted from the angles of `bundle.state`
  TurnFits(const Bundle& bundle, const TurnGrid& grid);

  /// How well two views fit with one turned against the other one, in pairs that agree and show the
  /// turn, less those that contradict.
  [[nodiscard]] double fit_of(std::size_t from, std::size_t to, double turn_rad) const;
  /// The same of all views, with changes of their angles.
  [[nodiscard]] double fit_of(const std::vector<double>& turned_rad) const;
  /// Of one view and all others, in both directions.
  [[nodiscard]] double fit_of_view(std::size_t view, const std::vector<double>& turned_rad) const;

 private:
  void compare(const Bundle& bundle, const SurfelLists& surfels, std::size_t at);

  TurnGrid grid_;
  std::size_t views_;
  ViewPairs pairs_;
  std::vector<std::vector<float>> fits_;  ///< of each view with each other, by turn
};

}  // namespace frangia
