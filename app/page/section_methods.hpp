#pragma once

#include <string_view>

namespace boresight::app {

/// How the numbers of a report's section are made, and where that is explained.
struct SectionMethod {
  std::string_view how;
  std::string_view explained_in;
};

/// By the section's heading; empty texts for a heading that is not known.
SectionMethod method_of(std::string_view heading);

}  // namespace boresight::app
