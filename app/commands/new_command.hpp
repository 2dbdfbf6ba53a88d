#pragma once

#include <string>

#include <boresight/app/commands/subcommand.hpp>

namespace boresight::app {

/// Writes FOLDER/case.toml, a case file to fill in with the folder's name as title; the folder is
/// made if it is not there. Returns what to do next, in a few lines.
/// @throws InvalidInput if there is a case already, or if it cannot be written.
std::string write_case_form(const std::string& folder);

Subcommand add_new(CLI::App& program);

}  // namespace boresight::app
