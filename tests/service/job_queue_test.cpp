#include "frangia/service/job_queue.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "frangia/core/error.h"

#include "support/error_of.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

using testing::error_of;

/// Waits until a job has finished and returns it.
Job finished(const JobQueue& queue, int number) {
  for (int i = 0; i < 30'000; ++i) {
    for (const Job& job : queue.jobs())
      if (job.number == number && job.state != JobState::Waiting && job.state != JobState::Running)
        return job;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ADD_FAILURE() << "the job does not end";
  return {};
}

TEST(JobQueue, ReportsWhatAJobSays) {
  std::atomic<int> changes = 0;
  JobQueue queue([&] { ++changes; });
  const int number = queue.start("scan", [](const frangia::Run& run) {
    run.stage("phase");
    run.report(0.5);
    run.note("a note");
    run.warn("a warning");
  });
  const Job job = finished(queue, number);
  EXPECT_EQ(job.state, JobState::Done);
  EXPECT_EQ(job.kind, "scan");
  EXPECT_EQ(job.stage, "phase");
  EXPECT_EQ(job.progress, 1.0);
  ASSERT_EQ(job.log.size(), 2U);
  EXPECT_FALSE(job.log[0].warning);
  EXPECT_EQ(job.log[1].sentence, "a warning");
  EXPECT_GE(changes, 6);
}

TEST(JobQueue, RunsJobsOneAfterTheOther) {
  JobQueue queue([] {});
  std::string order;
  int last = 0;
  for (const char letter : {'a', 'b', 'c'})
    last = queue.start("edit", [&order, letter](const frangia::Run&) { order += letter; });
  static_cast<void>(finished(queue, last));
  EXPECT_EQ(order, "abc");
}

TEST(JobQueue, StopsARunningAndAWaitingJob) {
  JobQueue queue([] {});
  const auto endless = [](const frangia::Run& run) {
    for (;;) {
      run.check();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  const int running = queue.start("scan", endless);
  const int waiting = queue.start("scan", endless);
  EXPECT_TRUE(queue.is_busy());
  EXPECT_TRUE(queue.stop(waiting));
  EXPECT_TRUE(queue.stop(running));
  EXPECT_EQ(finished(queue, running).state, JobState::Stopped);
  EXPECT_EQ(finished(queue, waiting).state, JobState::Stopped);
  EXPECT_FALSE(queue.stop(running));
  EXPECT_FALSE(queue.stop(99));
  EXPECT_FALSE(queue.is_busy());
}

TEST(JobQueue, KeepsTheSentenceOfAFailure) {
  JobQueue queue([] {});
  const int number = queue.start(
      "export", [](const frangia::Run&) { throw Error(ErrorKind::File, "the disk is full"); });
  const Job job = finished(queue, number);
  EXPECT_EQ(job.state, JobState::Failed);
  EXPECT_EQ(job.error, "the disk is full");
}

TEST(JobQueue, FailsAJobThatThrowsWhatIsNoException) {
  JobQueue queue([] {});
  static_cast<void>(queue.start("odd", [](const auto& /*run*/) { throw 7; }));
  static_cast<void>(queue.start("next", [](const auto& /*run*/) {}));
  ASSERT_TRUE(testing::wait_until([&] { return !queue.is_busy(); }));
  const std::vector<Job> jobs = queue.jobs();
  EXPECT_EQ(jobs.at(0).state, JobState::Failed);
  EXPECT_NE(jobs.at(0).error, "");
  EXPECT_EQ(jobs.at(1).state, JobState::Done);
}

TEST(JobQueue, RefusesMoreThanItsLimit) {
  JobQueue queue([] {});
  const auto endless = [](const frangia::Run& run) {
    while (!run.stop.stop_requested())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  for (std::size_t i = 0; i < JobQueue::kMostWaiting; ++i)
    static_cast<void>(queue.start("edit", endless));
  EXPECT_NE(error_of([&] { static_cast<void>(queue.start("edit", endless)); }), "");
}  // the destructor stops them all

TEST(JobQueue, RemembersABoundedNumberOfJobsAndLines) {
  JobQueue queue([] {});
  int last = 0;
  for (int i = 0; i < 40; ++i) {
    last = queue.start("edit", [](const frangia::Run& run) {
      for (std::size_t line = 0; line < 2 * JobQueue::kMostLogLines; ++line)
        run.note(std::to_string(line));
    });
    static_cast<void>(finished(queue, last));
  }
  EXPECT_LE(queue.jobs().size(), JobQueue::kMostJobs);
  const Job job = finished(queue, last);
  EXPECT_EQ(job.log.size(), JobQueue::kMostLogLines);
  EXPECT_EQ(job.log.back().sentence, std::to_string(2 * JobQueue::kMostLogLines - 1));
}

}  // namespace
}  // namespace frangia
