#include "frangia/calibrate/board/find_board.h"

#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/board/board_image.h"
#include "frangia/calibrate/board/find_charuco.h"
#include "frangia/calibrate/board/fit_phase_at.h"
#include "frangia/calibrate/board/measure_sharpness.h"
#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// A board seen obliquely: each pixel is traced back through a homography, 5 x 5 samples a pixel.
template <typename Albedo>
Image<float> picture_of(const Eigen::Matrix3d& px_from_mm, const Albedo& albedo) {
  constexpr int kSamples = 5;
  Image<float> image(800, 640);
  const Eigen::Matrix3d mm_from_px = px_from_mm.inverse();
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      double sum = 0.0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const int across = i % kSamples;
        const int down = i / kSamples;
        const Eigen::Vector3d pixel(
            x + (across + 0.5) / kSamples - 0.5, y + (down + 0.5) / kSamples - 0.5, 1.0);
        sum += albedo((mm_from_px * pixel).hnormalized());
      }
      image(x, y) = static_cast<float>(20.0 + 180.0 * sum / (kSamples * kSamples));
    }
  }
  return image;
}

Eigen::Matrix3d oblique() {
  Eigen::Matrix3d map;
  map << 4.0, 0.5, 140.0,  //
      -0.4, 3.8, 130.0,    //
      4e-4, 6e-4, 1.0;
  return map;
}

double checkerboard(const Eigen::Vector2d& mm) {
  const int column = static_cast<int>(std::floor(mm.x() / 10.0)) + 1;
  const int row = static_cast<int>(std::floor(mm.y() / 10.0)) + 1;
  if (column < 0 || row < 0 || column > 10 || row > 7) return 1.0;
  return (column + row) % 2 == 0 ? 0.0 : 1.0;
}

double circles(const Eigen::Vector2d& mm) {
  const Eigen::Vector2d cell(std::round(mm.x() / 10.0), std::round(mm.y() / 10.0));
  if (cell.minCoeff() < 0.0 || cell.x() > 9.0 || cell.y() > 6.0) return 1.0;
  return (mm - 10.0 * cell).norm() < 3.0 ? 0.0 : 1.0;
}

/// Largest distance of the found points from their true pixels. The order may start at either end
/// of a board that looks the same turned by 180 degrees.
double error_px(const std::vector<BoardPoint>& found, const Board& board) {
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(board);
  double forward = 0.0;
  double backward = 0.0;
  for (const BoardPoint& point : found) {
    const auto index = static_cast<std::size_t>(point.index);
    const auto error = [&](const Eigen::Vector2d& mm) {
      return ((oblique() * mm.homogeneous()).hnormalized() - point.camera_px).norm();
    };
    forward = std::max(forward, error(nominal[index]));
    backward = std::max(backward, error(nominal[nominal.size() - 1 - index]));
  }
  return std::min(forward, backward);
}

TEST(FindBoard, FindsTheCornersOfACheckerboardWithinATwentiethOfAPixel) {
  const Board board{.kind = BoardKind::Checkerboard, .columns = 10, .rows = 7, .square_mm = 10.0};
  const auto found = find_board(picture_of(oblique(), checkerboard), board);
  ASSERT_EQ(found.size(), 70U);
  EXPECT_LT(error_px(found, board), 0.05);
}

TEST(FindBoard, FindsTheCentersOfCirclesWithinAFifthOfAPixel) {
  const Board board{.kind = BoardKind::Circles, .columns = 10, .rows = 7, .square_mm = 10.0};
  const auto found = find_board(picture_of(oblique(), circles), board);
  ASSERT_EQ(found.size(), 70U);
  EXPECT_LT(error_px(found, board), 0.2);
}

/// The light falls off by 0.4 % a pixel across the board.
Image<float> lit_from_the_left(Image<float> image) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x)
      image(x, y) = static_cast<float>(image(x, y) * std::exp(-0.004 * x));
  }
  return image;
}

/// Root mean square of the distances from the pixels where `pixel_of` sees the nominal points.
template <typename PixelOf>
double rms_px(const std::vector<BoardPoint>& found, const Board& board, const PixelOf& pixel_of) {
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(board);
  double forward = 0.0;
  double backward = 0.0;
  for (const BoardPoint& point : found) {
    const auto index = static_cast<std::size_t>(point.index);
    forward += (pixel_of(nominal[index]) - point.camera_px).squaredNorm();
    backward += (pixel_of(nominal[nominal.size() - 1 - index]) - point.camera_px).squaredNorm();
  }
  return std::sqrt(std::min(forward, backward) / static_cast<double>(found.size()));
}

