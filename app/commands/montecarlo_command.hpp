#pragma once

#include <boresight/app/commands/subcommand.hpp>

namespace boresight::app {

/// `boresight montecarlo CASE`: evaluates one controller, gains fixed, on thousands of perturbed
/// plant models.
Subcommand add_montecarlo(CLI::App& program);

}  // namespace boresight::app
