// The sentence about a verdict, clause by clause.
#include "frangia/inspect/verdict_clause.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/measured_plate.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using testing::distance_from;
using testing::Plate;

const ClauseValue& value_of(const VerdictClause& clause, std::string_view name) {
  const auto found = std::find_if(clause.values.begin(), clause.values.end(), [&](const auto& one) {
    return one.first == name;
  });
  EXPECT_NE(found, clause.values.end()) << name;
  return found->second;
}

double number_of(const VerdictClause& clause, std::string_view name) {
  return std::get<double>(value_of(clause, name));
}

TEST(VerdictClause, StatesTheValuesThatItsTextNames) {
  Plate plate;
  plate.raise([](const Vector3f& at) { return distance_from(at, 20, 40) < 5.0 ? -0.3 : 0.0; });
  const SurfaceVerdict verdict = plate.verdict({.limits = {-0.05, 0.05}});
  const auto clauses = clauses_of(verdict);
  ASSERT_GE(clauses.size(), 2U);
  EXPECT_EQ(clauses[0].id, "out_at");
  EXPECT_NEAR(number_of(clauses[0], "deviation_mm"), -0.3, 0.01);
  EXPECT_NEAR(
      (std::get<Vector3d>(value_of(clauses[0], "at_mm")) - Vector3d(20, 40, 0)).norm(), 0.0, 6.0);
  EXPECT_EQ(clauses[1].id, "out_share");
  EXPECT_NEAR(number_of(clauses[1], "share"), 3.14159 * 25.0 / 3600.0, 0.01);
  EXPECT_EQ(sentence_of(verdict).find(clauses[0].text + "; " + clauses[1].text), 0U);
}

TEST(VerdictClause, NamesTheReasonAndWhatToDoOneByOne) {
  Plate noisy;
  noisy.mesh().sigma_mm.assign(noisy.mesh().vertices_mm.size(), 0.04F);
  const auto clauses =
      clauses_of(noisy.verdict({.limits = {-0.1, 0.1}, .max_uncertainty_share = 0.25}));
  ASSERT_GE(clauses.size(), 3U);
  EXPECT_EQ(clauses[0].id, "too_noisy");
  EXPECT_NEAR(number_of(clauses[0], "u95_mm"), 0.025, 1e-9);
  EXPECT_NEAR(number_of(clauses[0], "share"), 1.0, 0.01);
  EXPECT_EQ(clauses[1].id, "reduce_noise");
  EXPECT_EQ(clauses[2].id, "gap_too_wide");  // all of the plate
  Plate hole;
  hole.remove([](const Vector3f& at) { return distance_from(at, 30, 30) < 10.2; });
  const auto open = clauses_of(hole.verdict({.limits = {-0.05, 0.05}}));
  EXPECT_EQ(open[0].id, "not_measured");
  EXPECT_NEAR(number_of(open[0], "gap_mm"), 20.0, 4.0);
  EXPECT_EQ(open[1].id, "scan_more");
}

}  // namespace
}  // namespace frangia
