#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/exchange/internal/interpret_values.h"

namespace frangia {
namespace {

/// A text in lower case, without underscores, hyphens and blanks.
std::string letters_of(const std::string& text) {
  std::string plain;
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (std::isalnum(code) != 0) plain += static_cast<char>(std::tolower(code));
  }
  return plain;
}

/// Whether a text states a lens model that is not OpenCV's. Names, comments and files may hold the
/// words of one; its short names count only where a model or type is stated.
bool is_other_model(const std::string& key, const std::string& model) {
  const auto is_in = [](const std::string& text, std::initializer_list<const char*> parts) {
    return std::any_of(parts.begin(), parts.end(), [&](const char* part) {
      return text.find(part) != std::string::npos;
    });
  };
  if (is_in(key, {"name", "comment", "description", "note", "file", "path", "topic", "sensor"}))
    return false;
  if (key.find("fisheye") != std::string::npos)
    return model == "true" || model == "yes" || model == "on" || model == "y";
  if (is_in(model,
            {"fisheye",
             "equidist",
             "kannala",
             "doublesphere",
             "omnidir",
             "scaramuzza",
             "ftheta",
             "inversebrown"}))
    return true;
  const std::string what = key.substr(0, key.find_last_not_of("0123456789") + 1);  // of several
  if (!what.ends_with("model") && !what.ends_with("type") && !what.ends_with("projection"))
    return false;
  constexpr std::array kShort{"ds", "eucm", "ucm", "mei", "fov", "atan", "division", "kb", "ocam"};
  return is_in(model, {"sphere", "omni", "unified", "equi", "kb4", "kb8"}) ||
         std::find(kShort.begin(), kShort.end(), model) != kShort.end();
}

/// The last part of a name that says what a value is: "distortion" of "camera.distortion.name".
std::string key_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  std::string key = letters_of(name.substr(dot == std::string::npos ? 0 : dot + 1));
  if (key != "name" || dot == std::string::npos) return key;
  const std::string outer = name.substr(0, dot);
  const std::string owner = letters_of(outer.substr(outer.rfind('.') + 1));
  constexpr std::array kOwners{"model", "type", "projection", "distortion", "lens"};
  const bool of_model = std::any_of(
      kOwners.begin(), kOwners.end(), [&](const char* end) { return owner.ends_with(end); });
  return of_model ? owner + "model" : key;  // the name of a camera is any text
}

/// Whether a name of coefficients states another lens model: fisheye_D, D_equidistant.
bool names_other_model(const std::string& name) {
  const std::string letters = letters_of(name);
  constexpr std::array kModels{"fisheye", "equidist", "kannala", "doublesphere", "omnidir"};
  return std::any_of(kModels.begin(), kModels.end(), [&](const char* model) {
    return letters.find(model) != std::string::npos;
  });
}

}  // namespace

void check_lens_models(const NamedValues& values) {
  const auto refuse = [](const std::string& name, const std::string& model) {
    throw Error(ErrorKind::Input,
                fmt::format("{} is {}, a lens model that no rig can hold: calibrate with OpenCV's "
                            "model of k1 k2 p1 p2 k3 (plumb_bob, radtan)",
                            name,
                            model));
  };
  for (const auto& [name, text] : values.texts) {
    const std::string key = key_of(name);
    const std::string model = letters_of(text);
    if (is_other_model(key, model)) refuse(name, text);
  }
  for (const auto& [name, matrix] : values.matrices) {
    const std::string key = letters_of(name.substr(name.rfind('.') + 1));
    const bool set = matrix.size() == 1 && matrix(0, 0) != 0.0;
    if (set && key.find("fisheye") != std::string::npos) refuse(name, "set");
    if (key == "mappingcoefficients") refuse(name, "stated");  // MATLAB's fisheyeIntrinsics
    if (key == "xi" && set) refuse(name, "stated");            // of Mei's omnidirectional model
    if (matrix.size() > 1 && names_other_model(name)) refuse(name, "stated");
  }
}

}  // namespace frangia
