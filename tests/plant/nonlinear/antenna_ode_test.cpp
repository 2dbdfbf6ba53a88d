#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_nonlinear_antenna.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/fast_integrator.hpp>
#include <boresight/plant/integration/ode_integrator.hpp>
#include <boresight/plant/nonlinear/antenna_ode.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

OdeOptions tight(double tolerance = 1e-9) {
  OdeOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = VectorXd::Constant(1, 1e-2 * tolerance);
  return options;
}

// To t through all events on the way.
void integrate(OdeIntegrator& integrator, double t) {
  while (integrator.advance(t, Approach::stop_exactly).event) integrator.restart();
}

// Swinging on the oil and in the structure, lines ringing, valve closed.
VectorXd disturbed(const NonlinearAntenna& antenna) {
  VectorXd state = state_at_rest(antenna);
  state[AntennaStates::motor_rate] = 1.3;
  state[AntennaStates::side_1] += 6.0;
  state[AntennaStates::structure + 1] = -0.8;
  state[AntennaStates::structure + 2] = 0.05;
  state[state.size() - 4] = 2.0;
  return state;
}

TEST(AntennaOde, KeepsEnergyWhereNothingDissipates) {
  auto details = reference::drive_details();
  details.preload_torque = 20.0;
  details.backlash = 0.02;
  for (const bool backlash : {false, true}) {
    if (!backlash) details.backlash = std::numeric_limits<double>::infinity();
    const auto antenna = reference::lossless_antenna(details);
    const AntennaOde ode(antenna);
    const VectorXd start = disturbed(antenna);
    OdeIntegrator integrator(ode, 0.0, start, tight(1e-10));
    const double energy = stored_energy(antenna, start) -
                          (backlash ? stored_energy(antenna, state_at_rest(antenna)) : 0.0);
    for (double t = 0.25; t <= 1.5; t += 0.25) {
      integrate(integrator, t);
      const double now = stored_energy(antenna, integrator.state()) -
                         (backlash ? stored_energy(antenna, state_at_rest(antenna)) : 0.0);
      EXPECT_NEAR(now, energy, 2e-7 * energy) << t;
    }
  }
}

TEST(AntennaOde, NeverGainsEnergyWhereItDissipates) {
  auto details = reference::drive_details();
  details.null_leakage_share = 0.0;  // no supply joins in
  const auto antenna = reference::nonlinear_antenna(details);
  const AntennaOde ode(antenna);
  OdeIntegrator integrator(ode, 0.0, disturbed(antenna), tight());
  double energy = stored_energy(antenna, integrator.state());
  for (double t = 0.01; t < 2.0; t += 0.01) {
    integrate(integrator, t);
    const double now = stored_energy(antenna, integrator.state());
    EXPECT_LT(now, energy * (1.0 + 1e-8)) << t;
    energy = now;
  }
  EXPECT_LT(energy, 0.5 * stored_energy(antenna, disturbed(antenna)));
}

TEST(AntennaOde, ConservesOilBehindAClosedValve) {
  auto details = reference::drive_details();
  details.null_leakage_share = 0.0;
  const auto antenna = reference::nonlinear_antenna(details);
  const auto oil = [&](const VectorXd& state) {
    return state[AntennaStates::side_1] / antenna.oil.stiffness_1 +
           state[AntennaStates::side_2] / antenna.oil.stiffness_2;
  };
  const AntennaOde ode(antenna);
  OdeIntegrator integrator(ode, 0.0, disturbed(antenna), tight());
  integrate(integrator, 3.0);
  EXPECT_NEAR(oil(integrator.state()), oil(disturbed(antenna)), 1e-7);
  EXPECT_GT(std::abs(integrator.state()[AntennaStates::motor_angle]), 1e-2);
}

