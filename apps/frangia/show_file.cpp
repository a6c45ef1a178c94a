#include "show_file.h"

#include "run_program.h"

namespace frangia {

bool show_file(const std::filesystem::path& path, const std::stop_token& stop) {
  // Absolute, so that a name that begins with a dash is no option of xdg-open.
  return run_program({"xdg-open", std::filesystem::absolute(path).string()},
                     stop,
                     WhenStopped::LeaveRunning) == 0;
}

}  // namespace frangia
