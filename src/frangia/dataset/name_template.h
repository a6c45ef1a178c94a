#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace frangia {

/// The fields of a file name.
struct NameFields {
  std::string pattern;         ///< text of {pattern}; empty without that field
  std::optional<int> frame{};  ///< number of {frame}
  std::optional<int> view{};   ///< number of {view}
  std::string camera{};        ///< text of {camera}; empty without that field

  /// Whether all fields are equal.
  friend bool operator==(const NameFields&, const NameFields&) = default;
};

/// A template of file names such as "{pattern}_{frame:02}.bmp", relative to a folder.
///
/// The fields are {pattern} and {camera}, texts, {frame} and {view}, numbers. {frame:02} is a
/// number that printf's "%02d" writes. {*} is any text, such as a time stamp, and may occur several
/// times; without {frame}, the files are frames in the order of their names. "{{" and "}}" stand
/// for braces. Other letters stand for themselves, small or capital. Names may lead into
/// subfolders: "view{view:03}/{frame}.png".
class NameTemplate {
 public:
  /// Parses a template.
  ///
  /// @errors   Error(Input) that names the template and the place: an unknown field, a field that
  ///           occurs twice, a brace without its partner
  explicit NameTemplate(const std::string& text);

  [[nodiscard]] const std::string& text() const { return text_; }  ///< the template as given
  [[nodiscard]] bool has_pattern() const { return has(Kind::PatternText); }  ///< holds {pattern}
  [[nodiscard]] bool has_frame() const { return has(Kind::FrameNumber); }    ///< holds {frame}
  [[nodiscard]] bool has_view() const { return has(Kind::ViewNumber); }      ///< holds {view}
  [[nodiscard]] bool has_camera() const { return has(Kind::CameraText); }    ///< holds {camera}
  [[nodiscard]] bool has_any() const { return has(Kind::AnyText); }          ///< holds {*}
  [[nodiscard]] int depth() const;  ///< number of folders that names lead into

  /// Returns every reading of a name; none if it does not fit. A reading whose numbers have exactly
  /// the stated widths is preferred to one whose numbers have more digits. With `patterns`, only
  /// these texts fit {pattern}.
  [[nodiscard]] std::vector<NameFields> match(const std::string& name,
                                              const std::vector<std::string>& patterns = {}) const;

 private:
  enum class Kind { Literal, PatternText, CameraText, AnyText, FrameNumber, ViewNumber };
  struct Token {
    Kind kind = Kind::Literal;
    std::string literal;
    std::size_t width = 0;  ///< digits of a number; 0: any
  };
  struct Search;
  [[nodiscard]] bool has(Kind kind) const;
  void add_field(const std::string& field);
  void read_on(std::size_t token, std::size_t at, Search& search) const;
  void read_text(std::size_t token, std::size_t at, Search& search) const;
  void read_number(std::size_t token, std::size_t at, Search& search) const;

  std::string text_;
  std::vector<Token> tokens_;
};

/// Guesses the template of a folder's image files: the last number of a name is the frame, what
/// precedes it is the pattern where it differs, and a number in the names of subfolders is the
/// view. Subfolders such as left and right, or cam0 and cam1, are cameras; those with other names
/// are patterns. Where several numbers differ in each name, the one that counts by one is the
/// frame, and the others are a time. A few names of another kind than all others do not count.
///
/// @errors   Error(Input) when the names do not suggest a template
[[nodiscard]] std::string guess_name_template(const std::vector<std::string>& names);

/// Whether `a` comes before `b`, with numbers compared by their value: "p9" before "p10".
[[nodiscard]] bool is_before_in_natural_order(const std::string& a, const std::string& b);

}  // namespace frangia
