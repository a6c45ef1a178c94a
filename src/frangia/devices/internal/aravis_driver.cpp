#include "frangia/devices/internal/aravis_driver.h"

#include <initializer_list>
#include <string_view>

#include "frangia/devices/internal/aravis_camera.h"

namespace frangia {

#ifdef FRANGIA_WITH_ARAVIS

namespace {

const std::initializer_list<std::string_view> kPixelFormats = {
    "Mono8", "Mono10", "Mono12", "Mono14", "Mono16"};

std::unique_ptr<Device> open(DeviceSettings& settings,
                             const Rig& /*rig*/,
                             const Deadline& deadline) {
  AravisSettings camera;
  camera.id = settings.text_or("id", "");
  camera.pixel_format = settings.choice("pixel_format", kPixelFormats);
  const auto region = settings.numbers_or("region_px", {0, 0, 0, 0});
  if (region.size() != 4) settings.fail("region_px", "must be [x, y, width, height]");
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(region[i] >= 0.0 && region[i] < 65536.0))
      settings.fail("region_px", "must be whole numbers from 0");
    camera.region_px[i] = static_cast<int>(region[i]);
  }
  return open_aravis_camera(camera, deadline);
}

}  // namespace

Driver aravis_driver() {
  Driver driver;
  driver.name = "aravis";
  driver.kind = DeviceKind::Camera;
  driver.description = "GigE Vision and USB3 Vision cameras through Aravis";
  driver.open = open;
  driver.find = find_aravis_cameras;
  driver.choices = {{"pixel_format", {kPixelFormats.begin(), kPixelFormats.end()}}};
  return driver;
}

#else

Driver aravis_driver() {
  Driver driver;
  driver.name = "aravis";
  driver.kind = DeviceKind::Camera;
  driver.description = "GigE Vision and USB3 Vision cameras; not in this build";
  driver.open =
      [](DeviceSettings& settings, const Rig&, const Deadline&) -> std::unique_ptr<Device> {
    settings.fail("driver",
                  "is \"aravis\", which this build does not include; install "
                  "libaravis-dev and libusb-1.0-0-dev and build again");
  };
  return driver;
}

#endif

}  // namespace frangia
