#include <algorithm>
#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"

#include "batch/batch_plan.h"
#include "batch/batch_table.h"
#include "batch/batch_task.h"
#include "batch/slurm.h"
#include "counted.h"
#include "exit_codes.h"
#include "option_values.h"
#include "print_text.h"
#include "verbs.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

struct BatchArguments {
  fs::path plan;
  fs::path out;
  int jobs = 1;
  int task = -1;        ///< only this scan; -1: all
  bool retry = false;   ///< failed scans, too
  bool table = false;   ///< only writes the table
  bool slurm = false;   ///< submits instead
  bool verify = false;  ///< compares every file by its checksum
  std::string sbatch;   ///< an option for sbatch
  double memory_mb = 0.0;
  double minutes = 0.0;
};

/// This program, for the steps.
std::string own_path() {
  return fs::read_symlink("/proc/self/exe").string();
}

/// The cores of a step when several run side by side.
int threads_of(const CLI::App& program, int jobs) {
  const CLI::Option* option = program.get_option_no_throw("--threads");
  if (option != nullptr && option->count() > 0) return option->as<int>();
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / std::max(1, jobs));
}

bool is_to_be_run(const BatchRow& row, bool retry) {
  constexpr int kSignal = 128;  // a step that was killed says nothing about the scan
  return row.state == BatchState::Open ||
         (row.state == BatchState::Failed && (retry || row.exit_code >= kSignal));
}

std::vector<BatchRow> rows_of(const BatchPlan& plan, const fs::path& out, const CheckFiles& check) {
  std::vector<BatchRow> rows;
  if (check.all) check.run.stage("checksums");
  for (const BatchScan& scan : plan.scans)
    rows.push_back(read_row(scan, plan, out, check));
  return rows;
}

/// Under the lock, files are compared again. Progress is that of the batch.
CheckFiles check_of_task(const BatchArguments& arguments, const Run& run) {
  CheckFiles check{.all = arguments.verify};
  check.run.stop = run.stop;
  return check;
}

/// Works on the open scans, `jobs` at a time.
void run_open(const BatchPlan& plan,
              const BatchArguments& arguments,
              const BatchCommand& command,
              const Run& run,
              std::vector<BatchRow>& rows) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (is_to_be_run(rows[i], arguments.retry)) open.push_back(i);
  std::mutex mutex;
  std::size_t next = 0;
  std::size_t ended = 0;
  std::exception_ptr failure;
  const auto work = [&] {
    for (;;) {
      std::size_t i = 0;
      {
        const std::scoped_lock lock(mutex);
        if (next == open.size() || failure || run.stop.stop_requested()) return;
        i = open[next++];
      }
      try {
        BatchRow row =
            run_task(plan.scans[i], plan, arguments.out, command, check_of_task(arguments, run));
        const std::scoped_lock lock(mutex);
        rows[i] = std::move(row);
        ++ended;
      } catch (...) {
        const std::scoped_lock lock(mutex);
        failure = std::current_exception();
      }
    }
  };
  std::vector<std::thread> threads;
  const auto jobs = std::min(open.size(), static_cast<std::size_t>(arguments.jobs));
  std::atomic<std::size_t> alive{jobs};
  for (std::size_t k = 0; k < jobs; ++k) {
    threads.emplace_back([&] {
      work();
      --alive;
    });
  }
  std::size_t told = 0;
  while (alive > 0 || told < ended) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::scoped_lock lock(mutex);
    told = ended;
    if (!open.empty() && !run.stop.stop_requested())
      run.report(static_cast<double>(ended) / static_cast<double>(open.size()));
  }
  for (std::thread& thread : threads)
    thread.join();
  if (failure) std::rethrow_exception(failure);
}

SlurmJob job_of(const BatchArguments& arguments, const BatchPlan& plan, int threads) {
  SlurmJob job;
  job.plan = fs::absolute(arguments.plan);
  job.out = fs::absolute(arguments.out);
  job.program = own_path();
  job.scans = plan.scans.size();
  job.threads = threads;
  job.options = arguments.sbatch;
  return job;
}

/// Runs the first open scan here, unless one is done, and submits the rest with what it took.
void submit_batch(const BatchPlan& plan,
                  const BatchArguments& arguments,
                  int threads,
                  const Run& run,
                  Terminal& terminal) {
  constexpr double kMargin = 1.5;  // over the scan that was measured
  SlurmJob job = job_of(arguments, plan, threads);
  job.memory_mb = arguments.memory_mb;
  job.minutes = arguments.minutes;
  if (!(job.memory_mb > 0.0) || !(job.minutes > 0.0)) {
    std::vector<BatchRow> rows = rows_of(plan, arguments.out, {arguments.verify, run});
    auto known = std::find_if(rows.begin(), rows.end(), [](const BatchRow& row) {
      return row.state == BatchState::Done;
    });
    if (known == rows.end()) {
      rows.front() = run_task(plan.scans.front(),
                              plan,
                              arguments.out,
                              {own_path(), threads},
                              check_of_task(arguments, run));
      run.check();
      known = rows.begin();
    }
    if (!(job.memory_mb > 0.0)) job.memory_mb = kMargin * known->memory_mb;
    if (!(job.minutes > 0.0)) job.minutes = kMargin * known->seconds / 60.0 + 1.0;
  }
  const std::string number = submit(job, run.stop);
  terminal.finish();
  if (terminal.json) {
    print_json({{"job", number},
                {"scans", job.scans},
                {"memory_mb", job.memory_mb},
                {"minutes", job.minutes}});
    return;
  }
  print_text(
      "submitted {} as Slurm job {}, each with {:.0f} MB and {:.0f} minutes; the table will be "
      "{}\n",
      counted(job.scans, "scan"),
      number,
      job.memory_mb,
      job.minutes,
      (job.out / "table.csv").string());
}

