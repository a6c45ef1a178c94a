// Every verb ends within a second of the first Ctrl-C.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "frangia/core/angles.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/mesh.h"

#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using Clock = std::chrono::steady_clock;
using testing::run_program;
using testing::TemporaryFolder;

constexpr double kMost_s = 1.0;

/// A sphere with bumps, roughness and holes: 440 000 triangles.
Mesh rough_sphere() {
  constexpr std::uint32_t kAround = 720;
  constexpr std::uint32_t kDown = 310;
  Mesh mesh;
  for (std::uint32_t row = 0; row <= kDown; ++row) {
    const double polar = kPi * (0.03 + 0.94 * row / kDown);
    for (std::uint32_t column = 0; column < kAround; ++column) {
      const double turn = kTwoPi * column / kAround;
      const double roughness = 0.01 * std::sin(1e4 * turn + 3e3 * polar);
      const double radius_mm =
          40.0 + 2.0 * std::sin(9.0 * turn) * std::sin(7.0 * polar) + roughness;
      mesh.vertices_mm.emplace_back(Eigen::Vector3d(radius_mm * std::sin(polar) * std::cos(turn),
                                                    radius_mm * std::sin(polar) * std::sin(turn),
                                                    radius_mm * std::cos(polar))
                                        .cast<float>());
    }
  }
  for (std::uint32_t row = 0; row < kDown; ++row) {
    for (std::uint32_t column = 0; column < kAround; ++column) {
      if (row % 60 == 30 && column % 60 == 30) continue;  // a hole
      const std::uint32_t a = row * kAround + column;
      const std::uint32_t b = row * kAround + (column + 1) % kAround;
      mesh.triangles.push_back({a, a + kAround, b});
      mesh.triangles.push_back({b, a + kAround, b + kAround});
    }
  }
  return mesh;
}

/// Processor time of a process so far, in seconds.
double processor_seconds(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  text.erase(0, std::min(text.size(), text.rfind(')') + 1));
  std::istringstream fields(text);
  std::string skipped;
  for (int i = 3; i < 14; ++i)
    fields >> skipped;
  double user = 0.0;
  double system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

/// How a program ended after a signal.
struct Ending {
  int exit_code = -1;
  double elapsed_s = 0.0;
  double processor_s = 0.0;
};

/// Runs the program, and interrupts it after a delay.
Ending interrupt(const std::string& arguments, double after_s) {
  const std::string command =
      std::string("exec ") + FRANGIA_PROGRAM + " --quiet " + arguments + " >/dev/null 2>&1";
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);  // NOLINT(*-vararg)
    ::_exit(127);
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
  const double processor_before_s = processor_seconds(child);
  const auto start = Clock::now();
  ::kill(child, SIGINT);
  int status = 0;
  struct rusage usage = {};
  ::wait4(child, &status, 0, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  // Before the program handles signals, SIGINT ends it; a shell reports 130 for both.
  const bool by_interrupt = WIFSIGNALED(status) && WTERMSIG(status) == SIGINT;
  return {WIFEXITED(status) ? WEXITSTATUS(status)
          : by_interrupt    ? 130
                            : -1,
          std::chrono::duration<double>(Clock::now() - start).count(),
          seconds(usage.ru_utime) + seconds(usage.ru_stime) - processor_before_s};
}

class InterruptProgram : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder() = std::make_unique<TemporaryFolder>();
    write_mesh(path("mesh.ply"), rough_sphere());
    const auto scan = run_program("simulate bracket --rig angular --views 12 -o " + path("scan"));
    ASSERT_EQ(scan.exit_code, 0) << scan.output;
  }
  static void TearDownTestSuite() { folder().reset(); }
  static std::string path(const std::string& name) { return (folder()->path() / name).string(); }

  /// Other processes may take the processors, so the limit is for the shorter of the elapsed time
  /// and the program's own processor time.
  static void expect_prompt_end(const std::string& arguments, double after_s = 0.4) {
    const Ending ending = interrupt(arguments, after_s);
    EXPECT_TRUE(ending.exit_code == 130 || ending.exit_code == 0)
        << arguments << " ended with " << ending.exit_code;
    EXPECT_LT(std::min(ending.elapsed_s, ending.processor_s), kMost_s) << arguments;
  }
  static void expect_prompt_edit(const std::string& operations, double after_s = 0.6) {
    expect_prompt_end("edit " + path("mesh.ply") + " " + operations + " -o " + path("edited.ply"),
                      after_s);
  }

 private:
  static std::unique_ptr<TemporaryFolder>& folder() {
    static std::unique_ptr<TemporaryFolder> all;
    return all;
  }
};

TEST_F(InterruptProgram, EditsStop) {
  for (const char* operation : {"--decimate 0.001",
                                "--decimate-to 1000",
                                "--remesh 0.2",
                                "--fill-holes 100",
                                "--fill-holes-flat 100",
                                "--smooth 1000",
                                "--smooth-keeping-edges 100",
                                "--offset 0.5",
                                "--cut-capped 0,0,1,0",
                                "--mirror 0,0,1,0",
                                "--remove-self-intersections",
                                "--remove-spikes",
                                "--make-manifold",
                                "--orient",
                                "--stitch 0.01",
                                "--select-curvature 0.1 --grow 50"})
    expect_prompt_edit(operation);
}

TEST_F(InterruptProgram, RemeshingStopsInEachOfItsPhases) {
  for (const double after_s : {1.5, 3.0})
    expect_prompt_edit("--remesh 0.2", after_s);
}

TEST_F(InterruptProgram, ReconstructionsStop) {
  const std::string scan = path("scan");
  for (const double after_s : {0.3, 1.0})
    expect_prompt_end("reconstruct " + scan + " --watertight -o " + path("a.ply"), after_s);
  expect_prompt_end("decode " + scan + " -o " + path("stages"), 0.2);
  expect_prompt_end("merge " + path("mesh.ply") + " " + path("mesh.ply") + " -o " + path("m.ply"));
}

TEST_F(InterruptProgram, SimulationsStop) {
  for (const char* part : {"bust", "bracket"}) {
    expect_prompt_end(std::string("simulate ") + part + " --views 200 --samples 64 -o " +
                      path("rendered"));
  }
  expect_prompt_end("simulate bracket --views 200 --samples 64 -o " + path("rendered"), 2.0);
  expect_prompt_end("demo -o " + path("demo"));
}

TEST_F(InterruptProgram, InspectionsAndPicturesStop) {
  expect_prompt_end("inspect " + path("mesh.ply") + " --reference " + path("mesh.ply"));
  expect_prompt_end(
      "picture " + path("mesh.ply") + " --width 8000 --height 8000 -o " + path("picture.png"), 1.0);
}

TEST_F(InterruptProgram, ShortVerbsStop) {
  expect_prompt_end("plan --rig digital --fringes 64", 0.0);
  expect_prompt_end("algorithms", 0.0);
  expect_prompt_end("devices --no-search", 0.0);
}

}  // namespace
}  // namespace frangia
