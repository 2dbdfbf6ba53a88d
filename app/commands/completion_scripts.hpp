#pragma once

#include <string>

#include <boresight/app/commands/option_tree.hpp>

namespace boresight::app {

/// A shell script that completes the program's commands, options and known values (structures,
/// tests), and file names where a file is expected.
std::string bash_completion(const ProgramText& program);
std::string zsh_completion(const ProgramText& program);
std::string fish_completion(const ProgramText& program);

}  // namespace boresight::app
