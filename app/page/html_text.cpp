#include <fmt/format.h>

#include <boresight/app/page/html_text.hpp>

namespace boresight::app {

std::string json_for_script(std::string_view json) {
  // Tags begin in strings only, and there this means the same.
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

std::string css_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const bool plain = static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '\\' && c != '<';
    if (plain) {
      quoted += c;
    } else {
      quoted += fmt::format("\\{:x} ", static_cast<unsigned char>(c));
    }
  }
  return quoted + "\"";
}

}  // namespace boresight::app
