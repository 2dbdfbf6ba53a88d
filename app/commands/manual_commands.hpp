#pragma once

#include <string>
#include <vector>

#include <boresight/app/commands/subcommand.hpp>

namespace boresight::app {

// Commands that document the program itself, from the tree that parses its command line.

/// Shells that `boresight completion` writes for.
const std::vector<std::string>& completion_shells();

Subcommand add_completion(CLI::App& program);
Subcommand add_manual(CLI::App& program);
Subcommand add_schema(CLI::App& program);

}  // namespace boresight::app
