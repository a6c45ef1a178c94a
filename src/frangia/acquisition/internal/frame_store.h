#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Encodes and stores frames in order on a thread of its own while the next ones are captured. A
/// frame is in the manifest's memory as soon as `put` returns; an error of the disk is thrown by
/// the next call.
class FrameStore {
 public:
  explicit FrameStore(CaptureManifest& manifest);
  FrameStore(const FrameStore&) = delete;
  FrameStore& operator=(const FrameStore&) = delete;
  FrameStore(FrameStore&&) = delete;
  FrameStore& operator=(FrameStore&&) = delete;
  /// Waits until all frames are stored, unless the disk failed.
  ~FrameStore();

  /// Queues a frame; waits while three items are queued.
  /// @errors   the error of an earlier frame
  void put(std::string file, std::shared_ptr<const Frame> frame, const ManifestFrame& about);
  /// Queues the outcome of a set, after all its frames.
  void put(const std::string& set, const ManifestSet& outcome);
  /// Waits until all items are on the disk.
  /// @errors   as `put`
  void drain();

  /// Time that `put` and `drain` waited for the disk.
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
  std::deque<Job> jobs_;  ///< the front one is being stored
  std::exception_ptr fault_;
  bool writing_to_disk_ = false;  ///< the thread waits for the disk and is not encoding
  bool done_ = false;
  double disk_wait_s_ = 0.0;
  std::thread thread_;
};

}  // namespace frangia
