#include <optional>
#include <ranges>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/control/controllers/path_sections.hpp>
#include <boresight/control/program/feedback_statements.hpp>

namespace boresight::control::program {
namespace {

// A section in transposed direct form II: y = b0 u + s1, s1' = b1 u - a1 y + s2, s2' = b2 u - a2 y.
class Section {
 public:
  Section(Builder& builder, const DigitalSection& section, bool forward)
      : order_(section.order),
        forward_(forward),
        static_gain_(forward
                         ? builder.parameter(section.name + "_static_gain", Type::real,
                                             section.static_gain, "",
                                             section.description + ": output over input at rest")
                         : builder.parameter(section.name + "_inverse_static_gain", Type::real,
                                             section.inverse_static_gain, "",
                                             section.description + ": input over output at rest")),
        input_(builder.local(section.name + "_input", Type::real, "", "")),
        output_(builder.local(section.name + "_output", Type::real, "", "")) {
    constexpr const char* digits[]{"0", "1", "2"};
    for (std::size_t i = 0; std::cmp_less_equal(i, order_); ++i) {
      b_.push_back(builder.parameter(fmt::format("{}_b{}", section.name, digits[i]), Type::real,
                                     section.b[i], "", section.description));
    }
    for (std::size_t i = 0; std::cmp_less(i, order_); ++i) {
      a_.push_back(builder.parameter(fmt::format("{}_a{}", section.name, digits[i + 1]), Type::real,
                                     section.a[i], "", section.description));
      states_.push_back(builder.state(fmt::format("{}_state{}", section.name, digits[i + 1]),
                                      Type::real, "", section.description));
    }
  }

  Expression compute(Builder& builder, const Expression& input) const {
    builder.assign(input_, input);
    builder.assign(output_, order_ == 0 ? b_[0] * input_ : b_[0] * input_ + states_[0]);
    return output_;
  }

  const Expression& output() const { return output_; }

  // After compute.
  void advance(Builder& builder) const {
    if (order_ == 1) builder.assign(states_[0], b_[1] * input_ - a_[0] * output_);
    if (order_ == 2) {
      builder.assign(states_[0], b_[1] * input_ - a_[0] * output_ + states_[1]);
      builder.assign(states_[1], b_[2] * input_ - a_[1] * output_);
    }
  }

  // At rest: the output of an input (forward), or the input of an output.
  Expression start(Builder& builder, const Expression& known) const {
    builder.assign(forward_ ? input_ : output_, known);
    builder.assign(forward_ ? output_ : input_, (forward_ ? input_ : output_) * static_gain_);
    if (order_ > 0) builder.assign(states_[0], output_ - b_[0] * input_);
    if (order_ == 2) builder.assign(states_[1], b_[2] * input_ - a_[1] * output_);
    return forward_ ? output_ : input_;
  }

 private:
  int order_;
  bool forward_;
  Expression static_gain_, input_, output_;
  std::vector<Expression> b_, a_, states_;
};

// The integral of a position path with its dead zone or freeze: y = x + s + b f(x), s' = s + 2 b
// f(x).
class ConditionalSection {
 public:
  ConditionalSection(Builder& builder, const ConditionalIntegral& integral, double sample_time)
      : freeze_(integral.condition == BlockKind::freeze),
        width_(builder.parameter("position_integral_width", Type::real, integral.width, "rad",
                                 freeze_ ? "error within which the position integral holds"
                                         : "dead zone of the position integral")),
        half_step_(builder.parameter("position_integral_half_step", Type::real,
                                     0.5 * integral.corner * sample_time, "",
                                     "position integral corner times half the sample time")),
        input_(builder.local("position_integral_input", Type::real, "", "")),
        state_(builder.state("position_integral_state", Type::real, "rad", "position integral")) {}

  Expression compute(Builder& builder, const Expression& x) const {
    if (freeze_) {
      builder.begin_if(absolute(x) < width_);
      builder.assign(input_, constant(0.0));
      builder.otherwise();
      builder.assign(input_, x);
      builder.end_if();
    } else {
      builder.assign(input_, x - limited(x, width_));
    }
    return x + (state_ + half_step_ * input_);
  }
  // After compute.
  void advance(Builder& builder) const {
    builder.assign(state_, state_ + (half_step_ + half_step_) * input_);
  }
  // At rest without error.
  void start(Builder& builder, const Expression& output) const { builder.assign(state_, output); }

