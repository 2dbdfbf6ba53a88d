#include <boresight/control/loops/loop_evaluator_state.hpp>
#include <boresight/control/loops/panel_rule.hpp>
#include <boresight/numerics/vector_clones.hpp>

namespace boresight::control {

namespace {

using numerics::ComplexLanes;
using numerics::part;
using numerics::RealLanes;
using numerics::RealPack;
using numerics::set_part;

template <bool with_gradients, std::size_t width>
[[gnu::always_inline]] inline void multiply(BlockKind kind, const double* gains,
                                            const RealLanes<width>& w,
                                            const RealLanes<width>& period,
                                            ComplexLanes<width>& compensator,
                                            ComplexLanes<width>* by_gain) {
  using RealPart = RealLanes<width>;
  using ComplexPart = ComplexLanes<width>;
  const double g = *gains;
  if (kind == BlockKind::gain) {
    compensator = compensator * RealPart(g);
    if (with_gradients) by_gain[0] = {1.0, 0.0};
    return;
  }
  if (is_integral_condition(kind)) {
    if (with_gradients) by_gain[0] = {0.0, 0.0};
    return;
  }
  if (kind == BlockKind::notch) {
    const RealPart square = g * g - w * w;
    const ComplexPart above{square, 2.0 * gains[1] * g * w};
    const ComplexPart below{square, 2.0 * gains[2] * g * w};
    const ComplexPart below_inverse =
        numerics::conjugate(below) * RealPart(1.0 / numerics::square(below));
    compensator = compensator * (above * below_inverse);
    if (with_gradients) {
      const ComplexPart above_inverse =
          numerics::conjugate(above) * RealPart(1.0 / numerics::square(above));
      const RealPart twice = 2.0 * g * g;
      by_gain[0] = ComplexPart{twice, above.im} * above_inverse -
                   ComplexPart{twice, below.im} * below_inverse;
      by_gain[1] = ComplexPart{0.0, above.im} * above_inverse;
      by_gain[2] = ComplexPart{0.0, -below.im} * below_inverse;
    }
    return;
  }
  if (kind == BlockKind::integral || kind == BlockKind::lead) {
    compensator = compensator * (kind == BlockKind::integral ? ComplexPart{1.0, -g * period}
                                                             : ComplexPart{1.0, w * (1.0 / g)});
    if (!with_gradients) return;
  }
  // g/(s + g) and s/(s + g) at s = j w
  const RealPart scale = 1.0 / (g * g + w * w);
  const ComplexPart low{g * g * scale, -g * w * scale};
  const ComplexPart high{w * w * scale, g * w * scale};
  switch (kind) {
    case BlockKind::integral:
      by_gain[0] = low;
      break;
    case BlockKind::lag:
      compensator = compensator * low;
      if (with_gradients) by_gain[0] = high;
      break;
    case BlockKind::lead:
      by_gain[0] = {-high.re, -high.im};
      break;
    default:
      compensator = compensator * high;
      if (with_gradients) by_gain[0] = {-low.re, -low.im};
      break;
  }
}

}  // namespace

// The loop at as many frequencies as the registers are wide. With D1 and D2 the returns 1 + L of
// the rate loop and of both loops, a = -b/D2 what a demand of one does to the beam, m what the
// controller makes of the wind, and y its answer to each sensor's noise:
//   beam by wind  z = boresight_wind + a m,   dz = a (dm - m dD2/D2)
//   likewise the demand by wind with a = -1/D2 and the motor torque with its own response for b
//   noise         y = n/D2,              dy = (dn - y dD2)/D2
template <std::size_t width>
struct LoopEvaluator::State::LoopLanes {
  using RealPart = RealLanes<width>;
  using ComplexPart = ComplexLanes<width>;
  // The four compensators, by LoopPath.
  using Compensators = std::array<ComplexPart, 4>;
  // Derivatives by R, Q, P and C of a sum of weighted squares, each times its compensator: Re of
  // the product with d ln X/d ln g is the derivative by ln g.
  using Adjoint = std::array<ComplexPart, 4>;

  ComplexPart rate_part, pressure_part, bending_part, rp, position_part;
  ComplexPart rate_return, both_return, inverse, act;
  RealPart inverse_square;
  ComplexPart bent_wind, position_wind, pressure_wind, rate_wind, measured, wind;
  ComplexPart demand_by_wind, torque_by_wind;

  // Of the k-th part of eight frequencies, one by one.
  [[gnu::always_inline]] static inline void fill_from_state_space(const Controller& controller,
                                                                  const GridPack& grid,
                                                                  std::size_t k,
                                                                  Compensators& compensators) {
    for (std::size_t lane = 0; lane < width; ++lane) {
      const auto response = compensator_response(controller, grid.frequency[k * width + lane]);
      const std::array values{response.rate, response.pressure, response.position};
      for (std::size_t path = 0; path < values.size(); ++path) {
        compensators[path].re.set(lane, values[path].real());
        compensators[path].im.set(lane, values[path].imag());
      }
    }
  }

