// Where fringe orders come from, as a table: patterns, rig, options, and the plan in words.
#include "frangia/decode/plan_decoding.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/decode/decode_options.h"
#include "frangia/simulate/rig_presets.h"

#include "support/error_of.h"

namespace frangia {
namespace {

using Patterns = std::vector<Pattern>;

Patterns fringes(const std::vector<double>& periods_px, FringeDirection direction) {
  Patterns out;
  for (const double period : periods_px) {
    out.push_back({.name = "p" + std::to_string(out.size()),
                   .direction = direction,
                   .period_px = period,
                   .shifts_rad = {0.0, 1.0, 2.0}});
  }
  return out;
}

Patterns columns(const std::vector<double>& periods_px) {
  return fringes(periods_px, FringeDirection::Vertical);
}

Patterns rows(const std::vector<double>& periods_px) {
  return fringes(periods_px, FringeDirection::Horizontal);
}

/// Fringes over the 1280 columns.
Patterns counts(const std::vector<double>& over_the_field) {
  std::vector<double> periods_px;
  for (const double count : over_the_field)
    periods_px.push_back(1280.0 / count);
  return columns(periods_px);
}

Patterns degrees(const std::vector<double>& per_degree) {
  Patterns out;
  for (const double pitch : per_degree)
    out.push_back({.name = "f" + std::to_string(out.size()), .fringes_per_degree = pitch});
  return out;
}

Patterns gray(FringeDirection direction) {
  return {{.name = "gray", .kind = PatternKind::Gray, .direction = direction, .bits = 7}};
}

Patterns gray_columns() {
  return gray(FringeDirection::Vertical);
}

Patterns gray_rows() {
  return gray(FringeDirection::Horizontal);
}

Patterns single(PatternKind kind) {
  return {{.name = "single", .kind = kind}};
}

Patterns operator+(Patterns a, const Patterns& b) {
  std::copy(b.begin(), b.end(), std::back_inserter(a));
  return a;
}

Patterns bracketed(Patterns patterns) {
  for (Pattern& pattern : patterns)
    pattern.exposures_ms = {2.0, 8.0};
  return patterns;
}

Rig digital() {
  return rig_preset("digital");
}

Rig angular() {
  return rig_preset("angular");
}

/// A rig of which nothing but the size of the projector is known.
Rig phases_only() {
  Rig rig = digital();
  rig.reference().model.focal_px.setZero();
  return rig;
}

Rig angular_phases_only() {
  Rig rig = angular();
  rig.reference().model.focal_px.setZero();
  return rig;
}

DecodeOptions directions(DirectionChoice choice) {
  DecodeOptions options;
  options.directions = choice;
  return options;
}

DecodeOptions max_sigma(float sigma_rad) {
  DecodeOptions options;
  options.wrap.max_sigma_rad = sigma_rad;
  return options;
}

DecodeOptions own_unwrap() {
  DecodeOptions options;
  options.own.unwrap = [](std::span<const WrappedPhase>) { return AbsolutePhase{}; };
  return options;
}

DecodeOptions own_spatial() {
  DecodeOptions options;
  options.own.unwrap_spatially = [](const WrappedPhase&) { return RelativePhase{}; };
  return options;
}

DecodeOptions files(PhaseKind kind) {
  DecodeOptions options;
  options.phase_files = PhaseFiles{"maps", kind};
  return options;
}

struct Row {
  const char* name;
  Patterns patterns;
  Rig (*rig)();
  std::string plan;
  bool absolute = true;
  DecodeOptions options = {};
};

const std::string kOne = ": one fringe covers the field";
const std::string kCoarser =
    ": each map gives the orders of the next finer one, from one fringe over the field on";
const std::string kLevels =
    ": all maps give the phase, with orders level by level over maps and their beats";
const std::string kSafe = kLevels + ", safe for every pixel";
const std::string kSearch = ": all maps give the phase, with the most likely of all orders";
const std::string kGray = ": the Gray code gives the orders";
const std::string kCallers = ": your own function or files give the absolute phase";
const std::string kSheet = ": unwrapped in space; the laser sheet gives the orders";
const std::string kDistance =
    ": unwrapped in space; the distance at which the axes of camera and projector cross gives the "
    "orders";
const std::string kOpen =
    ": unwrapped in space; nothing gives the orders, and each region has an offset of its own";
const std::string kFiner = " of the coarsest map, each map those of the next finer one";

constexpr auto kBest = DirectionChoice::Best;
constexpr auto kColumns = DirectionChoice::Vertical;
constexpr auto kRows = DirectionChoice::Horizontal;

std::string v(const std::string& periods_px) {
  return "vertical fringes of " + periods_px + " px";
}

std::string h(const std::string& periods_px) {
  return "horizontal fringes of " + periods_px + " px";
}

std::string d(const std::string& per_degree) {
  return "vertical fringes of " + per_degree + " per degree";
}

std::vector<Row> table() {
  const Patterns three = columns({1280, 160, 20});
  const Patterns three_rows = rows({800, 100, 12.5});
  const Patterns line = single(PatternKind::Line);
  const std::string v3 = v("1280, 160 and 20");
  const std::string h3 = h("800, 100 and 12.5");
  const std::string v1 = v("20");
  const std::string h1 = h("12.5");
  return {
      // Maps alone.
      {"one fringe", columns({1280}), digital, v("1280") + kOne},
      {"wider than the field", columns({1300}), digital, v("1300") + kOne},
      {"two of ratio 8", columns({1280, 160}), digital, v("1280 and 160") + kCoarser},
      {"three of ratio 8", three, digital, v3 + kCoarser},
      {"fine to coarse", columns({20, 160, 1280}), digital, v3 + kCoarser},
      {"two of ratio 4", columns({1280, 320}), digital, v("1280 and 320") + kSafe},
      {"doubled",
       columns({1280, 640, 320, 160, 80, 40, 20}),
       digital,
       v("1280, 640, 320, 160, 80, 40 and 20") + kCoarser},
      {"doubled under less noise",
       columns({1280, 640, 320, 160, 80, 40, 20}),
       digital,
       v("1280, 640, 320, 160, 80, 40 and 20") + kSafe,
       true,
       max_sigma(0.05F)},
      {"ratio 4 under more noise",
       columns({1280, 320}),
       digital,
       v("1280 and 320") + kCoarser,
       true,
       max_sigma(0.2F)},
      {"ratio 8 under less noise",
       columns({1280, 160}),
       digital,
       v("1280 and 160") + kSafe,
       true,
       max_sigma(0.05F)},
      {"heterodyne", counts({56, 63, 64}), digital, v("22.86, 20.32 and 20") + kLevels},
      {"beats of beats", counts({53, 58, 64}), digital, v("24.15, 22.07 and 20") + kSearch},
      {"a beat of a narrow margin", counts({15, 16}), digital, v("85.33 and 80") + kLevels},
      {"a beat under little noise",
       counts({15, 16}),
       digital,
       v("85.33 and 80") + kSafe,
       true,
       max_sigma(0.02F)},
      {"fine fringes", columns({20}), digital, v1 + kDistance, false},
      {"fine fringes that repeat together",
       columns({160, 20}),
       digital,
       v("160 and 20") + kDistance + kFiner,
       false},
      {"frames of other kinds",
       single(PatternKind::White) + three + single(PatternKind::Ambient) +
           single(PatternKind::Ramp),
       digital,
       v3 + kCoarser},
      {"several exposures", bracketed(three), digital, v3 + kCoarser},
      // Gray code.
      {"code and one map", gray_columns() + columns({20}), digital, v1 + kGray},
      {"code and two maps",
       columns({160, 20}) + gray_columns(),
       digital,
       v("160 and 20") + kGray + kFiner},
      {"code before an absolute map", three + gray_columns(), digital, v3 + kGray + kFiner},
      {"code alone",
       gray_columns() + single(PatternKind::White),
       digital,
       "vertical Gray code: the Gray code gives the projector's columns"},
      {"code of rows alone",
       gray_rows(),
       digital,
       "horizontal Gray code: the Gray code gives the projector's rows"},
      {"codes of both directions",
       gray_columns() + gray_rows(),
       digital,
       "vertical Gray code: the Gray code gives the projector's columns\n"
       "horizontal Gray code: the Gray code gives the projector's rows"},
      {"code alone without geometry",
       gray_columns(),
       phases_only,
       "vertical Gray code: the Gray code gives the projector's columns"},
      {"code of the other direction", columns({20}) + gray_rows(), digital, v1 + kDistance, false},
      // Two directions.
      {"rows", three_rows, digital, h3 + kCoarser},
      {"both", three + three_rows, digital, v3 + kCoarser + "\n" + h3 + kCoarser},
      {"the best of both",
       three_rows + three,
       digital,
       v3 + kCoarser + "\n" + h3 + kCoarser,
       true,
       directions(kBest)},
      {"columns of both", three + three_rows, digital, v3 + kCoarser, true, directions(kColumns)},
      {"rows of both", three + three_rows, digital, h3 + kCoarser, true, directions(kRows)},
      {"absolute columns, fine rows", three + rows({12.5}), digital, v3 + kCoarser},
      {"fine columns, absolute rows", columns({20}) + three_rows, digital, h3 + kCoarser},
      {"both fine", columns({20}) + rows({12.5}), digital, v1 + kDistance, false},
      {"the fine rows of both",
       three + rows({12.5}),
       digital,
       h1 + kDistance,
       false,
       directions(kRows)},
      {"both with a code",
       columns({20}) + gray_columns() + rows({12.5}) + gray_rows(),
       digital,
       v1 + kGray + "\n" + h1 + kGray},
      {"a code of columns alone",
       columns({20}) + gray_columns() + rows({12.5}),
       digital,
       v1 + kGray},
      {"different sources",
       columns({20}) + gray_columns() + three_rows,
       digital,
       v1 + kGray + "\n" + h3 + kCoarser},
      // The laser sheet.
      {"the sheet", degrees({1}) + line, angular, d("1") + kSheet},
      {"two maps and the sheet",
       degrees({1, 0.25}) + line,
       angular,
       d("0.25 and 1") + kSheet + kFiner},
      {"maps that repeat together, and the sheet",
       degrees({0.9, 1}) + line,
       angular,
       d("0.9 and 1") + kSheet + kFiner},
      {"no sheet", degrees({1}), angular, d("1") + kDistance, false},
      {"one fringe of an interferometer",
       degrees({1.0 / 24.0, 1}) + line,
       angular,
       d("0.04167 and 1") + kCoarser},
      {"doubled by an interferometer",
       degrees({0.03125, 0.0625, 0.125, 0.25, 0.5, 1}),
       angular,
       d("0.03125, 0.0625, 0.125, 0.25, 0.5 and 1") + kCoarser},
      {"a sheet that is not needed", three + line, digital, v3 + kCoarser},
      {"a sheet beside fine fringes", columns({20}) + line, digital, v1 + kSheet},
      // A rig without geometry.
      {"phases of three maps", three, phases_only, v3 + kCoarser},
      {"phases of fine fringes", columns({20}), phases_only, v1 + kOpen, false},
      {"phases of two fine maps", columns({160, 20}), phases_only, v("160 and 20") + kOpen, false},
      {"phases with a sheet", degrees({1}) + line, angular_phases_only, d("1") + kOpen, false},
      // Functions and files of the caller.
      {"own unwrapping", three, digital, v3 + kCallers, true, own_unwrap()},
      {"own unwrapping of fine fringes", columns({20}), digital, v1 + kCallers, true, own_unwrap()},
      {"own unwrapping beside a code",
       gray_columns() + columns({20}),
       digital,
       v1 + kCallers,
       true,
       own_unwrap()},
      {"own unwrapping of both",
       three + three_rows,
       digital,
       v3 + kCallers + "\n" + h3 + kCallers,
       true,
       own_unwrap()},
      {"own unwrapping of a code alone",
       gray_columns(),
       digital,
       "vertical Gray code: the Gray code gives the projector's columns",
       true,
       own_unwrap()},
      {"files with the absolute phase",
       columns({20}),
       digital,
       v1 + kCallers,
       true,
       files(PhaseKind::Absolute)},
      {"files with wrapped maps", three, digital, v3 + kCoarser, true, files(PhaseKind::Wrapped)},
      {"own unwrapping in space", columns({20}), digital, v1 + kDistance, false, own_spatial()},
  };
}

TEST(PlanDecoding, TakesOrdersFromWhatThePatternsGive) {
  for (const Row& row : table()) {
    const DecodePlan plan = plan_decoding(row.patterns, row.rig(), row.options);
    EXPECT_EQ(describe(plan), row.plan) << row.name;
    EXPECT_EQ(is_absolute(plan), row.absolute) << row.name;
    const std::string text = describe(plan);
    EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 3) << row.name;
  }
}

TEST(PlanDecoding, KeepsMapsCoarseToFineAndStatesWhetherTheyDetermineOrders) {
  const DecodePlan three = plan_decoding(columns({20, 1280, 160}), digital(), {});
  ASSERT_EQ(three.directions.front().maps.size(), 3U);
  EXPECT_EQ(three.directions.front().maps.front().period_px, 1280.0);
  EXPECT_EQ(three.directions.front().maps.back().period_px, 20.0);
  EXPECT_TRUE(three.directions.front().maps_determine_orders);
  // The sheet gives orders that the maps do not.
  const DecodePlan sheet = plan_decoding(degrees({1}) + single(PatternKind::Line), angular(), {});
  EXPECT_FALSE(sheet.directions.front().maps_determine_orders);
  EXPECT_EQ(name_of(sheet.directions.front().orders), "laser-sheet");
}

TEST(PlanDecoding, RefusesPatternsThatHoldNoPhase) {
  const auto refusal = [](const Patterns& patterns, const DecodeOptions& options) {
    return testing::error_of(
        [&] { static_cast<void>(plan_decoding(patterns, digital(), options)); });
  };
  const std::string none = "scan.toml has no pattern of kind \"fringe\" or \"gray\"; add one";
  EXPECT_EQ(refusal({}, {}), none);
  EXPECT_EQ(refusal(single(PatternKind::White), {}), none);
  EXPECT_EQ(refusal(columns({20}), directions(kRows)),
            "scan.toml has no horizontal fringes; choose other `directions`");
  EXPECT_EQ(refusal(gray_rows(), directions(kColumns)),
            "scan.toml has no vertical Gray code; choose other `directions`");
}

}  // namespace
}  // namespace frangia