 private:
  bool freeze_;
  Expression width_, half_step_, input_, state_;
};

class Path {
 public:
  Path(Builder& builder, const Controller& controller, LoopPath path, double sample_time,
       bool forward) {
    const auto integral = path == LoopPath::position ? conditional_integral(controller)
                                                     : std::optional<ConditionalIntegral>();
    if (integral) conditional_.emplace(builder, *integral, sample_time);
    const Controller linear = integral ? without_conditional_integral(controller) : controller;
    for (const auto& section : digital_sections(linear, path, sample_time)) {
      sections_.emplace_back(builder, section, forward);
    }
  }

  Expression compute(Builder& builder, Expression signal) const {
    if (conditional_) signal = conditional_->compute(builder, signal);
    for (const auto& section : sections_) signal = section.compute(builder, signal);
    return signal;
  }
  void advance(Builder& builder) const {
    if (conditional_) conditional_->advance(builder);
    for (const auto& section : sections_) section.advance(builder);
  }
  const Expression& output() const { return sections_.back().output(); }
  Expression start_forward(Builder& builder, Expression input) const {
    for (const auto& section : sections_) input = section.start(builder, input);
    return input;
  }
  Expression start_backward(Builder& builder, Expression output) const {
    for (const Section& section : std::views::reverse(sections_)) {
      output = section.start(builder, output);
    }
    if (!conditional_) return output;
    conditional_->start(builder, output);
    return constant(0.0);
  }

 private:
  std::optional<ConditionalSection> conditional_;
  std::vector<Section> sections_;
};

class LoopFeedback final : public FeedbackStatements {
 public:
  LoopFeedback(Builder& builder, const Controller& controller, double sample_time,
               double back_calculation)
      : rate_(builder, controller, LoopPath::rate, sample_time, false),
        position_(builder, controller, LoopPath::position, sample_time, false),
        conditioned_(back_calculation > 0.0) {
    const auto path = [&](LoopPath which) {
      return controller.structure.has(which)
                 ? std::optional<Path>(std::in_place, builder, controller, which, sample_time, true)
                 : std::nullopt;
    };
    pressure_ = path(LoopPath::pressure);
    compliance_ = path(LoopPath::compliance);
    if (!conditioned_) return;
    const double gain =
        path_gain(controller, LoopPath::rate) * path_gain(controller, LoopPath::position);
    anti_windup_ = builder.parameter("anti_windup", Type::real, back_calculation / gain, "s",
                                     "angle error per valve command beyond its limit");
  }

  Expression start(Builder& builder, const Expression& feedback,
                   const FeedbackInputs& inputs) override {
    if (pressure_) pressure_->start_forward(builder, inputs.torque);
    const Expression rate_error = rate_.start_backward(builder, feedback);
    const Expression angle =
        position_.start_backward(builder, inputs.rate_feedforward - inputs.rate - rate_error);
    return compliance_ ? angle + compliance_->start_forward(builder, inputs.torque) : angle;
  }

  Expression feedback(Builder& builder, const FeedbackInputs& inputs) override {
    if (compliance_) compliance_->compute(builder, inputs.torque);
    const Expression rate = compute_rate(builder, inputs, inputs.angle_error);
    return pressure_ ? rate - pressure_->compute(builder, inputs.torque) : rate;
  }

  void advance(Builder& builder, const FeedbackInputs& inputs, const Expression& cut) override {
    if (conditioned_) {
      // The angle error of which the limited command is the result.
      compute_rate(builder, inputs, inputs.angle_error + anti_windup_ * cut);
    }
    if (compliance_) compliance_->advance(builder);
    position_.advance(builder);
    rate_.advance(builder);
    if (pressure_) pressure_->advance(builder);
  }

 private:
  // The rate path's output; what compliance compensation takes off is computed already.
  Expression compute_rate(Builder& builder, const FeedbackInputs& inputs,
                          const Expression& angle_error) {
    const Expression position =
        position_.compute(builder, compliance_ ? angle_error - compliance_->output() : angle_error);
    return rate_.compute(builder, inputs.rate_feedforward - position - inputs.rate);
  }

  Path rate_, position_;
  std::optional<Path> pressure_, compliance_;
  bool conditioned_;
  Expression anti_windup_;
};

}  // namespace

std::unique_ptr<FeedbackStatements> loop_feedback(Builder& builder, const Controller& controller,
                                                  double sample_time, double back_calculation) {
  return std::make_unique<LoopFeedback>(builder, controller, sample_time, back_calculation);
}

}  // namespace boresight::control::program