  // At the k-th part of eight frequencies.
  template <bool with_gradients>
  [[gnu::always_inline]] inline void fill(const Sweep& sweep, const GridPack& grid, std::size_t k,
                                          bool gusts, Compensators& controller,
                                          ComplexPart* by_gain) {
    for (std::size_t path = 0, b = 0; path < 4; ++path) {
      ComplexPart compensator{sweep.present[path] ? 1.0 : 0.0, 0.0};
      for (; b < sweep.path_end[path]; ++b) {
        const PlacedBlock& block = sweep.blocks[b];
        multiply<with_gradients>(block.kind, sweep.controller->gains.data() + block.first_gain,
                                 part<width>(grid.frequency, k), part<width>(grid.period, k),
                                 compensator,
                                 with_gradients ? by_gain + block.first_gain : nullptr);
      }
      controller[path] = compensator;
    }
    if (sweep.state_space) fill_from_state_space(*sweep.controller, grid, k, controller);
    const auto [r, q, p, c] = controller;
    const bool pressure = sweep.present[1], compliance = sweep.present[3];
    rate_part = r * part<width>(grid.tachometer_command, k);
    rp = r * p;
    ComplexPart angle = part<width>(grid.encoder_command, k);
    ComplexPart wind_angle = part<width>(grid.encoder_wind, k);
    rate_return = ComplexPart{1.0, 0.0} + rate_part;
    pressure_part = pressure_wind = bending_part = bent_wind = {};
    if (pressure) {
      pressure_part = q * part<width>(grid.torque_command, k);
      pressure_wind = q * part<width>(grid.torque_wind, k);
      rate_return = rate_return + pressure_part;
    }
    if (compliance) {
      bending_part = c * part<width>(grid.torque_command, k);
      bent_wind = c * part<width>(grid.torque_wind, k);
      angle = angle - bending_part;
      wind_angle = wind_angle - bent_wind;
    }
    position_part = rp * angle;
    both_return = rate_return + position_part;
    inverse_square = 1.0 / numerics::square(both_return);
    inverse = numerics::conjugate(both_return) * inverse_square;
    act = -part<width>(grid.boresight_command, k) * inverse;
    position_wind = rp * wind_angle;
    rate_wind = r * part<width>(grid.tachometer_wind, k) + position_wind;
    measured = rate_wind + pressure_wind;
    wind = part<width>(grid.boresight_wind, k) + act * measured;
    if (gusts) {
      demand_by_wind = -measured * inverse;
      torque_by_wind =
          part<width>(grid.torque_wind, k) + part<width>(grid.torque_command, k) * demand_by_wind;
    }
  }
};

LoopEvaluator::State::Sweep LoopEvaluator::State::prepare(const Controller& controller) const {
  Sweep sweep;
  sweep.controller = &controller;
  const double per_band = 1.0 / noise_.bandwidth;
  sweep.encoder_density = noise_.encoder_rms * noise_.encoder_rms * per_band;
  sweep.tachometer_density = noise_.tachometer_rms * noise_.tachometer_rms * per_band;
  sweep.torque_density = noise_.torque_rms * noise_.torque_rms * per_band;
  sweep.noisy = sweep.encoder_density + sweep.tachometer_density + sweep.torque_density > 0.0;
  std::size_t count = 0;
  for (std::size_t path = 0; path < 4; ++path) {
    std::size_t next = 0;
    for (const LoopBlock& block : controller.structure.blocks()) {
      if (static_cast<std::size_t>(block.path) == path) {
        sweep.blocks[count++] = {block.kind, next};
        for (std::size_t j = 0; j < block.gains.size(); ++j) sweep.path_of_gain[next + j] = path;
      }
      next += block.gains.size();
    }
    sweep.path_end[path] = count;
    sweep.present[path] = count > (path > 0 ? sweep.path_end[path - 1] : 0);
  }
  sweep.state_space = controller.structure.state_space() != nullptr;
  if (sweep.state_space) {
    sweep.present = {true, controller.structure.feeds_torque_back(), true, false};
  }
  return sweep;
}

struct LoopEvaluator::State::ValueSweep {
  template <std::size_t width>
  [[gnu::always_inline]] static inline void run(State& state, const Sweep& sweep,
                                                const std::uint32_t* packs, std::size_t count) {
    constexpr std::size_t parts = numerics::pack_size / width;
    const PanelRule& rule = panel_rule();
    for (std::size_t n = 0; n < count; ++n) {
      const GridPack& grid = state.packs_[packs[n]];
      LoopValues& values = state.values_[packs[n]];
      const bool noisy = sweep.noisy && grid.noisy;
      RealPack boresight;
      for (std::size_t k = 0; k < parts; ++k)
        set_values<width>(state, sweep, grid, k, values, boresight);
      set_turn<width>(values.turn, values.rate_return, values.both_return);
      if (state.panels_.empty()) continue;
      set_tail<width>(values.boresight_tail, rule.tail, boresight);
      if (noisy) {
        set_tail<width>(values.effort_tail, rule.tail, values.effort);
      } else {
        values.effort_tail = {};
      }
      if (state.gusts_) {
        set_tail<width>(values.demand_tail, rule.tail, values.wind_demand);
        set_tail<width>(values.torque_tail, rule.tail, values.wind_torque);
      }
    }
  }

