#include "frangia/files/deviation_csv.h"

#include <cmath>

#include "frangia/files/internal/file_writer.h"

namespace frangia {

void write_deviation_csv(const std::filesystem::path& path, std::span<const DeviationRow> rows) {
  FileWriter file(path);
  file.text("vertex,x_mm,y_mm,z_mm,deviation_mm,u_mm,conformity\n");
  for (const DeviationRow& row : rows) {
    file.number(std::size_t{row.vertex});
    for (const float coordinate : row.position_mm) {
      file.text(",");
      file.number(coordinate);
    }
    file.text(",");
    file.number(row.deviation_mm);
    file.text(",");
    if (std::isfinite(row.u_mm)) file.number(row.u_mm);
    file.text(",");
    file.text(row.conformity);
    file.text("\n");
  }
  file.commit();
}

}  // namespace frangia
