#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/registration/register_views.h"

namespace frangia {

/// Whether all stations state when they were taken.
[[nodiscard]] bool are_times_stated(std::span<const Station> stations);

/// When the stations were taken, from -0.5 to 0.5: by their times, else evenly in their order.
[[nodiscard]] std::vector<double> times_of(std::span<const Station> stations);

/// The courses that a drift may take between the first view and the last: even; a warm-up or a
/// settling, 1 - exp(-t / tau), for some tau; and a smooth one, by polynomials up to the third
/// degree.
inline constexpr std::size_t kTimeProfiles = 9;
/// The smooth one, which is near to all others.
inline constexpr std::size_t kSmoothProfile = kTimeProfiles - 1;

/// The functions of time that one of them consists of, each by one standard deviation: a course of
/// one function goes from -0.5 to 0.5.
///
/// @shape    `times`: of each view, from -0.5 to 0.5; views x functions
[[nodiscard]] Eigen::MatrixXd time_profile(std::size_t profile, std::span<const double> times);

/// Orthonormal functions of which all courses, and what does not change, consist.
///
/// @shape    views x functions; as many as views where they are few
[[nodiscard]] Eigen::MatrixXd basis_of_profiles(std::span<const double> times);

/// Orthonormal functions of which changes of a rig consist: those of each view, where they are not
/// too many, so that a rig may change at once; else those of all courses.
///
/// @shape    views x functions
[[nodiscard]] Eigen::MatrixXd basis_of_rigs(std::span<const double> times);

/// Of a warm-up, as a share of the time between the first view and the last.
///
/// @missing  NaN for the other courses
[[nodiscard]] double time_constant_of(std::size_t profile);

}  // namespace frangia
