#pragma once

#include <vector>

#include <boresight/app/commands/subcommand.hpp>

namespace boresight::app {

/// The commands that work on a case alone and fill sections of one report: redesign, audit,
/// identify, model.
std::vector<Subcommand> add_report_commands(CLI::App& program);

}  // namespace boresight::app
