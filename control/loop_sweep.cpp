#include <boresight/control/loop_evaluator.hpp>
#include <boresight/plant/vector_clones.hpp>

namespace boresight::control {
namespace {

using plant::ComplexPack;
using plant::RealPack;

// The four compensators at eight frequencies, and the logarithmic derivative by each gain.
struct CompensatorPack {
  std::array<ComplexPack, 4> path;  // by LoopPath
  std::array<ComplexPack, most_gains> by_gain;
};

[[gnu::always_inline]] inline void multiply(const LoopBlock& block, const double* gains,
                                            const RealPack& w, ComplexPack& compensator,
                                            ComplexPack* by_gain) {
  const double g = *gains;
  if (block.kind == BlockKind::gain) {
    compensator = compensator * RealPack(g);
    by_gain[0] = {1.0, 0.0};
    return;
  }
  if (block.kind == BlockKind::notch) {
    const RealPack square = g * g - w * w;
    const ComplexPack above{square, 2.0 * gains[1] * g * w};
    const ComplexPack below{square, 2.0 * gains[2] * g * w};
    const RealPack above_square = plant::square(above), below_square = plant::square(below);
    const ComplexPack above_inverse = (plant::conjugate(above)) * RealPack(1.0 / above_square);
    const ComplexPack below_inverse = (plant::conjugate(below)) * RealPack(1.0 / below_square);
    compensator = compensator * (above * below_inverse);
    const RealPack twice = 2.0 * g * g;
    by_gain[0] =
        ComplexPack{twice, above.im} * above_inverse - ComplexPack{twice, below.im} * below_inverse;
    by_gain[1] = ComplexPack{0.0, above.im} * above_inverse;
    by_gain[2] = ComplexPack{0.0, -below.im} * below_inverse;
    return;
  }
  // g/(s + g) and s/(s + g) at s = j w
  const RealPack scale = 1.0 / (g * g + w * w);
  const ComplexPack low{g * g * scale, -g * w * scale};
  const ComplexPack high{w * w * scale, g * w * scale};
  switch (block.kind) {
    case BlockKind::integral:
      compensator = compensator * ComplexPack{1.0, -g / w};
      by_gain[0] = low;
      break;
    case BlockKind::lag:
      compensator = compensator * low;
      by_gain[0] = high;
      break;
    case BlockKind::lead:
      compensator = compensator * ComplexPack{1.0, w / g};
      by_gain[0] = {-high.re, -high.im};
      break;
    default:
      compensator = compensator * high;
      by_gain[0] = {-low.re, -low.im};
      break;
  }
}

// Derivatives by R, Q, P and C of a sum of weighted squares, each times its compensator: Re of the
// product with d ln X/d ln g is the derivative by ln g.
using Adjoint = std::array<ComplexPack, 4>;

}  // namespace

struct LoopEvaluator::Sums {
  RealPack wind{}, noise{}, effort{}, wind_demand{}, wind_torque{};
  std::array<RealPack, most_gains> wind_gradient{}, noise_gradient{}, effort_gradient{};
  std::array<RealPack, most_gains> wind_demand_gradient{}, wind_torque_gradient{};
};

// With D1 and D2 the returns 1 + L of the rate loop and of both loops, a = -b/D2 what a demand of
// one does to the beam, m what the law makes of the wind, and y its answer to each sensor's noise:
//   beam by wind  z = beam_wind + a m,   dz = a (dm - m dD2/D2)
//   likewise the demand by wind with a = -1/D2 and the motor torque with its own response for b
//   noise         y = n/D2,              dy = (dn - y dD2)/D2
BORESIGHT_VECTOR_CLONES
void LoopEvaluator::sweep(const ControlLaw& law, bool with_gradients, LoopEvaluation& result) {
  const double per_band = 1.0 / noise_.bandwidth;
  const double encoder_density = noise_.encoder_rms * noise_.encoder_rms * per_band;
  const double tachometer_density = noise_.tachometer_rms * noise_.tachometer_rms * per_band;
  const double torque_density = noise_.torque_rms * noise_.torque_rms * per_band;
  const bool noisy = encoder_density + tachometer_density + torque_density > 0.0;
  const auto& blocks = law.structure.blocks();
  const std::size_t gains = law.gains.size();
  std::array<std::size_t, most_gains> path_of_gain{};
  std::size_t next = 0;
  std::array<bool, 4> present{};
  for (const LoopBlock& block : blocks) {
    present[static_cast<std::size_t>(block.path)] = true;
    for (std::size_t j = 0; j < block.gains.size(); ++j) {
      path_of_gain[next++] = static_cast<std::size_t>(block.path);
    }
  }

  Sums sums;
  const ComplexPack one{1.0, 0.0};
  for (std::size_t i = 0; i < packs_.size(); ++i) {
    const GridPack& grid = packs_[i];
    CompensatorPack law_here;
    for (std::size_t path = 0; path < 4; ++path) {
      law_here.path[path] = present[path] ? one : ComplexPack{};
    }
    std::size_t k = 0;
    for (const LoopBlock& block : blocks) {
      multiply(block, law.gains.data() + k, grid.frequency,
               law_here.path[static_cast<std::size_t>(block.path)], law_here.by_gain.data() + k);
      k += block.gains.size();
    }
    const ComplexPack& r = law_here.path[0];
    const ComplexPack& q = law_here.path[1];
    const ComplexPack& p = law_here.path[2];
    const ComplexPack& c = law_here.path[3];

    const ComplexPack rate_part = r * grid.tachometer_command;
    const ComplexPack pressure_part = q * grid.torque_command;
    const ComplexPack bending_part = c * grid.torque_command;
    const ComplexPack rp = r * p;
    const ComplexPack position_part = rp * (grid.encoder_command - bending_part);
    const ComplexPack rate_return = one + rate_part + pressure_part;
    const ComplexPack both_return = rate_return + position_part;
    rate_return_[i] = rate_return;
    both_return_[i] = both_return;
    const RealPack rate_square = plant::square(rate_return);
    const RealPack both_square = plant::square(both_return);
    const RealPack inverse_square = 1.0 / both_square;
    sensitivity_square_[0][i] = 1.0 / rate_square;
    sensitivity_square_[1][i] = inverse_square;
    sensitivity_square_[2][i] = rate_square * inverse_square;

    const ComplexPack inverse = (plant::conjugate(both_return)) * RealPack(inverse_square);
    const ComplexPack act = -grid.beam_command * inverse;
    // Derivatives of D2 by each compensator, times the compensator.
    const ComplexPack rp_bending = rp * bending_part;
    const Adjoint return_by{rate_part + position_part, pressure_part, position_part, -rp_bending};

    const ComplexPack bent_wind = c * grid.torque_wind;
    const ComplexPack position_wind = rp * (grid.encoder_wind - bent_wind);
    const ComplexPack pressure_wind = q * grid.torque_wind;
    const ComplexPack rate_wind = r * grid.tachometer_wind + position_wind;
    const ComplexPack measured = rate_wind + pressure_wind;
    const ComplexPack wind = grid.beam_wind + act * measured;
    sums.wind += grid.wind_weight * plant::square(wind);
    ComplexPack demand_by_wind, torque_by_wind;
    if (gusts_) {
      demand_by_wind = -measured * inverse;
      torque_by_wind = grid.torque_wind + grid.torque_command * demand_by_wind;
      sums.wind_demand += grid.wind_weight * plant::square(demand_by_wind);
      sums.wind_torque += grid.wind_weight * plant::square(torque_by_wind);
    }
    if (with_gradients) {
      const RealPack twice = 2.0 * grid.wind_weight;
      const ComplexPack left = (plant::conjugate(wind) * act) * twice;
      const ComplexPack turned = measured * inverse;
      const Adjoint measured_by{rate_wind, pressure_wind, position_wind, -rp * bent_wind};
      Adjoint change;
      for (std::size_t path = 0; path < 4; ++path) {
        change[path] = measured_by[path] - turned * return_by[path];
      }
      const auto add = [&](const ComplexPack& factor, std::array<RealPack, most_gains>& gradient) {
        Adjoint adjoint;
        for (std::size_t path = 0; path < 4; ++path) adjoint[path] = factor * change[path];
        for (std::size_t g = 0; g < gains; ++g) {
          gradient[g] += plant::real_product(adjoint[path_of_gain[g]], law_here.by_gain[g]);
        }
      };
      add(left, sums.wind_gradient);
      if (gusts_) {
        const ComplexPack by_demand = -inverse * twice;
        add(plant::conjugate(demand_by_wind) * by_demand, sums.wind_demand_gradient);
        add(plant::conjugate(torque_by_wind) * grid.torque_command * by_demand,
            sums.wind_torque_gradient);
      }
    }
    if (!noisy || i >= noise_packs_) continue;

    const ComplexPack torque_law = q - rp * c;
    const ComplexPack tachometer = r * inverse, encoder = rp * inverse,
                      torque = torque_law * inverse;
    const RealPack tachometer_square = plant::square(tachometer);
    const RealPack encoder_square = plant::square(encoder);
    const RealPack torque_square = plant::square(torque);
    const RealPack demand = tachometer_density * tachometer_square +
                            encoder_density * encoder_square + torque_density * torque_square;
    const RealPack to_beam = plant::square(grid.beam_command) * grid.noise_weight;
    sums.noise += to_beam * demand;
    sums.effort += grid.noise_weight * demand;
    if (!with_gradients) continue;
    const ComplexPack torque_left =
        (plant::conjugate(torque) * inverse) * RealPack(2.0 * torque_density);
    const RealPack own_rate =
        2.0 * (tachometer_density * tachometer_square + encoder_density * encoder_square);
    const RealPack own_position = 2.0 * encoder_density * encoder_square;
    const ComplexPack loop = (inverse)*RealPack(2.0 * demand);
    const ComplexPack compensated = torque_left * (rp * c);
    Adjoint adjoint{ComplexPack{own_rate, 0.0} - compensated, torque_left * q,
                    ComplexPack{own_position, 0.0} - compensated, -compensated};
    for (std::size_t path = 0; path < 4; ++path) {
      adjoint[path] = adjoint[path] - loop * return_by[path];
    }
    for (std::size_t g = 0; g < gains; ++g) {
      const RealPack change = plant::real_product(adjoint[path_of_gain[g]], law_here.by_gain[g]);
      sums.noise_gradient[g] += to_beam * change;
      sums.effort_gradient[g] += grid.noise_weight * change;
    }
  }
  result.wind_variance = plant::sum(sums.wind);
  result.noise_variance = plant::sum(sums.noise);
  result.effort_variance = plant::sum(sums.effort);
  result.wind_demand_variance = plant::sum(sums.wind_demand);
  result.wind_torque_variance = plant::sum(sums.wind_torque);
  if (!with_gradients) return;
  for (std::size_t g = 0; g < gains; ++g) {
    result.wind_log_gradient[g] = plant::sum(sums.wind_gradient[g]);
    result.noise_log_gradient[g] = plant::sum(sums.noise_gradient[g]);
    result.effort_log_gradient[g] = plant::sum(sums.effort_gradient[g]);
    result.wind_demand_log_gradient[g] = plant::sum(sums.wind_demand_gradient[g]);
    result.wind_torque_log_gradient[g] = plant::sum(sums.wind_torque_gradient[g]);
  }
}

}  // namespace boresight::control
