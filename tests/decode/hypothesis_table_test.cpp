// The table of hypotheses is computed from the hypotheses, and their classes are those of algebra.
#include "frangia/decode/explain/hypothesis_table.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace frangia {
namespace {

std::vector<std::string> causes_beside(const std::string& cause, int steps) {
  for (const AlikeCauses& one : alike_causes()) {
    const bool has = std::find(one.causes.begin(), one.causes.end(), cause) != one.causes.end();
    if (one.steps == steps && has) return one.causes;
  }
  return {};
}

TEST(HypothesisTable, ThreeStepsDoNotTellAnExchangeFromADirection) {
  const std::vector<std::string> expected{"as-described", "direction", "exchanged", "start"};
  EXPECT_EQ(causes_beside("direction", 3), expected);
}

TEST(HypothesisTable, SixStepsTellAllCausesButStartAndDirection) {
  const std::vector<std::string> expected{"as-described", "direction", "start"};
  EXPECT_EQ(causes_beside("direction", 6), expected);
  // Frames 0 and 2 exchanged are frames 3 and 5 exchanged, seen in the other direction.
  EXPECT_EQ(causes_beside("exchanged", 6), std::vector<std::string>{"exchanged"});
  EXPECT_TRUE(causes_beside("repeated", 6).empty());
}

TEST(HypothesisTable, CountsTheHypothesesOfEachNumberOfSteps) {
  const std::vector<CauseRow> rows = hypothesis_table();
  const auto lost = std::find_if(
      rows.begin(), rows.end(), [](const CauseRow& row) { return row.cause == "lost"; });
  ASSERT_NE(lost, rows.end());
  EXPECT_EQ(lost->counts, (std::vector<std::size_t>{3, 4, 5, 6, 8, 12}));
}

}  // namespace
}  // namespace frangia