TEST(FindBoard, UnevenLightMovesCornersByLessThanAHundredthOfAPixel) {
  const Board board{.kind = BoardKind::Checkerboard, .columns = 10, .rows = 7, .square_mm = 10.0};
  const Image<float> image = picture_of(oblique(), checkerboard);
  const auto even = find_board(image, board);
  const auto uneven = find_board(lit_from_the_left(image), board);
  ASSERT_EQ(even.size(), 70U);
  ASSERT_EQ(uneven.size(), 70U);
  double squares = 0.0;
  for (std::size_t i = 0; i < even.size(); ++i)
    squares += (even[i].camera_px - uneven[i].camera_px).squaredNorm();
  EXPECT_LT(std::sqrt(squares / static_cast<double>(even.size())), 0.01);
}

/// The pixel on which the center of the ellipse of a circle lies: the last column of its dual
/// conic.
Eigen::Vector2d ellipse_center(const Eigen::Vector2d& mm, double radius_mm) {
  Eigen::Matrix3d conic = -mm.homogeneous() * mm.homogeneous().transpose();
  conic.topLeftCorner<2, 2>() += radius_mm * radius_mm * Eigen::Matrix2d::Identity();
  const Eigen::Matrix3d image = oblique() * conic * oblique().transpose();
  return image.col(2).hnormalized();
}

TEST(FindBoard, FindsTheEllipsesOfCirclesInUnevenLightWithinAHundredthOfAPixel) {
  const Board board{.kind = BoardKind::Circles, .columns = 10, .rows = 7, .square_mm = 10.0};
  const auto found = find_board(lit_from_the_left(picture_of(oblique(), circles)), board);
  ASSERT_EQ(found.size(), 70U);
  EXPECT_LT(rms_px(found, board, [](const auto& mm) { return ellipse_center(mm, 3.0); }), 0.01);
}

/// A ChArUco board as picture_of wants it: black is 0.
auto charuco(const Board& board) {
  return [&board](const Eigen::Vector2d& mm) { return is_printed_black(board, mm) ? 0.0 : 1.0; };
}

const Board kCharuco{.kind = BoardKind::Charuco, .columns = 10, .rows = 7, .square_mm = 10.0};

TEST(FindBoard, FindsTheCornersOfACharucoBoardWithinATenthOfAPixel) {
  const auto found = find_board(picture_of(oblique(), charuco(kCharuco)), kCharuco);
  ASSERT_EQ(found.size(), 70U);
  EXPECT_LT(error_px(found, kCharuco), 0.1);
}

TEST(FindBoard, FindsTheSeenPartOfACharucoBoardTurnedUpsideDown) {
  const Image<float> whole = picture_of(oblique(), charuco(kCharuco));
  Image<float> part(whole.width(), whole.height(), 30.0F);
  for (int y = 0; y < whole.height(); ++y) {
    for (int x = 300; x < whole.width(); ++x)
      part(whole.width() - 1 - x, whole.height() - 1 - y) = whole(x, y);
  }
  const auto found = find_board(part, kCharuco);
  EXPECT_GT(found.size(), 30U);
  EXPECT_LT(found.size(), 66U);
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(kCharuco);
  for (const BoardPoint& point : found) {
    const Eigen::Vector2d truth =
        (oblique() * nominal[static_cast<std::size_t>(point.index)].homogeneous()).hnormalized();
    const Eigen::Vector2d turned(whole.width() - 1 - truth.x(), whole.height() - 1 - truth.y());
    EXPECT_LT((turned - point.camera_px).norm(), 0.1) << point.index;
  }
}

TEST(FindCharuco, TellsAMirroredBoard) {
  const Image<float> image = picture_of(oblique(), charuco(kCharuco));
  Image<float> mirrored(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x)
      mirrored(image.width() - 1 - x, y) = image(x, y);
  }
  const CharucoSight sight = find_charuco(mirrored, kCharuco);
  EXPECT_TRUE(sight.points.empty());
  EXPECT_GT(sight.mirrored_markers, 30);
}

TEST(FindCharuco, TellsAMirroredBoardWhoseMarkersResembleOthersMirrored) {
  // 40 of the 50 markers of four by four cells: some are, mirrored, within the distance of others.
  const Board board{.kind = BoardKind::Charuco,
                    .columns = 9,
                    .rows = 7,
                    .square_mm = 10.0,
                    .dictionary = "DICT_4X4_50"};
  const Image<float> image = picture_of(oblique(), charuco(board));
  Image<float> mirrored(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x)
      mirrored(image.width() - 1 - x, y) = image(x, y);
  }
  const CharucoSight sight = find_charuco(mirrored, board);
  EXPECT_TRUE(sight.points.empty());
  EXPECT_GT(sight.mirrored_markers, 25);
  EXPECT_EQ(find_charuco(image, board).mirrored_markers, 0);
}

