#pragma once

#include <string>

#include <boresight/app/commands/option_tree.hpp>

namespace boresight::app {

/// The manual in the man macros of troff, section 1: every command with its options and examples,
/// and the exit codes.
std::string man_page(const ProgramText& program);

}  // namespace boresight::app
