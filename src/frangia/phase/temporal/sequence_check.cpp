#include "frangia/phase/temporal/sequence_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frangia {
namespace {

std::string clause_of(const SequenceFault& fault) {
  const bool one = fault.patterns.size() == 1;
  std::string text =
      one ? fmt::format("pattern \"{}\" fits {}", fault.patterns.front(), fault.what)
          : fmt::format("patterns \"{}\" fit {}", fmt::join(fault.patterns, "\", \""), fault.what);
  if (!fault.same_as.empty())
    text += fmt::format(", which is the same as {}", fmt::join(fault.same_as, ", or "));
  return text + fmt::format(" ({})", fault.keys);
}

}  // namespace

std::string describe(const SequenceCheck& check) {
  if (!check.finding.empty()) return check.finding;
  const std::string names = fmt::format("\"{}\"", fmt::join(check.patterns, "\", \""));
  if (check.fits.size() == 1) return clause_of(check.fits.front());
  if (!check.fits.empty()) {
    std::vector<std::string> clauses;
    for (const SequenceFault& fault : check.fits)
      clauses.push_back(clause_of(fault));
    return fmt::format("the frames do not fit scan.toml, and they do not decide what does: {}",
                       fmt::join(clauses, ", or "));
  }
  if (check.patterns.size() == 1) {
    return fmt::format(
        "the frames of pattern {} do not fit its shifts, and no exchange of two frames does; "
        "check shifts_deg and the order of the frames",
        names);
  }
  if (check.split_rows > 0.0) {
    return fmt::format(
        "the patterns {} place both ends of the projector's field next to each other on the "
        "object; check their starts and periods",
        names);
  }
  return fmt::format(
      "the patterns {} disagree, and no change of one start, period, direction or order of frames "
      "makes them agree; check scan.toml against what was projected",
      names);
}

std::string describe(std::span<const SequenceCheck> checks) {
  std::string text;
  for (const SequenceCheck& check : checks)
    if (!check.consistent) text += (text.empty() ? "" : "; ") + describe(check);
  return text;
}

}  // namespace frangia
