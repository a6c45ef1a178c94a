#pragma once

#include <cmath>
#include <cstdint>

#include "frangia/core/angles.h"

namespace frangia {

/// Hashes a counter to 64 random bits. The result depends on the index only, not on the order of
/// the calls, so it is the same for any number of threads.
///
/// @source   splitmix64 (Steele, Lea & Flood 2014)
[[nodiscard]] constexpr std::uint64_t hash(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15U;
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
  return value ^ (value >> 31U);
}

/// Derives an independent stream for each index: hash(hash(seed, view), pattern), and so on.
[[nodiscard]] constexpr std::uint64_t hash(std::uint64_t stream, std::uint64_t index) {
  return hash(stream ^ hash(index));
}

/// Returns a uniform number in [0, 1).
[[nodiscard]] constexpr double uniform_from(std::uint64_t bits) {
  return static_cast<double>(bits >> 11U) * 0x1.0p-53;
}

/// Returns a normal number with mean 0 and variance 1.
///
/// @source   Box & Muller 1958
[[nodiscard]] inline double normal_from(std::uint64_t bits) {
  const double u = uniform_from(bits) + 0x1.0p-54;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(kTwoPi * uniform_from(hash(bits)));
}

}  // namespace frangia
