// CAD files against analytic distances, and files that cannot be read.
#include "frangia/cad/read_cad.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "frangia/cad/internal/separate_process.h"
#include "frangia/core/random.h"

#include "cad/made_cad_parts.h"
#include "support/error_of.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

class ReadCad : public testing::MadeCadParts {
 protected:
  static std::string refusal(const std::filesystem::path& path, const CadOptions& options = {}) {
    return testing::error_of([&] { static_cast<void>(read_cad(path, options)); });
  }
};

/// Signed distance of a box with half sizes and rounded edges.
double box_distance(const Vector3d& p, const Vector3d& half, double round) {
  const Vector3d beyond = p.cwiseAbs() - half + Vector3d::Constant(round);
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0) - round;
}

double cylinder_distance(const Vector3d& p, double radius, double half) {
  const Eigen::Vector2d beyond(p.head<2>().norm() - radius, std::abs(p.z()) - half);
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

double torus_distance(const Vector3d& p, double radius, double tube) {
  return std::hypot(p.head<2>().norm() - radius, p.z()) - tube;
}

/// The distance to the part at 100 mm times a number.
double primitive_distance(int part, const Vector3d& p) {
  if (part == 0) return box_distance(p, Vector3d::Constant(15.0), 0.0);
  if (part == 1) return cylinder_distance(p, 20.0, 20.0);
  if (part == 2 || part == 4) return p.norm() - 20.0;
  return torus_distance(p, 20.0, 6.0);
}

Vector3d random_point(std::uint64_t seed, std::uint64_t number, const Vector3d& half) {
  Vector3d point;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto key = hash(seed, 3 * number + static_cast<std::uint64_t>(k));
    point[k] = half[k] * (2.0 * uniform_from(key) - 1.0);
  }
  return point;
}

/// Largest error of the signed distance of a model from random points.
template <typename Truth>
double largest_error(const CadModel& model,
                     const Vector3d& center,
                     const Vector3d& half,
                     const Truth& truth) {
  const RayScene scene(model.mesh());
  double largest = 0.0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Vector3d offset = random_point(7, i, half);
    const Vector3d point = center + offset;
    const ExactPoint found = model.nearest(point, *scene.nearest(point));
    EXPECT_NEAR((point - found.point_mm).norm(), found.distance_mm, 1e-9);
    largest = std::max(largest, std::abs(found.signed_distance_mm - truth(offset)));
  }
  return largest;
}

TEST_F(ReadCad, MeasuresToEachKindOfFaceExactly) {
  const auto model = read_cad(at("primitives.step"));
  EXPECT_EQ(model->unit(), "millimetre");
  for (int part = 0; part < 6; ++part) {
    EXPECT_LT(largest_error(*model,
                            Vector3d(100.0 * part, 0, 0),
                            Vector3d::Constant(26.0),
                            [&](const Vector3d& p) { return primitive_distance(part, p); }),
              1e-6)
        << part;
  }
}

TEST_F(ReadCad, StopsAtTheEdgesOfTrimmedFaces) {
  for (const char* name : {"rounded.step", "rounded-inch.iges"}) {
    const auto model = read_cad(at(name));
    const Vector3d half(20, 15, 10);
    EXPECT_LT(largest_error(*model,
                            Vector3d::Zero(),
                            Vector3d(24, 19, 14),
                            [&](const Vector3d& p) { return box_distance(p, half, 4.0); }),
              1e-5)
        << name;
  }
}

TEST_F(ReadCad, TessellatesIntoAClosedMesh) {
  for (const char* name : {"primitives.step", "rounded.step", "plate.igs"}) {
    const auto model = read_cad(at(name));
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : model->mesh().triangles)
      for (std::size_t k = 0; k < 3; ++k)
        ++edges[{t.at(k), t.at((k + 1) % 3)}];
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1) << name;
      ASSERT_EQ(edges.count({edge.second, edge.first}), 1U) << name;
    }
  }
}

TEST_F(ReadCad, StatesTheNominalShapeOfAFaceInMmWhateverTheUnit) {
  for (const char* name : {"plate.stp", "plate-inch.step", "plate.igs"}) {
    const auto model = read_cad(at(name));
    EXPECT_EQ(model->unit(), std::string(name) == "plate-inch.step" ? "inch" : "millimetre");
    EXPECT_EQ(model->faces().size(), 7U) << name;
    int bores = 0;
    for (const CadFace& face : model->faces()) {
      ASSERT_TRUE(face.shape) << name;
      if (face.shape->kind != ShapeKind::Cylinder) continue;
      ++bores;
      EXPECT_NEAR(face.shape->radius_mm, 8.0, 1e-9);
      EXPECT_NEAR(face.shape->center_mm.z(), 5.0, 0.01);
      EXPECT_NEAR(face.area_mm2, 502.65, 2.0);
    }
    EXPECT_EQ(bores, 1);
  }
}

