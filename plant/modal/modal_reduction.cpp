#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/modal/modal_reduction.hpp>

namespace boresight::plant {
namespace {

using Marks = std::vector<bool>;

// A signal graph: the nodes are the core's inputs, states and outputs, one after another.
class SignalGraph {
 public:
  explicit SignalGraph(const StateSpace& core)
      : inputs_(core.b.cols()),
        states_(core.a.rows()),
        outputs_(core.c.rows()),
        successors_(static_cast<std::size_t>(inputs_ + states_ + outputs_)),
        predecessors_(successors_.size()) {
    add_block(core.b, state(0), input(0));
    add_block(core.a, state(0), state(0));
    add_block(core.c, output(0), state(0));
    add_block(core.d, output(0), input(0));
  }
  Eigen::Index input(Eigen::Index i) const { return i; }
  Eigen::Index state(Eigen::Index i) const { return inputs_ + i; }
  Eigen::Index output(Eigen::Index i) const { return inputs_ + states_ + i; }

  void add(Eigen::Index from, Eigen::Index to) {
    successors_[static_cast<std::size_t>(from)].push_back(to);
    predecessors_[static_cast<std::size_t>(to)].push_back(from);
  }
  Marks reached_from(Eigen::Index node) const { return walk(node, successors_); }
  Marks leading_to(Eigen::Index node) const { return walk(node, predecessors_); }

 private:
  using Neighbours = std::vector<std::vector<Eigen::Index>>;

  void add_block(const Eigen::MatrixXd& matrix, Eigen::Index to, Eigen::Index from) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
        if (matrix(i, j) != 0.0) add(from + j, to + i);
      }
    }
  }
  static Marks walk(Eigen::Index start, const Neighbours& neighbours) {
    Marks seen(neighbours.size(), false);
    std::vector<Eigen::Index> waiting{start};
    seen[static_cast<std::size_t>(start)] = true;
    while (!waiting.empty()) {
      const auto node = static_cast<std::size_t>(waiting.back());
      waiting.pop_back();
      for (const Eigen::Index next : neighbours[node]) {
        if (seen[static_cast<std::size_t>(next)]) continue;
        seen[static_cast<std::size_t>(next)] = true;
        waiting.push_back(next);
      }
    }
    return seen;
  }

  Eigen::Index inputs_, states_, outputs_;
  Neighbours successors_, predecessors_;
};

void check_name(const char* what, const std::vector<std::string>& names, std::string_view name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InvalidInput(fmt::format("modal system: expected one of the {}s {}, found '{}'", what,
                                   fmt::join(names, ", "), name));
  }
}

// A force, or the signal before a dead time, with all it may move.
struct Forcing {
  Eigen::Index row;       // of the core's outputs
  Eigen::Index force;     // -1 for a dead time
  std::size_t dead_time;  // of a dead time
};

// A displacement with its rate, or the signal after a dead time.
struct Back {
  Eigen::Index column;        // of the core's inputs, -1 for none
  Eigen::Index rate_column;   // likewise
  Eigen::Index displacement;  // -1 for a dead time
  std::size_t dead_time;
};

Eigen::Index optional_input(const StateSpace& core, const std::string& name) {
  return name.empty() ? -1 : input_index(core, name);
}

std::vector<Forcing> all_forcings(const ModalSystem& system) {
  std::vector<Forcing> drives;
  for (std::size_t k = 0; k < system.modes.forces.size(); ++k) {
    drives.push_back(
        {output_index(system.core, system.modes.forces[k]), static_cast<Eigen::Index>(k), 0});
  }
  for (std::size_t k = 0; k < system.dead_times.size(); ++k) {
    drives.push_back({output_index(system.core, system.dead_times[k].from), -1, k});
  }
  return drives;
}

std::vector<Back> all_returns(const ModalSystem& system) {
  std::vector<Back> returns;
  for (std::size_t j = 0; j < system.modes.displacements.size(); ++j) {
    returns.push_back({optional_input(system.core, system.modes.displacements[j]),
                       optional_input(system.core, system.modes.rates[j]),
                       static_cast<Eigen::Index>(j), 0});
  }
  for (std::size_t j = 0; j < system.dead_times.size(); ++j) {
    returns.push_back({input_index(system.core, system.dead_times[j].to), -1, -1, j});
  }
  return returns;
}

bool moves(const ModalSystem& system, const Forcing& drive, const Back& back) {
  if (drive.force < 0 || back.displacement < 0) {
    return drive.force < 0 && back.displacement < 0 && drive.dead_time == back.dead_time;
  }
  return (system.modes.force_shape.col(drive.force).array() *
              system.modes.displacement_shape.row(back.displacement).transpose().array() !=
          0.0)
      .any();
}

