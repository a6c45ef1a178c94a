#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/simulate/internal/simulated_devices.h"

namespace frangia {
namespace {

class SimulatedDisplay final : public PatternDisplay {
 public:
  SimulatedDisplay(DeviceSettings& settings, const Rig& rig, BenchPtr bench)
      : bench_(std::move(bench)) {
    const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
    if (pinhole == nullptr) settings.fail("driver", "is a digital projector, but the rig has none");
    layout_ = rig.projector.pixels;
    const std::array<int, 2> size = image_size(layout_, pinhole->width_px, pinhole->height_px);
    info_.width_px = size[0];
    info_.height_px = size[1];
    if (const double rate_hz = settings.number_or("refresh_hz", 0.0, 0.0, 1000.0); rate_hz > 0.0)
      info_.refresh_period_ms = 1000.0 / rate_hz;
    latency_s_ = 1e-3 * settings.number_or("latency_ms", 0.0, 0.0, 10'000.0);
    delay_s_ = settings.number_or("delay_s", 0.0, 0.0, 10.0);
  }

  [[nodiscard]] std::string name() const override { return "simulated display"; }
  [[nodiscard]] const DisplayInfo& info() const override { return info_; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    return fmt::format("{} x {} pixels", info_.width_px, info_.height_px);
  }
  void make_safe() noexcept override { bench_->pictures.assign(1, {}); }
  void show(const Image<float>& light, const Deadline& deadline) override {
    deadline.check();
    const double period_s = 1e-3 * info_.refresh_period_ms;
    double& clock_s = bench_->clock_s;
    if (period_s > 0.0) clock_s = period_s * std::ceil(clock_s / period_s);
    auto& pictures = bench_->pictures;
    pictures.push_back(
        {clock_s + latency_s_, layout_ == PixelLayout::Square ? light : on_chip(light)});
    clock_s += delay_s_;
    while (pictures.size() > 1 && pictures[1].from_s <= clock_s)
      pictures.erase(pictures.begin());
  }
  void show_dark(const Deadline& /*deadline*/) override { bench_->pictures.assign(1, {}); }
  [[nodiscard]] double delay_s() const override { return delay_s_; }
  void set_delay(double seconds) override { delay_s_ = seconds; }

 private:
  /// The light at every place of a chip with diamond pixels; each pixel lights two places of its
  /// row.
  static Image<float> on_chip(const Image<float>& image) {
    Image<float> chip(2 * image.width(), image.height(), 0.0F);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const int column = chip_column(PixelLayout::Diamond, x, y);
        chip(column, y) = image(x, y);
        if (column + 1 < chip.width()) chip(column + 1, y) = image(x, y);
      }
    }
    return chip;
  }

  BenchPtr bench_;
  DisplayInfo info_;
  double latency_s_ = 0.0;  ///< from the buffer swap until a picture is on the screen
  double delay_s_ = 0.0;
  PixelLayout layout_ = PixelLayout::Square;
};

class SimulatedSwitch final : public SwitchDevice {
 public:
  SimulatedSwitch(BenchPtr bench, bool SimulatedBench::*light)
      : bench_(std::move(bench)), light_(light) {
    (*bench_).*light_ = false;
  }
  [[nodiscard]] std::string name() const override {
    return light_ == &SimulatedBench::line_light ? "simulated laser sheet" : "simulated light";
  }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    return is_on() ? "on" : "off";
  }
  void make_safe() noexcept override { (*bench_).*light_ = false; }
  void set(bool on, const Deadline& /*deadline*/) override { (*bench_).*light_ = on; }
  [[nodiscard]] bool is_on() const override { return (*bench_).*light_; }

 private:
  BenchPtr bench_;
  bool SimulatedBench::*light_;
};

}  // namespace

std::unique_ptr<PatternDisplay> open_simulated_display(DeviceSettings& settings,
                                                       const Rig& rig,
                                                       BenchPtr bench) {
  return std::make_unique<SimulatedDisplay>(settings, rig, std::move(bench));
}

std::unique_ptr<SwitchDevice> open_simulated_switch(BenchPtr bench, bool SimulatedBench::*light) {
  return std::make_unique<SimulatedSwitch>(std::move(bench), light);
}

}  // namespace frangia
