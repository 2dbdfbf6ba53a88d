#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::plant {
namespace {

using Names = std::vector<std::string>;

bool has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<Eigen::Index> positions(const char* function, const char* what, const Names& all,
                                    const Names& chosen) {
  std::vector<Eigen::Index> result;
  std::set<std::string> seen;
  for (const auto& name : chosen) {
    const auto found = std::find(all.begin(), all.end(), name);
    if (found == all.end()) {
      throw InvalidInput(fmt::format("{}: expected {}s among {}, found '{}'", function, what,
                                     fmt::join(all, ", "), name));
    }
    if (!seen.insert(name).second) {
      throw InvalidInput(fmt::format("{}: the {} '{}' is given twice", function, what, name));
    }
    result.push_back(found - all.begin());
  }
  return result;
}

Names with_suffix(const Names& names, const char* suffix) {
  Names result;
  for (const auto& name : names) result.push_back(name + suffix);
  return result;
}

// outputs[i] = first[i] + sign of second's signal of the same place.
StateSpace sum(const Names& first, const Names& second, const Names& outputs, double sign = 1.0) {
  const auto n = static_cast<Eigen::Index>(outputs.size());
  Eigen::MatrixXd gain(n, 2 * n);
  gain << Eigen::MatrixXd::Identity(n, n), sign * Eigen::MatrixXd::Identity(n, n);
  Names inputs = first;
  inputs.insert(inputs.end(), second.begin(), second.end());
  return static_gain(gain, inputs, outputs);
}

// Signals that reach themselves through feedthroughs alone.
std::set<std::string> algebraic_loop(const std::vector<StateSpace>& systems) {
  std::map<std::string, std::set<std::string>> reached;
  for (const auto& system : systems) {
    for (Eigen::Index i = 0; i < system.d.rows(); ++i) {
      for (Eigen::Index j = 0; j < system.d.cols(); ++j) {
        if (system.d(i, j) == 0.0) continue;
        reached[system.inputs[static_cast<std::size_t>(j)]].insert(
            system.outputs[static_cast<std::size_t>(i)]);
      }
    }
  }
  for (bool grown = true; grown;) {
    grown = false;
    for (auto& [from, to] : reached) {
      const std::set<std::string> before = to;
      for (const auto& middle : before) {
        if (const auto onward = reached.find(middle); onward != reached.end()) {
          to.insert(onward->second.begin(), onward->second.end());
        }
      }
      grown = grown || to.size() > before.size();
    }
  }
  std::set<std::string> loop;
  for (const auto& [from, to] : reached) {
    if (to.contains(from)) loop.insert(from);
  }
  return loop;
}

StateSpace connect_well_posed(const char* function, const std::vector<StateSpace>& systems,
                              const Names& inputs, const Names& outputs) {
  try {
    return connect(systems, inputs, outputs);
  } catch (const NumericalFailure& failure) {
    throw NumericalFailure(
        fmt::format("{}: the algebraic loop through {} has no solution ({}); put something without "
                    "feedthrough, a lag or a delay, into it",
                    function, fmt::join(algebraic_loop(systems), ", "), failure.what()));
  }
}

Names without(const Names& names, const Names& taken) {
  Names rest;
  std::copy_if(names.begin(), names.end(), std::back_inserter(rest),
               [&](const std::string& name) { return !has(taken, name); });
  return rest;
}

void expect_length(const char* field, const Names& names, std::size_t length, const char* of) {
  if (!names.empty() && names.size() != length) {
    throw InvalidInput(
        fmt::format("feedback: expected no {} or one for each of the {} {}, found {} ({})", field,
                    length, of, names.size(), fmt::join(names, ", ")));
  }
}

}  // namespace

StateSpace subsystem(const StateSpace& system, const Names& inputs, const Names& outputs) {
  validate(system);
  const auto columns = positions("subsystem", "input", system.inputs, inputs);
  const auto rows = positions("subsystem", "output", system.outputs, outputs);
  return {system.a,
          system.b(Eigen::all, columns),
          system.c(rows, Eigen::all),
          system.d(rows, columns),
          inputs,
          outputs,
          system.states,
          system.sample_time};
}

