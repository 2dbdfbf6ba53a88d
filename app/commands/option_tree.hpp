#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace boresight::app {

/// The completions offered for a value in addition to `words`.
enum class ValueFiles { none, files, folders };

/// One option, flag or argument of a command, in words.
struct OptionText {
  std::vector<std::string> names;  // "-h", "--help"; of an argument its one name, "CASE"
  bool argument = false;           // stands without a name
  bool required = false;
  bool several = false;            // takes more than one value
  std::string value;               // what it takes, "FILE"; empty for a flag
  std::string range;               // "1 to 100000"; empty: any
  std::string default_value;       // empty: none that is printed
  std::string description;         // one sentence without a full stop
  std::vector<std::string> words;  // values it is known to take
  ValueFiles files = ValueFiles::none;
};

struct CommandText {
  std::string name;
  std::string description;
  std::vector<OptionText> options;
};

/// The command line as described in help, manual and completion.
struct ProgramText {
  std::string description;
  std::vector<OptionText> options;  // of the program itself
  std::vector<CommandText> commands;
};

// Read from the tree that parses the command line.
CommandText describe_command(const CLI::App& command);
ProgramText describe_program(const CLI::App& program);

}  // namespace boresight::app
