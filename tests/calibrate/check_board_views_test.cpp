#include "frangia/calibrate/board/check_board_views.h"

#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/board_poses.h"
#include "support/error_of.h"

namespace frangia {
namespace {

using testing::kBoard;
using testing::known_rig;
using testing::make_views;

std::vector<PoseCapture> captures(int count, double tilt = 0.5) {
  std::vector<PoseCapture> poses;
  for (BoardView& view : make_views({}, count, 0.05, 3, tilt))
    poses.push_back({.view = std::move(view), .brightness = 0.6});
  return poses;
}

/// The message of the fault that `change` makes in each of eight good poses; empty for none.
std::string fault_of(const std::function<void(PoseCapture&)>& change) {
  std::vector<PoseCapture> poses = captures(8);
  for (PoseCapture& pose : poses)
    change(pose);
  return testing::error_of([&] { check_board_views(poses, kBoard, known_rig()); });
}

TEST(CheckBoardViews, AcceptsGoodPoses) {
  EXPECT_NO_THROW(check_board_views(captures(8), kBoard, known_rig()));
}

TEST(CheckBoardViews, StatesHowManyPosesAreMissing) {
  const std::string message =
      testing::error_of([] { check_board_views(captures(2), kBoard, known_rig()); });
  EXPECT_EQ(message, "the scan has 2 views; capture at least 3 poses, each tilted another way");
}

TEST(CheckBoardViews, NamesTheViewsWithoutTheBoard) {
  std::vector<PoseCapture> poses = captures(4);
  poses[1].view.points.clear();
  poses[3].view.points.clear();
  const std::string message =
      testing::error_of([&] { check_board_views(poses, kBoard, known_rig()); });
  EXPECT_NE(message.find("found in 2 of 4 views"), std::string::npos) << message;
  EXPECT_NE(message.find("not found in pose 1, pose 3"), std::string::npos) << message;
}

TEST(CheckBoardViews, NamesBlurWhereItHidesTheBoard) {
  std::vector<PoseCapture> poses = captures(6);
  for (PoseCapture& pose : poses)
    pose.image = {.blur_px = 0.7, .contrast = 150.0};
  poses[1].view.points.clear();  // somewhere else, and sharp
  poses[2].view.points.clear();
  poses[2].image.blur_px = 2.4;
  const PoseChecks checks = check_board_views(poses, kBoard, known_rig());
  ASSERT_EQ(checks.warnings.size(), 1U);
  EXPECT_NE(checks.warnings[0].find("out of focus or moving in pose 2,"), std::string::npos)
      << checks.warnings[0];
}

TEST(CheckBoardViews, NamesTheCornersThatTheImagesShow) {
  const std::string message = fault_of([](PoseCapture& pose) {
    pose.view.points.clear();
    pose.counted = {{9, 6}};
  });
  EXPECT_NE(message.find("set corners = [9, 6]"), std::string::npos) << message;
}

TEST(CheckBoardViews, NamesALargerBoardOfWhichThePartWasFound) {
  std::vector<PoseCapture> poses = captures(8);
  for (std::size_t i = 3; i < poses.size(); ++i) {
    poses[i].view.points.clear();
    if (i < 5) poses[i].counted = {{kBoard.columns + 1, kBoard.rows}};
  }
  const std::string message =
      testing::error_of([&] { check_board_views(poses, kBoard, known_rig()); });
  EXPECT_NE(message.find("2 views show a checkerboard of"), std::string::npos) << message;
}

TEST(CheckBoardViews, NamesASmallerBoardThatWasOnceTakenForTheStatedOne) {
  std::vector<PoseCapture> poses = captures(8);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    poses[i].view.points.clear();
    if (i < 7) poses[i].counted = {{kBoard.columns - 1, kBoard.rows}};
  }
  const std::string message =
      testing::error_of([&] { check_board_views(poses, kBoard, known_rig()); });
  EXPECT_NE(message.find("6 views show a checkerboard of"), std::string::npos) << message;
}

TEST(CheckBoardViews, TakesASmallGridBesideTheBoardForNoise) {
  std::vector<PoseCapture> poses = captures(8);
  for (std::size_t i = 2; i < poses.size(); ++i) {
    poses[i].view.points.clear();
    if (i < 5) poses[i].counted = {{4, 3}};
  }
  const std::string message =
      testing::error_of([&] { check_board_views(poses, kBoard, known_rig()); });
  EXPECT_NE(message.find("found in 2 of 8 views"), std::string::npos) << message;
}

TEST(CheckBoardViews, NamesDarkAndOverexposedBoards) {
  EXPECT_NE(fault_of([](PoseCapture& pose) {
              pose.view.points.clear();
              pose.brightness = 0.02;
            }).find("too dark"),
            std::string::npos);
  EXPECT_NE(fault_of([](PoseCapture& pose) {
              for (BoardPoint& point : pose.view.points)
                point.projector_px.setConstant(std::nan(""));
              pose.saturated = 0.4;
            }).find("overexposed"),
            std::string::npos);
}

TEST(CheckBoardViews, RecognizesExchangedRowsAndColumns) {
  const std::string message = fault_of([](PoseCapture& pose) {
    for (BoardPoint& point : pose.view.points)
      point.projector_px = point.projector_px.reverse().eval();
  });
  EXPECT_NE(message.find("rows and columns of the projector are exchanged"), std::string::npos)
      << message;
}

TEST(CheckBoardViews, RecognizesAMirroredProjector) {
  const std::string message = fault_of([](PoseCapture& pose) {
    for (BoardPoint& point : pose.view.points)
      point.projector_px.x() = 1279.0 - point.projector_px.x();
  });
  EXPECT_NE(message.find("mirrored"), std::string::npos) << message;
}

TEST(CheckBoardViews, RecognizesPhasesBeyondTheProjector) {
  const std::string message = fault_of([](PoseCapture& pose) {
    for (BoardPoint& point : pose.view.points)
      point.projector_px *= 3.0;
  });
  EXPECT_NE(message.find("outside of the projector of 1280 x 800"), std::string::npos) << message;
}

TEST(CheckBoardViews, LeavesOutThePoseThatMoved) {
  std::vector<PoseCapture> poses = captures(8);
  poses[2].motion_px = 0.9;
  poses[2].moved_in = "rows-fine";
  const PoseChecks checks = check_board_views(poses, kBoard, known_rig());
  EXPECT_EQ(checks.left_out, std::vector<std::string>{"pose 2"});
  ASSERT_EQ(checks.warnings.size(), 1U);
  EXPECT_EQ(checks.warnings[0],
            "the board or the camera moved during the capture of pose 2, by 0.9 px up to pattern "
            "\"rows-fine\"; fix both while a pose is captured; this view is left out");
  EXPECT_NE(fault_of([](PoseCapture& pose) { pose.motion_px = 0.9; }).find("moved during"),
            std::string::npos);
}

TEST(CheckBoardViews, TakesFramesThatDoNotFitInABlurredPoseForBlur) {
  std::vector<PoseCapture> poses = captures(8);
  poses[3].misfit = 1.4;
  poses[3].misfit_in = "rows-fine";
  poses[3].blur_px = 4.0;
  const PoseChecks checks = check_board_views(poses, kBoard, known_rig());
  EXPECT_EQ(checks.left_out, std::vector<std::string>{"pose 3"});
  ASSERT_EQ(checks.warnings.size(), 1U);
  EXPECT_NE(checks.warnings[0].find("out of focus or moving in pose 3"), std::string::npos)
      << checks.warnings[0];
}

TEST(CheckBoardViews, LeavesOutThePosesWhosePatternsAreExchanged) {
  std::vector<PoseCapture> poses = captures(8);
  for (const std::size_t i : {2UL, 5UL}) {
    poses[i].likeness = 0.1;
    poses[i].least_like = "rows-coarse";
  }
  const PoseChecks checks = check_board_views(poses, kBoard, known_rig());
  EXPECT_EQ(checks.left_out, (std::vector<std::string>{"pose 2", "pose 5"}));
  ASSERT_EQ(checks.warnings.size(), 1U);
  EXPECT_NE(checks.warnings[0].find("pattern \"rows-coarse\" in pose 2, pose 5 shows the board at "
                                    "another place"),
            std::string::npos)
      << checks.warnings[0];
}

TEST(CheckBoardViews, RecognizesFramesThatDoNotFollowTheShifts) {
  EXPECT_NE(fault_of([](PoseCapture& pose) {
              pose.misfit = 1.4;
              pose.misfit_in = "columns-fine";
            }).find("the frames of pattern \"columns-fine\" in pose 0, pose 1"),
            std::string::npos);
}

TEST(CheckBoardViews, NamesFramesThatDoNotFollowTheShiftsInMostPosesFirst) {
  // In the others the fringe is wide, and the swap happens to leave no residual, but wrong phases.
  std::vector<PoseCapture> poses = captures(8);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i < 5) poses[i].misfit = 1.4;
    for (BoardPoint& point : poses[i].view.points)
      if (point.index % 2 == 0) point.projector_px.x() += 40.0;
  }
  const std::string message =
      testing::error_of([&] { check_board_views(poses, kBoard, known_rig()); });
  EXPECT_EQ(message.find("the frames of pattern"), 0U) << message;
}

