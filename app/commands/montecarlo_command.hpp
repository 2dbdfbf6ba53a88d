#pragma once

#include <boresight/app/commands/subcommand.hpp>

namespace boresight::app {

/// `boresight montecarlo CASE`: one law on thousands of plants that may be the true one.
Subcommand add_montecarlo(CLI::App& program);

}  // namespace boresight::app
