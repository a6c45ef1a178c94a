#include <utility>

#include "frangia/core/error.h"
#include "frangia/service/internal/implementation.h"

namespace frangia {

nlohmann::ordered_json Service::Implementation::start_edit(CommandArguments& arguments) {
  const EditStep step{arguments.text("operation"), arguments.text_or("value", "")};
  arguments.check_all_read();
  check_step(step);
  return started_change(arguments.key(),
                        [step](const SurfaceModel& model, int revision, const Run& run) {
                          return model.applied(step, revision, run);
                        });
}
nlohmann::ordered_json Service::Implementation::start_preview(CommandArguments& arguments) {
  const EditStep step{arguments.text("operation"), arguments.text_or("value", "")};
  arguments.check_all_read();
  check_step(step);
  return started_view("preview", [step](const SurfaceModel& model, int count, const Run& run) {
    return model.with_preview(step, count, run);
  });
}
nlohmann::ordered_json Service::Implementation::drop_preview(CommandArguments& arguments) {
  arguments.check_all_read();
  return started_view("preview", [](const SurfaceModel& model, int, const Run&) {
    return model.without_preview();
  });
}
nlohmann::ordered_json Service::Implementation::start_select_component(
    CommandArguments& arguments) {
  const std::size_t triangle = arguments.whole("triangle", 0, UINT32_MAX);
  arguments.check_all_read();
  return started_change(arguments.key(),
                        [triangle](const SurfaceModel& model, int revision, const Run& run) {
                          return model.with_component_of(triangle, revision, run);
                        });
}
nlohmann::ordered_json Service::Implementation::start_undo(CommandArguments& arguments) {
  arguments.check_all_read();
  return started_change(arguments.key(),
                        [](const SurfaceModel& model, int revision, const Run& run) {
                          return model.undone(revision, run);
                        });
}
nlohmann::ordered_json Service::Implementation::start_redo(CommandArguments& arguments) {
  arguments.check_all_read();
  return started_change(arguments.key(),
                        [](const SurfaceModel& model, int revision, const Run& run) {
                          return model.redone(revision, run);
                        });
}
nlohmann::ordered_json Service::Implementation::start_fit(CommandArguments& arguments) {
  const std::string kind = arguments.text("kind");
  arguments.check_all_read();
  require(kind == "plane" || kind == "cylinder" || kind == "sphere",
          "kind: is plane, cylinder or sphere");
  return started_view("edit", [kind](const SurfaceModel& model, int, const Run& run) {
    return model.with_fit(kind, run);
  });
}

}  // namespace frangia