TEST(CheckBoardViews, NamesAllThatIsWrongWhenTooFewPosesAreLeft) {
  std::vector<PoseCapture> poses = captures(5);
  poses[0].misfit = 1.4;
  poses[1].misfit = 1.4;
  poses[3].motion_px = 1.0;
  const std::string message =
      testing::error_of([&] { check_board_views(poses, kBoard, known_rig()); });
  EXPECT_NE(message.find("pose 0, pose 1 do not follow"), std::string::npos) << message;
  EXPECT_NE(message.find("besides, the board or the camera moved during the capture of pose 3"),
            std::string::npos)
      << message;
}

TEST(CheckBoardViews, TakesABlurredBoardForBlurredNotForMoved) {
  std::vector<PoseCapture> poses = captures(8);
  poses[2].blur_px = 4.0;
  poses[2].motion_px = 0.6;  // what fringes do to a blurred corner
  const PoseChecks checks = check_board_views(poses, kBoard, known_rig());
  EXPECT_TRUE(checks.left_out.empty());
  ASSERT_EQ(checks.warnings.size(), 1U);
  EXPECT_NE(checks.warnings[0].find("out of focus or moving in pose 2"), std::string::npos)
      << checks.warnings[0];
}

TEST(CheckBoardViews, LeavesOutThePoseWhosePhasesAreNotThoseOfAPlane) {
  std::vector<PoseCapture> poses = captures(8);
  for (BoardPoint& point : poses[5].view.points)
    point.projector_px.x() += point.index % 2 == 0 ? 20.0 : -20.0;
  const PoseChecks checks = check_board_views(poses, kBoard, known_rig());
  EXPECT_EQ(checks.left_out, std::vector<std::string>{"pose 5"});
  EXPECT_NE(checks.warnings.at(0).find("not those of a plane"), std::string::npos);
}

