#include "frangia/decode/view_decoder.h"

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/dataset/read_frames.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::small_scan;
using testing::TemporaryFolder;

class DecodesAhead : public ::testing::Test {
 protected:
  [[nodiscard]] Image<Eigen::Vector2f> rays() const { return rays_of(scan_.rig.reference().model); }
  [[nodiscard]] std::filesystem::path frame(int view) const {
    return scan_.folder / "views" / std::to_string(view) / frame_file_name(scan_.patterns[0], 0);
  }

  TemporaryFolder folder_;
  Scan scan_ = small_scan(folder_.path(), "plate", "digital", 3, {}, 4);
};

TEST_F(DecodesAhead, GivesTheViewsInTheirOrderAsDecodedOneByOne) {
  const auto rays_of_camera = rays();
  const DecodeOptions options;
  const frangia::Run run;
  ViewDecoder decoder(scan_, rays_of_camera, options, run);
  for (std::size_t view = 0; view < scan_.views.size(); ++view) {
    const DecodedView expected =
        decode_view(read_frames(scan_, view), scan_.rig, rays_of_camera, options);
    const DecodedView found = decoder.next();
    const auto a = found.directions.front().phase.phase_rad.pixels();
    const auto b = expected.directions.front().phase.phase_rad.pixels();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), [](float x, float y) {
      return x == y || (std::isnan(x) && std::isnan(y));
    }));
  }
}

TEST_F(DecodesAhead, ThrowsTheErrorOfAViewInItsTurn) {
  std::filesystem::remove(frame(1));
  std::filesystem::remove(frame(2));
  const auto rays_of_camera = rays();
  const DecodeOptions options;
  const frangia::Run run;
  ViewDecoder decoder(scan_, rays_of_camera, options, run);
  EXPECT_NO_THROW(static_cast<void>(decoder.next()));
  try {
    static_cast<void>(decoder.next());
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(frame(1).string()), std::string::npos) << error.what();
  }
}

TEST_F(DecodesAhead, StopsAViewThatIsBeingDecodedWhenTheUserAsks) {
  std::stop_source source;
  frangia::Run run;
  run.stop = source.get_token();
  const auto rays_of_camera = rays();
  const DecodeOptions options;
  ViewDecoder decoder(scan_, rays_of_camera, options, run);
  static_cast<void>(decoder.next());
  source.request_stop();
  try {
    // One view may have been complete already; none is started after the request.
    static_cast<void>(decoder.next());
    static_cast<void>(decoder.next());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Cancelled);
  }
}

TEST_F(DecodesAhead, CallsTheCallbacksOnTheCallersThreadInTheOrderOfViews) {
  std::vector<std::string> messages;
  std::vector<std::thread::id> threads;
  frangia::Run run;
  run.on_note = [&](const std::string& sentence) {
    messages.push_back(sentence);
    threads.push_back(std::this_thread::get_id());
  };
  const auto rays_of_camera = rays();
  DecodeOptions options;
  options.recover_saturated = true;  // makes a note for each pattern
  ViewDecoder decoder(scan_, rays_of_camera, options, run);
  for (std::size_t view = 0; view < scan_.views.size(); ++view) {
    EXPECT_EQ(messages.size(), view * scan_.patterns.size());
    static_cast<void>(decoder.next());
  }
  EXPECT_EQ(messages.size(), scan_.views.size() * scan_.patterns.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const std::string folder = scan_.views[i / scan_.patterns.size()].folder.string();
    EXPECT_TRUE(messages[i].starts_with(folder + ": pattern")) << messages[i];
  }
  for (const std::thread::id thread : threads)
    EXPECT_EQ(thread, std::this_thread::get_id());
}

}  // namespace
}  // namespace frangia
