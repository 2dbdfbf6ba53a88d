#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace boresight::app {

/// A call of the program as somebody would type it, and what it is good for.
struct CommandExample {
  std::string call;
  std::string purpose;
};

/// Two or three of a command, or of the program itself for "". Help and manual show them.
const std::vector<CommandExample>& command_examples(std::string_view command);

/// As the foot of a help text; empty if there are none.
std::string examples_text(std::string_view command);

}  // namespace boresight::app
