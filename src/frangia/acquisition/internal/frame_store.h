#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/frames/frame.h"

namespace frangia {

/// Packs and stores frames on a thread of its own, one after the other, while the next ones are
/// taken. What it is given counts for the manifest's questions at once; should the disk fail, the
/// next call says so.
class FrameStore {
 public:
  explicit FrameStore(CaptureManifest& manifest);
  FrameStore(const FrameStore&) = delete;
  FrameStore& operator=(const FrameStore&) = delete;
  FrameStore(FrameStore&&) = delete;
  FrameStore& operator=(FrameStore&&) = delete;
  /// Stores what was put, unless the disk failed.
  ~FrameStore();

  /// Waits while three things are on their way to the disk.
  /// errors   what went wrong with an earlier frame
  void put(std::string file, std::shared_ptr<const Frame> frame, const ManifestFrame& about);
  /// A outcome on a set, after all its frames.
  void put(const std::string& set, const ManifestSet& outcome);
  /// Returns when all frames are acknowledged.
  /// errors   as `put`
  void drain();

  /// How long the callers of `put` and `drain` were kept waiting for the disk, in seconds.
  [[nodiscard]] double disk_wait_s();

 private:
  struct Job {
    std::string file;
    std::shared_ptr<const Frame> frame;
    ManifestFrame about;
    ManifestSet outcome;  ///< of the set `file`, when there is no frame
  };
  void work();
  void push(Job job);
  void store(const Job& job);
  void wait_until(std::unique_lock<std::mutex>& lock, std::size_t pending);

  CaptureManifest& manifest_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;  ///< the first one is being stored
  std::exception_ptr fault_;
  bool writing_to_disk_ = false;  ///< the thread waits for the disk, not for its own packing
  bool done_ = false;
  double disk_wait_s_ = 0.0;
  std::thread thread_;
};

}  // namespace frangia