/// What an image of one board shows where another one is expected.
std::optional<OtherCharuco> other_of(const Board& shown, const Board& expected) {
  const CharucoSight sight = find_charuco(picture_of(oblique(), charuco(shown)), expected);
  EXPECT_TRUE(!sight.other || sight.points.empty());
  return sight.other;
}

TEST(FindCharuco, FindsABoardThatBeginsWithAnotherMarker) {
  Board board = kCharuco;
  board.first_id = 18;
  EXPECT_EQ(find_board(picture_of(oblique(), charuco(board)), board).size(), 70U);
  const auto other = other_of(board, kCharuco);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->dictionary, "DICT_5X5_100");
  EXPECT_EQ(other->first_id, 18);
  EXPECT_EQ(other->last_id, 18 + 43);
  EXPECT_EQ(other->columns, 10);
  EXPECT_EQ(other->layout_first_id, 18);
  EXPECT_FALSE(other_of(kCharuco, kCharuco));
}

TEST(FindCharuco, NamesAnotherDictionary) {
  Board board = kCharuco;
  board.dictionary = "DICT_6X6_250";
  const auto other = other_of(board, kCharuco);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->dictionary, "DICT_6X6_50");
  EXPECT_FALSE(other->inverted);
  EXPECT_FALSE(other->mirrored);
  EXPECT_EQ(other->columns, 0) << "the layout is the expected one";
}

TEST(FindCharuco, NamesTheMarkersWhereACheckerboardIsExpected) {
  Board checkerboard = kCharuco;
  checkerboard.kind = BoardKind::Checkerboard;
  const auto other = find_other_charuco(picture_of(oblique(), charuco(kCharuco)), checkerboard);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->dictionary, "DICT_5X5_50");
  EXPECT_EQ(other->last_id, 43);
}

TEST(FindCharuco, NamesExchangedWidthAndHeight) {
  Board exchanged = kCharuco;
  std::swap(exchanged.columns, exchanged.rows);
  const auto other = other_of(kCharuco, exchanged);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->columns, 10);
  EXPECT_EQ(other->rows, 7);
}

TEST(FindCharuco, NamesTheOlderLayout) {
  Board older = kCharuco;
  older.legacy_layout = true;
  const auto other = other_of(older, kCharuco);
  ASSERT_TRUE(other);
  EXPECT_TRUE(other->legacy_layout);
  EXPECT_EQ(other->columns, 10);
}

TEST(FindCharuco, TellsAnInvertedPrint) {
  Image<float> image = picture_of(oblique(), charuco(kCharuco));
  for (float& counts : image.pixels())
    counts = 220.0F - counts;
  const CharucoSight sight = find_charuco(image, kCharuco);
  ASSERT_TRUE(sight.other);
  EXPECT_TRUE(sight.other->inverted);
  EXPECT_EQ(sight.other->first_id, 0);
  EXPECT_EQ(sight.other->last_id, 43);
  EXPECT_TRUE(sight.points.empty());
}

TEST(FindBoard, FindsNothingWhereTheBoardHasOtherCornersAndTheyAreCounted) {
  const Image<float> image = picture_of(oblique(), checkerboard);
  const Board board{.kind = BoardKind::Checkerboard, .columns = 9, .rows = 6, .square_mm = 10.0};
  EXPECT_TRUE(find_board(image, board).empty());
  const auto counted = count_corners(image);
  ASSERT_TRUE(counted);
  EXPECT_EQ((*counted)[0], 10);
  EXPECT_EQ((*counted)[1], 7);
  EXPECT_FALSE(count_corners(Image<float>(400, 300, 100.0F)));
}

