#include "frangia/scan_plan/scan_until.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/reconstruct/reconstruct.h"

namespace frangia {
namespace {

/// Where the stations of a round lie between those of the first, of their distance.
constexpr std::array<double, 8> kBetween{0.0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875};

/// Adds the stations of a round: those of the first one, turned by a part of their distance.
void add_round(Scan& plan, const std::vector<ScanView>& first, std::size_t round) {
  const double step_rad = kTwoPi / static_cast<double>(first.size());
  for (ScanView view : first) {
    view.angle_rad += kBetween.at(round) * step_rad;
    view.folder = fmt::format("views/{:03}", plan.views.size());
    plan.views.push_back(std::move(view));
  }
}

/// Why no further round is worth its time; nothing: it is.
std::optional<ScanStop> stop_after(const std::vector<ScanRound>& rounds, Conformity verdict) {
  const ScanReach& last = rounds.back().reach;
  if (verdict != Conformity::Undecided || last.need == ScanNeed::Nothing) return ScanStop::Decided;
  // Also what is alike in all stations may shrink: more of them overlap, which determines the axis
  // of the turntable.
  if (rounds.size() < 2 || decides_more(last, rounds[rounds.size() - 2].reach)) return std::nullopt;
  if (last.need == ScanNeed::Calibration) return ScanStop::Rig;
  return last.need == ScanNeed::Coverage ? ScanStop::NotSeen : ScanStop::NotHelped;
}

}  // namespace

ScanUntil scan_until(const Scan& plan,
                     const CaptureViews& capture,
                     const InspectionReference& reference,
                     const InspectionPlan& inspection,
                     std::size_t most_rounds,
                     const Run& run) {
  most_rounds = std::min(most_rounds, kBetween.size());
  require(most_rounds > 0 && !plan.views.empty(), "a scan needs a round and a view");
  InspectionPlan wanted = inspection;
  if (wanted.align.empty()) wanted.align = "best-fit";
  ScanUntil done;
  Scan planned = plan;
  for (std::size_t round = 0; round < most_rounds; ++round) {
    if (round > 0) add_round(planned, plan.views, round);
    const Scan scan = capture(planned);
    if (!done.rounds.empty() && scan.views.size() == done.rounds.back().stations) continue;
    const InspectOptions options{.statistics = false, .scan = &scan, .mesh_name = scan.folder};
    done.found = inspect_part(reconstruct(scan, {}, run).mesh, &reference, wanted, options, run);
    done.rounds.push_back(
        {scan.views.size(), reach_of(done.found, wanted.surface.well_measured_share())});
    if (const auto stop = stop_after(done.rounds, done.found.verdict)) {
      done.stop = *stop;
      return done;
    }
    const ScanRound& last = done.rounds.back();
    run.note(fmt::format("{} stations decide {} of the nominal area; more are added for {}",
                         last.stations,
                         share_text(last.reach.decidable_share),
                         name_of(last.reach.need)));
  }
  return done;
}

std::string text_of(ScanStop stop) {
  constexpr std::array<const char*, 5> kTexts{
      "all that has a tolerance is decided",
      "further stations do not see what lacks; turn the part over, and add it as another `setup`",
      "further stations do not make it certain enough; set a longer `exposure`, finer fringes or "
      "more `shifts`",
      "the uncertainty of the rig is too large for the tolerance; calibrate again, or state a "
      "tolerance that this rig can decide",
      "more stations may still help; scan again with more `views`"};
  return kTexts.at(static_cast<std::size_t>(stop));
}

}  // namespace frangia
