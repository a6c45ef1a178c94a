#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace frangia {

/// Smooth deviation of an interferometer's fringes from even ones, by lenses and mirrors that are
/// not ideal: what is added to psi. Its coordinates are u, psi from the middle of the field, and v,
/// the tangent of the elevation over the fringes' plane, both over half the field, so that each
/// coefficient is the deviation that it makes at the edge of the field.
///
/// A constant, u, v and u v are left out: they are rotations of the projector and its pitch.
struct Wavefront {
  static constexpr std::size_t kTerms = 6;  ///< number of coefficients
  /// Names of the terms, in the order of the coefficients.
  static constexpr std::array<const char*, kTerms> kNames = {
      "uu", "vv", "uuu", "uuv", "uvv", "vvv"};
  /// The coefficients of the second order come first.
  static constexpr std::size_t kSecondOrder = 2;

  /// Name of a term among the parameters of a rig.
  [[nodiscard]] static std::string parameter_name(std::size_t term) {
    return std::string("projector.wavefront_") + kNames.at(term) + "_rad";
  }

  std::array<double, kTerms> coefficients_rad{};  ///< in the order of `kNames`

  /// Whether the fringes are even.
  [[nodiscard]] bool is_plane() const {
    return std::all_of(
        coefficients_rad.begin(), coefficients_rad.end(), [](double c) { return c == 0.0; });
  }

  /// Deviation at a place of the field for any type of number.
  template <typename T>
  [[nodiscard]] static T deviation(const T* coefficients, const T& u, const T& v) {
    return u * u * (coefficients[0] + coefficients[2] * u + coefficients[3] * v) +
           v * v * (coefficients[1] + coefficients[4] * u + coefficients[5] * v);
  }
};

}  // namespace frangia
