#ifdef FRANGIA_WITH_GLFW

#include "frangia/devices/internal/glfw_display.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace frangia {
namespace {

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw Error(ErrorKind::Device, name + ": " + what);
}

/// The last error of GLFW.
std::string glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason given";
}

/// Initializes GLFW for the first user and terminates it after the last, since GLFW does not count.
class Glfw {
 public:
  Glfw() {
    if (glfwInit() == GLFW_FALSE) {
      fail("monitor",
           fmt::format("no screen found ({}); run this in a desktop session, or set DISPLAY",
                       glfw_error()));
    }
    ++users();
  }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
  Glfw(Glfw&&) = delete;
  Glfw& operator=(Glfw&&) = delete;
  ~Glfw() {
    if (--users() == 0) glfwTerminate();
  }
  [[nodiscard]] static std::vector<GLFWmonitor*> monitors() {
    int count = 0;
    GLFWmonitor** all = glfwGetMonitors(&count);
    return {all, all + count};
  }

 private:
  static int& users() {
    static int count = 0;
    return count;
  }
};

std::string name_of(std::size_t number, GLFWmonitor* monitor) {
  return fmt::format("monitor {} {}", number, glfwGetMonitorName(monitor));
}

class GlfwDisplay final : public PatternDisplay {
 public:
  explicit GlfwDisplay(const GlfwSettings& settings) : settings_(settings) {
    GLFWmonitor* monitor = find(settings.monitor);
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    info_.width_px = mode->width;
    info_.height_px = mode->height;
    info_.refresh_period_ms = mode->refreshRate > 0 ? 1000.0 / mode->refreshRate : 0.0;
    open_window(monitor, *mode);
    levels_.resize(static_cast<std::size_t>(info_.width_px) *
                   static_cast<std::size_t>(info_.height_px));
    fill_table();
    show_dark(Deadline::in(5.0));
  }
  GlfwDisplay(const GlfwDisplay&) = delete;
  GlfwDisplay& operator=(const GlfwDisplay&) = delete;
  GlfwDisplay(GlfwDisplay&&) = delete;
  GlfwDisplay& operator=(GlfwDisplay&&) = delete;
  ~GlfwDisplay() override {
    if (window_ != nullptr) glfwDestroyWindow(window_);
  }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] const DisplayInfo& info() const override { return info_; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    return fmt::format("{} x {} pixels, {:.1f} ms per image",
                       info_.width_px,
                       info_.height_px,
                       info_.refresh_period_ms);
  }
  void make_safe() noexcept override {
    try {
      show_dark(Deadline::in(1.0));
    } catch (...) {  // a closed window shows nothing
      return;
    }
  }

  void show(const Image<float>& light, const Deadline& deadline) override {
    if (light.width() != info_.width_px || light.height() != info_.height_px) {
      fail(name_,
           fmt::format("an image of {} x {} pixels does not fit its {} x {}",
                       light.width(),
                       light.height(),
                       info_.width_px,
                       info_.height_px));
    }
    const auto pixels = light.pixels();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      levels_[i] = table_[static_cast<std::size_t>(
          std::lround(std::clamp(pixels[i], 0.0F, 1.0F) * static_cast<float>(table_.size() - 1)))];
    }
    show_levels(deadline);
  }
  [[nodiscard]] double delay_s() const override { return settings_.delay_s; }
  void set_delay(double seconds) override { settings_.delay_s = seconds; }
  void show_dark(const Deadline& deadline) override {
    std::fill(levels_.begin(), levels_.end(), std::uint8_t{0});
    show_levels(deadline);
  }

 private:
  GLFWmonitor* find(const std::string& wanted) {
    const auto monitors = Glfw::monitors();
    if (monitors.empty()) fail("monitor", "no monitor found; connect the projector");
    std::string names;
    for (std::size_t i = 0; i < monitors.size(); ++i) {
      const bool last = wanted.empty() && i + 1 == monitors.size();
      if (last || wanted == std::to_string(i) || wanted == glfwGetMonitorName(monitors[i])) {
        name_ = name_of(i, monitors[i]);
        return monitors[i];
      }
      names += (names.empty() ? "" : ", ") + name_of(i, monitors[i]);
    }
    fail("monitor " + wanted, "it does not exist; the monitors are: " + names);
  }

  void open_window(GLFWmonitor* monitor, const GLFWvidmode& mode) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_RED_BITS, mode.redBits);
    glfwWindowHint(GLFW_GREEN_BITS, mode.greenBits);
    glfwWindowHint(GLFW_BLUE_BITS, mode.blueBits);
    glfwWindowHint(GLFW_REFRESH_RATE, mode.refreshRate);
    glfwWindowHint(GLFW_DECORATED, GLFW_FALSE);
    glfwWindowHint(GLFW_AUTO_ICONIFY,
                   GLFW_FALSE);  // keep it open when another window gets the focus
    glfwWindowHint(GLFW_FOCUSED, GLFW_FALSE);
    glfwWindowHint(GLFW_SAMPLES, 0);
    window_ = glfwCreateWindow(mode.width, mode.height, "frangia", monitor, nullptr);
    if (window_ == nullptr)
      fail(name_, fmt::format("cannot open a window on it ({})", glfw_error()));
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetInputMode(window_, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    glfwPollEvents();
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    if (width != info_.width_px || height != info_.height_px)
      fail(name_, "the desktop scales its image; set the scale to 100 %");
  }

  /// Converts light to levels with a table of 4096 steps, finer than the 256 output levels.
  void fill_table() {
    table_.resize(4096);
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const double light = static_cast<double>(i) / static_cast<double>(table_.size() - 1);
      const double level = settings_.response ? settings_.response->level_of(light) : light;
      table_[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(level, 0.0, 1.0)));
    }
  }

  void show_levels(const Deadline& deadline) {
    deadline.check();
    glfwMakeContextCurrent(window_);
    glDisable(GL_DITHER);
    glDisable(GL_BLEND);
    glViewport(0, 0, info_.width_px, info_.height_px);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glRasterPos2f(-1.0F, 1.0F);
    glPixelZoom(1.0F, -1.0F);
    glDrawPixels(info_.width_px, info_.height_px, GL_LUMINANCE, GL_UNSIGNED_BYTE, levels_.data());
    glfwSwapBuffers(window_);
    glFinish();  // returns after the buffer swap
    glfwPollEvents();
    if (glfwWindowShouldClose(window_) == GLFW_TRUE) fail(name_, "its window was closed");
    deadline.sleep(settings_.delay_s);
  }

  Glfw glfw_;
  GlfwSettings settings_;
  std::string name_;
  DisplayInfo info_;
  GLFWwindow* window_ = nullptr;
  std::vector<std::uint8_t> table_;
  std::vector<std::uint8_t> levels_;
};