  template <std::size_t width>
  [[gnu::always_inline]] static inline void set_values(const State& state, const Sweep& sweep,
                                                       const GridPack& grid, std::size_t k,
                                                       LoopValues& values, RealPack& boresight) {
    using RealPart = RealLanes<width>;
    LoopLanes<width> loop;
    typename LoopLanes<width>::Compensators controller;
    loop.template fill<false>(sweep, grid, k, state.gusts_, controller, nullptr);
    set_part(values.rate_return, k, loop.rate_return);
    set_part(values.both_return, k, loop.both_return);
    set_part(values.sensitivity_square[1], k, loop.inverse_square);
    if (state.breaks_[0] || state.breaks_[2]) {
      const RealPart rate_square = numerics::square(loop.rate_return);
      if (state.breaks_[0]) set_part(values.sensitivity_square[0], k, 1.0 / rate_square);
      set_part(values.sensitivity_square[2], k, rate_square * loop.inverse_square);
    }
    const RealPart wind_weight = part<width>(grid.wind_weight, k);
    const RealPart wind = wind_weight * numerics::square(loop.wind);
    set_part(values.wind, k, wind);
    if (state.gusts_) {
      set_part(values.wind_demand, k, wind_weight * numerics::square(loop.demand_by_wind));
      set_part(values.wind_torque, k, wind_weight * numerics::square(loop.torque_by_wind));
    }
    RealPart noise{}, effort{};
    if (sweep.noisy && grid.noisy) {
      const auto& [r, q, p, c] = controller;
      const RealPart demand = (sweep.tachometer_density * numerics::square(r) +
                               sweep.encoder_density * numerics::square(loop.rp) +
                               sweep.torque_density * numerics::square(q - loop.rp * c)) *
                              loop.inverse_square;
      effort = part<width>(grid.noise_weight, k) * demand;
      noise = numerics::square(part<width>(grid.boresight_command, k)) * effort;
      if (sweep.state_space) {
        RealPart samples{};
        for (std::size_t lane = 0; lane < width; ++lane) {
          samples.set(lane, sample_density(*sweep.controller, grid.frequency[k * width + lane]));
        }
        effort = effort * samples;
      }
    }
    set_part(values.noise, k, noise);
    set_part(values.effort, k, effort);
    set_part(boresight, k, wind + noise);
  }
};

void LoopEvaluator::State::sweep_values(const Sweep& sweep, const std::uint32_t* packs,
                                        std::size_t count) {
  numerics::run_on_widest_lanes<ValueSweep>(*this, sweep, packs, count);
}

struct LoopEvaluator::State::GradientSums {
  std::array<RealPack, max_gains> wind{}, noise{}, effort{}, wind_demand{}, wind_torque{};
};

struct LoopEvaluator::State::GradientSweep {
  template <std::size_t width>
  [[gnu::always_inline]] static inline void run(const State& state, const Sweep& sweep,
                                                GradientSums& sums) {
    std::array<ComplexLanes<width>, max_gains> by_gain;  // d ln X/d ln g of its own compensator X
    for (const std::uint32_t i : state.leaves_) {
      const GridPack& grid = state.packs_[i];
      if (!grid.weighted) continue;
      for (std::size_t k = 0; k < numerics::pack_size / width; ++k) {
        add<width>(state, sweep, grid, k, by_gain, sums);
      }
    }
  }

  template <std::size_t width>
  [[gnu::always_inline]] static inline void add_to(RealPack& sum, std::size_t k,
                                                   const RealLanes<width>& x) {
    set_part(sum, k, part<width>(sum, k) + x);
  }

