#pragma once

#include <boresight/app/commands/subcommand.hpp>

namespace boresight::app {

Subcommand add_match(CLI::App& program);

}  // namespace boresight::app
