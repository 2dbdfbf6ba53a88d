#pragma once

#include <string>

#include <boresight/app/commands/option_tree.hpp>

namespace boresight::app {

/// A script that, sourced by the shell, completes the program's commands, options and the values it
/// knows (structures, tests), and else names of files where a file is wanted.
std::string bash_completion(const ProgramText& program);
std::string zsh_completion(const ProgramText& program);
std::string fish_completion(const ProgramText& program);

}  // namespace boresight::app
