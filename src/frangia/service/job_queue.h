#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "frangia/core/enum_names.h"
#include "frangia/core/run.h"

namespace frangia {

/// State of a job.
enum class JobState {
  Waiting,  ///< for the jobs before it
  Running,  ///< on the queue's thread
  Done,     ///< ended without an error
  Failed,   ///< ended with `Job::error`
  Stopped   ///< ended because its stop was requested
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(JobState /*any*/) {
  return EnumNames<JobState, 5>{{{JobState::Waiting, "waiting"},
                                 {JobState::Running, "running"},
                                 {JobState::Done, "done"},
                                 {JobState::Failed, "failed"},
                                 {JobState::Stopped, "stopped"}}};
}

/// A sentence that a job logged.
struct JobLogLine {
  bool warning = false;  ///< otherwise a note
  std::string sentence;  ///< as `Run` passed it
};

/// What is known of a long task.
struct Job {
  int number = 0;                      ///< unique in a queue, from 1
  std::string kind;                    ///< "scan", "reconstruct", "edit", ...
  JobState state = JobState::Waiting;  ///< present state
  double progress = 0.0;               ///< finished share, 0 to 1
  std::string stage;                   ///< as `Run::stage` announced it
  std::vector<JobLogLine> log;         ///< the last kMostLogLines sentences
  std::string error;                   ///< why it failed; empty otherwise
  double seconds = 0.0;                ///< since it began to run, or its duration
  std::optional<int> revision{};       ///< that it made or wrote out
};

/// Long tasks, one after the other on a thread of the queue's own. They go on when no client is
/// connected. All functions may be called from any thread.
class JobQueue {
 public:
  static constexpr std::size_t kMostJobs = 16;       ///< finished ones that are remembered
  static constexpr std::size_t kMostWaiting = 8;     ///< jobs that have not finished
  static constexpr std::size_t kMostLogLines = 200;  ///< of a job

  /// `on_change` is called after every change, on the thread that made it, without a lock held. It
  /// does not throw.
  explicit JobQueue(std::function<void()> on_change);
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;
  JobQueue(JobQueue&&) = delete;
  JobQueue& operator=(JobQueue&&) = delete;
  /// Stops all jobs and waits for the present one.
  ~JobQueue();

  /// Queues a task and returns its number. Its `Run` reports to the job; an exception is the job's
  /// error.
  ///
  /// @errors   Error(Input) when kMostWaiting jobs have not finished
  int start(std::string kind, std::function<void(const Run&)> work);
  /// Requests that a job stop. Returns false for a number that is unknown or has finished.
  bool stop(int number);
  /// All remembered jobs, oldest first.
  [[nodiscard]] std::vector<Job> jobs() const;
  /// Whether a job waits or runs.
  [[nodiscard]] bool is_busy() const;
  /// Called by the job that runs: states the revision that it made or wrote out.
  void set_revision(int revision) noexcept;

 private:
  using Clock = std::chrono::steady_clock;
  struct Task {
    Job job;
    std::function<void(const Run&)> work;
    std::stop_source stop;
    Clock::time_point began;
  };
  using TaskPtr = std::shared_ptr<Task>;

  void serve();
  void run_task(const TaskPtr& task);
  void change(const TaskPtr& task, const std::function<void(Job&)>& edit);
  void finish(const TaskPtr& task, JobState state, std::string error) noexcept;
  void forget_oldest();
  [[nodiscard]] std::size_t unfinished() const;

  std::function<void()> on_change_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<TaskPtr> tasks_;  ///< oldest first
  TaskPtr running_;
  int next_number_ = 1;
  bool ending_ = false;
  std::thread thread_;  ///< last: starts when everything else exists
};

}  // namespace frangia