StateSpace renamed(const StateSpace& system, const std::map<std::string, std::string>& new_names) {
  validate(system);
  StateSpace result = system;
  std::set<std::string> used;
  for (Names* names : {&result.inputs, &result.outputs, &result.states}) {
    for (auto& name : *names) {
      const auto found = new_names.find(name);
      if (found == new_names.end()) continue;
      used.insert(name);
      name = found->second;
    }
  }
  for (const auto& [before, after] : new_names) {
    if (!used.contains(before)) {
      throw InvalidInput(
          fmt::format("renamed: expected a name among the inputs {}, outputs {} and states {}, "
                      "found '{}'",
                      fmt::join(system.inputs, ", "), fmt::join(system.outputs, ", "),
                      fmt::join(system.states, ", "), before));
    }
  }
  validate(result);
  return result;
}

StateSpace series(const StateSpace& first, const StateSpace& second) {
  positions("series", "input of the second system", first.outputs, second.inputs);
  return connect({first, second}, first.inputs, second.outputs);
}

StateSpace parallel(const StateSpace& first, const StateSpace& second) {
  positions("parallel", "input", first.inputs, second.inputs);
  positions("parallel", "input", second.inputs, first.inputs);
  positions("parallel", "output", first.outputs, second.outputs);
  positions("parallel", "output", second.outputs, first.outputs);
  StateSpace one = first;
  StateSpace two = second;
  one.outputs = with_suffix(first.outputs, " (first)");
  two.outputs = with_suffix(second.outputs, " (second)");
  const auto total = sum(one.outputs, with_suffix(first.outputs, " (second)"), first.outputs);
  return connect({one, two, total}, first.inputs, first.outputs);
}

StateSpace feedback(const StateSpace& forward, const StateSpace& back,
                    const FeedbackOptions& options) {
  positions("feedback", "input of the returning system", forward.outputs, back.inputs);
  positions("feedback", "output of the returning system", forward.inputs, back.outputs);
  if (std::abs(options.sign) != 1.0) {
    throw InvalidInput(fmt::format("feedback: expected a sign of 1 or -1, found {}", options.sign));
  }
  expect_length("output disturbances", options.output_disturbances, forward.outputs.size(),
                "outputs of the forward system");
  expect_length("measurement noises", options.measurement_noises, back.inputs.size(),
                "inputs of the returning system");
  expect_length("total inputs", options.total_inputs, forward.inputs.size(),
                "inputs of the forward system");

  // A name of its own for each place of the loop that has several contributions.
  StateSpace way = forward;
  way.inputs =
      options.total_inputs.empty() ? with_suffix(forward.inputs, " (total)") : options.total_inputs;
  StateSpace returned = back;
  returned.outputs = with_suffix(back.outputs, " (returned)");
  std::vector<StateSpace> parts;
  Names inputs = forward.inputs;
  if (!options.output_disturbances.empty()) {
    way.outputs = with_suffix(forward.outputs, " (undisturbed)");
    parts.push_back(sum(way.outputs, options.output_disturbances, forward.outputs));
    inputs.insert(inputs.end(), options.output_disturbances.begin(),
                  options.output_disturbances.end());
  }
  if (!options.measurement_noises.empty()) {
    returned.inputs = with_suffix(back.inputs, " (measured)");
    parts.push_back(sum(back.inputs, options.measurement_noises, returned.inputs));
    inputs.insert(inputs.end(), options.measurement_noises.begin(),
                  options.measurement_noises.end());
  }
  for (std::size_t i = 0; i < forward.inputs.size(); ++i) {
    const std::string& name = forward.inputs[i];
    if (has(back.outputs, name)) {
      parts.push_back(sum({name}, {name + " (returned)"}, {way.inputs[i]}, options.sign));
    } else {
      parts.push_back(static_gain(Eigen::MatrixXd::Ones(1, 1), {name}, {way.inputs[i]}));
    }
  }
  Names outputs = forward.outputs;
  outputs.insert(outputs.end(), options.total_inputs.begin(), options.total_inputs.end());
  parts.insert(parts.begin(), {way, returned});
  return connect_well_posed("feedback", parts, inputs, outputs);
}

StateSpace lower_fractional_transformation(const StateSpace& system, const StateSpace& controller) {
  const char* function = "lower_fractional_transformation";
  positions(function, "input of the controller", system.outputs, controller.inputs);
  positions(function, "output of the controller", system.inputs, controller.outputs);
  return connect_well_posed(function, {system, controller},
                            without(system.inputs, controller.outputs),
                            without(system.outputs, controller.inputs));
}

}  // namespace boresight::plant
