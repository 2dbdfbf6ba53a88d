#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {
namespace {

void refuse_duplicates(const char* what, const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const auto& name : names) {
    if (!seen.insert(name).second) {
      throw InvalidInput(
          fmt::format("state space: expected unique {} names, found '{}' twice", what, name));
    }
  }
}

Eigen::Index index_of(const char* what, const std::vector<std::string>& names,
                      std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InvalidInput(fmt::format("state space: expected one of the {}s {}, found '{}'", what,
                                   fmt::join(names, ", "), name));
  }
  return found - names.begin();
}

void append(std::vector<std::string>& names, const std::vector<std::string>& more) {
  names.insert(names.end(), more.begin(), more.end());
}

// The sample time that all systems with states share.
double common_sample_time(const std::vector<StateSpace>& systems) {
  const StateSpace* first = nullptr;
  for (const auto& system : systems) {
    if (system.states.empty()) continue;
    if (first == nullptr) first = &system;
    if (system.sample_time != first->sample_time) {
      throw InvalidInput(fmt::format(
          "connect: expected one sample time, found {} s (with state '{}') and {} s (with state "
          "'{}'); sample the continuous part first",
          first->sample_time, first->states.front(), system.sample_time, system.states.front()));
    }
  }
  if (first != nullptr) return first->sample_time;
  return systems.empty() ? 0.0 : systems.front().sample_time;
}

// All systems side by side, not connected.
StateSpace stack(const std::vector<StateSpace>& systems) {
  Eigen::Index n = 0, m = 0, p = 0;
  for (const auto& system : systems) {
    n += system.a.rows();
    m += system.b.cols();
    p += system.c.rows();
  }
  StateSpace all{Eigen::MatrixXd::Zero(n, n),
                 Eigen::MatrixXd::Zero(n, m),
                 Eigen::MatrixXd::Zero(p, n),
                 Eigen::MatrixXd::Zero(p, m),
                 {},
                 {},
                 {}};
  n = m = p = 0;
  for (const auto& system : systems) {
    const Eigen::Index dn = system.a.rows(), dm = system.b.cols(), dp = system.c.rows();
    all.a.block(n, n, dn, dn) = system.a;
    all.b.block(n, m, dn, dm) = system.b;
    all.c.block(p, n, dp, dn) = system.c;
    all.d.block(p, m, dp, dm) = system.d;
    append(all.inputs, system.inputs);
    append(all.outputs, system.outputs);
    append(all.states, system.states);
    n += dn;
    m += dm;
    p += dp;
  }
  return all;
}

// The inverse of a matrix with ones on its diagonal, zero where no chain of its elements leads:
// what rounding would leave there are couplings that do not exist, and balancing would enlarge
// them.
Eigen::MatrixXd structural_inverse(const Eigen::MatrixXd& matrix) {
  const Eigen::Index n = matrix.rows();
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> leads = matrix.array() != 0.0;
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!leads(i, k)) continue;
      for (Eigen::Index j = 0; j < n; ++j) leads(i, j) = leads(i, j) || leads(k, j);
    }
  }
  Eigen::MatrixXd inverse =
      numerics::linear_solve(matrix, Eigen::MatrixXd::Identity(n, n), "connect");
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (i != j && !leads(i, j)) inverse(i, j) = 0.0;
    }
  }
  return inverse;
}

}  // namespace

void validate(const StateSpace& system) {
  const auto n = static_cast<Eigen::Index>(system.states.size());
  const auto m = static_cast<Eigen::Index>(system.inputs.size());
  const auto p = static_cast<Eigen::Index>(system.outputs.size());
  const auto check = [](const char* name, const Eigen::MatrixXd& matrix, Eigen::Index rows,
                        Eigen::Index columns) {
    if (matrix.rows() != rows || matrix.cols() != columns) {
      throw InvalidInput(fmt::format("state space: expected {} as {} x {}, found {} x {}", name,
                                     rows, columns, matrix.rows(), matrix.cols()));
    }
    if (!matrix.allFinite()) {
      throw InvalidInput(fmt::format("state space: {} has elements that are not finite", name));
    }
  };
  check("A", system.a, n, n);
  check("B", system.b, n, m);
  check("C", system.c, p, n);
  check("D", system.d, p, m);
  refuse_duplicates("input", system.inputs);
  refuse_duplicates("output", system.outputs);
  refuse_duplicates("state", system.states);
  if (!std::isfinite(system.sample_time) || system.sample_time < 0.0) {
    throw InvalidInput(
        fmt::format("state space: expected a sample time of 0 (continuous) or more, found {} s",
                    system.sample_time));
  }
}

Eigen::Index input_index(const StateSpace& system, std::string_view name) {
  return index_of("input", system.inputs, name);
}

Eigen::Index output_index(const StateSpace& system, std::string_view name) {
  return index_of("output", system.outputs, name);
}

StateSpace static_gain(const Eigen::MatrixXd& gain, std::vector<std::string> inputs,
                       std::vector<std::string> outputs) {
  StateSpace system{Eigen::MatrixXd(0, 0),
                    Eigen::MatrixXd(0, gain.cols()),
                    Eigen::MatrixXd(gain.rows(), 0),
                    gain,
                    std::move(inputs),
                    std::move(outputs),
                    {}};
  validate(system);
  return system;
}

