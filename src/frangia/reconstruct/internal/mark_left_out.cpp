#include "frangia/reconstruct/internal/mark_left_out.h"

#include <cstddef>

namespace frangia {

void add_outliers(std::set<std::string>& names, const MeasuredSetup& setup) {
  if (!setup.registration) return;
  for (const std::size_t view : setup.registration->outliers)
    names.insert(setup.measured.stations[view].name);
}

void mark_left_out(std::vector<ViewSummary>& summaries,
                   const MeasuredSetup& joined,
                   const std::set<std::string>& outliers) {
  std::set<std::string> used;
  for (const Station& station : joined.measured.stations)
    used.insert(station.name);
  for (ViewSummary& view : summaries) {
    if (!used.contains(view.name) || outliers.contains(view.name)) view.left_out = true;
  }
}

}  // namespace frangia
