#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

#include "scratch_folder.hpp"
#include <boresight/io/case/case_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight {

inline std::string case_path(const std::string& antenna) {
  std::string path = BORESIGHT_SOURCE_DIR "/cases/";
  path += antenna;
  path += "/case.toml";
  return path;
}

/// A good case file's text with edits. Each edit names what it replaces, so that a test fails
/// loudly when the case has changed under it.
class EditedCase {
 public:
  explicit EditedCase(const std::string& antenna = "dss14-70m")
      : text_(content_of(case_path(antenna))) {
    if (text_.empty()) throw std::runtime_error("cannot read " + case_path(antenna));
  }

  /// Replaces a text that stands in the file once. A '^' in the replacement is left out and marks
  /// the place that line() and column() then give.
  EditedCase& replace(const std::string& old, std::string replacement) {
    const std::size_t at = text_.find(old);
    if (at == std::string::npos || text_.find(old, at + 1) != std::string::npos) {
      throw std::runtime_error("not in the case, or not once: " + old);
    }
    const std::size_t mark = replacement.find('^');
    if (mark != std::string::npos) replacement.erase(mark, 1);
    text_.replace(at, old.size(), replacement);
    if (mark != std::string::npos) place(at + mark);
    return *this;
  }

  /// Replaces the line that begins so, and stands in the file once, by others or, empty, by none.
  EditedCase& replace_line(const std::string& begin, const std::string& replacement) {
    const std::size_t at = text_.find("\n" + begin);
    if (at == std::string::npos) throw std::runtime_error("not in the case: " + begin);
    return replace(text_.substr(at, text_.find('\n', at + 1) - at),
                   replacement.empty() ? "" : "\n" + replacement);
  }

  /// Removes a table, up to the next header.
  EditedCase& remove_table(const std::string& name) {
    const std::size_t at = text_.find("\n[" + name + "]\n");
    if (at == std::string::npos) throw std::runtime_error("not in the case: [" + name + "]");
    text_.erase(at, text_.find("\n[", at + 1) - at);
    return *this;
  }

  /// Marks the first occurrence of a text.
  EditedCase& mark(const std::string& text) {
    place(text_.find(text));
    return *this;
  }

  const std::string& text() const { return text_; }
  int line() const { return line_; }
  int column() const { return column_; }

 private:
  void place(std::size_t at) {
    const std::string_view before = std::string_view(text_).substr(0, at);
    line_ = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    column_ = static_cast<int>(before.size() - (before.rfind('\n') + 1)) + 1;
  }

  std::string text_;
  int line_ = 0;
  int column_ = 0;
};

/// Why the program does not take a case of this text; "taken" if it does.
inline std::string refusal_of(const std::string& text) {
  try {
    io::parse_case(text, "case.toml");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "taken";
}

}  // namespace boresight
