// Values that operations refuse, and operations that cannot do what they are asked.
#include "frangia/editor/edit_operation.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/editor/edit_script.h"
#include "frangia/geometry/selection.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

/// The message of the error that applying the step throws; empty when it succeeds.
std::string error_of(EditState& state, const EditStep& step) {
  try {
    apply_step(state, step);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Input) << step.operation;
    return error.what();
  }
  return {};
}

EditState ball_state() {
  return {.mesh = testing::sphere({0, 0, 0}, 10.0, 20), .selection = {}};
}

TEST(CheckStep, NamesTheFaultOfAValue) {
  const auto error = [](const EditStep& step) {
    try {
      check_step(step);
    } catch (const Error& wrong) {
      return std::string(wrong.what());
    }
    return std::string();
  };
  EXPECT_NE(error({"fill-holes", "ten"}).find("fill-holes: 'ten' is not SIZE"), std::string::npos);
  EXPECT_NE(error({"fill-holes", "10km"}).find("10mm"), std::string::npos);
  EXPECT_NE(error({"cut", "0,0,1"}).find("X,Y,Z,MM"), std::string::npos);
  EXPECT_NE(error({"decimate-to", "-5"}), "");
  EXPECT_NE(error({"decimate-to", "nan"}), "");
  EXPECT_NE(error({"select-mark", "red"}).find("measured, displaced or synthesized"),
            std::string::npos);
  EXPECT_NE(error({"orient", "3"}).find("takes no value"), std::string::npos);
  EXPECT_NE(error({"explode", ""}).find("explode"), std::string::npos);
  EXPECT_EQ(error({"cut", "0,0,-1,5mm"}), "");
  EXPECT_EQ(error({"fill-holes", "0.5in"}), "");
}

TEST(ReadEditScript, NamesAnUnknownStep) {
  const testing::TemporaryFolder folder;
  write_edit_script(folder.path() / "h.json", {{{"orient", ""}, {"explode", "3"}}, 2});
  try {
    static_cast<void>(read_edit_script(folder.path() / "h.json"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("step 2"), std::string::npos) << error.what();
  }
}

TEST(CheckStep, RefusesSizesAndCountsThatAreNotPositive) {
  for (const char* name :
       {"fill-holes", "fill-holes-flat", "remove-islands", "decimate", "remesh"}) {
    for (const char* value : {"-3mm", "0", "0mm"}) {
      EXPECT_THROW(check_step({name, value}), Error) << name << ' ' << value;
    }
  }
  EXPECT_THROW(check_step({"stitch", "-0.1mm"}), Error);
  EXPECT_NO_THROW(check_step({"stitch", "0mm"}));
  EXPECT_THROW(check_step({"select-ball", "0,0,0,-1mm"}), Error);
  EXPECT_THROW(check_step({"select-normal", "0,0,1,-5deg"}), Error);
  EXPECT_THROW(check_step({"max-sigmas", "-1"}), Error);
  for (const char* name : {"decimate-to", "keep-largest", "smooth", "grow", "shrink"})
    EXPECT_THROW(check_step({name, "0"}), Error) << name;
  EXPECT_NO_THROW(check_step({"offset", "-3mm"}));
  EXPECT_NO_THROW(check_step({"cut", "0,0,1,-3mm"}));
}

TEST(ApplyStep, RefusesToChangeASelectionThatWasNotMade) {
  for (const EditStep& step :
       {EditStep{"grow", "1"}, {"shrink", "1"}, {"add", ""}, {"within", ""}, {"without", ""}}) {
    EditState state = ball_state();
    EXPECT_NE(error_of(state, step).find("nothing is selected"), std::string::npos)
        << step.operation;
  }
  EditState state = ball_state();
  EXPECT_EQ(error_of(state, {"select-ball", "0,0,10,3mm"}), "");
  EXPECT_EQ(error_of(state, {"grow", "1"}), "");
}

TEST(ApplyStep, WarnsOfASelectionWithoutATriangle) {
  EditState state = ball_state();
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  apply_step(state, {"select-ball", "0,0,10,5mm"}, run);
  EXPECT_TRUE(warnings.empty());
  apply_step(state, {"select-ball", "100,0,0,5mm"}, run);
  apply_step(state, {"select-mark", "synthesized"}, run);
  EXPECT_EQ(warnings,
            (std::vector<std::string>{"select-ball: no triangle is selected",
                                      "select-mark: no triangle is selected"}));
}

TEST(ApplyStep, RefusesACutThatLeavesNothing) {
  EditState state = ball_state();
  EXPECT_NE(error_of(state, {"cut", "0,0,1,30mm"}).find("no triangle of the mesh would be left"),
            std::string::npos);
}

TEST(ApplyStep, RefusesAnOffsetThatLeavesNothing) {
  for (const char* value : {"-10.5mm", "-15mm", "-40mm"}) {
    EditState state = ball_state();
    EXPECT_NE(error_of(state, {"offset", value}).find("leaves nothing"), std::string::npos)
        << value;
  }
  for (const char* value : {"-5.2mm", "-11mm", "-60mm"}) {  // half of the box is 5 mm
    EditState state{.mesh = testing::box({0, 0, 0}, {10, 20, 30}), .selection = {}};
    EXPECT_NE(error_of(state, {"offset", value}).find("leaves nothing"), std::string::npos)
        << value;
  }
  for (const char* value : {"-4.5mm", "8mm"}) {
    EditState state{.mesh = testing::box({0, 0, 0}, {10, 20, 30}), .selection = {}};
    EXPECT_EQ(error_of(state, {"offset", value}), "") << value;
  }
}

TEST(ApplyStep, NamesTheOperationAndNoFunctionForAMeshWithoutTriangles) {
  Mesh points;
  points.vertices_mm = {{0, 0, 0}, {1, 0, 0}};
  for (const EditStep& step : {EditStep{"fill-hole", "0"},
                               {"bridge", "0,1"},
                               {"select-component", "0"},
                               {"select-loop", "0"},
                               {"select-sigma", "1mm"},
                               {"select-views", "2"}}) {
    EditState state{.mesh = points, .selection = {}};
    const std::string message = error_of(state, step);
    EXPECT_EQ(message.find(step.operation + ": "), 0U) << message;
    for (const char* function : {"fill_holes:", "bridge_loops:", "select_by"})
      EXPECT_EQ(message.find(function), std::string::npos) << message;
  }
}

TEST(ApplyStep, GrowsAndShrinksTheSelectionByWholeRings) {
  // A disk of rings around a hub: its rings are known.
  Mesh disk;
  disk.vertices_mm = {{0, 0, 0}};
  constexpr std::uint32_t kSectors = 12;
  constexpr std::uint32_t kRings = 4;
  for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
    for (std::uint32_t i = 0; i < kSectors; ++i) {
      const double turn = kTwoPi * i / kSectors;
      disk.vertices_mm.emplace_back(static_cast<float>(ring * std::cos(turn)),
                                    static_cast<float>(ring * std::sin(turn)),
                                    0.0F);
    }
  }
  const auto at = [](std::uint32_t ring, std::uint32_t i) {
    return ring == 0 ? 0 : 1 + (ring - 1) * kSectors + i % kSectors;
  };
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t i = 0; i < kSectors; ++i) {
      disk.triangles.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
      if (ring > 0) disk.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
    }
  }
  EditState state{.mesh = disk, .selection = {}};
  ASSERT_EQ(error_of(state, {"select-ball", "0,0,0,0.9mm"}), "");
  EXPECT_EQ(count_selected(state.selection), kSectors);  // the triangles at the hub
  ASSERT_EQ(error_of(state, {"grow", "2"}), "");
  EXPECT_EQ(count_selected(state.selection), 5 * kSectors);  // two more rings of 2 x kSectors
  ASSERT_EQ(error_of(state, {"shrink", "1"}), "");
  EXPECT_EQ(count_selected(state.selection), 3 * kSectors);
  ASSERT_EQ(error_of(state, {"shrink", "1"}), "");
  EXPECT_EQ(count_selected(state.selection), kSectors);
  ASSERT_EQ(error_of(state, {"grow", "1000000000"}), "");
  EXPECT_EQ(count_selected(state.selection), disk.triangles.size());
}

