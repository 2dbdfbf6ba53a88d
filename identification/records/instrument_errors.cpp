#include <algorithm>

#include <boresight/identification/records/instrument_errors.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::identification {

Eigen::Index channel_count(const Campaign& campaign) {
  std::size_t channels = 0;
  for (const auto& record : campaign.records) {
    channels = std::max(channels, record.inlet_pressure.size() + record.outlet_pressure.size());
  }
  return static_cast<Eigen::Index>(channels);
}

InstrumentErrors no_instrument_errors(Eigen::Index channels) {
  return {Eigen::VectorXd::Zero(channels), Eigen::VectorXd::Zero(channels), 0.0, 0.0};
}

InstrumentErrors draw_instrument_errors(const Campaign& campaign, std::uint64_t seed,
                                        std::uint64_t draw) {
  const Eigen::Index channels = channel_count(campaign);
  const auto& instruments = campaign.instruments;
  const auto& knowledge = campaign.knowledge;
  const auto relative = [](const numerics::Uncertain& number) {
    return number.value == 0.0 ? 0.0 : number.standard_uncertainty / number.value;
  };
  const numerics::NormalNumbers normal(seed, draw);
  InstrumentErrors errors = no_instrument_errors(channels);
  for (Eigen::Index channel = 0; channel < channels; ++channel) {
    const auto pair = normal.pair(static_cast<std::uint64_t>(channel) + 2);
    errors.pressure_gain(channel) = instruments.pressure_gain * pair.real();
    errors.pressure_zero(channel) = instruments.pressure_zero * pair.imag();
  }
  errors.tachometer_scale = instruments.tachometer_scale * normal.pair(0).real();
  const auto constants = normal.pair(1);
  errors.torque_scale = relative(knowledge.displacement) * constants.real() +
                        relative(knowledge.torque_efficiency) * constants.imag();
  return errors;
}

double torque_impulse(const Eigen::VectorXd& pressure_impulse, Eigen::Index inlets, double duration,
                      double torque_per_pressure, const InstrumentErrors& errors) {
  double sum = 0.0;
  for (Eigen::Index channel = 0; channel < pressure_impulse.size(); ++channel) {
    const double impulse = (1.0 - errors.pressure_gain(channel)) * pressure_impulse(channel) -
                           errors.pressure_zero(channel) * duration;
    sum += channel < inlets ? impulse : -impulse;
  }
  return torque_per_pressure * (1.0 + errors.torque_scale) * sum;
}

}  // namespace boresight::identification
