#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/antenna_ode.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;

constexpr std::array<std::string_view, AntennaChannels::event_count> names{
    "motor reverses",
    "spool at its upper stroke limit",
    "spool at its lower stroke limit",
    "spool at the upper edge of the overlap",
    "spool at the lower edge of the overlap",
    "spool at its slew limit, opening upwards",
    "spool at its slew limit, opening downwards",
    "make-up valve of side 1 opens or closes",
    "make-up valve of side 2 opens or closes",
    "lower flank parts or meets",
    "upper flank parts or meets",
    "lower flank meets the opposite side of its backlash",
    "upper flank meets the opposite side of its backlash"};

constexpr double relative_difference = 1e-5;
// To one side, where the error scales with the difference itself.
constexpr double one_sided_difference = 1e-7;

// Breakaway and Coulomb torque bound each other.
enum class Bound { none, above, below };

Bound bound_of(const FrictionCurve& curve, AntennaParameter which) {
  const double room = curve.breakaway_torque - curve.coulomb_torque;
  if (which == AntennaParameter::coulomb_torque &&
      room < relative_difference * curve.coulomb_torque) {
    return Bound::above;
  }
  if (which == AntennaParameter::breakaway_torque &&
      room < relative_difference * curve.breakaway_torque) {
    return Bound::below;
  }
  return Bound::none;
}

}  // namespace

AntennaOde::AntennaOde(const NonlinearAntenna& antenna, std::vector<AntennaParameter> parameters)
    : ode_(to_feedback_system(antenna)),
      matrices_(feedback_matrices(to_feedback_system(antenna))),
      channels_(antenna.valve, antenna.oil, antenna.friction, antenna.offset, antenna.gear) {
  for (const auto which : parameters) {
    if (std::ranges::count(parameters, which) != 1) {
      throw InvalidInput(fmt::format("AntennaOde: parameter {} is given twice", to_string(which)));
    }
    const double value = parameter(antenna, which);
    const Bound bound = bound_of(antenna.friction.curve, which);
    const double step = (bound == Bound::none ? relative_difference : one_sided_difference) *
                        (value == 0.0 ? 1.0 : std::abs(value));
    const double above = bound == Bound::above ? 0.0 : step;
    const double below = bound == Bound::below ? 0.0 : step;
    if (value == 0.0 && which != AntennaParameter::offset_torque) {
      throw InvalidInput(fmt::format(
          "AntennaOde: no derivative by {}, which is 0 and cannot be less", to_string(which)));
    }
    varied_.push_back(
        {FeedbackOde(to_feedback_system(with_parameter(antenna, which, value + above))),
         FeedbackOde(to_feedback_system(with_parameter(antenna, which, value - below))),
         above + below});
  }
  more_ = less_ = Eigen::VectorXd::Zero(states());
  z_ = Eigen::VectorXd::Zero(channels_.inputs());
}

void AntennaOde::drive(const FeedbackOde::Input& input) {
  ode_.drive(input);
  for (auto& varied : varied_) {
    varied.more.drive(input);
    varied.less.drive(input);
  }
}

void AntennaOde::drive(double t0, const Eigen::VectorXd& u0, double t1, const Eigen::VectorXd& u1) {
  ode_.drive(t0, u0, t1, u1);
  for (auto& varied : varied_) {
    varied.more.drive(t0, u0, t1, u1);
    varied.less.drive(t0, u0, t1, u1);
  }
}

std::string_view AntennaOde::event_name(Index i) {
  return names.at(static_cast<std::size_t>(i));
}

Eigen::VectorXd AntennaOde::outputs(double t, const Eigen::Ref<const Eigen::VectorXd>& x) const {
  return ode_.outputs(t, x);
}

void AntennaOde::rate(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                      Eigen::Ref<Eigen::VectorXd> dx) const {
  ode_.rate(t, x, dx);
}

void AntennaOde::jacobian(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                          Eigen::Ref<Eigen::MatrixXd> j) const {
  ode_.jacobian(t, x, j);
}

void AntennaOde::event_values(double /*t*/, const Eigen::Ref<const Eigen::VectorXd>& x,
                              Eigen::Ref<Eigen::VectorXd> g) const {
  z_.noalias() = matrices_.channel_output * x;
  channels_.events(z_, g);
}

void AntennaOde::rate_by_parameters(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                                    Eigen::Ref<Eigen::MatrixXd> df_dp) const {
  for (std::size_t k = 0; k < varied_.size(); ++k) {
    varied_[k].more.rate(t, x, more_);
    varied_[k].less.rate(t, x, less_);
    df_dp.col(static_cast<Index>(k)) = (more_ - less_) / varied_[k].difference;
  }
}

}  // namespace boresight::plant
