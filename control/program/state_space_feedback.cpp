#include <algorithm>
#include <string>

#include <fmt/format.h>

#include <boresight/control/program/feedback_statements.hpp>
#include <boresight/numerics/linear_solve.hpp>

namespace boresight::control::program {
namespace {

using Eigen::Index;

// The signals that a state space regulates to 0.
struct Signal {
  Index column;
  const char* name;
};

class StateSpaceFeedback final : public FeedbackStatements {
 public:
  StateSpaceFeedback(Builder& builder, const plant::StateSpace& controller)
      : reads_torque_(std::ranges::count(controller.inputs, "motor_torque") > 0) {
    const plant::StateSpace system = in_modal_blocks(controller);
    signals_ = {{plant::input_index(system, "tachometer"), "rate"},
                {plant::input_index(system, "encoder"), "angle"}};
    if (reads_torque_) signals_.push_back({plant::input_index(system, "motor_torque"), "torque"});
    const Index states = system.a.rows();
    for (Index i = 0; i < states; ++i) {
      states_.push_back(builder.state(fmt::format("state_{}", i + 1), Type::real, "",
                                      system.states[static_cast<std::size_t>(i)]));
      next_.push_back(builder.local(fmt::format("next_{}", i + 1), Type::real, "", ""));
    }
    for (Index i = 0; i < states; ++i) declare_row(builder, system, i);
    declare_output(builder, system);
    declare_start(builder, system);
  }

  Expression start(Builder& builder, const Expression& feedback,
                   const FeedbackInputs& inputs) override {
    std::vector<Expression> known{feedback, inputs.rate - inputs.rate_feedforward};
    if (reads_torque_) known.push_back(inputs.torque);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      builder.assign(states_[i], weighted(start_[i], known));
    }
    return weighted(start_.back(), known);
  }

  Expression feedback(Builder& builder, const FeedbackInputs& inputs) override {
    static_cast<void>(builder);
    return output_of(signals_of(inputs));
  }

  void advance(Builder& builder, const FeedbackInputs& inputs, const Expression& cut) override {
    static_cast<void>(cut);
    const auto signals = signals_of(inputs);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      builder.assign(next_[i], sum(rows_[i], signals));
    }
    for (std::size_t i = 0; i < states_.size(); ++i) builder.assign(states_[i], next_[i]);
  }

 private:
  // A coefficient and what it multiplies: a state, or a signal behind the states.
  struct Term {
    Expression coefficient;
    std::size_t factor = 0;
  };

  std::vector<Expression> signals_of(const FeedbackInputs& inputs) const {
    std::vector<Expression> signals{inputs.rate - inputs.rate_feedforward, inputs.angle_error};
    if (reads_torque_) signals.push_back(inputs.torque);
    return signals;
  }

  static Expression weighted(const std::vector<Expression>& coefficients,
                             const std::vector<Expression>& values) {
    Expression total = coefficients[0] * values[0];
    for (std::size_t i = 1; i < values.size(); ++i) total = total + coefficients[i] * values[i];
    return total;
  }

  Expression sum(const std::vector<Term>& terms, const std::vector<Expression>& signals) const {
    Expression total;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const std::size_t factor = terms[i].factor;
      const Expression& value =
          factor < states_.size() ? states_[factor] : signals[factor - states_.size()];
      const Expression product = terms[i].coefficient * value;
      total = i == 0 ? product : total + product;
    }
    return total;
  }

  Expression output_of(const std::vector<Expression>& signals) const {
    return sum(output_, signals);
  }

  void declare_row(Builder& builder, const plant::StateSpace& system, Index i) {
    std::vector<Term>& row = rows_.emplace_back();
    for (Index j = 0; j < system.a.cols(); ++j) {
      if (system.a(i, j) == 0.0) continue;
      row.push_back({builder.parameter(fmt::format("a_{}_{}", i + 1, j + 1), Type::real,
                                       system.a(i, j), "", "of state to state"),
                     static_cast<std::size_t>(j)});
    }
    for (std::size_t k = 0; k < signals_.size(); ++k) {
      row.push_back({builder.parameter(fmt::format("b_{}_{}", i + 1, signals_[k].name), Type::real,
                                       system.b(i, signals_[k].column), "", "of signal to state"),
                     states_.size() + k});
    }
  }

  void declare_output(Builder& builder, const plant::StateSpace& system) {
    for (Index j = 0; j < system.c.cols(); ++j) {
      if (system.c(0, j) == 0.0) continue;
      output_.push_back({builder.parameter(fmt::format("c_{}", j + 1), Type::real, system.c(0, j),
                                           "", "of state to valve command"),
                         static_cast<std::size_t>(j)});
    }
    for (std::size_t k = 0; k < signals_.size(); ++k) {
      output_.push_back(
          {builder.parameter(fmt::format("d_{}", signals_[k].name), Type::real,
                             system.d(0, signals_[k].column), "", "of signal to valve command"),
           states_.size() + k});
    }
  }

  // States and angle error at rest, as multiples of feedback, rate and torque:
  // (I - A) x - Bangle e = Brate r + Btorque t,  C x + Dangle e = u - Drate r - Dtorque t.
  void declare_start(Builder& builder, const plant::StateSpace& system) {
    const Index states = system.a.rows();
    const Index angle = signals_[1].column;
    Eigen::MatrixXd equations(states + 1, states + 1);
    equations.topLeftCorner(states, states) = Eigen::MatrixXd::Identity(states, states) - system.a;
    equations.topRightCorner(states, 1) = -system.b.col(angle);
    equations.bottomLeftCorner(1, states) = system.c;
    equations(states, states) = system.d(0, angle);
    std::vector<Signal> known{signals_[0]};
    if (reads_torque_) known.push_back(signals_[2]);
    const auto columns = static_cast<Index>(known.size()) + 1;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(states + 1, columns);
    right(states, 0) = 1.0;
    for (Index k = 1; k < columns; ++k) {
      const Index column = known[static_cast<std::size_t>(k - 1)].column;
      right.col(k).head(states) = system.b.col(column);
      right(states, k) = -system.d(0, column);
    }
    const Eigen::MatrixXd steady =
        numerics::linear_solve(equations, right, "controller program: steady motion");
    for (Index i = 0; i <= states; ++i) {
      std::vector<Expression>& row = start_.emplace_back();
      const std::string name = i == states ? "error" : fmt::format("{}", i + 1);
      for (Index k = 0; k < columns; ++k) {
        row.push_back(builder.parameter(
            fmt::format("start_{}_{}", name,
                        k == 0 ? "valve" : known[static_cast<std::size_t>(k - 1)].name),
            Type::real, steady(i, k), "", "of steady motion to state at the start"));
      }
    }
  }

  bool reads_torque_;
  std::vector<Signal> signals_;
  std::vector<Expression> states_, next_;
  std::vector<std::vector<Term>> rows_;
  std::vector<Term> output_;
  std::vector<std::vector<Expression>> start_;  // one a state, then the angle error
};

}  // namespace

std::unique_ptr<FeedbackStatements> state_space_feedback(Builder& builder,
                                                         const plant::StateSpace& controller) {
  return std::make_unique<StateSpaceFeedback>(builder, controller);
}

}  // namespace boresight::control::program
