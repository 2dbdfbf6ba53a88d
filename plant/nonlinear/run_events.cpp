#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/plant/nonlinear/run_events.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double rest_before = 0.1;  // s of standstill before sliding counts as breaking away

template <typename Holds>
SampledEvent sampled(Index samples, double interval, const Holds& holds) {
  SampledEvent event;
  for (Index k = 0; k < samples; ++k) {
    if (!holds(k)) continue;
    if (!event.first) event.first = interval * static_cast<double>(k);
    ++event.samples;
  }
  event.fraction =
      samples > 0 ? static_cast<double>(event.samples) / static_cast<double>(samples) : 0.0;
  return event;
}

std::vector<SlidingStart> sliding_starts(const NonlinearAntenna& antenna,
                                         const SimulationResult& run, double interval) {
  const VectorXd rate = column(run, "motor_rate");
  const VectorXd angle = column(run, "motor_angle");
  const VectorXd friction = column(run, "friction_torque");
  const VectorXd torque = column(run, "motor_torque");
  const double standstill = 0.1 * antenna.friction.curve.stribeck_rate;
  const double stiffness = antenna.friction.bristle_stiffness;
  const double bend = stiffness > 0.0 ? antenna.friction.curve.breakaway_torque / stiffness : 0.0;
  std::vector<SlidingStart> starts;
  double rested = 0.0;  // s
  for (Index k = 0; k < rate.size(); ++k) {
    if (std::abs(rate[k]) < standstill) {
      rested += interval;
      continue;
    }
    const bool from_rest = rested >= rest_before && k > 0;
    rested = 0.0;
    if (!from_rest) continue;
    const double sign = rate[k] > 0.0 ? 1.0 : -1.0;
    Index turn = k;
    while (turn > 0 && sign * rate[turn - 1] > 0.0) --turn;
    // Not before the standstill is left: creeping is none.
    Index slides = k;
    while (slides < rate.size() && sign * rate[slides] > 0.0 &&
           sign * (angle[slides] - angle[turn]) < 4.0 * bend) {
      ++slides;
    }
    if (slides == rate.size() || sign * rate[slides] <= 0.0) continue;
    const double offset = offset_torque(antenna.offset, angle[slides]).value;
    starts.push_back({interval * static_cast<double>(slides), sign > 0.0, sign * rate[slides],
                      sign * (friction[slides] - offset), torque[slides],
                      sign * rate[slides] <= antenna.friction.curve.stribeck_rate});
  }
  return starts;
}

void add_pressures(RunEvents& events, const NonlinearAntenna& antenna, const SimulationResult& run,
                   double interval) {
  const std::size_t motors = antenna.oil.lines.size();
  if (motors == 0) return;
  VectorXd lowest = column(run, "inlet_pressure_1");
  VectorXd highest = lowest;
  for (std::size_t motor = 1; motor <= motors; ++motor) {
    for (const char* side : {"inlet", "outlet"}) {
      const VectorXd pressure = column(run, fmt::format("{}_pressure_{}", side, motor));
      lowest = lowest.cwiseMin(pressure);
      highest = highest.cwiseMax(pressure);
    }
  }
  events.lowest_pressure = lowest.minCoeff();
  events.highest_pressure = highest.maxCoeff();
  const double makeup = antenna.oil.makeup_torque / antenna.oil.torque_per_pressure;
  events.below_makeup =
      sampled(lowest.size(), interval, [&](Index k) { return lowest[k] < makeup; });
  events.below_zero = sampled(lowest.size(), interval, [&](Index k) { return lowest[k] < 0.0; });
}

}  // namespace

RunEvents events_of(const NonlinearAntenna& antenna, const SimulationResult& run,
                    const VectorXd& commands, double interval) {
  RunEvents events;
  events.integrator = run.statistics;
  events.sliding_starts = sliding_starts(antenna, run, interval);
  const auto& valve = antenna.valve;
  const VectorXd spool = column(run, "spool");
  const Index samples = spool.size();
  events.stroke_limit = sampled(samples, interval, [&](Index k) {
    return std::abs(spool[k] + valve.null_offset) >= valve.stroke_limit;
  });
  events.slew_limit = sampled(samples, interval, [&](Index k) {
    return k > 0 && std::abs(spool[k] - spool[k - 1]) >= 0.99 * valve.slew_limit * interval;
  });
  events.command_limit = sampled(samples, interval, [&](Index k) {
    return std::abs(commands[k]) >= valve.stroke_limit * (1.0 - 1e-12);
  });
  const auto& gear = antenna.gear;
  if (!std::isinf(gear.backlash)) {
    const VectorXd windup = column(run, "motor_angle") - column(run, "encoder");
    const double pressed = gear.preload_torque / (0.5 * gear.stiffness);
    const auto lost = [&](Index k) { return std::abs(windup[k]) > pressed; };
    events.contact_lost = sampled(samples, interval, lost);
    for (Index k = 0; k < samples; ++k) {
      if (lost(k) && (k == 0 || !lost(k - 1))) ++events.contact_losses;
    }
  }
  add_pressures(events, antenna, run, interval);
  return events;
}

std::optional<SlidingStart> first_start(const RunEvents& events, bool upward) {
  const auto found = std::ranges::find_if(events.sliding_starts, [&](const SlidingStart& start) {
    return start.upward == upward && start.shows_breakaway;
  });
  if (found == events.sliding_starts.end()) return std::nullopt;
  return *found;
}

}  // namespace boresight::plant
