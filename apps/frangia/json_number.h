#pragma once

#include <cmath>

#include <nlohmann/json.hpp>

namespace frangia {

/// A number for JSON; null for one that is missing.
inline nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

}  // namespace frangia
