#include "run_work.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace frangia::python {
namespace {

namespace py = pybind11;

/// What the working thread has to say.
struct Message {
  enum class Kind { Note, Warning, Progress } kind = Kind::Note;
  std::string text;    ///< the sentence, or the stage
  double share = 0.0;  ///< of a stage that is done
};

class Mailbox {
 public:
  void put(Message message) {
    const std::scoped_lock lock(mutex_);
    if (message.kind == Message::Kind::Progress && !messages_.empty() &&
        messages_.back().kind == Message::Kind::Progress && messages_.back().text == message.text)
      messages_.pop_back();
    messages_.push_back(std::move(message));
    changed_.notify_one();
  }
  void finish() {
    const std::scoped_lock lock(mutex_);
    done_ = true;
    changed_.notify_one();
  }
  /// Waits for messages or the end, not longer than signals may wait.
  bool take(std::deque<Message>& out) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(
        lock, std::chrono::milliseconds(50), [this] { return done_ || !messages_.empty(); });
    out.swap(messages_);
    return done_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Message> messages_;
  bool done_ = false;
};

void deliver(const std::deque<Message>& messages, const py::object& progress) {
  if (messages.empty()) return;
  const py::object logger = py::module_::import("logging").attr("getLogger")("frangia");
  for (const Message& message : messages) {
    if (message.kind == Message::Kind::Warning) logger.attr("warning")("%s", message.text);
    if (message.kind == Message::Kind::Note) logger.attr("info")("%s", message.text);
    if (message.kind == Message::Kind::Progress && !progress.is_none())
      progress(message.share, message.text);
  }
}

}  // namespace

void run_work(const py::object& progress, const std::function<void(const Run&)>& work) {
  Mailbox mailbox;
  std::stop_source stop;
  std::exception_ptr failure;
  std::thread thread([&] {
    std::string stage;
    Run run;
    run.stop = stop.get_token();
    run.on_note = [&](const std::string& text) { mailbox.put({Message::Kind::Note, text}); };
    run.on_warning = [&](const std::string& text) { mailbox.put({Message::Kind::Warning, text}); };
    run.on_stage = [&](const std::string& name) {
      stage = name;
      mailbox.put({Message::Kind::Progress, stage, 0.0});
    };
    run.progress = [&](double share) { mailbox.put({Message::Kind::Progress, stage, share}); };
    try {
      work(run);
    } catch (...) {
      failure = std::current_exception();
    }
    mailbox.finish();
  });
  std::exception_ptr raised;
  for (bool done = false; !done;) {
    std::deque<Message> messages;
    {
      const py::gil_scoped_release release;
      done = mailbox.take(messages);
    }
    if (raised) continue;
    try {
      deliver(messages, progress);
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (...) {
      raised = std::current_exception();
      stop.request_stop();
    }
  }
  {
    const py::gil_scoped_release release;
    thread.join();
  }
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace frangia::python
