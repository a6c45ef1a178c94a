#include "frangia/devices/find_devices.h"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/devices/rig_devices.h"

namespace frangia {

std::vector<ConnectedDevice> find_devices(const std::vector<Driver>& drivers,
                                          const Run& run,
                                          double timeout_s) {
  std::vector<ConnectedDevice> all;
  for (const Driver& driver : drivers) {
    if (!driver.find) continue;
    run.check();
    try {
      for (FoundDevice& found : driver.find(Deadline::in(timeout_s, run.stop)))
        all.push_back({driver.kind, driver.name, std::move(found)});
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::Cancelled) throw;
      run.warn(fmt::format("the search for {} devices failed: {}", driver.name, error.what()));
    }
  }
  return all;
}

std::vector<DeviceTest> test_devices(const std::filesystem::path& rig_file,
                                     const Rig& rig,
                                     const std::vector<Driver>& drivers,
                                     Guardian* guardian,
                                     const Run& run,
                                     double timeout_s) {
  std::vector<Guardian::Watch> watches;
  std::vector<std::unique_ptr<Device>> opened;  // kept open: tables may share a board
  std::vector<DeviceTest> all;
  for (DeviceSettings& settings : read_device_settings(rig_file)) {
    DeviceTest test{.table = settings.device(), .driver = settings.text_or("driver", "")};
    try {
      const Driver& driver = driver_for(settings, drivers);
      opened.push_back(driver.open(settings, rig, Deadline::in(timeout_s, run.stop)));
      if (const auto how = opened.back()->safe_off(); how && guardian != nullptr)
        watches.push_back(guardian->watch(*how));
      // Read where exposures are chosen, not by the driver.
      if (driver.kind == DeviceKind::Camera)
        static_cast<void>(settings.number_or("exposure_step_ms", 0.0));
      settings.warn_of_unused_keys(run);
      test.name = opened.back()->name();
      test.answer = opened.back()->test(Deadline::in(timeout_s, run.stop));
      warn_of(*opened.back(), run);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::Cancelled) throw;
      test.fault = error.what();
    }
    all.push_back(std::move(test));
  }
  std::vector<Device*> devices;
  devices.reserve(opened.size());
  for (const auto& device : opened)
    devices.push_back(device.get());
  make_safe(devices);
  opened.clear();  // before the guardian's watches end
  return all;
}

}  // namespace frangia
