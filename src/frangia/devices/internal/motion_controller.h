#pragma once

#include <memory>
#include <string>

#include "frangia/devices/internal/transport.h"

namespace frangia {

/// A motion board, in the board's own units along its axis. Call `connect` first. A call that
/// throws leaves the board stopped and its position unknown.
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
  /// Stops motion and outputs at once. Never throws.
  virtual void stop() noexcept = 0;
  /// The number of stops so far. A stop invalidates known positions and outputs.
  [[nodiscard]] int stop_count() const { return stop_count_; }

 protected:
  void record_stop() noexcept { ++stop_count_; }

 private:
  int stop_count_ = 0;
};

struct MotionControllerSettings {
  char axis = 'X';
  double boot_s = 2.5;          ///< boot time of a board that resets when its port is opened
  double steps_per_unit = 0.0;  ///< GRBL: written when the motor is enabled; 0 keeps the board's
};

/// GRBL 1.1 and derived firmware.
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