void print_rows(const std::vector<BatchRow>& rows, const fs::path& out, Terminal& terminal) {
  terminal.finish();
  const auto failed = static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const BatchRow& row) { return row.state != BatchState::Done; }));
  if (failed > 0) terminal.exit_code = DeviceFault;
  if (terminal.json) {
    print_json(json_of(rows));
    return;
  }
  if (terminal.quiet) return;
  write_output(table_of(rows));
  if (failed > 0) {
    print_text("{} of {} not done; OUT/NAME/*.log tells more, `--retry` tries failed ones again\n",
               failed,
               counted(rows.size(), "scan"));
  }
  terminal.print_written((out / "table.csv").string());
}

void batch_verb(const BatchArguments& arguments, const CLI::App& program, Terminal& terminal) {
  const Run run = terminal.run();
  const BatchPlan plan = read_batch_plan(arguments.plan);
  make_folder(arguments.out);
  const int threads = threads_of(program, arguments.slurm ? 1 : arguments.jobs);
  if (arguments.slurm) {
    submit_batch(plan, arguments, threads, run, terminal);
    return;
  }
  const BatchCommand command{own_path(), threads};
  if (arguments.task >= 0) {
    if (static_cast<std::size_t>(arguments.task) >= plan.scans.size()) {
      throw Error(ErrorKind::Input,
                  fmt::format("{} has no scan {}; its scans are 0 to {}",
                              arguments.plan.string(),
                              arguments.task,
                              plan.scans.size() - 1));
    }
    const BatchScan& scan = plan.scans[static_cast<std::size_t>(arguments.task)];
    BatchRow row = read_row(scan, plan, arguments.out, {arguments.verify, run});
    if (is_to_be_run(row, arguments.retry))
      row = run_task(scan, plan, arguments.out, command, check_of_task(arguments, run));
    run.check();
    terminal.finish();
    if (terminal.json) {
      print_json(json_of(std::vector{row}));
    } else if (!terminal.quiet) {
      write_output(table_of({row}));
    }
    return;
  }
  std::vector<BatchRow> rows = rows_of(plan, arguments.out, {arguments.verify, run});
  if (!arguments.table) {
    run.stage("scans");
    run_open(plan, arguments, command, run, rows);
  }
  write_table(rows, arguments.out);
  run.check();
  print_rows(rows, arguments.out, terminal);
}

}  // namespace

void add_batch_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<BatchArguments>();
  CLI::App* verb =
      program.add_subcommand("batch", "reconstruct, edit and inspect many scans, here or by Slurm");
  verb->footer(
      "example:\n  frangia batch scans -o meshes --jobs 2\n  frangia batch plan.toml -o meshes "
      "--slurm");
  verb->add_option("PLAN", arguments->plan, "a folder of scans, or a plan (docs/batch.md)")
      ->required();
  verb->add_option("-o,--output", arguments->out, "folder of the results, one folder a scan")
      ->required();
  verb->add_option("--jobs", arguments->jobs, "scans at a time")
      ->check(from_to(1, 1024))
      ->capture_default_str();
  verb->add_flag("--retry", arguments->retry, "try failed scans again");
  verb->add_flag("--verify",
                 arguments->verify,
                 "compare every file of the scans and results by its checksum; what has changed is "
                 "done again");
  verb->add_flag("--table", arguments->table, "only write the table of what is done");
  verb->add_option("--task", arguments->task, "only this scan, counted from 0")
      ->check(zero_or_more());
  CLI::Option* slurm = verb->add_flag(
      "--slurm", arguments->slurm, "submit an array job, one task a scan, and one for the table");
  verb->add_option("--memory",
                   arguments->memory_mb,
                   "MB of each task; default: 1.5 times that of one scan, which is measured")
      ->needs(slurm);
  verb->add_option("--minutes", arguments->minutes, "of each task; default: likewise")
      ->needs(slurm);
  verb->add_option("--sbatch", arguments->sbatch, "an option for sbatch: --partition=night")
      ->needs(slurm);
  verb->callback([arguments, &program, &terminal] { batch_verb(*arguments, program, terminal); });
}

}  // namespace frangia
