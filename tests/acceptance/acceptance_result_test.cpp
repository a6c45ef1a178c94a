// Plans of acceptance tests, and decisions about errors that are known.
#include "frangia/acceptance/acceptance_result.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "frangia/acceptance/acceptance_plan.h"
#include "frangia/acceptance/certificate.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

AcceptancePlan plan_of_text(const std::string& text) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.path() / "acceptance.toml")
      << "format = \"frangia-acceptance\"\nversion = 1\n"
      << text;
  return read_acceptance_plan(folder.path() / "acceptance.toml");
}

AcceptancePlan bar_plan() {
  AcceptancePlan plan;
  plan.artifact = {.diameters_mm = {30.0, 30.0}, .spacing_mm = 70.0, .u95_mm = 0.002};
  plan.volume_mm = Eigen::Vector3d(100.0, 100.0, 100.0);
  plan.arrangements = usual_arrangements(plan.artifact);
  return plan;
}

/// Seven arrangements without errors, with the form 0.01 mm.
std::vector<ArrangementResult> exact_results() {
  std::vector<ArrangementResult> results(7);
  for (ArrangementResult& result : results) {
    MeasuredBall ball;
    ball.diameter_mm = 30.0;
    ball.form_95_mm = 0.01;
    ball.form_all_mm = 0.02;
    result.measured = {{ball, ball}, 70.0, 100.0};
  }
  return results;
}

const AcceptanceQuantity& quantity_of(const AcceptanceResult& result, const std::string& symbol) {
  for (const AcceptanceQuantity& quantity : result.quantities)
    if (quantity.symbol == symbol) return quantity;
  throw std::out_of_range(symbol);
}

TEST(AcceptanceResult, TakesTheWorstOfAllArrangementsWithItsSign) {
  AcceptancePlan plan = bar_plan();
  plan.limits = {0.03, 0.02, 0.02, 0.03};
  auto results = exact_results();
  results[2].measured.spacing_mm = 70.01;
  results[4].measured.spacing_mm = 69.985;
  results[5].measured.balls[1].diameter_mm = 30.004;
  results[6].measured.length_mm = 100.012;
  const AcceptanceResult result = acceptance_result(plan, results);
  EXPECT_NEAR(quantity_of(result, "SD").error_mm, -0.015, 1e-12);
  EXPECT_EQ(quantity_of(result, "SD").arrangement, 4U);
  EXPECT_NEAR(quantity_of(result, "P_Size.Sph.All").error_mm, 0.004, 1e-12);
  EXPECT_NEAR(quantity_of(result, "E").error_mm, 0.012, 1e-12);
  EXPECT_EQ(result.conformity, Conformity::In);
  EXPECT_TRUE(result.incomplete.empty());
}

TEST(AcceptanceResult, CountsTheUncertaintyOfTheArtifact) {
  AcceptancePlan plan = bar_plan();
  plan.limits.sphere_spacing_mm = 0.02;
  auto results = exact_results();
  // Standard uncertainty 0.001, guard band 1.645: in to 0.01836, out from 0.02164.
  for (const auto& [error, expected] : {std::pair{0.0183, Conformity::In},
                                        {0.0185, Conformity::Undecided},
                                        {0.0215, Conformity::Undecided},
                                        {0.0217, Conformity::Out}}) {
    results[0].measured.spacing_mm = 70.0 + error;
    EXPECT_EQ(acceptance_result(plan, results).conformity, expected) << error;
  }
  // A temperature that is known to 1 K: 70 mm, 20e-6/K, k = 2 add 0.0028 mm.
  plan.artifact.expansion_ppm_per_k = 20.0;
  plan.temperature_u_k = 1.0;
  EXPECT_NEAR(
      quantity_of(acceptance_result(plan, results), "SD").u95_mm, std::hypot(0.002, 0.0028), 1e-9);
}

TEST(AcceptanceResult, CorrectsTheTemperature) {
  AcceptancePlan plan = bar_plan();
  plan.artifact.expansion_ppm_per_k = 10.0;
  plan.temperature_c = 30.0;
  const MeasuredArtifact at20 = at_reference_temperature(exact_results()[0].measured, plan);
  EXPECT_NEAR(at20.spacing_mm, 70.0 / 1.0001, 1e-9);
  EXPECT_NEAR(at20.balls[0].diameter_mm, 30.0 / 1.0001, 1e-9);
}

TEST(AcceptanceResult, SaysWhatAWholeTestLacks) {
  AcceptancePlan plan = bar_plan();
  auto results = exact_results();
  results.resize(5);
  plan.volume_mm = Eigen::Vector3d(300.0, 300.0, 300.0);
  const AcceptanceResult result = acceptance_result(plan, results);
  ASSERT_EQ(result.incomplete.size(), 2U);
  EXPECT_EQ(result.incomplete[0], "5 of 7 arrangements");
  EXPECT_NE(result.incomplete[1].find("a spacing of at least 156 mm"), std::string::npos);
  EXPECT_FALSE(result.judged);
  EXPECT_NE(sentence_of(result).find("not judged"), std::string::npos);
  for (auto& each : results)
    each.measured.length_mm = kMissing;
  EXPECT_EQ(acceptance_result(plan, results).quantities.size(), 4U);
}

TEST(Certificate, HoldsEveryFigureAndEscapesTexts) {
  AcceptancePlan plan = bar_plan();
  plan.limits.sphere_spacing_mm = 0.02;
  plan.conditions = {{"operator", "A <b> & C"}};
  auto results = exact_results();
  for (auto& each : results)
    each = {"level", "scan-1", "abc123", 42, each.measured};
  results[1].measured.spacing_mm = 70.1;
  const AcceptanceResult result = acceptance_result(plan, results);
  const std::string html =
      certificate_html(plan, results, result, {"now", "Frangia", "rig", "", {}});
  for (const char* part : {"exceeds its limits", "+100.0", "20.0", "abc123", "A &lt;b&gt; &amp; C"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

TEST(AcceptancePlan, NamesTheKeyThatIsWrong) {
  constexpr const char* kArtifact =
      "[artifact]\ndiameters_mm = [30.0, 30.0]\nspacing_mm = 70.0\nu95_mm = 0.001\n";
  const auto error = [&](const std::string& head, const std::string& tail) {
    return testing::error_of([&] { (void)plan_of_text(head + kArtifact + tail); });
  };
  EXPECT_NE(error("source = \"cloud\"\n", "").find("scans, devices or simulation"),
            std::string::npos);
  EXPECT_NE(error("source = \"scans\"\n", "").find("arrangements"), std::string::npos);
  EXPECT_NE(error("source = \"devices\"\n", "").find("rig"), std::string::npos);
  EXPECT_NE(error("source = \"simulation\"\nrig = \"digital\"\n", "[limits]\nlength_mm = -1\n")
                .find("length_mm"),
            std::string::npos);
  EXPECT_NE(testing::error_of([] {
              (void)plan_of_text(
                  "source = \"devices\"\nrig = \"r.toml\"\n[artifact]\n"
                  "diameters_mm = [40.0, 40.0]\nspacing_mm = 30\nu95_mm = 0.001\n");
            }).find("overlap"),
            std::string::npos);
  EXPECT_NE(error("source = \"simulation\"\nrig = \"digital\"\n", "[limits]\nlenght_mm = 1\n")
                .find("limits.lenght_mm is unknown here; perhaps length_mm was meant"),
            std::string::npos);
  EXPECT_EQ(plan_of_text(std::string("source = \"simulation\"\nrig = \"digital\"\n") + kArtifact)
                .arrangements.size(),
            7U);
}

}  // namespace
}  // namespace frangia
