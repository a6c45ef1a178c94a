#include "frangia/range/internal/pixel_connections.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/core/random.h"
#include "frangia/range/measured_volume.h"

#include "range/flat_view.h"

namespace frangia {
namespace {

TEST(PixelConnections, AgreeWithTheTestOfEachPair) {
  FlatView view;
  for (std::size_t i = 0; i < view.range.depth_mm.pixels().size(); ++i) {
    const bool missing = hash(2, i) % 7 == 0;
    view.range.depth_mm.pixels()[i] +=
        missing ? kMissing : static_cast<float>(normal_from(hash(1, i)));
    view.range.sigma_mm.pixels()[i] +=
        missing ? kMissing : 0.3F * static_cast<float>(hash(3, i) % 3);
  }
  const PixelBox box = measured_box(view.range.depth_mm);
  constexpr float kSlope = 1.5F;
  const PixelConnections all = connect_pixels(view.range, view.rays, box, kSlope);
  const auto& depth = view.range.depth_mm;
  int connected = 0;
  int broken = 0;
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      for (int i = 0; i < PixelConnections::SideCount; ++i) {
        const auto side = static_cast<PixelConnections::Side>(i);
        const auto [dx, dy] = PixelConnections::kOffsets[static_cast<std::size_t>(i)];
        const bool inside = x + dx >= 0 && x + dx < depth.width() && y + dy < depth.height();
        const bool expected =
            inside && is_connected(view.range, view.rays, {x, y}, {x + dx, y + dy}, kSlope);
        const bool both = inside && !std::isnan(depth(x, y)) && !std::isnan(depth(x + dx, y + dy));
        EXPECT_EQ(all.connected(x, y, side), expected) << x << " " << y << " " << i;
        EXPECT_EQ(all.broken(x, y, side), both && !expected) << x << " " << y << " " << i;
        connected += expected ? 1 : 0;
        broken += both && !expected ? 1 : 0;
      }
    }
  }
  EXPECT_GT(connected, 1000);
  EXPECT_GT(broken, 1000);
  EXPECT_FALSE(all.connected(-1, 0, PixelConnections::Right));
}

}  // namespace
}  // namespace frangia
