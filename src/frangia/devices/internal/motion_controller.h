#pragma once

#include <memory>
#include <string>

#include "frangia/devices/internal/transport.h"

namespace frangia {

/// How the board that turns a table is spoken to, in the board's own units along its axis.
/// `connect` comes first. A call that throws leaves the board stopped, its position unknown.
class MotionController {
 public:
  MotionController() = default;
  MotionController(const MotionController&) = delete;
  MotionController& operator=(const MotionController&) = delete;
  MotionController(MotionController&&) = delete;
  MotionController& operator=(MotionController&&) = delete;
  virtual ~MotionController() = default;

  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Waits for the board to be up, its outputs off and its motor still.
  virtual void connect(const Deadline& deadline) = 0;
  /// What the board says of itself, without moving anything.
  [[nodiscard]] virtual std::string identify(const Deadline& deadline) = 0;
  /// Lets the motor hold, or lets go of it, on boards that can.
  virtual void enable_motor(bool on, const Deadline& deadline) = 0;
  /// Runs to the home switch; the axis is at 0 afterwards.
  virtual void home(const Deadline& deadline) = 0;
  /// Calls the place where the axis stands 0.
  virtual void set_zero(const Deadline& deadline) = 0;
  /// Goes there and returns at standstill.
  virtual void move_to(double units, double units_per_s, const Deadline& deadline) = 0;
  /// One line of the board's language, for lamps and lasers: "M3 S1000".
  virtual void command(const std::string& line, const Deadline& deadline) = 0;
  /// Motion and outputs end at once. Never throws: it is called when all else has failed.
  virtual void stop() noexcept = 0;
  /// How often it was stopped: what was known of positions and outputs before is void.
  [[nodiscard]] int stop_count() const { return stop_count_; }

 protected:
  void record_stop() noexcept { ++stop_count_; }

 private:
  int stop_count_ = 0;
};

struct MotionControllerSettings {
  char axis = 'X';
  double boot_s = 2.5;          ///< a board that resets when its port is opened is up within this
  double steps_per_unit = 0.0;  ///< GRBL: written when the motor is enabled; 0 keeps the board's
};

/// GRBL 1.1 and what descends from it.
/// source   github.com/gnea/grbl/wiki, Grbl v1.1 Interface
[[nodiscard]] std::unique_ptr<MotionController> make_grbl(
    std::unique_ptr<Transport> transport, const MotionControllerSettings& settings = {});

/// Marlin: lines with numbers and checksums, sent again when asked for.
/// source   marlinfw.org/docs/gcode, RepRap wiki "G-code"
[[nodiscard]] std::unique_ptr<MotionController> make_marlin(
    std::unique_ptr<Transport> transport, const MotionControllerSettings& settings = {});

/// Horus 0.2, the firmware of the Ciclop scanner's ZUM board; units are degrees, X the only axis,
/// and there is no home switch.
/// source   github.com/bqlabs/horus-fw
[[nodiscard]] std::unique_ptr<MotionController> make_horus(
    std::unique_ptr<Transport> transport, const MotionControllerSettings& settings = {});

}  // namespace frangia