TEST(CheckBoardViews, WarnsOfGammaAndBlurWithoutLeavingPosesOut) {
  std::vector<PoseCapture> poses = captures(8);
  for (PoseCapture& pose : poses)
    pose.misfit = 0.3;
  poses[1].blur_px = 4.0;
  const PoseChecks checks = check_board_views(poses, kBoard, known_rig());
  EXPECT_TRUE(checks.left_out.empty());
  ASSERT_EQ(checks.warnings.size(), 2U);
  EXPECT_NE(checks.warnings[0].find("not linear"), std::string::npos);
  EXPECT_NE(checks.warnings[1].find("out of focus or moving in pose 1"), std::string::npos);
}

TEST(CheckBoardViews, CountsACopyOfAViewOnce) {
  std::vector<PoseCapture> poses = captures(6);
  poses[4].view.points = poses[1].view.points;
  const PoseChecks checks = check_board_views(poses, kBoard, known_rig());
  EXPECT_EQ(checks.left_out, std::vector<std::string>{"pose 4"});
  EXPECT_NE(checks.warnings.at(0).find("the very image of another view"), std::string::npos)
      << checks.warnings.at(0);
  for (PoseCapture& pose : poses)
    pose.view.points = poses[0].view.points;
  const std::string message =
      testing::error_of([&] { check_board_views(poses, kBoard, known_rig()); });
  EXPECT_NE(message.find("no further poses"), std::string::npos) << message;
}