/// Segments of a digit as on a pocket calculator, bit 0 at the top, then clockwise, bit 6 in the
/// middle.
constexpr std::array<unsigned, 10> kSegments = {
    0x3FU, 0x06U, 0x5BU, 0x4FU, 0x66U, 0x6DU, 0x7DU, 0x07U, 0x7FU, 0x6FU};

/// Whether a point of a digit is lit; its box is from 0 to 1 each way, y downwards.
bool is_lit(unsigned digit, double x, double y) {
  constexpr double kThick = 0.16;
  constexpr double kHalf = 0.5;
  const unsigned segments = kSegments.at(digit);
  const auto on = [&](unsigned bit) { return (segments >> bit & 1U) != 0U; };
  const bool left = x < kThick;
  const bool right = x > 1.0 - kThick;
  return (y < kThick / 2 && on(0)) || (y > 1.0 - kThick / 2 && on(3)) ||
         (std::abs(y - kHalf) < kThick / 4 && on(6)) || (right && y < kHalf && on(1)) ||
         (right && y >= kHalf && on(2)) || (left && y >= kHalf && on(4)) ||
         (left && y < kHalf && on(5));
}

/// A digit in the middle of a dark picture.
Image<float> digit_image(int width, int height, unsigned digit) {
  constexpr double kShare = 0.5;   // of the height
  constexpr double kNarrow = 0.5;  // width over height of the digit
  const double tall = kShare * height;
  const double wide = kNarrow * tall;
  Image<float> image(width, height, 0.0F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = (x - 0.5 * (width - wide)) / wide;
      const double v = (y - 0.5 * (height - tall)) / tall;
      if (u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0 && is_lit(digit, u, v)) image(x, y) = 1.0F;
    }
  }
  return image;
}

}  // namespace

void identify_glfw_monitors(const Deadline& deadline) {
  const Glfw glfw;
  std::vector<std::unique_ptr<PatternDisplay>> displays;
  const std::size_t count = std::min(Glfw::monitors().size(), kSegments.size());
  for (std::size_t i = 0; i < count; ++i) {
    displays.push_back(open_glfw_display(
        {.monitor = std::to_string(i), .delay_s = 0.0, .response = std::nullopt}));
    const DisplayInfo& info = displays.back()->info();
    displays.back()->show(digit_image(info.width_px, info.height_px, static_cast<unsigned>(i)),
                          deadline);
  }
  if (displays.empty()) fail("monitor", "no monitor found; connect the projector");
  deadline.sleep(kIdentify_s);
}

std::unique_ptr<PatternDisplay> open_glfw_display(const GlfwSettings& settings) {
  return std::make_unique<GlfwDisplay>(settings);
}

std::vector<FoundDevice> find_glfw_monitors() {
  const Glfw glfw;
  std::vector<FoundDevice> found;
  const auto monitors = Glfw::monitors();
  for (std::size_t i = 0; i < monitors.size(); ++i) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    const std::string name = glfwGetMonitorName(monitors[i]);
    // Two monitors of one model differ by their number alone.
    const bool unique = std::count_if(monitors.begin(), monitors.end(), [&](GLFWmonitor* other) {
                          return name == glfwGetMonitorName(other);
                        }) == 1;
    found.push_back({fmt::format("{}, {} x {} pixels{}",
                                 name_of(i, monitors[i]),
                                 mode->width,
                                 mode->height,
                                 i == 0 ? ", the primary monitor" : ""),
                     fmt::format("driver = \"monitor\"\nmonitor = \"{}\"\n",
                                 unique ? name : std::to_string(i))});
  }
  return found;
}

}  // namespace frangia

#endif
