#include "frangia/service/job_queue.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "frangia/core/error.h"

namespace frangia {
namespace {

/// What an exception says; nothing where that does not fit into the memory.
std::string words_of(const std::exception& error) noexcept {
  try {
    return error.what();
  } catch (const std::bad_alloc&) {
    return {};
  }
}

bool has_finished(const Job& job) {
  return job.state != JobState::Waiting && job.state != JobState::Running;
}

}  // namespace

JobQueue::JobQueue(std::function<void()> on_change)
    : on_change_(std::move(on_change)), thread_([this] { serve(); }) {}

JobQueue::~JobQueue() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    for (const TaskPtr& task : tasks_)
      task->stop.request_stop();
  }
  wake_.notify_all();
  thread_.join();
}

int JobQueue::start(std::string kind, std::function<void(const Run&)> work) {
  int number = 0;
  {
    const std::lock_guard lock(mutex_);
    if (unfinished() >= kMostWaiting)
      throw Error(ErrorKind::Input, "too many tasks wait; let one finish, or stop one, first");
    auto task = std::make_shared<Task>();
    number = task->job.number = next_number_++;
    task->job.kind = std::move(kind);
    task->work = std::move(work);
    tasks_.push_back(std::move(task));
    forget_oldest();
  }
  wake_.notify_all();
  on_change_();
  return number;
}

bool JobQueue::stop(int number) {
  const std::lock_guard lock(mutex_);
  for (const TaskPtr& task : tasks_) {
    if (task->job.number != number || has_finished(task->job)) continue;
    task->stop.request_stop();
    return true;
  }
  return false;
}

std::vector<Job> JobQueue::jobs() const {
  const std::lock_guard lock(mutex_);
  std::vector<Job> all;
  for (const TaskPtr& task : tasks_) {
    all.push_back(task->job);
    if (task->job.state == JobState::Running)
      all.back().seconds = std::chrono::duration<double>(Clock::now() - task->began).count();
  }
  return all;
}

bool JobQueue::is_busy() const {
  const std::lock_guard lock(mutex_);
  return unfinished() > 0;
}

void JobQueue::set_revision(int revision) noexcept {
  const std::lock_guard lock(mutex_);
  if (running_) running_->job.revision = revision;
}

void JobQueue::serve() {
  for (;;) {
    TaskPtr next;
    {
      std::unique_lock lock(mutex_);
      const auto waiting = [&] {
        return std::find_if(tasks_.begin(), tasks_.end(), [](const TaskPtr& task) {
          return task->job.state == JobState::Waiting;
        });
      };
      wake_.wait(lock, [&] { return ending_ || waiting() != tasks_.end(); });
      if (ending_) return;
      next = *waiting();
      next->job.state = JobState::Running;
      running_ = next;
      next->began = Clock::now();
    }
    on_change_();
    run_task(next);
  }
}

void JobQueue::run_task(const TaskPtr& task) {
  const auto log = [this, task](bool warning, const std::string& sentence) {
    change(task, [&](Job& job) {
      if (job.log.size() >= kMostLogLines) job.log.erase(job.log.begin());
      job.log.push_back({warning, sentence});
    });
  };
  Run run;
  run.stop = task->stop.get_token();
  run.progress = [this, task](double done) {
    change(task, [done](Job& job) { job.progress = std::clamp(done, 0.0, 1.0); });
  };
  run.on_stage = [this, task](const std::string& name) {
    change(task, [&](Job& job) {
      job.stage = name;
      job.progress = 0.0;
    });
  };
  run.on_warning = [log](const std::string& sentence) { log(true, sentence); };
  run.on_note = [log](const std::string& sentence) { log(false, sentence); };
  try {
    run.check();  // stopped while it waited
    task->work(run);
    finish(task, JobState::Done, {});
  } catch (const Error& error) {
    const bool stopped = error.kind() == ErrorKind::Cancelled;
    finish(task,
           stopped ? JobState::Stopped : JobState::Failed,
           stopped ? std::string() : words_of(error));
  } catch (const std::bad_alloc&) {
    finish(task, JobState::Failed, "this does not fit into the memory of the machine");
  } catch (const std::exception& error) {
    finish(task, JobState::Failed, words_of(error));
  } catch (...) {  // of another library
    finish(task, JobState::Failed, "the task failed for a reason that has no words");
  }
}

void JobQueue::change(const TaskPtr& task, const std::function<void(Job&)>& edit) {
  {
    const std::lock_guard lock(mutex_);
    edit(task->job);
  }
  on_change_();
}

void JobQueue::finish(const TaskPtr& task, JobState state, std::string error) noexcept {
  {
    const std::lock_guard lock(mutex_);
    task->job.seconds = std::chrono::duration<double>(Clock::now() - task->began).count();
    task->job.state = state;
    task->job.error = std::move(error);
    if (state == JobState::Done) task->job.progress = 1.0;
    task->work = {};  // frees what it holds
    running_.reset();
  }
  on_change_();
}

void JobQueue::forget_oldest() {
  while (tasks_.size() > kMostJobs) {
    const auto oldest = std::find_if(
        tasks_.begin(), tasks_.end(), [](const TaskPtr& task) { return has_finished(task->job); });
    if (oldest == tasks_.end()) return;
    tasks_.erase(oldest);
  }
}

std::size_t JobQueue::unfinished() const {
  return static_cast<std::size_t>(std::count_if(
      tasks_.begin(), tasks_.end(), [](const TaskPtr& task) { return !has_finished(task->job); }));
}

}  // namespace frangia