  template <std::size_t width>
  [[gnu::always_inline]] static inline void add(const State& state, const Sweep& sweep,
                                                const GridPack& grid, std::size_t k,
                                                std::array<ComplexLanes<width>, max_gains>& by_gain,
                                                GradientSums& sums) {
    using Loop = LoopLanes<width>;
    using RealPart = RealLanes<width>;
    using ComplexPart = ComplexLanes<width>;
    const std::size_t gains = sweep.controller->gains.size();
    const auto& path_of_gain = sweep.path_of_gain;
    Loop loop;
    typename Loop::Compensators controller;
    loop.template fill<true>(sweep, grid, k, state.gusts_, controller, by_gain.data());
    const auto& [r, q, p, c] = controller;
    // Derivatives of D2 by each compensator, times the compensator.
    const typename Loop::Adjoint return_by{loop.rate_part + loop.position_part, loop.pressure_part,
                                           loop.position_part, -loop.rp * loop.bending_part};
    const typename Loop::Adjoint measured_by{loop.rate_wind, loop.pressure_wind, loop.position_wind,
                                             -loop.rp * loop.bent_wind};
    const ComplexPart turned = loop.measured * loop.inverse;
    typename Loop::Adjoint change;
    for (std::size_t path = 0; path < 4; ++path) {
      if (sweep.present[path]) change[path] = measured_by[path] - turned * return_by[path];
    }
    const auto add_square = [&](const ComplexPart& factor,
                                std::array<RealPack, max_gains>& gradient) {
      typename Loop::Adjoint adjoint;
      for (std::size_t path = 0; path < 4; ++path) {
        if (sweep.present[path]) adjoint[path] = factor * change[path];
      }
      for (std::size_t g = 0; g < gains; ++g) {
        add_to(gradient[g], k, numerics::real_product(adjoint[path_of_gain[g]], by_gain[g]));
      }
    };
    const RealPart twice = 2.0 * part<width>(grid.wind_weight, k);
    add_square((numerics::conjugate(loop.wind) * loop.act) * twice, sums.wind);
    if (state.gusts_) {
      const ComplexPart by_demand = -loop.inverse * twice;
      add_square(numerics::conjugate(loop.demand_by_wind) * by_demand, sums.wind_demand);
      add_square(numerics::conjugate(loop.torque_by_wind) * part<width>(grid.torque_command, k) *
                     by_demand,
                 sums.wind_torque);
    }
    if (!sweep.noisy || !grid.noisy) return;

    const ComplexPart torque = (q - loop.rp * c) * loop.inverse;
    const RealPart tachometer_square =
        sweep.tachometer_density * numerics::square(r) * loop.inverse_square;
    const RealPart encoder_square =
        sweep.encoder_density * numerics::square(loop.rp) * loop.inverse_square;
    const RealPart demand =
        tachometer_square + encoder_square + sweep.torque_density * numerics::square(torque);
    const RealPart noise_weight = part<width>(grid.noise_weight, k);
    const RealPart to_boresight =
        numerics::square(part<width>(grid.boresight_command, k)) * noise_weight;
    const ComplexPart torque_left =
        (numerics::conjugate(torque) * loop.inverse) * RealPart(2.0 * sweep.torque_density);
    const RealPart own_rate = 2.0 * (tachometer_square + encoder_square);
    const RealPart own_position = 2.0 * encoder_square;
    const ComplexPart by_return = loop.inverse * RealPart(2.0 * demand);
    const ComplexPart compensated = torque_left * (loop.rp * c);
    typename Loop::Adjoint adjoint{ComplexPart{own_rate, 0.0} - compensated, torque_left * q,
                                   ComplexPart{own_position, 0.0} - compensated, -compensated};
    for (std::size_t path = 0; path < 4; ++path) {
      adjoint[path] = adjoint[path] - by_return * return_by[path];
    }
    for (std::size_t g = 0; g < gains; ++g) {
      const RealPart slope = numerics::real_product(adjoint[path_of_gain[g]], by_gain[g]);
      add_to(sums.noise[g], k, to_boresight * slope);
      add_to(sums.effort[g], k, noise_weight * slope);
    }
  }
};

void LoopEvaluator::State::sweep_gradients(const Sweep& sweep, LoopEvaluation& result) const {
  GradientSums sums;
  numerics::run_on_widest_lanes<GradientSweep>(*this, sweep, sums);
  for (std::size_t g = 0; g < sweep.controller->gains.size(); ++g) {
    result.wind_log_gradient[g] = numerics::sum(sums.wind[g]);
    result.noise_log_gradient[g] = numerics::sum(sums.noise[g]);
    result.effort_log_gradient[g] = numerics::sum(sums.effort[g]);
    result.wind_demand_log_gradient[g] = numerics::sum(sums.wind_demand[g]);
    result.wind_torque_log_gradient[g] = numerics::sum(sums.wind_torque[g]);
  }
}

}  // namespace boresight::control
