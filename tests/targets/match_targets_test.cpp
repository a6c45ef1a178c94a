#include "frangia/targets/match_targets.h"

#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/targets/measure_scale.h"

namespace frangia {
namespace {

struct Sticker {
  Eigen::Vector3d center_mm;
  Eigen::Vector3d normal;
  int code = -1;
};

/// Twelve stickers on the sides of a block, at no regular places.
std::vector<Sticker> block() {
  std::vector<Sticker> all;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const auto draw = [&](std::uint64_t k) { return uniform_from(hash(hash(i), k)) - 0.5; };
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    if (i % 4 < 2) {
      all.push_back(
          {{side * 60.0, 70.0 * draw(1), 20.0 * draw(2)}, side * Eigen::Vector3d::UnitX()});
    } else {
      all.push_back(
          {{100.0 * draw(1), side * 40.0, 20.0 * draw(2)}, side * Eigen::Vector3d::UnitY()});
    }
  }
  return all;
}

Eigen::Isometry3d pose(double angle_rad, const Eigen::Vector3d& axis, const Eigen::Vector3d& move) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
  out.translation() = move;
  return out;
}

TargetView view_of(const std::vector<Sticker>& stickers,
                   const Eigen::Isometry3d& rig_from_object,
                   std::uint64_t seed,
                   double sigma_mm = 0.01,
                   const Eigen::Isometry3d& error = Eigen::Isometry3d::Identity()) {
  TargetView view{"views/" + std::to_string(seed), {}, rig_from_object};
  for (std::uint64_t i = 0; i < stickers.size(); ++i) {
    TargetSighting one;
    one.code = stickers[i].code;
    one.center_mm = error * rig_from_object * stickers[i].center_mm;
    for (std::uint64_t k = 0; k < 3; ++k)
      one.center_mm[static_cast<Eigen::Index>(k)] += sigma_mm * normal_from(hash(hash(seed, i), k));
    one.normal = rig_from_object.linear() * stickers[i].normal;
    one.covariance_mm2 = sigma_mm * sigma_mm * Eigen::Matrix3d::Identity();
    view.sightings.push_back(one);
  }
  return view;
}

const TargetSet kDiscs{.diameter_mm = 4.0};
const TargetSet kCoded{.dictionary = "DICT_4X4_50", .marker_mm = 8.0};

TEST(MatchTargets, CollectsWhatSeveralViewsSawWithASigmaOfAllOfThem) {
  const auto stickers = block();
  const Eigen::Vector3d axis(0.1, -0.9, -0.4);
  std::vector<TargetView> views;
  for (std::uint64_t i = 0; i < 4; ++i)
    views.push_back(view_of(stickers, pose(0.8 * static_cast<double>(i), axis, {3, 20, 400}), i));
  const auto targets = match_targets(views, kDiscs);
  ASSERT_EQ(targets.size(), stickers.size());
  double square = 0.0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    EXPECT_EQ(targets[i].seen.size(), 4U);
    square += (targets[i].center_mm - stickers[i].center_mm).squaredNorm() / 3.0;
    EXPECT_NEAR(targets[i].covariance_mm2(0, 0), 0.01 * 0.01 / 4.0, 1e-9);
  }
  EXPECT_NEAR(std::sqrt(square / 12.0), 0.005, 0.002);
  EXPECT_EQ(ties_of(targets, views).size(), 12U * 6U);
}

TEST(MatchTargets, RefusesTwoStickersWithOneCode) {
  auto stickers = block();
  stickers.resize(4);
  for (std::size_t i = 0; i < 4; ++i)
    stickers[i].code = static_cast<int>(i);
  stickers[3].code = 1;
  const std::vector<TargetView> views = {view_of(stickers, pose(0.1, {0, 1, 0}, {0, 0, 400}), 1)};
  try {
    static_cast<void>(match_targets(views, kCoded));
    FAIL() << "accepted";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("two targets have the code 1"), std::string::npos) << text;
    EXPECT_NE(text.find("views/1"), std::string::npos) << text;
  }
}

