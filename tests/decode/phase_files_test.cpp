// The maps that the program itself measured, written and read again, must give the same surface.
#include "frangia/decode/phase_files.h"

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/dataset/read_frames.h"
#include "frangia/frames/float_tiff.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/error_of.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

class PhaseFilesOfAScan : public ::testing::Test {
 protected:
  PhaseFilesOfAScan()
      : scan_(testing::small_scan(
            folder_.path() / "scan", "plate", "digital", 2, {.samples_per_px = 4}, 4)),
        rays_(rays_of(scan_.rig.reference().model)) {
    options_.indirect_light = false;
    options_.register_views = false;
    options_.decode.survey = survey_scan(scan_);
  }

  /// Writes the maps of all views as another program would.
  void write_maps(PhaseKind kind) const {
    for (std::size_t view = 0; view < scan_.views.size(); ++view) {
      const auto to = folder_.path() / "maps" / fmt::format("{:03}", view);
      std::filesystem::create_directories(to);
      const DecodedView decoded =
          decode_view(read_frames(scan_, view), scan_.rig, rays_, options_.decode);
      const auto write = [&](const auto& map) {
        write_float_tiff(to / (map.pattern.name + "-phase.tiff"), map.phase_rad);
        write_float_tiff(to / (map.pattern.name + "-sigma.tiff"), map.sigma_rad);
      };
      if (kind == PhaseKind::Absolute) {
        write(decoded.directions.front().phase);
      } else {
        for (const WrappedPhase& map : decoded.directions.front().wrapped)
          write(map);
      }
    }
  }
  [[nodiscard]] ReconstructOptions with_files(PhaseKind kind) const {
    ReconstructOptions options = options_;
    options.decode.phase_files = PhaseFiles{folder_.path() / "maps", kind};
    return options;
  }

  testing::TemporaryFolder folder_;
  Scan scan_;
  Image<Eigen::Vector2f> rays_;
  ReconstructOptions options_;
};

TEST_F(PhaseFilesOfAScan, GiveTheSameSurface) {
  const Reconstruction expected = reconstruct(scan_, options_);
  for (const PhaseKind kind : {PhaseKind::Absolute, PhaseKind::Wrapped}) {
    write_maps(kind);
    const Reconstruction found = reconstruct(scan_, with_files(kind));
    EXPECT_NEAR(static_cast<double>(found.points),
                static_cast<double>(expected.points),
                0.01 * static_cast<double>(expected.points));
    EXPECT_NEAR(
        found.sigma.combined_mm, expected.sigma.combined_mm, 0.05 * expected.sigma.combined_mm);
  }
}

TEST_F(PhaseFilesOfAScan, AreUsed) {
  write_maps(PhaseKind::Absolute);
  const auto map = folder_.path() / "maps" / "001" / (scan_.patterns.back().name + "-phase.tiff");
  const Image<float> nothing(rays_.width(), rays_.height(), std::nanf(""));
  write_float_tiff(map, nothing);
  const Reconstruction found = reconstruct(scan_, with_files(PhaseKind::Absolute));
  EXPECT_EQ(found.views, 1U);
}

TEST_F(PhaseFilesOfAScan, AreNamedWhereTheyAreWrong) {
  const auto fault = [&] {
    return testing::error_of(
        [&] { static_cast<void>(reconstruct(scan_, with_files(PhaseKind::Absolute))); });
  };
  EXPECT_NE(testing::error_of([&] {
              check_phase_files({folder_.path() / "maps", PhaseKind::Wrapped}, scan_);
            }).find("000/"),
            std::string::npos);
  write_maps(PhaseKind::Absolute);
  const std::string name = scan_.patterns.back().name;
  const auto sigma = folder_.path() / "maps" / "000" / (name + "-sigma.tiff");
  write_float_tiff(sigma, Image<float>(rays_.width(), rays_.height(), 0.0F));
  EXPECT_NE(fault().find("above 0"), std::string::npos) << fault();
  write_float_tiff(sigma, Image<float>(7, 5, 0.1F));
  EXPECT_NE(fault().find("7 x 5"), std::string::npos) << fault();
  std::filesystem::remove(sigma);
  EXPECT_NE(fault().find("-sigma.tiff"), std::string::npos) << fault();
}

}  // namespace
}  // namespace frangia
