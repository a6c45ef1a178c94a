#include "frangia/devices/find_devices.h"

#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"

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

}  // namespace frangia
