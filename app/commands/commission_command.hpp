#pragma once

#include <functional>
#include <string>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/commission/commission_study.hpp>

namespace boresight::app {

struct CommissionArguments {
  std::string case_path;
  Outputs outputs;
  CommissionOptions options;
};

/// With records the plant is the one they show and the plants that may be the true one are drawn
/// from what they leave open; else from the case's ranges.
/// @throws as plan_commission; Interrupted after `interrupted` said yes.
CommissionReport commission_case(const CommissionArguments& arguments,
                                 const std::function<bool()>& interrupted);

Subcommand add_commission(CLI::App& program);

}  // namespace boresight::app
