#include "frangia/reconstruct/internal/trust.h"

#include <algorithm>

#include <fmt/format.h>

namespace frangia {
namespace {

/// States that a view and an earlier one hold the same frames; empty otherwise.
std::string copy_text(const ViewSummary& view) {
  if (view.same_as.empty()) return {};
  return fmt::format(
      "{} and {} hold the same frames to the last count, so that one of them is a copy; capture "
      "both again",
      view.same_as,
      view.name);
}

}  // namespace

bool blames_rig(const std::optional<RegistrationReport>& registration) {
  return registration && registration->explanation.best == PoseCause::Rig &&
         registration->explanation.decided;
}

void warn_of_copies(std::span<const ViewSummary> views, const Run& run) {
  const auto is_left_out = [&](const std::string& name) {
    return std::any_of(views.begin(), views.end(), [&](const ViewSummary& view) {
      return view.name == name && view.left_out;
    });
  };
  for (const ViewSummary& view : views) {
    if (!view.same_as.empty() && (view.left_out || is_left_out(view.same_as)))
      run.warn(copy_text(view));
  }
}

bool withdraw_explanations(std::vector<MeasuredSetup>& setups) {
  bool any = false;
  for (MeasuredSetup& setup : setups) {
    if (!setup.registration) continue;
    PoseExplanation& found = setup.registration->explanation;
    const bool moved = found.decided && found.best != PoseCause::AsStated;
    if (!moved && setup.registration->untrusted_reason().empty()) continue;
    found = PoseExplanation{};
    any = true;
  }
  return any;
}

std::string untrusted_reason_of(const Reconstruction& result, bool relative) {
  for (const RigAgreement& agreement : result.agreements) {
    if (agreement.contradicts()) return agreement.text();
  }
  if (relative) {
    return "the views do not fit together: the frames do not tell which fringe is which, so that "
           "each view may be off by whole fringes; capture coarser fringes or a Gray code, too, or "
           "the laser sheet";
  }
  std::string reason;
  if (result.registration) reason = result.registration->untrusted_reason();
  if (reason.empty() && result.silhouettes && result.silhouettes->contradicts())
    reason = result.silhouettes->text();
  if (reason.empty() && blames_rig(result.registration)) {
    reason =
        "the views show that the rig is not what rig.toml states, and do not determine how: "
        "calibrate the rig again";
  }
  if (reason.empty()) return reason;
  // Camera noise makes each capture another one. Without noise, views of a round part may be equal,
  // but then they do not contradict each other.
  for (const ViewSummary& view : result.view_summaries)
    if (!view.same_as.empty()) return copy_text(view);
  return reason;
}

}  // namespace frangia
