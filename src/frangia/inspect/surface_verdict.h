#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/enum_names.h"
#include "frangia/core/missing.h"
#include "frangia/inspect/surface_patches.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// How the deviations of a surface are decided.
struct SurfaceRule {
  ToleranceLimits limits{-0.1, 0.1};  ///< of the deviation, mm
  /// Diameter of the patches; 0: twice the mean spacing of the vertices, 4 % of the size at most.
  double min_feature_mm = 0.0;
  /// Width of the strips along edges of the reference that are not judged; 0: none. Nothing:
  /// `default_edge_mm`.
  std::optional<double> edge_mm;
  /// Largest U95 that proves "in", of the half-width: the guard band is the proof, but an interval
  /// wider than the tolerance proves nothing.
  double max_uncertainty_share = 1.0;
  double min_coverage = 0.9;          ///< least share of the nominal area that is decided
  double max_gap_mm = 0.0;            ///< widest gap; 0: a tenth of the reference's diagonal
  std::vector<ExcludedBox> excluded;  ///< parts of the reference that are not judged

  /// Largest U95 of what is measured well, of the half-width: a quarter, and
  /// `max_uncertainty_share` at most. Scans are planned for it.
  [[nodiscard]] double well_measured_share() const;

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// The decision about a patch of the surface.
enum class PatchDecision : std::uint8_t {
  In,               ///< proven to be within the limits
  Out,              ///< proven to be beyond a limit, or its material is missing
  NearLimit,        ///< within the guard band of a limit
  NotWellMeasured,  ///< its U95 is too large to decide
  NotMeasured,      ///< nothing was compared
  AtEdge            ///< not judged: in a strip along an edge
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(PatchDecision /*any*/) {
  return EnumNames<PatchDecision, 6>{{{PatchDecision::In, "in"},
                                      {PatchDecision::Out, "out"},
                                      {PatchDecision::NearLimit, "near_limit"},
                                      {PatchDecision::NotWellMeasured, "not_well_measured"},
                                      {PatchDecision::NotMeasured, "not_measured"},
                                      {PatchDecision::AtEdge, "at_edge"}}};
}
inline constexpr std::size_t kPatchDecisions = 6;  ///< number of values of `PatchDecision`

/// A connected part of the surface whose patches were decided alike.
struct SurfacePlace {
  PatchDecision decision = PatchDecision::In;         ///< never `In` or `AtEdge`
  Eigen::Vector3d at_mm = Eigen::Vector3d::Zero();    ///< its worst patch
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of the nominal surface there
  double deviation_mm = kMissing;                     ///< of that patch; NaN: not measured
  double u95_mm = kMissing;                           ///< of that patch
  double area_mm2 = 0.0;                              ///< nominal
  bool missing = false;  ///< surface was measured behind the nominal one
};

/// An extreme of the deviations, and where.
struct Extreme {
  double deviation_mm = kMissing;                     ///< signed
  double u95_mm = kMissing;                           ///< NaN when no uncertainty is known
  Eigen::Vector3d at_mm = Eigen::Vector3d::Zero();    ///< frame of the reference
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of the nominal surface there
};

/// Why a surface is undecided.
enum class UndecidedReason : std::uint8_t {
  None,         ///< it is decided
  NotMeasured,  ///< too little was measured, or a gap is too wide
  Noise,        ///< noise makes the uncertainty too large
  Systematic,   ///< calibration, alignment or temperature make it too large
  NearLimit     ///< values lie within the guard band of a limit
};

/// The decision about a surface. Shares are of the nominal area, less what is excluded and the
/// strips along edges; they sum to 1, that of `AtEdge` is 0.
struct SurfaceVerdict {
  Conformity conformity = Conformity::Undecided;   ///< of the surface
  UndecidedReason reason = UndecidedReason::None;  ///< the one of the largest share
  SurfaceRule rule;                                ///< with the values that were chosen
  std::array<double, kPatchDecisions> share{};     ///< by `PatchDecision`
  double coverage = 0.0;                           ///< share that is decided
  double area_mm2 = 0.0;    ///< nominal, less what is excluded and the strips along edges
  double edge_share = 0.0;  ///< of the strips, of the nominal area with them
  double gap_mm = 0.0;      ///< width of the widest gap
  Eigen::Vector3d gap_at_mm = Eigen::Vector3d::Zero();  ///< its middle
  std::size_t patches = 0;                              ///< that were decided
  std::size_t independent = 0;                          ///< effective number of those
  bool uncertainty_known = true;                        ///< as in `SurfacePatches`
  double noise_factor = 1.0;                            ///< as in `SurfacePatches`
  double median_u_mm = kMissing;                        ///< of a patch; NaN when none is known
  /// Least half-width of a tolerance, about the middle of this one, for which `min_coverage` of the
  /// nominal area is proven in and no value is near a limit, gaps aside; NaN when too little was
  /// measured for any, or no uncertainty is known.
  double decidable_mm = kMissing;
  Extreme lowest;                    ///< of the patches
  Extreme highest;                   ///< of the patches
  std::vector<SurfacePlace> places;  ///< those that are out or undecided, the worst first

  [[nodiscard]] double share_of(PatchDecision decision) const;  ///< of the nominal area
};

/// Decides about a surface by ISO 14253-1:2017, patch by patch.
///
/// Where no uncertainty is known, the limits alone decide. In: each patch that is measured well
/// lies inside of both limits by 1.645 u, at least `min_coverage` of the nominal area is decided,
/// and no gap is wider than `max_gap_mm`. Out: a patch lies beyond a limit by the guard band for
/// the effective number of independent patches, or its material is missing.
/// @errors   Error(Input) as SurfaceRule::check
/// @source   ISO 14253-1:2017, 5.2 and 5.3; Bonferroni's inequality
[[nodiscard]] SurfaceVerdict judge_surface(const SurfacePatches& patches, const SurfaceRule& rule);

/// The patches of `deviations` by the rule, and the decision about them.
///
/// @errors   Error(Input) as surface_patches and SurfaceRule::check; Error(Cancelled)
[[nodiscard]] SurfaceVerdict judge_surface(const Mesh& mesh,
                                           const Deviations& deviations,
                                           const RayScene& reference,
                                           const SurfaceRule& rule,
                                           const Run& run = {});

/// The verdict in a sentence: "in, over 97.3 % of the nominal area"; of an undecided surface the
/// reason that matters most, and what to do.
[[nodiscard]] std::string sentence_of(const SurfaceVerdict& verdict);

/// A share as percent with one decimal; what is not all or nothing does not read as if it were.
[[nodiscard]] std::string share_text(double share);

/// A place as "(1.00, -2.50, 30.00) mm".
[[nodiscard]] std::string place_text(const Eigen::Vector3d& at_mm);

}  // namespace frangia
