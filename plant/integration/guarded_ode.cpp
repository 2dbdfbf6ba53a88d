#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <boresight/plant/integration/guarded_ode.hpp>

namespace boresight::plant {
namespace {

// Where a state leaves for infinity, an integrator may go on for ever at the same time.
constexpr int max_standing_steps = 100;

// The first element that is not finite, counted from 0; there is one.
std::string describe(const char* function, double t,
                     const Eigen::Ref<const Eigen::MatrixXd>& values) {
  Eigen::Index row = 0, column = 0;
  while (std::isfinite(values(row, column))) {
    if (++row < values.rows()) continue;
    row = 0;
    ++column;
  }
  const std::string place =
      values.cols() > 1 ? fmt::format("({}, {})", row, column) : fmt::format("({})", row);
  return fmt::format("{}{} is {} at t = {} s", function, place, values(row, column), t);
}

}  // namespace

void GuardedOde::start(double t) {
  asked_ = accepted_ = t;
  accepted_steps_ = 0;
  standing_ = 0;
  complaint_.clear();
}

template <class Evaluate>
int GuardedOde::classify(const char* function, double t,
                         const Eigen::Ref<const Eigen::MatrixXd>& values,
                         const Evaluate& evaluate) {
  try {
    evaluate();
    complaint_.clear();
    if (values.allFinite()) return 0;
    complaint_ = describe(function, t, values);
    return within_rounding(t) ? give_up : smaller_step;
  } catch (...) {
    thrown_ = std::current_exception();
    return give_up;
  }
}

int GuardedOde::rate(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                     Eigen::Ref<Eigen::VectorXd> dx, long accepted_steps) {
  const bool stands = stands_still(t, accepted_steps);
  const int verdict = classify("rate", t, dx, [&] { system_.rate(t, x, dx); });
  if (verdict != 0 || !stands) return verdict;
  complaint_ = fmt::format("the steps are below the rounding of the time since {} s", accepted_);
  return give_up;
}

bool GuardedOde::stands_still(double t, long accepted_steps) {
  if (accepted_steps != accepted_steps_) {
    standing_ = asked_ == accepted_ ? standing_ + 1 : 0;
    accepted_ = asked_;
    accepted_steps_ = accepted_steps;
  }
  asked_ = t;
  return standing_ >= max_standing_steps;
}

// Whether no smaller step is to be had. It is else tried again and again that little before where
// the system has no values.
bool GuardedOde::within_rounding(double t) const {
  return std::abs(t - accepted_) <= 4.0 * std::numeric_limits<double>::epsilon() * std::abs(t);
}

int GuardedOde::jacobian(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                         Eigen::Ref<Eigen::MatrixXd> j) {
  return classify("jacobian", t, j, [&] { system_.jacobian(t, x, j); });
}

int GuardedOde::rate_by_parameters(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                                   Eigen::Ref<Eigen::MatrixXd> df_dp) {
  return classify("rate_by_parameters", t, df_dp, [&] { system_.rate_by_parameters(t, x, df_dp); });
}

int GuardedOde::event_values(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                             Eigen::Ref<Eigen::VectorXd> g) {
  return classify("event_values", t, g, [&] { system_.event_values(t, x, g); });
}

void GuardedOde::rethrow() {
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

}  // namespace boresight::plant
