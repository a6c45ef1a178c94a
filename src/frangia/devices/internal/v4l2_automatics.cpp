#include "frangia/devices/internal/v4l2_automatics.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <linux/videodev2.h>

namespace frangia {
namespace {

/// An automatic function.
struct Automatic {
  std::uint32_t id;
  int off;  ///< its value without the function
  const char* what;
  const char* effect;  ///< when it stays on
};

constexpr std::array<Automatic, 7> kAutomatics{{
    {V4L2_CID_EXPOSURE_AUTO,
     V4L2_EXPOSURE_MANUAL,
     "automatic exposure",
     "the brightness of frames changes with the pattern"},
    {V4L2_CID_EXPOSURE_AUTO_PRIORITY,
     0,
     "priority of the exposure over the frame rate",
     "frames may be exposed longer than asked for"},
    {V4L2_CID_AUTOGAIN, 0, "automatic gain", "the brightness of frames changes with the pattern"},
    {V4L2_CID_AUTO_WHITE_BALANCE,
     0,
     "automatic white balance",
     "the brightness of frames changes with the pattern"},
    {V4L2_CID_FOCUS_AUTO, 0, "autofocus", "the focus and with it the calibration changes"},
    {V4L2_CID_BACKLIGHT_COMPENSATION,
     0,
     "backlight compensation",
     "the brightness of a pixel depends on the others"},
    {V4L2_CID_POWER_LINE_FREQUENCY,
     V4L2_CID_POWER_LINE_FREQUENCY_DISABLED,
     "filter against the flicker of lamps",
     "exposures are rounded to periods of the mains"},
}};

bool set_control(V4l2System& system, int file, const V4l2Control& control) {
  v4l2_control setting{control.id, control.value};
  return system.ioctl(file, VIDIOC_S_CTRL, &setting) >= 0;
}

/// Whether the camera has the control and it is in use.
bool has_control(V4l2System& system, int file, std::uint32_t id) {
  v4l2_queryctrl query;
  std::memset(&query, 0, sizeof query);
  query.id = id;
  return system.ioctl(file, VIDIOC_QUERYCTRL, &query) >= 0 &&
         (query.flags & V4L2_CTRL_FLAG_DISABLED) == 0;
}

}  // namespace

bool get_control(V4l2System& system, int file, V4l2Control& control) {
  v4l2_control setting{control.id, 0};
  if (system.ioctl(file, VIDIOC_G_CTRL, &setting) < 0) return false;
  control.value = setting.value;
  return true;
}

V4l2Automatics switch_off_automatics(V4l2System& system, int file) {
  V4l2Automatics done;
  for (const Automatic& automatic : kAutomatics) {
    if (!has_control(system, file, automatic.id)) continue;
    V4l2Control before{automatic.id, 0};
    const bool known = get_control(system, file, before);
    if (known && before.value == automatic.off) continue;
    const bool set = set_control(system, file, {automatic.id, automatic.off});
    const std::string cause = set ? "it keeps its value" : std::generic_category().message(errno);
    V4l2Control after{automatic.id, automatic.off};
    if (!set || (get_control(system, file, after) && after.value != automatic.off)) {
      done.warnings.push_back(fmt::format(
          "its {} cannot be switched off ({}): {}", automatic.what, cause, automatic.effect));
      continue;
    }
    if (automatic.id == V4L2_CID_FOCUS_AUTO) {
      // Switched on again, it would move the focus between the calibration and the scan.
      done.warnings.emplace_back(
          "its autofocus was on and is now off, also after the scan; calibrate it with this focus");
    } else if (known) {
      done.before.push_back(before);
    }
  }
  return done;
}

void restore_controls(V4l2System& system,
                      int file,
                      const std::vector<V4l2Control>& before) noexcept {
  for (auto control = before.rbegin(); control != before.rend(); ++control)
    static_cast<void>(set_control(system, file, *control));
}

}  // namespace frangia
