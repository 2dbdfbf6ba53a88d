#pragma once

#include <functional>
#include <string>
#include <vector>

#include <boresight/app/change/change_report.hpp>
#include <boresight/app/commands/benchmark_command.hpp>

namespace boresight::app {

/// Compares the records before and after a change of the controller. The controller after is that
/// of the arguments; the one before is that of `change`, else the present one of the case, if it
/// states one.
/// @throws InvalidInput for invalid arguments, cases or files; as recommended_controller;
/// Interrupted.
ChangeReport change_of_case(const BenchmarkArguments& arguments,
                            const std::function<bool()>& interrupted);

/// The same, delivered. Exit code `infeasible` if a check of the change failed.
int compare_change(const BenchmarkArguments& arguments);

}  // namespace boresight::app
