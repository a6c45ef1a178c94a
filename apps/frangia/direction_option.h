#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "frangia/simulate/default_patterns.h"

#include "option_values.h"

namespace frangia {

/// Adds --direction. `plan` must outlive the verb.
inline void add_direction_option(CLI::App& verb, PatternPlan& plan) {
  verb.add_option_function<std::string>(
          "--direction",
          [&plan](const std::string& name) { plan.direction = find_named<FringeDirection>(name); },
          "digital projector: vertical or horizontal fringes; by default those that measure depth, "
          "as the projector stands to the camera")
      ->check(one_of(all_names<FringeDirection>()));
}

}  // namespace frangia
