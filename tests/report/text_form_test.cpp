// Texts with places for values: which text has which form, and that no text makes the search long.
#include "frangia/report/internal/text_form.h"

#include <string>

#include <gtest/gtest.h>

#include "frangia/report/internal/fault_rows.h"

namespace frangia::report {
namespace {

TEST(TextForm, FindsTheShortestValues) {
  Values values;
  ASSERT_TRUE(has_form("{0} of {1} in", "3 of 4 of 5 in", ValueKind::Clause, values));
  EXPECT_EQ(values[0], "3");
  EXPECT_EQ(values[1], "4 of 5");
  ASSERT_TRUE(has_form("bore {A}", "bore one", ValueKind::Clause, values));
  EXPECT_EQ(values[10], "one");
  EXPECT_FALSE(has_form("{0} of {1} in", "3 of 4", ValueKind::Clause, values));
}

TEST(TextForm, TellsClausesFromSentences) {
  Values values;
  EXPECT_FALSE(has_form("{0} mm", "a; b mm", ValueKind::Clause, values));
  EXPECT_TRUE(has_form("{0} mm", "a; b mm", ValueKind::Any, values));
  EXPECT_FALSE(has_form("{0} mm", " mm", ValueKind::Clause, values));
  EXPECT_TRUE(has_form("{0} mm", " mm", ValueKind::Any, values));
}

TEST(TextForm, CountsCharactersThatAreNoPlace) {
  EXPECT_EQ(fixed_of("{0} of {B} in"), 7U);
}

// A name of a plan may hold any number of separators.
TEST(TextForm, GivesUpWhereATextHasManySeparators) {
  std::string text;
  for (int i = 0; i < 5000; ++i)
    text += "; ";
  Values values;
  EXPECT_FALSE(has_form("{0}; {1}; {2}; {3}; {4}!", text, ValueKind::Any, values));
  EXPECT_EQ(worded_fault(text + "a", 1), text + "a");
}

}  // namespace
}  // namespace frangia::report