TEST(JoinTargets, FindsTheMotionOfUncodedTargetsByTheirDistances) {
  const auto stickers = block();
  const Eigen::Isometry3d truth = pose(2.9, {0.3, 1.0, 0.2}, {12, -40, 25});
  std::vector<Sticker> moved;
  for (std::size_t i = 0; i < 9; ++i)  // three are not seen, and come in another order
    moved.push_back({truth * stickers[11 - i].center_mm, truth.linear() * stickers[11 - i].normal});
  const std::vector<TargetView> one = {view_of(stickers, pose(0.3, {0, 1, 0}, {0, 0, 400}), 1)};
  const std::vector<TargetView> other = {view_of(moved, pose(1.3, {0, 1, 0}, {0, 0, 400}), 2)};
  const auto join = join_targets(match_targets(other, kDiscs), match_targets(one, kDiscs), kDiscs);
  ASSERT_TRUE(join.has_value());
  EXPECT_EQ(join->pairs.size(), 9U);
  EXPECT_FALSE(join->ambiguous());
  EXPECT_LT((join->to_from.translation() - truth.translation()).norm(), 0.05);
  EXPECT_LT(Eigen::AngleAxisd(join->to_from.linear().transpose() * truth.linear()).angle(), 5e-4);
}

TEST(JoinTargets, SaysThatASymmetricPatternFitsTwice) {
  std::vector<Sticker> square;
  for (const double x : {-30.0, 30.0})
    for (const double y : {-20.0, 20.0})
      square.push_back({{x, y, 0.0}, Eigen::Vector3d::UnitZ()});
  const std::vector<TargetView> one = {view_of(square, pose(2.5, {1, 0, 0}, {0, 0, 400}), 1)};
  const std::vector<TargetView> other = {view_of(square, pose(2.7, {1, 0, 0}, {5, 0, 400}), 2)};
  const auto join = join_targets(match_targets(one, kDiscs), match_targets(other, kDiscs), kDiscs);
  ASSERT_TRUE(join.has_value());
  EXPECT_TRUE(join->ambiguous());
}

TEST(JoinTargets, FindsNoMotionOfOtherStickers) {
  auto others = block();
  for (Sticker& sticker : others)
    sticker.center_mm = {sticker.center_mm.x() * 1.37, sticker.center_mm.y() * 0.71, 0.0};
  const std::vector<TargetView> one = {view_of(block(), pose(0.3, {0, 1, 0}, {0, 0, 400}), 1)};
  const std::vector<TargetView> other = {view_of(others, pose(0.3, {0, 1, 0}, {0, 0, 400}), 2)};
  const auto join = join_targets(match_targets(one, kDiscs), match_targets(other, kDiscs), kDiscs);
  EXPECT_TRUE(!join || join->ambiguous() || join->pairs.size() < 5);
}

TEST(MeasureScale, IsThatOfTheKnownDistancesWithTheirUncertainty) {
  auto stickers = block();
  stickers.resize(4);
  for (std::size_t i = 0; i < 4; ++i)
    stickers[i].code = static_cast<int>(i);
  const std::vector<TargetView> views = {view_of(stickers, pose(0.3, {0, 1, 0}, {0, 0, 400}), 1)};
  TargetSet set = kCoded;
  const auto length = [&](std::size_t i, std::size_t j) {
    return (stickers[i].center_mm - stickers[j].center_mm).norm();
  };
  set.distances = {{0, 1, 1.002 * length(0, 1), 0.005},
                   {2, 3, 1.002 * length(2, 3), 0.005},
                   {0, 9, 50.0, 0.005}};
  const auto scale = measure_scale(match_targets(views, set), set);
  ASSERT_TRUE(scale.has_value());
  EXPECT_EQ(scale->distances, 2U);
  EXPECT_EQ(scale->missing.size(), 1U);
  EXPECT_NEAR(scale->factor, 1.002, 4.0 * scale->sigma);
  EXPECT_LT(scale->sigma, 3e-4);
  EXPECT_FALSE(scale->contradicts());
  set.distances[1].distance_mm *= 1.05;
  EXPECT_TRUE(measure_scale(match_targets(views, set), set)->contradicts());
}

}  // namespace
}  // namespace frangia
