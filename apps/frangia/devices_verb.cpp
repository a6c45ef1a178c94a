#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/rig/read_rig.h"

#include "drivers.h"
#include "verbs.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

template <typename Kind>
void list(Json& all, const char* role, const std::map<std::string, Driver<Kind>>& drivers) {
  for (const auto& [name, driver] : drivers) {
    Json entry{{"role", role}, {"driver", name}, {"help", driver.help}};
    entry["found"] = driver.find ? driver.find() : std::vector<std::string>{};
    all.push_back(entry);
  }
}

Json list_drivers(const DriverRegistry& registry) {
  Json all = Json::array();
  list(all, "camera", registry.cameras);
  list(all, "phase_shifter", registry.phase_shifters);
  list(all, "pattern_display", registry.pattern_displays);
  list(all, "line_source", registry.line_sources);
  list(all, "turntable", registry.turntables);
  list(all, "lamp, laser", registry.enable_switches);
  return all;
}

/// Asks every device of a rig for a sign of life. All are asked, whatever one of them says.
Json test_devices(const std::filesystem::path& rig_file,
                  const DriverRegistry& registry,
                  const Run& run,
                  std::string& first_fault) {
  constexpr std::chrono::seconds kPatience{5};
  const Rig rig = read_rig(rig_file, run);
  const Devices devices = open_devices(read_device_settings(rig_file), registry, rig, run);
  Json all = Json::array();
  for (const auto& [role, device] : devices.all()) {
    Json entry{{"role", role}};
    try {
      entry["answer"] = device->probe(Deadline::after(kPatience));
    } catch (const Error& error) {
      entry["fault"] = error.what();
      if (first_fault.empty()) first_fault = error.what();
    }
    all.push_back(entry);
  }
  devices.make_safe();
  return all;
}

void print(const Json& drivers, const Json& tested) {
  for (const Json& driver : drivers) {
    fmt::print("{:<16} {:<12} {}\n",
               driver["role"].get<std::string>(),
               driver["driver"].get<std::string>(),
               driver["help"].get<std::string>());
    for (const Json& found : driver["found"])
      fmt::print("{:<30}found: {}\n", "", found.get<std::string>());
  }
  for (const Json& device : tested) {
    const bool well = device.contains("answer");
    fmt::print("{:<16} {}: {}\n",
               device["role"].get<std::string>(),
               well ? "answers" : "fault",
               device[well ? "answer" : "fault"].get<std::string>());
  }
}

}  // namespace

void add_devices_verb(CLI::App& program, Terminal& terminal) {
  auto* verb =
      program.add_subcommand("devices", "the drivers, what is connected, and a rig's test");
  verb->footer("Example:\n  frangia devices\n  frangia devices --rig rig.toml");
  auto rig = std::make_shared<std::filesystem::path>();
  verb->add_option("--rig", *rig, "open and test every device that this rig.toml names");
  verb->callback([rig, &terminal] {
    const Run run = terminal.run();
    const DriverRegistry registry = all_drivers();
    const Json drivers = list_drivers(registry);
    std::string fault;
    const Json tested = rig->empty() ? Json::array() : test_devices(*rig, registry, run, fault);
    terminal.finish();
    if (terminal.json) {
      fmt::print("{}\n", Json{{"drivers", drivers}, {"devices", tested}}.dump(2));
    } else {
      print(drivers, tested);
    }
    if (!fault.empty()) throw Error(ErrorKind::Device, fault);
  });
}

}  // namespace frangia
