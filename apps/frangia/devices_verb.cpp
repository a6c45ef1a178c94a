#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/devices/find_devices.h"
#include "frangia/rig/read_rig.h"

#include "drivers.h"
#include "exit_codes.h"
#include "print_text.h"
#include "verbs.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

Json list_drivers(const std::vector<Driver>& drivers) {
  Json all = Json::array();
  for (const Driver& driver : drivers) {
    all.push_back({{"table", table_name(driver.kind)},
                   {"driver", driver.name},
                   {"description", driver.description}});
  }
  return all;
}

Json list_connected(const std::vector<Driver>& drivers, const Run& run) {
  Json all = Json::array();
  for (const ConnectedDevice& device : find_devices(drivers, run)) {
    all.push_back({{"table", table_name(device.kind)},
                   {"driver", device.driver},
                   {"name", device.found.name},
                   {"settings", device.found.settings}});
  }
  return all;
}

/// Opens and queries every device of a rig, even if another one fails.
Json list_tests(const std::filesystem::path& rig_file,
                const std::vector<Driver>& drivers,
                const Run& run) {
  const Rig rig = read_rig(rig_file, run, RigContent::StartValues);
  DeviceSession session;
  Json all = Json::array();
  for (const DeviceTest& test : test_devices(rig_file, rig, drivers, &session.guardian, run)) {
    Json entry{{"table", test.table}};
    if (!test.driver.empty()) entry["driver"] = test.driver;
    if (!test.name.empty()) entry["name"] = test.name;
    entry[test.fault.empty() ? "answer" : "fault"] = test.fault.empty() ? test.answer : test.fault;
    all.push_back(entry);
  }
  return all;
}

void print(const Json& drivers, const Json& found, const Json& tested) {
  print_text("Drivers\n");
  for (const Json& driver : drivers) {
    print_text("  [devices.{}]{:{}} driver = {:<20} {}\n",
               driver["table"].get<std::string>(),
               "",
               10 - driver["table"].get<std::string>().size(),
               "\"" + driver["driver"].get<std::string>() + "\"",
               driver["description"].get<std::string>());
  }
  print_text("\nConnected{}\n", found.empty() ? ": no device was found" : "");
  for (const Json& device : found) {
    print_text("  {}\n    [devices.{}]\n",
               device["name"].get<std::string>(),
               device["table"].get<std::string>());
    std::string settings = device["settings"];
    for (std::size_t at = 0; !settings.empty();) {
      at = settings.find('\n');
      print_text("    {}\n", settings.substr(0, at));
      settings.erase(0, at == std::string::npos ? at : at + 1);
    }
  }
  if (tested.empty()) return;
  print_text("\nThis rig\n");
  for (const Json& device : tested) {
    const bool well = device.contains("answer");
    print_text("  [devices.{}] {}\n",
               device["table"].get<std::string>(),
               well ? fmt::format("works: {}: {}",
                                  device["name"].get<std::string>(),
                                  device["answer"].get<std::string>())
                    : "FAULT: " + device["fault"].get<std::string>());
  }
}

void list(const std::filesystem::path& rig, bool search, Terminal& terminal) {
  const Run run = terminal.run();
  const std::vector<Driver> drivers = all_drivers();
  const Json found = search ? list_connected(drivers, run) : Json::array();
  const Json tested = rig.empty() ? Json::array() : list_tests(rig, drivers, run);
  terminal.finish();
  if (terminal.json) {
    const Json all{{"drivers", list_drivers(drivers)}, {"connected", found}, {"rig", tested}};
    print_json(all);
  } else {
    print(list_drivers(drivers), found, tested);
  }
  int faults = 0;
  for (const Json& device : tested)
    faults += device.contains("fault") ? 1 : 0;
  if (faults == 0) return;
  const std::string sentence =
      fmt::format("{} of the {} devices of {} failed; see the faults above",
                  faults,
                  tested.size(),
                  rig.string());
  if (!terminal.json) throw Error(ErrorKind::Device, sentence);
  run.warn(sentence);  // the answer is one JSON document, and it names the faults
  terminal.exit_code = DeviceFault;
}

}  // namespace

void add_devices_verb(CLI::App& program, Terminal& terminal) {
  auto* verb = program.add_subcommand(
      "devices", "list drivers and connected devices; test the devices of a rig");
  verb->footer(
      "Example:\n"
      "  frangia devices\n"
      "  frangia devices rig.toml       opens and queries each device of this rig; nothing moves");
  auto rig = std::make_shared<std::filesystem::path>();
  auto no_search = std::make_shared<bool>(false);
  verb->add_option("rig,--rig", *rig, "open and query every device of this rig.toml");
  verb->add_flag("--no-search", *no_search, "do not search for connected devices");
  verb->callback([rig, no_search, &terminal] { list(*rig, !*no_search, terminal); });
}

}  // namespace frangia
