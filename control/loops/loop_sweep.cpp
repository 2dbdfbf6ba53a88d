#include <boresight/control/loops/loop_evaluator_state.hpp>
#include <boresight/control/loops/panel_rule.hpp>
#include <boresight/numerics/vector_clones.hpp>

namespace boresight::control {

namespace {

using numerics::ComplexPack;
using numerics::RealPack;

// The four compensators at eight frequencies, by LoopPath.
using Compensators = std::array<ComplexPack, 4>;

template <bool with_gradients>
[[gnu::always_inline]] inline void multiply(BlockKind kind, const double* gains, const RealPack& w,
                                            const RealPack& period, ComplexPack& compensator,
                                            ComplexPack* by_gain) {
  const double g = *gains;
  if (kind == BlockKind::gain) {
    compensator = compensator * RealPack(g);
    if (with_gradients) by_gain[0] = {1.0, 0.0};
    return;
  }
  if (kind == BlockKind::notch) {
    const RealPack square = g * g - w * w;
    const ComplexPack above{square, 2.0 * gains[1] * g * w};
    const ComplexPack below{square, 2.0 * gains[2] * g * w};
    const ComplexPack below_inverse =
        numerics::conjugate(below) * RealPack(1.0 / numerics::square(below));
    compensator = compensator * (above * below_inverse);
    if (with_gradients) {
      const ComplexPack above_inverse =
          numerics::conjugate(above) * RealPack(1.0 / numerics::square(above));
      const RealPack twice = 2.0 * g * g;
      by_gain[0] = ComplexPack{twice, above.im} * above_inverse -
                   ComplexPack{twice, below.im} * below_inverse;
      by_gain[1] = ComplexPack{0.0, above.im} * above_inverse;
      by_gain[2] = ComplexPack{0.0, -below.im} * below_inverse;
    }
    return;
  }
  if (kind == BlockKind::integral || kind == BlockKind::lead) {
    compensator = compensator * (kind == BlockKind::integral ? ComplexPack{1.0, -g * period}
                                                             : ComplexPack{1.0, w * (1.0 / g)});
    if (!with_gradients) return;
  }
  // g/(s + g) and s/(s + g) at s = j w
  const RealPack scale = 1.0 / (g * g + w * w);
  const ComplexPack low{g * g * scale, -g * w * scale};
  const ComplexPack high{w * w * scale, g * w * scale};
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

// The cosine, times the magnitudes, of each value's angle to the next; the last has none.
[[gnu::always_inline]] inline RealPack onward(const ComplexPack& x) {
  const RealPack::Lanes re =
      __builtin_shufflevector(x.re.lanes, x.re.lanes, 1, 2, 3, 4, 5, 6, 7, 7);
  const RealPack::Lanes im =
      __builtin_shufflevector(x.im.lanes, x.im.lanes, 1, 2, 3, 4, 5, 6, 7, 7);
  RealPack product;
  product.lanes = x.re.lanes * re + x.im.lanes * im;
  return product;
}

[[gnu::always_inline]] inline RealPack smaller(const RealPack& x, const RealPack& y) {
  RealPack result;
  result.lanes = x.lanes < y.lanes ? x.lanes : y.lanes;
  return result;
}

// Derivatives by R, Q, P and C of a sum of weighted squares, each times its compensator: Re of the
// product with d ln X/d ln g is the derivative by ln g.
using Adjoint = std::array<ComplexPack, 4>;

}  // namespace

// The loop at eight frequencies. With D1 and D2 the returns 1 + L of the rate loop and of both
// loops, a = -b/D2 what a demand of one does to the beam, m what the law makes of the wind, and y
// its answer to each sensor's noise:
//   beam by wind  z = beam_wind + a m,   dz = a (dm - m dD2/D2)
//   likewise the demand by wind with a = -1/D2 and the motor torque with its own response for b
//   noise         y = n/D2,              dy = (dn - y dD2)/D2
struct LoopEvaluator::State::LoopPack {
  ComplexPack rate_part, pressure_part, bending_part, rp, position_part;
  ComplexPack rate_return, both_return, inverse, act;
  RealPack inverse_square;
  ComplexPack bent_wind, position_wind, pressure_wind, rate_wind, measured, wind;
  ComplexPack demand_by_wind, torque_by_wind;

