#include "frangia/views/sigma_terms.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"

namespace frangia {
namespace {

/// A term that is alike at all pixels.
SigmaTerm term_of(UncertaintyTerm term, float part_mm) {
  return {term, [part_mm](const View& view, std::size_t camera) {
            const Image<float>& depth = view.range.depth_mm;
            return Image<float>(
                depth.width(), depth.height(), static_cast<float>(camera + 1) * part_mm);
          }};
}

View view_of_three_points() {
  View view;
  view.range = {Image<float>(4, 1, 500.0F), Image<float>(4, 1, 0.01F)};
  view.range.depth_mm(2, 0) = kMissing;
  view.range.sigma_mm(2, 0) = kMissing;
  return view;
}

TEST(SigmaTerms, CombineWithWhatIsStoredAndEachOther) {
  View view = view_of_three_points();
  view.range.systematic_mm = Image<float>(4, 1, 0.03F);
  view.range.differing_share = 1.0F;
  const std::vector<SigmaTerm> terms{term_of(UncertaintyTerm::Calibration, 0.02F),
                                     term_of(UncertaintyTerm::Turntable, 0.06F)};
  const Image<float> differing = add_terms(view, 1, terms);
  EXPECT_FLOAT_EQ(view.range.systematic_mm(0, 0), std::hypot(0.03F, 0.04F, 0.12F));
  EXPECT_TRUE(std::isnan(view.range.systematic_mm(2, 0)));
  EXPECT_EQ(view.range.differing_share, 0.0F);
  // The errors of the turntable differ from view to view, those of the rig do not.
  ASSERT_FALSE(differing.empty());
  EXPECT_FLOAT_EQ(differing(0, 0), 0.12F);
}

TEST(SigmaTerms, SayNothingOfAViewWithoutAnImage) {
  View view = view_of_three_points();
  const std::vector<SigmaTerm> terms{
      {UncertaintyTerm::IndirectLight, [](const View&, std::size_t) { return Image<float>(); }}};
  EXPECT_TRUE(add_terms(view, 0, terms).empty());
  EXPECT_TRUE(view.range.systematic_mm.empty());
}

TEST(SigmaTerms, CountAsNothingWhereTheyAreNotKnown) {
  View view = view_of_three_points();
  SigmaTerm partly = term_of(UncertaintyTerm::Calibration, 0.02F);
  partly.systematic_mm = [](const View&, std::size_t) {
    Image<float> out(4, 1, kMissing);
    out(0, 0) = 0.02F;
    return out;
  };
  add_terms(view, 0, {&partly, 1});
  EXPECT_FLOAT_EQ(view.range.systematic_mm(0, 0), 0.02F);
  EXPECT_EQ(view.range.systematic_mm(1, 0), 0.0F);
  EXPECT_TRUE(std::isnan(view.range.systematic_mm(2, 0)));
}

TEST(SigmaTerms, RefuseAnImageOfAnotherSize) {
  View view = view_of_three_points();
  const SigmaTerm wrong{UncertaintyTerm::Calibration,
                        [](const View&, std::size_t) { return Image<float>(3, 1, 0.1F); }};
  EXPECT_THROW(add_terms(view, 0, {&wrong, 1}), Error);
}

}  // namespace
}  // namespace frangia
