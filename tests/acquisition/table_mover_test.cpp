// A turntable without a home switch over several sessions of a scan.
#include <string>
#include <vector>

#include "frangia/acquisition/capture_scan.h"

#include "support/error_of.h"
#include "support/simulated_capture.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::text_of;

class TableWithoutSwitch : public testing::SimulatedCapture {
 protected:
  TableWithoutSwitch() { place_table(0.0); }
  /// Opens the next session with the table at an angle that its motor does not know.
  void place_table(double angle_deg, const std::string& more = {}) {
    devices_["turntable"] =
        "driver = \"simulated\"\nhome = \"here\"\nstart_deg = " + std::to_string(angle_deg) + "\n" +
        more;
  }
  [[nodiscard]] std::string complaint(const CaptureOptions& options = {}) {
    return error_of([&] { static_cast<void>(capture(options)); });
  }
  void interrupt_at(double share) {
    stop_at_ = share;
    static_cast<void>(complaint());
    stop_ = std::stop_source();
    stop_at_ = 2.0;
  }
  static CaptureOptions table_at(double angle_deg) {
    CaptureOptions options;
    options.table_at_rad = rad_from_deg(angle_deg);
    return options;
  }
  /// The last line about the table, without its checksum.
  [[nodiscard]] std::string last_table_line() const {
    const std::string text = text_of(plan_.folder / "capture/manifest.txt");
    const std::size_t line = text.rfind("table ");
    return line == std::string::npos ? "" : text.substr(line, text.find(" crc=", line) - line);
  }
};

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(TableWithoutSwitch, NeedsItsAngleToContinueAScan) {
  static_cast<void>(capture());
  const auto whole = images();
  std::filesystem::remove_all(plan_.folder);
  interrupt_at(0.45);
  EXPECT_EQ(last_table_line(), "table at 120") << "nothing moves after a stop";
  place_table(120.0);
  const auto stored = images();
  const std::string sentence = complaint();
  EXPECT_TRUE(says(sentence, "simulated turntable: has no home switch")) << sentence;
  EXPECT_TRUE(says(sentence, "left it at 120 degrees")) << sentence;
  EXPECT_TRUE(says(sentence, "set `table_at_rad` to 120")) << sentence;
  EXPECT_TRUE(images() == stored) << "nothing was captured";
  EXPECT_EQ(complaint(table_at(120.0)), "");
  EXPECT_TRUE(images() == whole);
}

TEST_F(TableWithoutSwitch, ContinuesFromAnyStatedAngle) {
  static_cast<void>(capture());
  const auto whole = images();
  std::filesystem::remove_all(plan_.folder);
  interrupt_at(0.45);
  place_table(0.0);  // turned back by hand
  EXPECT_EQ(complaint(table_at(0.0)), "");
  EXPECT_TRUE(images() == whole);
  ASSERT_FALSE(warnings_.empty());
  EXPECT_TRUE(says(warnings_.front(), "left it at 120 degrees, and `table_at_rad` is 0"))
      << warnings_.front();
}

TEST_F(TableWithoutSwitch, ReturnsToZeroAfterACompleteScan) {
  static_cast<void>(capture());
  EXPECT_EQ(last_table_line(), "table at 0");
}

TEST_F(TableWithoutSwitch, IsNotNeededWhenNothingIsMissing) {
  static_cast<void>(capture());
  place_table(77.0);
  EXPECT_EQ(capture().captured, 0U);
  std::filesystem::remove(plan_.folder / "scan.toml");
  EXPECT_EQ(capture().captured, 0U);
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "scan.toml"));
}

TEST_F(TableWithoutSwitch, KeepsItsAngleThroughAFaultOfTheCamera) {
  static_cast<void>(capture());
  const auto whole = images();
  std::filesystem::remove_all(plan_.folder);
  devices_["camera"] += "faults = [\"lost 1 fringe 2\"]\n";
  EXPECT_TRUE(capture().skipped.empty());
  EXPECT_TRUE(images() == whole);
}

TEST_F(TableWithoutSwitch, LosesItsAngleInAFaultWhileItMoves) {
  place_table(0.0, "faults = [\"alarm 240\"]\n");
  EXPECT_TRUE(says(complaint(), "no home switch")) << complaint();
  EXPECT_EQ(last_table_line(), "table moving 240");
  const std::string sentence = complaint();
  EXPECT_TRUE(says(sentence, "ended while it turned from 120 to 240 degrees")) << sentence;
  EXPECT_TRUE(says(sentence, "turn it to 0 by hand")) << sentence;
}

TEST_F(TableWithoutSwitch, BeginsAtAStatedAngle) {
  static_cast<void>(capture());
  const auto whole = images();
  std::filesystem::remove_all(plan_.folder);
  place_table(30.0);
  EXPECT_EQ(complaint(table_at(30.0)), "");
  EXPECT_TRUE(images() == whole);
}

TEST_F(TableWithoutSwitch, IsAskedForOnlyWithoutAHomeSwitch) {
  devices_["turntable"] = "driver = \"simulated\"\n";
  EXPECT_TRUE(says(complaint(table_at(30.0)), "leave `table_at_rad` out"));
}

TEST_F(TableWithoutSwitch, DoesNotReturnAfterASkippedView) {
  devices_["turntable"] = "driver = \"simulated\"\nfaults = [\"stuck 120 always\"]\n";
  EXPECT_EQ(capture().skipped.size(), 1U);
  EXPECT_EQ(last_table_line(), "table at 240");
}

TEST_F(TableWithoutSwitch, ThatCannotReturnLeavesACompleteScan) {
  devices_["turntable"] = "driver = \"simulated\"\n";
  plan_.views.front().angle_rad = rad_from_deg(10.0);
  devices_["turntable"] += "faults = [\"stuck 0\"]\n";
  EXPECT_EQ(capture().captured, 15U);
  ASSERT_FALSE(warnings_.empty());
  EXPECT_TRUE(says(warnings_.back(), "the turntable did not return to 0")) << warnings_.back();
  EXPECT_EQ(read_scan(plan_.folder).views.size(), 3U);
}

}  // namespace
}  // namespace frangia
