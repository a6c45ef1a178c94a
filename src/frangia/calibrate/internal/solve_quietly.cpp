#include "frangia/calibrate/internal/solve_quietly.h"

#include <algorithm>
#include <mutex>

#include <ceres/ceres.h>
#include <glog/logging.h>

namespace frangia {
namespace {

// glog's level belongs to the process, so what guards it does too.
std::mutex log_mutex;
int quiet_logs = 0;
int level_before = 0;

/// Keeps warnings of glog back while an object of this class exists.
class QuietLog {
 public:
  QuietLog() {
    const std::lock_guard lock(log_mutex);
    if (quiet_logs++ > 0) return;
    level_before = FLAGS_minloglevel;
    FLAGS_minloglevel = std::max<int>(FLAGS_minloglevel, google::GLOG_ERROR);
  }
  ~QuietLog() {
    const std::lock_guard lock(log_mutex);
    if (--quiet_logs == 0) FLAGS_minloglevel = level_before;
  }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;
  QuietLog(QuietLog&&) = delete;
  QuietLog& operator=(QuietLog&&) = delete;
};

}  // namespace

ceres::Solver::Summary solve_quietly(ceres::Solver::Options options, ceres::Problem& problem) {
  options.logging_type = ceres::SILENT;
  const QuietLog quiet;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

}  // namespace frangia