TEST(MeasureSharpness, FindsTheBlurAndTheMotionThatTheImageHas) {
  const Board board{.kind = BoardKind::Checkerboard, .columns = 10, .rows = 7, .square_mm = 10.0};
  const Image<float> image = picture_of(oblique(), checkerboard);
  const auto points = find_board(image, board);
  ASSERT_EQ(points.size(), 70U);
  EXPECT_LT(measure_blur_px(image, points, 8), 1.0);
  EXPECT_LT(measure_motion_px(image, points, 8), 0.02);
  Image<float> blurred(image.width(), image.height());
  const cv::Mat from(
      image.height(), image.width(), CV_32F, const_cast<float*>(image.pixels().data()));
  cv::Mat to(image.height(), image.width(), CV_32F, blurred.pixels().data());
  cv::GaussianBlur(from, to, {}, 3.0);
  EXPECT_NEAR(measure_blur_px(blurred, points, 8), 3.0, 0.8);
  Eigen::Matrix3d moved = Eigen::Matrix3d::Identity();
  moved(0, 2) = 0.8;
  moved(1, 2) = -0.6;
  const Image<float> shifted = picture_of(moved * oblique(), checkerboard);
  EXPECT_NEAR(measure_motion_px(shifted, points, 8), 1.0, 0.05);
  EXPECT_GT(measure_likeness(shifted, image, points, 20), 0.8);
  // Another pose: a corner that is sought nearby may not be found at all, and seem not to move.
  moved(0, 2) = 55.0;
  moved(1, 2) = 20.0;
  EXPECT_LT(measure_likeness(picture_of(moved * oblique(), checkerboard), image, points, 20), 0.3);
}

TEST(MeasureSharpness, ComparesImagesWithoutABoard) {
  const Image<float> image = picture_of(oblique(), checkerboard);
  Image<float> blurred(image.width(), image.height());
  const cv::Mat from(
      image.height(), image.width(), CV_32F, const_cast<float*>(image.pixels().data()));
  cv::Mat to(image.height(), image.width(), CV_32F, blurred.pixels().data());
  cv::GaussianBlur(from, to, {}, 2.5);
  EXPECT_LT(measure_image_sharpness(image).blur_px, 1.0);
  EXPECT_NEAR(measure_image_sharpness(blurred).blur_px, 2.5, 0.6);
  EXPECT_NEAR(measure_image_sharpness(image).contrast, 180.0, 5.0);
}

/// Frames of fringes along x with equal shifts through a display of a given gamma.
FrameStack fringes_of(int shifts, double gamma) {
  FrameStack stack;
  stack.pattern.period_px = 20.0;
  for (int i = 0; i < shifts; ++i) {
    stack.pattern.shifts_rad.push_back(kTwoPi * i / shifts);
    Image<std::uint8_t> frame(200, 100);
    for (int y = 0; y < 100; ++y) {
      for (int x = 0; x < 200; ++x) {
        const double light =
            0.5 + 0.5 * std::cos(kTwoPi * (x / 20.3 + y / 47.0) + stack.pattern.shifts_rad.back());
        frame(x, y) = static_cast<std::uint8_t>(std::lround(20.0 + 200.0 * std::pow(light, gamma)));
      }
    }
    stack.frames.emplace_back(std::move(frame));
  }
  return stack;
}

TEST(MeasureFringeMisfit, TellsLinearProjectorsGammaAndSwappedFramesApart) {
  const std::vector<BoardPoint> points = {{.index = 0, .camera_px = {5.0, 5.0}},
                                          {.index = 1, .camera_px = {190.0, 90.0}}};
  EXPECT_LT(measure_fringe_misfit(fringes_of(4, 1.0), points), 0.01);
  const double gamma = measure_fringe_misfit(fringes_of(4, 2.2), points);
  EXPECT_GT(gamma, 0.15);
  EXPECT_LT(gamma, 0.5);
  FrameStack swapped = fringes_of(4, 1.0);
  std::swap(swapped.frames[1], swapped.frames[2]);
  EXPECT_GT(measure_fringe_misfit(swapped, points), 1.0);
  EXPECT_TRUE(std::isnan(measure_fringe_misfit(fringes_of(3, 1.0), points)));
}

TEST(BoardImage, IsFreeOfFringesOfUnevenShifts) {
  FrameStack stack;
  stack.pattern.period_px = 20.0;
  stack.pattern.shifts_rad = {0.0, 1.2, 2.9, 4.0};
  for (const double shift : stack.pattern.shifts_rad) {
    Image<std::uint16_t> frame(100, 2);
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 100; ++x) {
        frame(x, y) = static_cast<std::uint16_t>(
            std::lround(20000.0 + 10000.0 * std::cos(kTwoPi * x / 20.0 + shift)));
      }
    }
    stack.frames.emplace_back(std::move(frame));
  }
  const std::vector stacks = {stack};
  const Image<float> image = board_image(stacks);
  for (int x = 0; x < 100; ++x)
    EXPECT_NEAR(image(x, 1), 20000.0, 2.0) << x;
}

TEST(BoardImage, IsTheWhiteFrameWhereThereIsOne) {
  FrameStack white;
  white.pattern.kind = PatternKind::White;
  white.frames.emplace_back(Image<std::uint8_t>(4, 4, 77));
  const std::vector stacks = {white};
  EXPECT_EQ(board_image(stacks)(2, 2), 77.0F);
}

}  // namespace
}  // namespace frangia