// Which entries of the core there are, and which drives depend on a return.
void find_loops(ModalReduction& reduction) {
  const SignalGraph inner(reduction.core);
  reduction.entry.resize(reduction.core.d.rows(), reduction.core.d.cols());
  for (Eigen::Index c = 0; c < reduction.core.d.cols(); ++c) {
    const Marks reached = inner.reached_from(inner.input(c));
    for (Eigen::Index r = 0; r < reduction.core.d.rows(); ++r) {
      reduction.entry(r, c) = reached[static_cast<std::size_t>(inner.output(r))];
    }
  }
  const Eigen::Index returns = reduction.entry.cols() - 1;
  for (Eigen::Index row = 1; row < reduction.entry.rows(); ++row) {
    reduction.in_loop.push_back(reduction.entry.row(row).tail(returns).any());
  }
}

struct CoreQuality {
  double distance;   // of its poles from the axis, relative to the largest
  double condition;  // of its eigenvectors
};

CoreQuality quality(const StateSpace& core) {
  if (core.a.size() == 0) return {1.0, 1.0};
  try {
    const ModalForm form = modal_form(core);
    const double highest = form.poles.cwiseAbs().maxCoeff();
    return {highest > 0.0 ? form.poles.real().cwiseAbs().minCoeff() / highest : 0.0,
            form.condition};
  } catch (const NumericalFailure&) {
    return {0.0, std::numeric_limits<double>::infinity()};
  }
}

// Integrators of the core that only a loop through modes or dead times holds: the loop is closed
// with its gain at frequency 0, and what is left of it vanishes there.
void close_statically(ModalReduction& reduction) {
  // Rounding scatters a chain of k integrators by epsilon^(1/k): four come to lie within 1e-4.
  constexpr double near = 1e-4;
  if (reduction.paths.empty()) return;
  const CoreQuality before = quality(reduction.core);
  if (before.distance > near) return;
  const ModalReduction open = reduction;
  StateSpace& core = reduction.core;
  // Only the displacement has a gain at frequency 0: its rate becomes a return of its own.
  for (std::size_t j = 0, count = reduction.returns.size(); j < count; ++j) {
    if (reduction.returns[j].column < 0 || reduction.returns[j].rate_column < 0) continue;
    ModalReduction::Return rate;
    std::swap(rate.rate_column, reduction.returns[j].rate_column);
    for (std::size_t p = 0, paths = reduction.paths.size(); p < paths; ++p) {
      if (reduction.paths[p].to_return != j) continue;
      auto copy = reduction.paths[p];
      copy.to_return = reduction.returns.size();
      reduction.paths.push_back(std::move(copy));
    }
    reduction.returns.push_back(rate);
  }
  Eigen::MatrixXd back = Eigen::MatrixXd::Zero(core.b.cols(), core.c.rows());
  std::vector<double> within(reduction.paths.size(), 0.0);
  for (std::size_t p = 0; p < reduction.paths.size(); ++p) {
    const auto& path = reduction.paths[p];
    const Eigen::Index column = reduction.returns[path.to_return].column;
    if (column < 0) continue;
    double gain = 1.0;
    if (path.gain.size() > 0) {
      gain = 0.0;
      for (Eigen::Index i = 0; i < path.gain.size(); ++i) {
        const double w = reduction.mode_frequency[i];
        if (w > 0.0) gain += path.gain[i] / (w * w);
      }
    }
    within[p] = gain;
    back(column, static_cast<Eigen::Index>(path.from_drive) + 1) = gain;
  }
  const Eigen::Index columns = core.b.cols();
  const Eigen::MatrixXd loop = Eigen::MatrixXd::Identity(columns, columns) - back * core.d;
  Eigen::MatrixXd right(columns, core.a.cols() + columns);
  right << back * core.c, Eigen::MatrixXd::Identity(columns, columns);
  Eigen::MatrixXd solved;
  try {
    solved = numerics::linear_solve(loop, right, "the loops at frequency 0");
  } catch (const NumericalFailure&) {
    reduction = open;
    return;
  }
  const Eigen::MatrixXd from_states = solved.leftCols(core.a.cols());
  const Eigen::MatrixXd from_inputs = solved.rightCols(columns);
  core.a += core.b * from_states;
  core.c += core.d * from_states;
  core.b = (core.b * from_inputs).eval();
  core.d = (core.d * from_inputs).eval();
  for (std::size_t p = 0; p < within.size(); ++p) reduction.paths[p].within_core = within[p];
  const CoreQuality after = quality(core);
  // A chain of integrators is told by its eigenvectors, one alone by its place.
  if (after.distance <= before.distance && !(after.condition < 0.01 * before.condition)) {
    reduction = open;
  }
}

}  // namespace