TEST(CheckBoardViews, NamesBlurWhereItLeavesNoFringes) {
  std::vector<PoseCapture> poses = captures(8);
  poses[4].blur_px = 4.0;
  for (BoardPoint& point : poses[4].view.points)
    point.projector_px.setConstant(std::nan(""));
  const PoseChecks checks = check_board_views(poses, kBoard, known_rig());
  EXPECT_EQ(checks.left_out, std::vector<std::string>{"pose 4"});
  EXPECT_NE(checks.warnings.at(0).find("out of focus or moving in pose 4"), std::string::npos)
      << checks.warnings.at(0);
}

TEST(CheckBoardViews, RecognizesAMirroredCharucoBoard) {
  EXPECT_NE(fault_of([](PoseCapture& pose) {
              pose.view.points.clear();
              pose.mirrored_markers = 40;
            }).find("mirrored"),
            std::string::npos);
}

TEST(CheckBoardViews, NamesTheCharucoBoardThatIsSeenInstead) {
  const auto sentence = [](const OtherCharuco& other) {
    Board board = kBoard;
    board.kind = BoardKind::Charuco;
    std::vector<PoseCapture> poses = captures(8);
    for (PoseCapture& pose : poses) {
      pose.view.points.clear();
      pose.other_board = other;
    }
    poses[3].other_board->last_id = other.last_id + 2;
    return testing::error_of([&] { check_board_views(poses, board, known_rig()); });
  };
  const std::string ids =
      sentence({.dictionary = "DICT_5X5_50", .markers = 20, .first_id = 18, .last_id = 47});
  EXPECT_NE(ids.find("8 views show markers of DICT_5X5, ids 18 to 49"), std::string::npos) << ids;
  const std::string dictionary =
      sentence({.dictionary = "DICT_6X6_50", .markers = 20, .first_id = 0, .last_id = 20});
  EXPECT_NE(dictionary.find("set dictionary = \"DICT_6X6_50\""), std::string::npos) << dictionary;
  const std::string inverted =
      sentence({.dictionary = "DICT_5X5_50", .markers = 20, .last_id = 20, .inverted = true});
  EXPECT_NE(inverted.find("without inversion"), std::string::npos) << inverted;
  const std::string layout = sentence({.dictionary = "DICT_5X5_50",
                                       .markers = 20,
                                       .last_id = 20,
                                       .columns = kBoard.rows,
                                       .rows = kBoard.columns});
  EXPECT_NE(layout.find(fmt::format("corners = [{}, {}]", kBoard.rows, kBoard.columns)),
            std::string::npos)
      << layout;
}

TEST(CheckBoardViews, RecognizesParallelPoses) {
  const std::string message =
      testing::error_of([] { check_board_views(captures(8, 0.01), kBoard, known_rig()); });
  EXPECT_NE(message.find("parallel"), std::string::npos) << message;
}

}  // namespace
}  // namespace frangia
