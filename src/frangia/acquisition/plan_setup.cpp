#include "frangia/acquisition/plan_setup.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

using Views = std::vector<ScanView>;

/// The views of the scan.toml in a folder, without its rig: a stored plan has no covariance file.
Views views_in(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder / "scan.toml", ignored)) return {};
  return read_scan(folder, {}, RigContent::PhaseOnly).views;
}

bool has_setup(const Views& views, int setup) {
  return std::any_of(
      views.begin(), views.end(), [&](const ScanView& view) { return view.setup == setup; });
}

/// Whether the first views of a stored setup are those of a plan.
bool begins_with(const Views& stored, const Views& plan) {
  return stored.size() >= plan.size() &&
         std::equal(plan.begin(), plan.end(), stored.begin(), [](const auto& a, const auto& b) {
           return std::abs(a.angle_rad - b.angle_rad) < 1e-6;  // they are stored as text
         });
}

}  // namespace

int last_setup(const std::filesystem::path& scan_folder) {
  int last = 0;
  for (const ScanView& view : views_in(scan_folder / "capture"))
    last = std::max(last, view.setup);
  return last;
}

Scan plan_setup(const Scan& plan, int setup) {
  require(setup >= 0, "`setup` must be 0 or more");
  const Views stored = views_in(plan.folder / "capture");
  if (setup > 0 && !has_setup(views_in(plan.folder), setup - 1)) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: setup {} is not captured; scan it first, before the part is turned "
                    "over for setup {}",
                    plan.folder.string(),
                    setup - 1,
                    setup));
  }
  Scan all = plan;
  const auto own = [&](const ScanView& view) { return view.setup == setup; };
  const auto begin = static_cast<std::size_t>(std::distance(
      stored.begin(), std::find_if(stored.begin(), stored.end(), own)));  // or behind all of them
  for (std::size_t i = 0; i < all.views.size(); ++i) {
    all.views[i].setup = setup;
    if (begin > 0) all.views[i].folder = fmt::format("views/{:03}", begin + i);
  }
  Views captured;
  std::copy_if(stored.begin(), stored.end(), std::back_inserter(captured), own);
  if (begins_with(captured, all.views)) {
    const auto added = captured.begin() + static_cast<std::ptrdiff_t>(all.views.size());
    all.views.insert(all.views.end(), added, captured.end());
  }
  Views others = stored;
  std::erase_if(others, own);
  const auto at = std::find_if(
      others.begin(), others.end(), [&](const ScanView& view) { return view.setup > setup; });
  all.views.insert(all.views.begin(), others.begin(), at);
  all.views.insert(all.views.end(), at, others.end());
  return all;
}

}  // namespace frangia