ModalReduction reduce(const ModalSystem& system, std::string_view input, std::string_view output) {
  validate(system);
  check_name("input", system.inputs, input);
  check_name("output", system.outputs, output);
  const StateSpace& core = system.core;
  const auto drives = all_forcings(system);
  const auto returns = all_returns(system);

  SignalGraph graph(core);
  for (const auto& drive : drives) {
    for (const auto& back : returns) {
      if (!moves(system, drive, back)) continue;
      if (back.column >= 0) graph.add(graph.output(drive.row), graph.input(back.column));
      if (back.rate_column >= 0) graph.add(graph.output(drive.row), graph.input(back.rate_column));
    }
  }
  const Marks after = graph.reached_from(graph.input(input_index(core, input)));
  const Marks before = graph.leading_to(graph.output(output_index(core, output)));
  const auto on_path = [&](Eigen::Index node) {
    return after[static_cast<std::size_t>(node)] && before[static_cast<std::size_t>(node)];
  };

  std::vector<Eigen::Index> states, columns{input_index(core, input)},
      rows{output_index(core, output)};
  for (Eigen::Index i = 0; i < core.a.rows(); ++i) {
    if (on_path(graph.state(i))) states.push_back(i);
  }
  ModalReduction result;
  std::vector<const Forcing*> kept_drives;
  for (const auto& drive : drives) {
    if (!on_path(graph.output(drive.row))) continue;
    rows.push_back(drive.row);
    kept_drives.push_back(&drive);
  }
  if (kept_drives.size() > max_drives) {
    throw InvalidInput(fmt::format(
        "modal system: expected at most {} forces and dead times between '{}' and '{}', found {}",
        max_drives, input, output, kept_drives.size()));
  }
  std::vector<const Back*> kept_returns;
  for (const auto& back : returns) {
    const bool direct = back.column >= 0 && on_path(graph.input(back.column));
    const bool rate = back.rate_column >= 0 && on_path(graph.input(back.rate_column));
    if (!direct && !rate) continue;
    kept_returns.push_back(&back);
    auto& kept = result.returns.emplace_back();
    const auto column = [&](Eigen::Index from) {
      columns.push_back(from);
      return static_cast<Eigen::Index>(columns.size()) - 1;
    };
    if (direct) kept.column = column(back.column);
    if (rate) kept.rate_column = column(back.rate_column);
    kept.is_dead_time = back.displacement < 0;
    if (kept.is_dead_time) kept.delay = system.dead_times[back.dead_time].delay;
  }

  result.core.a = core.a(states, states);
  result.core.b = core.b(states, columns);
  result.core.c = core.c(rows, states);
  result.core.d = core.d(rows, columns);
  for (const Eigen::Index i : states) {
    result.core.states.push_back(core.states[static_cast<std::size_t>(i)]);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    result.core.inputs.push_back(fmt::format("column {}", i));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.core.outputs.push_back(fmt::format("row {}", i));
  }

  std::vector<Eigen::Index> used_modes;
  for (Eigen::Index i = 0; i < system.modes.frequency.size(); ++i) {
    bool used = false;
    for (const auto* drive : kept_drives) {
      for (const auto* back : kept_returns) {
        used = used || (drive->force >= 0 && back->displacement >= 0 &&
                        system.modes.force_shape(i, drive->force) *
                                system.modes.displacement_shape(back->displacement, i) !=
                            0.0);
      }
    }
    if (used) used_modes.push_back(i);
  }
  result.mode_frequency = system.modes.frequency(used_modes);
  result.mode_damping_ratio = system.modes.damping_ratio(used_modes);
  for (std::size_t k = 0; k < kept_drives.size(); ++k) {
    for (std::size_t j = 0; j < kept_returns.size(); ++j) {
      const Forcing& drive = *kept_drives[k];
      const Back& back = *kept_returns[j];
      if (!moves(system, drive, back)) continue;
      Eigen::VectorXd gain;
      if (drive.force >= 0) {
        gain = system.modes.force_shape(used_modes, drive.force)
                   .cwiseProduct(
                       system.modes.displacement_shape(back.displacement, used_modes).transpose());
      }
      result.paths.push_back({j, k, std::move(gain)});
    }
  }
  close_statically(result);
  find_loops(result);
  return result;
}

}  // namespace boresight::plant
