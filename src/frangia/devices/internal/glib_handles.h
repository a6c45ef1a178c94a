#pragma once

#include <memory>
#include <string>

#include <glib-object.h>

namespace frangia {

/// Gives up one reference to a GObject.
struct Unref {
  void operator()(gpointer object) const { g_object_unref(object); }
};
/// Owns one reference to a GObject.
template <typename T>
using Ref = std::unique_ptr<T, Unref>;

/// Owns a GError.
class GlibError {
 public:
  GlibError() = default;
  GlibError(const GlibError&) = delete;
  GlibError& operator=(const GlibError&) = delete;
  GlibError(GlibError&&) = delete;
  GlibError& operator=(GlibError&&) = delete;
  ~GlibError() { g_clear_error(&error_); }

  /// Where a function of GLib stores an error; an earlier one is dropped.
  [[nodiscard]] GError** out() {
    g_clear_error(&error_);
    return &error_;
  }
  explicit operator bool() const { return error_ != nullptr; }
  [[nodiscard]] std::string text() const { return error_ != nullptr ? error_->message : ""; }

 private:
  GError* error_ = nullptr;
};

}  // namespace frangia
