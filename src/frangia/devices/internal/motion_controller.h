#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "frangia/devices/device.h"
#include "frangia/devices/internal/transport.h"

namespace frangia {

struct MotionControllerSettings;

/// A motion board, in the board's own units along its axis. Call `connect` first. A call of
/// `move_to` that throws leaves the board stopped and its position unknown.
class MotionController {
 public:
  MotionController() = default;
  MotionController(const MotionController&) = delete;
  MotionController& operator=(const MotionController&) = delete;
  MotionController(MotionController&&) = delete;
  MotionController& operator=(MotionController&&) = delete;
  virtual ~MotionController() = default;

  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Waits until the board has booted with outputs off and motor at rest.
  virtual void connect(const Deadline& deadline) = 0;
  /// A description from the board, without motion.
  [[nodiscard]] virtual std::string identify(const Deadline& deadline) = 0;
  /// Sets the axis that the board drives from now on: a lamp may have opened the board before.
  virtual void use(const MotionControllerSettings& /*settings*/) {}
  /// What differs between the memory of the board and what the rig states, without a change.
  /// Empty: nothing.
  [[nodiscard]] virtual std::string difference(const Deadline& /*deadline*/) { return {}; }
  /// What was changed in the memory of the board since the last call; empty: nothing.
  [[nodiscard]] virtual std::string take_change() { return {}; }
  /// Enables or disables the motor, on boards that support it.
  virtual void enable_motor(bool on, const Deadline& deadline) = 0;
  /// Moves to the home switch; the position is 0 afterwards.
  virtual void home(const Deadline& deadline) = 0;
  /// Sets the present position to 0.
  virtual void set_zero(const Deadline& deadline) = 0;
  /// Moves to a position and returns at standstill.
  virtual void move_to(double units, double units_per_s, const Deadline& deadline) = 0;
  /// Sends one line in the language of the board, such as "M3 S1000" for a laser.
  virtual void command(const std::string& line, const Deadline& deadline) = 0;
  /// Stops motion and switches outputs off at once. Returns within 1.5 s and never throws. Does
  /// nothing if nothing was sent since the last stop.
  virtual void stop() noexcept = 0;
  /// How another process stops the board and switches its outputs off.
  [[nodiscard]] virtual SafeOff safe_off() const = 0;
  /// Expected duration of a move over a distance, by the limits that the board reports.
  [[nodiscard]] virtual double move_time_s(double distance, double units_per_s) const {
    return distance / units_per_s;
  }
  /// Expected duration of homing; 0 when the board does not report it.
  [[nodiscard]] virtual double home_time_s() const { return 0.0; }

  /// Adds a command that switches an output off. `stop` and `safe_off` send it.
  void add_off_command(const std::string& command) { off_commands_.push_back(command); }
  /// The number of stops so far. A stop invalidates known positions and outputs.
  [[nodiscard]] int stop_count() const { return stop_count_; }
  /// Devices that share the board lock it in `make_safe`, which runs in parallel.
  [[nodiscard]] std::mutex& mutex() { return mutex_; }

 protected:
  void record_stop() noexcept { ++stop_count_; }
  [[nodiscard]] std::size_t off_command_count() const { return off_commands_.size(); }
  /// The commands that switch outputs off, each with `end` after it.
  [[nodiscard]] std::string off_commands(const std::string& end) const {
    std::string all;
    for (const std::string& command : off_commands_)
      all += command + end;
    return all;
  }

 private:
  std::vector<std::string> off_commands_;
  std::mutex mutex_;
  int stop_count_ = 0;
};

struct MotionControllerSettings {
  char axis = 'X';              ///< that turns the table: X, Y, Z or A
  double boot_s = 2.5;          ///< boot time of a board that resets when its port is opened
  double steps_per_unit = 0.0;  ///< GRBL: written when the motor is enabled; 0 keeps the board's
};

/// GRBL 1.1 and derived firmware: grblHAL, FluidNC, Grbl_ESP32.
///
/// @source   github.com/gnea/grbl/wiki, Grbl v1.1 Interface
[[nodiscard]] std::unique_ptr<MotionController> make_grbl(
    std::unique_ptr<Transport> transport, const MotionControllerSettings& settings = {});

/// Marlin, with line numbers and checksums; lines are sent again on request.
///
/// @source   marlinfw.org/docs/gcode, RepRap wiki "G-code"
[[nodiscard]] std::unique_ptr<MotionController> make_marlin(
    std::unique_ptr<Transport> transport, const MotionControllerSettings& settings = {});

/// Horus 0.2, the firmware of the ZUM board of the Ciclop scanner; units are degrees, X is the only
/// axis, and there is no home switch.
///
/// @source   github.com/bqlabs/horus-fw
[[nodiscard]] std::unique_ptr<MotionController> make_horus(
    std::unique_ptr<Transport> transport, const MotionControllerSettings& settings = {});

}  // namespace frangia
