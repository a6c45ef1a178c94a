#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/devices/table_firmware.h"

namespace frangia {
namespace {

class Horus final : public TableFirmware {
 public:
  Horus(std::unique_ptr<Transport> transport, const FirmwareSettings& settings)
      : transport_(std::move(transport)), settings_(settings) {}

  [[nodiscard]] const std::string& name() const override { return transport_->name(); }

  void connect(const Deadline& deadline) override {
    if (!greeted(deadline.at_most(settings_.boot_s))) {
      transport_->write("\x18\r\n", deadline);
      if (!greeted(deadline)) {
        fail_device(name(), "does not greet as Horus 0.2; check port and firmware");
      }
    }
    transport_->discard_input();
    command("M70T1", deadline);
    command("M70T2", deadline);
  }

  [[nodiscard]] std::string identify(const Deadline& deadline) override {
    command("M70T1", deadline);
    return "Horus 0.2, ready";
  }

  void hold_motor(bool on, const Deadline& deadline) override {
    command(on ? "M17" : "M18", deadline);
  }

  void find_home(const Deadline& /*deadline*/) override {
    throw Error(ErrorKind::Input,
                fmt::format("{}: Horus boards have no home switch; set home = \"here\"", name()));
  }

  void set_zero(const Deadline& deadline) override {
    command("G50", deadline);
    at_ = 0.0;
  }

  void go_to(double units, double units_per_s, const Deadline& deadline) override {
    try {
      command(fmt::format("G1F{:.3f}", units_per_s), deadline);
      const auto started = Deadline::Clock::now();
      command(fmt::format("G1X{:.4f}", units), deadline);
      // Some boards answer when the move is queued and have no word for its end: wait for as long
      // as the way takes, and a little for speeding up and slowing down.
      const double way_s = std::abs(units - at_) / units_per_s + 0.2;
      const std::chrono::duration<double> gone = Deadline::Clock::now() - started;
      deadline.sleep(way_s - gone.count());
      if (deadline.passed()) {
        fail_device(name(), fmt::format("the move takes over {:.3g} s", deadline.given_s));
      }
      at_ = units;
    } catch (const Error&) {
      stop();
      throw;
    }
  }

  void command(const std::string& line, const Deadline& deadline) override {
    transport_->write(line + "\r\n", deadline);
    for (;;) {
      const std::string answer = read_line(*transport_, deadline);
      if (answer == "ok") return;
      if (answer.rfind("Horus", 0) == 0) {
        fail_device(name(), "the board started anew; its angle is lost, home the table again");
      }
      if (!answer.empty()) {
        fail_device(name(), fmt::format("answered '{}' to {}", printable(answer), line));
      }
    }
  }

  void stop() noexcept override {
    count_stop();
    try {
      transport_->write("!\x18", Deadline::in(1.0));  // hold, then reset: lasers and motor go off
    } catch (
        const Error&) {  // NOLINT(bugprone-empty-catch) the line is dead: nothing more can be done
    }
  }

 private:
  bool greeted(const Deadline& deadline) {
    while (auto line = transport_->try_read('\n', deadline)) {
      if (line->find("Horus 0.2") != std::string::npos) return true;
    }
    return false;
  }

  std::unique_ptr<Transport> transport_;
  FirmwareSettings settings_;
  double at_ = 0.0;
};

}  // namespace

std::unique_ptr<TableFirmware> make_horus(std::unique_ptr<Transport> transport,
                                          const FirmwareSettings& settings) {
  return std::make_unique<Horus>(std::move(transport), settings);
}

}  // namespace frangia
