#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace boresight::app {

/// The help of the program or of a command, from the tree that parses its command line: usage,
/// arguments, options with ranges and defaults, commands, examples; no line beyond 108 columns but
/// where an example has it.
class HelpText : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* command, std::string name,
                        CLI::AppFormatMode mode) const override;
};

}  // namespace boresight::app
