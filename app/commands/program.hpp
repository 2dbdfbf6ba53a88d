#pragma once

#include <memory>
#include <string>
#include <vector>

#include <boresight/app/commands/subcommand.hpp>

namespace boresight::app {

/// The program's whole command line: what parses it, and what runs when it is parsed. `options`
/// is null only before make_program() and after a move.
struct Program {
  std::shared_ptr<CLI::App> options;
  std::vector<Subcommand> commands;
};

/// Every command with its options and examples, and the options common to all commands.
Program make_program();

/// Why the program does not take these arguments (its own name left out), in one sentence that
/// names what was meant where a command or an option is misspelt. Empty if it takes them.
std::string parse_refusal(const std::vector<std::string>& arguments);

}  // namespace boresight::app
