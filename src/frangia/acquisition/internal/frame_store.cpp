#include "frangia/acquisition/internal/frame_store.h"

#include <chrono>
#include <utility>
#include <vector>

#include "frangia/frames/png.h"

namespace frangia {

FrameStore::FrameStore(CaptureManifest& manifest)
    : manifest_(manifest), thread_([this] { work(); }) {}

FrameStore::~FrameStore() {
  {
    const std::scoped_lock lock(mutex_);
    done_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FrameStore::put(std::string file,
                     std::shared_ptr<const Frame> frame,
                     const ManifestFrame& about) {
  manifest_.add(file, about);
  push({std::move(file), std::move(frame), about, {}});
}

void FrameStore::put(const std::string& set, const ManifestSet& outcome) {
  manifest_.add(set, outcome);
  push({set, nullptr, {}, outcome});
}

void FrameStore::push(Job job) {
  constexpr std::size_t kPending = 2;  // besides this one
  std::unique_lock lock(mutex_);
  wait_until(lock, kPending);
  jobs_.push_back(std::move(job));
  changed_.notify_all();
}

void FrameStore::drain() {
  std::unique_lock lock(mutex_);
  wait_until(lock, 0);
}

double FrameStore::disk_wait_s() {
  const std::scoped_lock lock(mutex_);
  return disk_wait_s_;
}

void FrameStore::wait_until(std::unique_lock<std::mutex>& lock, std::size_t pending) {
  while (jobs_.size() > pending && !fault_) {
    const bool writing_to_disk = writing_to_disk_;
    const auto begin = std::chrono::steady_clock::now();
    changed_.wait(lock);
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
    if (writing_to_disk) disk_wait_s_ += waited.count();
  }
  if (fault_) std::rethrow_exception(fault_);
}

void FrameStore::store(const Job& job) {
  if (!job.frame) return manifest_.store(job.file, job.outcome);
  const std::vector<char> bytes = encode_png(*job.frame);
  {
    const std::scoped_lock lock(mutex_);
    writing_to_disk_ = true;
  }
  changed_.notify_all();
  manifest_.store(job.file, bytes, job.about);
}

void FrameStore::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return done_ || !jobs_.empty(); });
    if (jobs_.empty() || fault_) return;
    const Job job = jobs_.front();
    lock.unlock();
    try {
      store(job);
      lock.lock();
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      fault_ = std::current_exception();
    }
    writing_to_disk_ = false;
    jobs_.pop_front();
    changed_.notify_all();
    if (fault_) return;
  }
}

}  // namespace frangia