TEST(AntennaOde, JacobianIsThatOfTheRate) {
  auto details = reference::drive_details();
  details.backlash = 0.1;
  details.preload_torque = 10.0;
  details.air_fraction = 0.005;
  const auto antenna = reference::nonlinear_antenna(details);
  AntennaOde ode(antenna);
  VectorXd state = disturbed(antenna);
  state[AntennaStates::spool] = 3.0;
  state[AntennaStates::bristle] = 1e-3;
  const Index n = state.size();
  MatrixXd jacobian = MatrixXd::Zero(n, n);
  ode.jacobian(0.0, state, jacobian);
  for (Index i = 0; i < n; ++i) {
    const double h = 1e-6 * std::max(1.0, std::abs(state[i]));
    VectorXd up = state;
    VectorXd down = state;
    up[i] += h;
    down[i] -= h;
    VectorXd rate_up(n);
    VectorXd rate_down(n);
    ode.rate(0.0, up, rate_up);
    ode.rate(0.0, down, rate_down);
    const VectorXd difference = (rate_up - rate_down) / (2.0 * h);
    EXPECT_LT((difference - jacobian.col(i)).norm(), 1e-5 * (1.0 + jacobian.col(i).norm())) << i;
  }
}

// Valve opened by a smooth pulse: the antenna breaks away, moves and comes to rest.
FeedbackOde::Input pulse() {
  return [](double t, Eigen::Ref<VectorXd> u) {
    u.setZero();
    u[0] = 8.0 * std::exp(-std::pow((t - 0.6) / 0.25, 2));
  };
}

TEST(AntennaOde, SensitivitiesAreDifferencesOfSolutions) {
  const std::vector<AntennaParameter> parameters{
      AntennaParameter::motor_inertia,     AntennaParameter::antenna_inertia,
      AntennaParameter::bulk_modulus,      AntennaParameter::leakage,
      AntennaParameter::coulomb_torque,    AntennaParameter::saturating_torque,
      AntennaParameter::viscous_friction,  AntennaParameter::offset_torque,
      AntennaParameter::bristle_stiffness, AntennaParameter::supply_torque};
  auto details = reference::drive_details();
  details.modes_per_line = 0;
  const auto antenna = reference::nonlinear_antenna(details);
  // Solutions apart from the mean pressure, which moves with the supply.
  const VectorXd start = state_at_rest(antenna);
  AntennaOde ode(antenna, parameters);
  ode.drive(pulse());
  auto options = tight(1e-10);
  options.sensitivities = true;
  options.parameter_scale.resize(static_cast<Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const double value = parameter(antenna, parameters[k]);
    options.parameter_scale[static_cast<Index>(k)] = value == 0.0 ? 1.0 : value;
  }
  OdeIntegrator integrator(ode, 0.0, start, options);
  const double end = 1.2;
  integrate(integrator, end);
  const auto solution = [&](AntennaParameter which, double value) {
    AntennaOde varied(with_parameter(antenna, which, value));
    varied.drive(pulse());
    OdeIntegrator run(varied, 0.0, start, tight(1e-12));
    integrate(run, end);
    return run.state();
  };
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const double value = parameter(antenna, parameters[k]);
    const double h = 1e-4 * (value == 0.0 ? 1.0 : value);
    // Richardson's extrapolation of two central differences.
    const auto difference = [&](double step) -> VectorXd {
      return (solution(parameters[k], value + step) - solution(parameters[k], value - step)) /
             (2.0 * step);
    };
    const VectorXd expected = (4.0 * difference(h) - difference(2.0 * h)) / 3.0;
    const VectorXd found = integrator.sensitivities().col(static_cast<Index>(k));
    EXPECT_LT((found - expected).norm(), 1e-5 * expected.norm()) << to_string(parameters[k]);
  }
}