TEST_F(ReadCad, RefusesWhatIsNoPartInASentence) {
  const std::string step = testing::text_of(at("plate.stp"));
  const std::string iges = testing::text_of(at("plate.igs"));
  const auto says = [](const std::string& sentence, const char* words) {
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  };
  says(refusal(written("empty.step", "")), "empty");
  says(refusal(written("text.step", "solid")), "no STEP file");
  says(refusal(written("cut.step", step.substr(0, step.size() / 2))), "cut short");
  says(refusal(written("cut.igs", iges.substr(0, iges.size() / 2))), "cut short");
  says(refusal(written("text.igs", "solid")), "no IGES file");
  says(refusal(at("wire.step")), "no faces");
  says(refusal(at("wire.igs")), "no faces");
  says(refusal(at("huge.step")), "its size is none of a part");
  says(refusal(at("missing.step")), "no such file");
  says(refusal(at("plate-inch.step"), {.units = 10.0}), "it states its unit, the inch");
}

TEST_F(ReadCad, SurvivesDamagedFiles) {
  const std::string step = testing::text_of(at("rounded.step"));
  const std::size_t begin = step.find("DATA;");
  for (std::uint64_t i = 0; i < 12; ++i) {
    std::string damaged = step;
    for (std::uint64_t k = 0; k < 20; ++k) {
      const auto place = begin + 10 + hash(i, 2 * k) % (step.size() - begin - 60);
      damaged[place] = static_cast<char>('0' + hash(i, 2 * k + 1) % 10);
    }
    try {
      const auto model = read_cad(written("damaged.step", damaged));
      const RayScene scene(model->mesh());
      const Vector3d point(30, 3, 2);
      EXPECT_TRUE(std::isfinite(model->nearest(point, *scene.nearest(point)).distance_mm));
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("damaged.step: "), std::string::npos);
    }
  }
}

TEST_F(ReadCad, NamesAnEdgeWhoseIndexPointsNowhere) {
  const std::filesystem::path file =
      std::filesystem::path(FRANGIA_SOURCE_DIR) / "tests/data/cad/step-one-token-changed.stp";
  const std::string sentence = refusal(file);
  EXPECT_NE(sentence.find("its shape is damaged: an edge of its face"), std::string::npos)
      << sentence;
}

/// The library for CAD files may not come to an end with it, or the check of its answer finds it.
TEST_F(ReadCad, RefusesACoordinateThatIsNoNumberWithinItsTime) {
  const std::filesystem::path file =
      std::filesystem::path(FRANGIA_SOURCE_DIR) / "tests/data/cad/step-nan.step";
  const std::string sentence = refusal(file, {.allow_time_s = 1.0});
  const bool named = sentence.find("has a coordinate that is no number") != std::string::npos;
  const bool late = sentence.find("takes more than 1 s of processor time") != std::string::npos;
  EXPECT_TRUE(named || late) << sentence;
}

TEST_F(ReadCad, RefusesWhatTakesMoreTimeOrMemoryThanAllowed) {
  const std::filesystem::path file = at("primitives.step");
  const auto refused = [&](double memory_bytes, double processor_s) {
    const ProcessLimits limits{MemoryBudget(file, 1, static_cast<std::uint64_t>(memory_bytes)),
                               processor_s};
    return translate_in_process(file, {}, limits, {}).said.error;
  };
  const std::string late = refused(1e9, 0.01);
  EXPECT_NE(late.find("it takes more than 0.01 s of processor time to read"), std::string::npos)
      << late;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const std::string large = refused(1e3, 120.0);
  EXPECT_NE(large.find("or raise `allow_memory`"), std::string::npos) << large;
#endif
}

TEST_F(ReadCad, StopsWhenItIsAskedTo) {
  std::stop_source stop;
  stop.request_stop();
  frangia::Run run;
  run.stop = stop.get_token();
  EXPECT_THROW(static_cast<void>(read_cad(at("plate.stp"), {}, run)), Error);
}

}  // namespace
}  // namespace frangia