TEST(ReadEditScript, RefusesNumbersThatAreNoCountsAndDeepOrLargeFiles) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "h.json";
  const auto fault_of = [&](const std::string& text) {
    std::ofstream(path) << text;
    return testing::error_of([&] { return read_edit_script(path); });
  };
  const std::string head = R"({"format": "frangia-edits", "version": )";
  for (const char* number : {"1e300", "1.5", "true", "null", "-1e300"}) {
    EXPECT_NE(fault_of(head + number + R"(, "steps": []})").find("version"), std::string::npos);
    EXPECT_NE(fault_of(head + R"(1, "steps": [], "done": )" + number + "}").find("done"),
              std::string::npos);
  }
  EXPECT_NE(fault_of(head + R"(18446744073709551615, "steps": []})").find("newer"),
            std::string::npos);
  EXPECT_NE(fault_of(head + std::string(1'000'000, '[')).find("nested"), std::string::npos);
  std::filesystem::resize_file(path, 100'000'000'000);
  EXPECT_NE(testing::error_of([&] { return read_edit_script(path); }).find("bytes"),
            std::string::npos);
}

TEST(ReadEditScript, RefusesMoreStepsDoneThanItHas) {
  const testing::TemporaryFolder folder;
  for (const char* done : {"2", "-1"}) {
    std::ofstream(folder.path() / "h.json")
        << R"({"format": "frangia-edits", "version": 1, "done": )" << done
        << R"(, "steps": [{"operation": "orient"}]})";
    try {
      static_cast<void>(read_edit_script(folder.path() / "h.json"));
      ADD_FAILURE() << done;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("the script has 1 step"), std::string::npos)
          << error.what();
    }
  }
}

TEST(ApplyStep, TakesTheNextSelectionOutOfThePresentOne) {
  EditState state{.mesh = testing::box({0, 0, 0}, {10, 10, 10}), .selection = {}};
  apply_step(state, {"invert", ""});  // all
  apply_step(state, {"without", ""});
  apply_step(state, {"select-plane", "0,0,1,5"});
  std::size_t above = 0;
  for (std::size_t i = 0; i < state.selection.size(); ++i) {
    float height = 0.0F;
    for (const auto vertex : state.mesh.triangles[i])
      height += state.mesh.vertices_mm[vertex].z() / 3.0F;
    EXPECT_EQ(state.selection[i], height > 5.0F ? 0 : 1) << height;
    above += height > 5.0F ? 1 : 0;
  }
  EXPECT_GT(above, 0U);
  EXPECT_LT(above, state.selection.size());
}

}  // namespace
}  // namespace frangia