TEST(AntennaOde, DifferentiatesByCoulombAndBreakawayTorqueWhereTheyAreEqual) {
  auto antenna = reference::nonlinear_antenna();
  antenna.friction.curve.breakaway_torque = antenna.friction.curve.coulomb_torque;
  const AntennaOde ode(antenna,
                       {AntennaParameter::coulomb_torque, AntennaParameter::breakaway_torque});
  VectorXd state = disturbed(antenna);
  state[AntennaStates::bristle] = 1e-3;
  // At 0.05 rad/s both matter: of the curve's level and of its bump.
  state[AntennaStates::motor_rate] = 0.05;
  MatrixXd by(ode.states(), 2);
  ode.rate_by_parameters(0.0, state, by);
  EXPECT_GT(by.col(0).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_GT(by.col(1).cwiseAbs().maxCoeff(), 1e-4);
  // Both at once may go either way.
  const double step = 1e-5 * antenna.friction.curve.coulomb_torque;
  const auto rate = [&](double change) {
    auto other = antenna;
    other.friction.curve.coulomb_torque += change;
    other.friction.curve.breakaway_torque += change;
    VectorXd dx(ode.states());
    AntennaOde(other).rate(0.0, state, dx);
    return dx;
  };
  const VectorXd both = (rate(step) - rate(-step)) / (2.0 * step);
  EXPECT_LT((by.rowwise().sum() - both).norm(), 1e-5 * both.norm());
}

TEST(AntennaOde, FastIntegratorGoesTheSameWay) {
  auto details = reference::drive_details();
  details.slew_limit = 300.0;
  details.overlap = 0.05;
  const auto antenna = reference::nonlinear_antenna(details);
  const auto system = to_feedback_system(antenna);
  AntennaOde ode(antenna);
  OdeIntegrator reference(ode, 0.0, state_at_rest(antenna), tight(1e-10));
  FastIntegrator fast(system, {.interval = 0.01});
  fast.start_from(state_at_rest(antenna));
  // Steps of the valve command, held; a wind that grows.
  VectorXd from = VectorXd::Zero(2);
  VectorXd to = from;
  double worst = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double t = 0.01 * k;
    from << (k < 30 ? 0.0 : k < 150 ? 6.0 : k < 260 ? -9.0 : 0.4), 2.0 * t;
    to = from;
    to[1] = 2.0 * (t + 0.01);
    ode.drive(t, from, t + 0.01, to);
    reference.restart();
    integrate(reference, t + 0.01);
    fast.advance(from, to);
    worst = std::max(worst, (fast.state() - reference.state())
                                .segment(AntennaStates::motor_rate, 1)
                                .cwiseAbs()
                                .maxCoeff());
  }
  EXPECT_LT(worst, 1e-5);
}

TEST(AntennaOde, EventsAreNamedWhereTheyHappen) {
  const auto antenna = reference::nonlinear_antenna();
  AntennaOde ode(antenna);
  ode.drive([](double t, Eigen::Ref<VectorXd> u) { u << 10.0 * std::sin(3.0 * t), 0.0; });
  OdeIntegrator integrator(ode, 0.0, state_at_rest(antenna), tight(1e-8));
  int reversals = 0;
  for (;;) {
    const auto stop = integrator.advance(4.0, Approach::stop_exactly);
    if (!stop.event) break;
    if (stop.directions[0] != 0) {
      ++reversals;
      EXPECT_NEAR(integrator.state()[AntennaStates::motor_rate], 0.0, 1e-6);
    }
    integrator.restart();
  }
  EXPECT_GE(reversals, 3);
  EXPECT_EQ(AntennaOde::event_name(0), "motor reverses");
}

TEST(AntennaParameters, AreReadAsTheyAreSet) {
  const auto antenna = reference::nonlinear_antenna();
  for (const auto which : antenna_parameters()) {
    const double value = which == AntennaParameter::breakaway_torque
                             ? 20.0
                             : 1.1 * parameter(antenna, which) +
                                   (which == AntennaParameter::offset_torque ? 3.0 : 0.0);
    const auto changed = with_parameter(antenna, which, value);
    const bool relative =
        which == AntennaParameter::bulk_modulus || which == AntennaParameter::leakage;
    EXPECT_NEAR(parameter(changed, which), relative ? 1.0 : value, 1e-12 * std::abs(value))
        << to_string(which);
    EXPECT_THROW(with_parameter(antenna, which, std::nan("")), InvalidInput);
  }
  EXPECT_THROW(with_parameter(antenna, AntennaParameter::motor_inertia, 0.0), InvalidInput);
  EXPECT_THROW(AntennaOde(antenna, {AntennaParameter::leakage, AntennaParameter::leakage}),
               InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
