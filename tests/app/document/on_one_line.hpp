// A text as one line: where its sentences are broken changes with every word of them.
#pragma once

#include <regex>
#include <string>

namespace boresight::app {

inline std::string on_one_line(const std::string& text) {
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

}  // namespace boresight::app
