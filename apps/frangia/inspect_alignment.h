#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

#include "frangia/align/align_best_fit.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// Options of the alignment of a mesh to its reference.
struct AlignmentArguments {
  std::string align;                 ///< empty: as it stands, without a word about the alignment
  std::size_t start = 0;             ///< of poses that fit alike, counted from 1; 0: none chosen
  std::optional<double> unit_mm;     ///< of the reference; none: not stated
  std::vector<double> tolerance_mm;  ///< one: plus and minus; two: lower and upper; none: chosen

  /// The tolerance band; plus and minus 0.1 mm where none is stated.
  [[nodiscard]] ToleranceLimits band() const;
  /// The deviation that still counts as overlap; 0: chosen by the size of the reference.
  [[nodiscard]] double overlap_tolerance_mm() const;
  /// What aligning needs of them.
  [[nodiscard]] BestFitOptions best_fit() const;
};

/// Adds the options.
void add_alignment_options(CLI::App& verb, AlignmentArguments& arguments);

/// The pose that the options ask for.
[[nodiscard]] Alignment align(const Mesh& mesh,
                              const RayScene& reference,
                              const AlignmentArguments& arguments,
                              const Run& run);

/// Adds `alignment` and `alignment_details`.
void add_alignment(nlohmann::ordered_json& json, const Alignment& alignment);

/// The alignment in a line or more, for people.
[[nodiscard]] std::string alignment_text(const Alignment& alignment);

}  // namespace frangia
