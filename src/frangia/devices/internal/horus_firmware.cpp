#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/devices/internal/motion_controller.h"

namespace frangia {
namespace {

/// The reset switches lasers and motor off.
constexpr const char* kHoldAndReset = "!\x18";

class Horus final : public MotionController {
 public:
  Horus(std::unique_ptr<Transport> transport, const MotionControllerSettings& settings)
      : transport_(std::move(transport)), settings_(settings) {}

  [[nodiscard]] const std::string& name() const override { return transport_->name(); }

  void connect(const Deadline& deadline) override {
    if (!wait_for_greeting(deadline.at_most(settings_.boot_s))) {
      transport_->write("\x18\r\n", deadline);
      if (!wait_for_greeting(deadline)) {
        fail_device(name(), "does not identify as Horus 0.2; check port and firmware");
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

  void enable_motor(bool on, const Deadline& deadline) override {
    command(on ? "M17" : "M18", deadline);
  }

  void home(const Deadline& /*deadline*/) override {
    throw Error(ErrorKind::Input,
                fmt::format("{}: Horus boards have no home switch; set home = \"here\"", name()));
  }

  void set_zero(const Deadline& deadline) override {
    command("G50", deadline);
    position_ = 0.0;
  }

  void move_to(double units, double units_per_s, const Deadline& deadline) override {
    try {
      command(fmt::format("G1F{:.3f}", units_per_s), deadline);
      const auto started = Deadline::Clock::now();
      command(fmt::format("G1X{:.4f}", units), deadline);
      // Some boards answer when the move is queued and do not report its end. Wait for the duration
      // of the move plus a margin for acceleration.
      const double travel_s = std::abs(units - position_) / units_per_s + 0.2;
      const std::chrono::duration<double> gone = Deadline::Clock::now() - started;
      deadline.sleep(travel_s - gone.count());
      if (deadline.passed()) {
        fail_device(name(), fmt::format("the move takes more than {:.3g} s", deadline.timeout_s));
      }
      position_ = units;
    } catch (const Error&) {
      stop();
      throw;
    }
  }

  void command(const std::string& line, const Deadline& deadline) override {
    stopped_ = false;
    transport_->write(line + "\r\n", deadline);
    for (;;) {
      const std::string answer = read_line(*transport_, deadline);
      if (answer == "ok") return;
      if (answer.rfind("Horus", 0) == 0) {
        fail_device(name(), "the board restarted; its angle is lost, home the table again");
      }
      if (!answer.empty()) {
        fail_device(name(), fmt::format("answered '{}' to {}", printable(answer), line));
      }
    }
  }

  void stop() noexcept override {
    record_stop();
    if (stopped_) return;
    try {
      transport_->write(kHoldAndReset, Deadline::in(1.0));
      stopped_ = true;
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch) the line is broken
    }
  }

  [[nodiscard]] SafeOff safe_off() const override {
    return {.line = name(),
            .file = transport_->file(),
            .end_command = transport_->framed(kHoldAndReset),
            .pause_s = 0.1,
            .off = "\r\n" + off_commands("\r\n")};
  }

 private:
  bool wait_for_greeting(const Deadline& deadline) {
    while (auto line = transport_->try_read('\n', deadline)) {
      if (line->find("Horus 0.2") != std::string::npos) return true;
    }
    return false;
  }

  std::unique_ptr<Transport> transport_;
  MotionControllerSettings settings_;
  double position_ = 0.0;
  bool stopped_ = false;  ///< nothing was sent since the last stop
};

}  // namespace

std::unique_ptr<MotionController> make_horus(std::unique_ptr<Transport> transport,
                                             const MotionControllerSettings& settings) {
  return std::make_unique<Horus>(std::move(transport), settings);
}

}  // namespace frangia
