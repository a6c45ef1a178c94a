#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include <arv.h>

namespace frangia::testing {

/// What a fake camera is asked for when it fills a frame.
struct FakeExposure {
  double exposure_us = 0.0;
  double gain = 0.0;
  int width_px = 0;
  int height_px = 0;
  int bytes_per_px = 1;
  int black_level = 0;
};

/// Aravis' fake GigE Vision camera on 127.0.0.1, with a black level added to its description, whose
/// pictures a test paints, and which loses packets where that is wanted.
class FakeGigeCamera {
 public:
  using Paint = std::function<void(const FakeExposure&, std::uint8_t* pixels)>;

  FakeGigeCamera(const std::string& serial, const std::filesystem::path& folder, Paint paint)
      : paint_(std::move(paint)) {
    const auto description = folder / "camera.xml";
    write_description(description);
    camera_ = arv_gv_fake_camera_new_full("127.0.0.1", serial.c_str(), description.c_str());
    if (arv_gv_fake_camera_is_running(camera_) == FALSE) throw std::runtime_error("no fake camera");
    fake_ = arv_gv_fake_camera_get_fake_camera(camera_);
    arv_fake_camera_set_fill_pattern(fake_, &FakeGigeCamera::fill, this);
  }
  FakeGigeCamera(const FakeGigeCamera&) = delete;
  FakeGigeCamera& operator=(const FakeGigeCamera&) = delete;
  FakeGigeCamera(FakeGigeCamera&&) = delete;
  FakeGigeCamera& operator=(FakeGigeCamera&&) = delete;
  ~FakeGigeCamera() { stop(); }

  void stop() {
    if (camera_ != nullptr) g_object_unref(std::exchange(camera_, nullptr));
  }
  /// Of its packets, from now on.
  void set_packet_loss(double share) { g_object_set(camera_, "gvsp-lost-ratio", share, nullptr); }

 private:
  static constexpr std::uint32_t kBlackLevelRegister = 0x400;

  /// The stock description has no black level: give it a register that the camera does not use.
  static void write_description(const std::filesystem::path& file) {
    ArvCamera* stock = nullptr;
    arv_enable_interface("Fake");
    stock = arv_camera_new("Fake_1", nullptr);
    if (stock == nullptr) throw std::runtime_error("no stock description");
    std::size_t size = 0;
    std::string xml = arv_device_get_genicam_xml(arv_camera_get_device(stock), &size);
    g_object_unref(stock);
    arv_disable_interface("Fake");
    xml.resize(std::min(xml.size(), size));
    const std::string nodes =
        "<Integer Name=\"BlackLevelRaw\"><pValue>BlackLevelRegister</pValue><Min>0</Min>"
        "<Max>255</Max></Integer>\n"
        "<IntReg Name=\"BlackLevelRegister\"><Address>0x400</Address><Length>4</Length>"
        "<AccessMode>RW</AccessMode><pPort>Device</pPort><Sign>Unsigned</Sign>"
        "<Endianess>BigEndian</Endianess></IntReg>\n";
    const std::size_t end = xml.rfind("</RegisterDescription>");
    if (end == std::string::npos) throw std::runtime_error("another kind of description");
    xml.insert(end, nodes);
    std::ofstream(file) << xml;
  }

  static void fill(
      ArvBuffer* buffer, void* self, guint32 exposure_us, guint32 gain, ArvPixelFormat format) {
    auto* me = static_cast<FakeGigeCamera*>(self);
    FakeExposure exposure;
    exposure.exposure_us = exposure_us;
    exposure.gain = gain;
    exposure.bytes_per_px = format == ARV_PIXEL_FORMAT_MONO_8 ? 1 : 2;
    exposure.width_px = me->read(ARV_FAKE_CAMERA_REGISTER_WIDTH);
    exposure.height_px = me->read(ARV_FAKE_CAMERA_REGISTER_HEIGHT);
    exposure.black_level = me->read(kBlackLevelRegister);
    // The buffer may be larger than a frame: its own size says nothing.
    std::size_t size = 0;
    auto* pixels =
        static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, &size)));
    me->paint_(exposure, pixels);
  }
  [[nodiscard]] int read(std::uint32_t address) const {
    std::uint32_t value = 0;
    arv_fake_camera_read_register(fake_, address, &value);
    return static_cast<int>(value);
  }

  Paint paint_;
  ArvGvFakeCamera* camera_ = nullptr;
  ArvFakeCamera* fake_ = nullptr;
};

}  // namespace frangia::testing