StateSpace rational(const std::vector<double>& numerator, const std::vector<double>& denominator,
                    const std::string& input, const std::string& output, const std::string& name) {
  const auto n = static_cast<Eigen::Index>(denominator.size()) - 1;
  if (n < 0 || denominator.back() == 0.0) {
    throw InvalidInput(
        fmt::format("rational '{}': the leading denominator coefficient is 0", name));
  }
  if (numerator.size() > denominator.size()) {
    throw InvalidInput(
        fmt::format("rational '{}': expected a proper function, found numerator degree {} above "
                    "denominator degree {}",
                    name, numerator.size() - 1, denominator.size() - 1));
  }
  const double leading = denominator.back();
  Eigen::VectorXd zeros = Eigen::VectorXd::Zero(n + 1);
  Eigen::VectorXd poles(n + 1);
  for (std::size_t i = 0; i < denominator.size(); ++i) {
    poles[static_cast<Eigen::Index>(i)] = denominator[i] / leading;
    if (i < numerator.size()) zeros[static_cast<Eigen::Index>(i)] = numerator[i] / leading;
  }
  StateSpace system{Eigen::MatrixXd::Zero(n, n),
                    Eigen::MatrixXd::Zero(n, 1),
                    Eigen::MatrixXd::Zero(1, n),
                    Eigen::MatrixXd::Constant(1, 1, zeros[n]),
                    {input},
                    {output},
                    {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i + 1 < n) system.a(i, i + 1) = 1.0;
    system.a(n - 1, i) = -poles[i];
    system.c(0, i) = zeros[i] - zeros[n] * poles[i];
    system.states.push_back(fmt::format("{}.{}", name, i + 1));
  }
  if (n > 0) system.b(n - 1, 0) = 1.0;
  return system;
}

StateSpace connect(const std::vector<StateSpace>& systems,
                   const std::vector<std::string>& external_inputs,
                   const std::vector<std::string>& external_outputs) {
  for (const auto& system : systems) validate(system);
  refuse_duplicates("external input", external_inputs);
  refuse_duplicates("external output", external_outputs);
  const StateSpace all = stack(systems);
  refuse_duplicates("output", all.outputs);
  refuse_duplicates("state", all.states);

  const auto m = static_cast<Eigen::Index>(all.inputs.size());
  const auto p = static_cast<Eigen::Index>(all.outputs.size());
  const auto outside = static_cast<Eigen::Index>(external_inputs.size());
  std::map<std::string, Eigen::Index> output_of, external_of;
  for (Eigen::Index i = 0; i < p; ++i) output_of[all.outputs[static_cast<std::size_t>(i)]] = i;
  for (Eigen::Index i = 0; i < outside; ++i) {
    const auto& name = external_inputs[static_cast<std::size_t>(i)];
    if (output_of.contains(name)) {
      throw InvalidInput(
          fmt::format("connect: the external input '{}' is also an output of a system", name));
    }
    external_of[name] = i;
  }
  // u = feedback y + selection r
  Eigen::MatrixXd feedback = Eigen::MatrixXd::Zero(m, p);
  Eigen::MatrixXd selection = Eigen::MatrixXd::Zero(m, outside);
  std::set<std::string> used;
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto& name = all.inputs[static_cast<std::size_t>(i)];
    if (const auto output = output_of.find(name); output != output_of.end()) {
      feedback(i, output->second) = 1.0;
    } else if (const auto input = external_of.find(name); input != external_of.end()) {
      selection(i, input->second) = 1.0;
      used.insert(name);
    } else {
      throw InvalidInput(fmt::format(
          "connect: nothing feeds the input '{}' (no output and no external input has that name)",
          name));
    }
  }
  for (const auto& name : external_inputs) {
    if (!used.contains(name)) {
      throw InvalidInput(fmt::format("connect: no system has the external input '{}'", name));
    }
  }
  // y = C x + D u, u = F y + E r  =>  u = (I - F D)^-1 (F C x + E r)
  const Eigen::MatrixXd loop = Eigen::MatrixXd::Identity(m, m) - feedback * all.d;
  const Eigen::MatrixXd through = structural_inverse(loop);
  const Eigen::MatrixXd from_states = through * (feedback * all.c);
  const Eigen::MatrixXd from_outside = through * selection;
  const Eigen::MatrixXd c = all.c + all.d * from_states;
  const Eigen::MatrixXd d = all.d * from_outside;

  StateSpace result;
  result.a = all.a + all.b * from_states;
  result.b = all.b * from_outside;
  result.c.resize(static_cast<Eigen::Index>(external_outputs.size()), all.a.cols());
  result.d.resize(static_cast<Eigen::Index>(external_outputs.size()), outside);
  for (std::size_t i = 0; i < external_outputs.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::Index from = index_of("output", all.outputs, external_outputs[i]);
    result.c.row(row) = c.row(from);
    result.d.row(row) = d.row(from);
  }
  result.inputs = external_inputs;
  result.outputs = external_outputs;
  result.states = all.states;
  result.sample_time = common_sample_time(systems);
  return result;
}

Eigen::MatrixXcd frequency_response(const StateSpace& system, double angular_frequency) {
  const std::complex<double> s = system.sample_time > 0.0
                                     ? std::polar(1.0, angular_frequency * system.sample_time)
                                     : std::complex<double>{0.0, angular_frequency};
  return numerics::transfer_matrix(system.a, system.b, system.c, system.d, s);
}

}  // namespace boresight::plant