  template <bool with_gradients>
  [[gnu::always_inline]] inline void fill(const Sweep& sweep, const GridPack& grid, bool gusts,
                                          Compensators& law, ComplexPack* by_gain) {
    for (std::size_t path = 0, b = 0; path < 4; ++path) {
      ComplexPack compensator{sweep.present[path] ? 1.0 : 0.0, 0.0};
      for (; b < sweep.path_end[path]; ++b) {
        const PlacedBlock& block = sweep.blocks[b];
        multiply<with_gradients>(block.kind, sweep.law->gains.data() + block.first_gain,
                                 grid.frequency, grid.period, compensator,
                                 with_gradients ? by_gain + block.first_gain : nullptr);
      }
      law[path] = compensator;
    }
    const auto [r, q, p, c] = law;
    const bool pressure = sweep.present[1], compliance = sweep.present[3];
    rate_part = r * grid.tachometer_command;
    rp = r * p;
    ComplexPack angle = grid.encoder_command, wind_angle = grid.encoder_wind;
    rate_return = ComplexPack{1.0, 0.0} + rate_part;
    pressure_part = pressure_wind = bending_part = bent_wind = {};
    if (pressure) {
      pressure_part = q * grid.torque_command;
      pressure_wind = q * grid.torque_wind;
      rate_return = rate_return + pressure_part;
    }
    if (compliance) {
      bending_part = c * grid.torque_command;
      bent_wind = c * grid.torque_wind;
      angle = angle - bending_part;
      wind_angle = wind_angle - bent_wind;
    }
    position_part = rp * angle;
    both_return = rate_return + position_part;
    inverse_square = 1.0 / numerics::square(both_return);
    inverse = numerics::conjugate(both_return) * inverse_square;
    act = -grid.beam_command * inverse;
    position_wind = rp * wind_angle;
    rate_wind = r * grid.tachometer_wind + position_wind;
    measured = rate_wind + pressure_wind;
    wind = grid.beam_wind + act * measured;
    if (gusts) {
      demand_by_wind = -measured * inverse;
      torque_by_wind = grid.torque_wind + grid.torque_command * demand_by_wind;
    }
  }
};

LoopEvaluator::State::Sweep LoopEvaluator::State::prepare(const ControlLaw& law) const {
  Sweep sweep;
  sweep.law = &law;
  const double per_band = 1.0 / noise_.bandwidth;
  sweep.encoder_density = noise_.encoder_rms * noise_.encoder_rms * per_band;
  sweep.tachometer_density = noise_.tachometer_rms * noise_.tachometer_rms * per_band;
  sweep.torque_density = noise_.torque_rms * noise_.torque_rms * per_band;
  sweep.noisy = sweep.encoder_density + sweep.tachometer_density + sweep.torque_density > 0.0;
  std::size_t count = 0;
  for (std::size_t path = 0; path < 4; ++path) {
    std::size_t next = 0;
    for (const LoopBlock& block : law.structure.blocks()) {
      if (static_cast<std::size_t>(block.path) == path) {
        sweep.blocks[count++] = {block.kind, next};
        for (std::size_t j = 0; j < block.gains.size(); ++j) sweep.path_of_gain[next + j] = path;
      }
      next += block.gains.size();
    }
    sweep.path_end[path] = count;
    sweep.present[path] = count > (path > 0 ? sweep.path_end[path - 1] : 0);
  }
  return sweep;
}

BORESIGHT_VECTOR_CLONES
void LoopEvaluator::State::sweep_values(const Sweep& sweep, const std::uint32_t* packs,
                                        std::size_t count) {
  const PanelRule& rule = panel_rule();
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = packs[n];
    const GridPack& grid = packs_[i];
    LoopPack loop;
    Compensators law;
    loop.fill<false>(sweep, grid, gusts_, law, nullptr);
    LoopValues& values = values_[i];
    values.rate_return = loop.rate_return;
    values.both_return = loop.both_return;
    values.turn = smaller(onward(loop.rate_return), onward(loop.both_return));
    values.sensitivity_square[1] = loop.inverse_square;
    if (breaks_[0] || breaks_[2]) {
      const RealPack rate_square = numerics::square(loop.rate_return);
      if (breaks_[0]) values.sensitivity_square[0] = 1.0 / rate_square;
      values.sensitivity_square[2] = rate_square * loop.inverse_square;
    }
    values.wind = grid.wind_weight * numerics::square(loop.wind);
    RealPack beam = values.wind, effort{};
    if (gusts_) {
      values.wind_demand = grid.wind_weight * numerics::square(loop.demand_by_wind);
      values.wind_torque = grid.wind_weight * numerics::square(loop.torque_by_wind);
    }
    if (sweep.noisy && grid.noisy) {
      const auto& [r, q, p, c] = law;
      const RealPack demand = (sweep.tachometer_density * numerics::square(r) +
                               sweep.encoder_density * numerics::square(loop.rp) +
                               sweep.torque_density * numerics::square(q - loop.rp * c)) *
                              loop.inverse_square;
      effort = grid.noise_weight * demand;
      values.noise = numerics::square(grid.beam_command) * effort;
      beam += values.noise;
    } else {
      values.noise = RealPack{};
    }
    values.effort = effort;
    if (!panels_.empty()) {
      RealPack tail{}, gust_tail{};
#pragma GCC unroll 8
      for (std::size_t lane = 0; lane < numerics::pack_size; ++lane) {
        tail += rule.first_tail[lane] * beam[lane];
      }
      if (sweep.noisy && grid.noisy) {
        for (std::size_t lane = 0; lane < numerics::pack_size; ++lane) {
          tail += rule.second_tail[lane] * effort[lane];
        }
      }
      values.tail = tail;
      if (gusts_) {
        for (std::size_t lane = 0; lane < numerics::pack_size; ++lane) {
          gust_tail += rule.first_tail[lane] * values.wind_demand[lane] +
                       rule.second_tail[lane] * values.wind_torque[lane];
        }
        values.gust_tail = gust_tail;
      }
    }
  }
}

struct LoopEvaluator::State::GradientSums {
  std::array<RealPack, most_gains> wind{}, noise{}, effort{}, wind_demand{}, wind_torque{};
};

BORESIGHT_VECTOR_CLONES
void LoopEvaluator::State::sweep_gradients(const Sweep& sweep, LoopEvaluation& result) const {
  const std::size_t gains = sweep.law->gains.size();
  const auto& path_of_gain = sweep.path_of_gain;
  GradientSums sums;
  std::array<ComplexPack, most_gains> by_gain;  // d ln X/d ln g of its own compensator X
  for (const std::uint32_t i : leaves_) {
    const GridPack& grid = packs_[i];
    if (!grid.weighted) continue;
    LoopPack loop;
    Compensators law;
    loop.fill<true>(sweep, grid, gusts_, law, by_gain.data());
    const auto& [r, q, p, c] = law;
    // Derivatives of D2 by each compensator, times the compensator.
    const Adjoint return_by{loop.rate_part + loop.position_part, loop.pressure_part,
                            loop.position_part, -loop.rp * loop.bending_part};
    const Adjoint measured_by{loop.rate_wind, loop.pressure_wind, loop.position_wind,
                              -loop.rp * loop.bent_wind};
    const ComplexPack turned = loop.measured * loop.inverse;
    Adjoint change;
    for (std::size_t path = 0; path < 4; ++path) {
      if (sweep.present[path]) change[path] = measured_by[path] - turned * return_by[path];
    }
    const auto add = [&](const ComplexPack& factor, std::array<RealPack, most_gains>& gradient) {
      Adjoint adjoint;
      for (std::size_t path = 0; path < 4; ++path) {
        if (sweep.present[path]) adjoint[path] = factor * change[path];
      }
      for (std::size_t g = 0; g < gains; ++g) {
        gradient[g] += numerics::real_product(adjoint[path_of_gain[g]], by_gain[g]);
      }
    };
    const RealPack twice = 2.0 * grid.wind_weight;
    add((numerics::conjugate(loop.wind) * loop.act) * twice, sums.wind);
    if (gusts_) {
      const ComplexPack by_demand = -loop.inverse * twice;
      add(numerics::conjugate(loop.demand_by_wind) * by_demand, sums.wind_demand);
      add(numerics::conjugate(loop.torque_by_wind) * grid.torque_command * by_demand,
          sums.wind_torque);
    }
    if (!sweep.noisy || !grid.noisy) continue;

    const ComplexPack torque = (q - loop.rp * c) * loop.inverse;
    const RealPack tachometer_square =
        sweep.tachometer_density * numerics::square(r) * loop.inverse_square;
    const RealPack encoder_square =
        sweep.encoder_density * numerics::square(loop.rp) * loop.inverse_square;
    const RealPack demand =
        tachometer_square + encoder_square + sweep.torque_density * numerics::square(torque);
    const RealPack to_beam = numerics::square(grid.beam_command) * grid.noise_weight;
    const ComplexPack torque_left =
        (numerics::conjugate(torque) * loop.inverse) * RealPack(2.0 * sweep.torque_density);
    const RealPack own_rate = 2.0 * (tachometer_square + encoder_square);
    const RealPack own_position = 2.0 * encoder_square;
    const ComplexPack by_return = loop.inverse * RealPack(2.0 * demand);
    const ComplexPack compensated = torque_left * (loop.rp * c);
    Adjoint adjoint{ComplexPack{own_rate, 0.0} - compensated, torque_left * q,
                    ComplexPack{own_position, 0.0} - compensated, -compensated};
    for (std::size_t path = 0; path < 4; ++path) {
      adjoint[path] = adjoint[path] - by_return * return_by[path];
    }
    for (std::size_t g = 0; g < gains; ++g) {
      const RealPack slope = numerics::real_product(adjoint[path_of_gain[g]], by_gain[g]);
      sums.noise[g] += to_beam * slope;
      sums.effort[g] += grid.noise_weight * slope;
    }
  }
  for (std::size_t g = 0; g < gains; ++g) {
    result.wind_log_gradient[g] = numerics::sum(sums.wind[g]);
    result.noise_log_gradient[g] = numerics::sum(sums.noise[g]);
    result.effort_log_gradient[g] = numerics::sum(sums.effort[g]);
    result.wind_demand_log_gradient[g] = numerics::sum(sums.wind_demand[g]);
    result.wind_torque_log_gradient[g] = numerics::sum(sums.wind_torque[g]);
  }
}

}  // namespace boresight::control
