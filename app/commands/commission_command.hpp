#pragma once

#include <functional>
#include <string>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/commission/commission_study.hpp>

namespace boresight::app {

struct CommissionArguments {
  std::string case_path;
  Outputs outputs;
  std::string folder;  // for the sheets; empty: none
  CommissionOptions options;
};

/// With records, the plant is the identified one and the uncertainty set is sampled from the
/// uncertainty that the records leave. Without records, it is sampled from the case's ranges.
/// @throws as plan_commission; Interrupted after `interrupted` returned true.
CommissionReport commission_case(const CommissionArguments& arguments,
                                 const std::function<bool()>& interrupted);

Subcommand add_commission(CLI::App& program);

}  // namespace boresight::app
