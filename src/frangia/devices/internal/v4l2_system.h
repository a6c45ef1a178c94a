#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

/// The system calls of the V4L2 camera; tests substitute a fake camera. Each returns as the system
/// call of its name: negative or null with errno on failure.
class V4l2System {
 public:
  V4l2System() = default;
  V4l2System(const V4l2System&) = delete;
  V4l2System& operator=(const V4l2System&) = delete;
  V4l2System(V4l2System&&) = delete;
  V4l2System& operator=(V4l2System&&) = delete;
  virtual ~V4l2System() = default;

  [[nodiscard]] virtual int open(const char* path) = 0;
  virtual void close(int file) = 0;
  [[nodiscard]] virtual int ioctl(int file, unsigned long request, void* argument) = 0;
  /// Null on failure.
  [[nodiscard]] virtual void* map(std::size_t length, int file, std::size_t offset) = 0;
  virtual void unmap(void* memory, std::size_t length) = 0;
  /// Positive when a frame is available; 0 when none arrived in time.
  [[nodiscard]] virtual int wait_readable(int file, int milliseconds) = 0;
  /// The clock of the frame time stamps.
  [[nodiscard]] virtual double now_s() = 0;
};

/// The system calls of the kernel.
[[nodiscard]] std::shared_ptr<V4l2System> kernel_v4l2();

/// A pixel format of V4L2 cameras that the driver reads.
struct V4l2Format {
  std::string_view name;    ///< in rig.toml
  unsigned code = 0;        ///< V4L2_PIX_FMT_...
  std::string_view people;  ///< as people write it
};

/// All of them, the least compressed first: compression costs accuracy.
[[nodiscard]] const std::vector<V4l2Format>& v4l2_formats();

/// One way in which a camera delivers images.
struct V4l2Mode {
  V4l2Format format;
  int width_px = 0;   ///< of the images
  int height_px = 0;  ///< of the images
  double fps = 0.0;   ///< images per second; 0: the camera does not say
};

/// What an open camera says that it can deliver, by format, the largest image and the highest rate
/// first; empty where it does not say. Sizes in steps give their largest one.
[[nodiscard]] std::vector<V4l2Mode> v4l2_modes(V4l2System& system, int file);

/// The same as people and rig.toml state them: `size_px`, `pixel_format`, `frames_per_s`.
[[nodiscard]] std::vector<DeviceMode> device_modes(const std::vector<V4l2Mode>& modes);

/// A control of a webcam and the value that it had.
struct V4l2Control {
  std::uint32_t id = 0;
  int value = 0;
};

/// What switching off the automatic functions of a webcam has changed.
struct V4l2Automatics {
  std::vector<V4l2Control> before;    ///< values to restore, in the order of their change
  std::vector<std::string> warnings;  ///< what stays automatic, and what stays changed
};

/// Switches off what makes frames of one scene differ: automatic exposure and its priority over the
/// frame rate, gain, white balance and focus, backlight compensation and the filter against the
/// flicker of lamps. A control that the camera does not have is passed over; one that it does not
/// change is named.
///
/// @source   Linux media documentation, "User controls" and "Camera controls"
[[nodiscard]] V4l2Automatics switch_off_automatics(V4l2System& system, int file);

/// The value of a control; false when the camera does not have it.
[[nodiscard]] bool get_control(V4l2System& system, int file, V4l2Control& control);

/// Gives controls the values that they had, the last one first. Failures are ignored: the camera
/// may be unplugged.
void restore_controls(V4l2System& system,
                      int file,
                      const std::vector<V4l2Control>& before) noexcept;

}  // namespace frangia
