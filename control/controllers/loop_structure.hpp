#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

class SensorResponse;

/// The compensators of a controller:
///   rate       R  of rate command less tachometer
///   pressure   Q  of motor torque (dynamic pressure feedback)
///   position   P  of the corrected angle
///   compliance C  of motor torque: estimates the flexure beyond the encoder (non-collocated)
///   u = R (r - tachometer) - Q torque,   r = -P (encoder - C torque)
enum class LoopPath { rate, pressure, position, compliance };
std::string_view to_string(LoopPath path);

/// A factor of a compensator and its gains, in this order.
enum class BlockKind {
  gain,      // g
  integral,  // 1 + wi/s
  lag,       // 1/(1 + s/wp)
  lead,      // 1 + s/wz, not without a lag in the same path
  washout,   // s/(s + wd)
  notch,     // (s^2 + 2 zz wn s + wn^2)/(s^2 + 2 zp wn s + wn^2): wn, zz, zp
  // What the position path's integral takes of the corrected angle x; 1 in all linear figures.
  dead_zone,  // 0 within +-d, beyond it x less d
  freeze,     // 0 within +-d: the integral holds; beyond it x
};
std::string_view to_string(BlockKind kind);
std::size_t gain_count(BlockKind kind);
/// True for dead_zone and freeze, whose gain is a width.
bool is_integral_condition(BlockKind kind);

/// Name and symbol of a gain, its SI unit, and the bounds of a search.
struct GainDescription {
  std::string name;
  std::string symbol;
  std::string unit;
  double lower = 0.0;
  double upper = 0.0;
};

struct LoopBlock {
  LoopPath path = LoopPath::rate;
  BlockKind kind = BlockKind::gain;
  std::vector<GainDescription> gains;
};

inline constexpr std::size_t max_gains = 16;

/// The load of a drive, as far as it determines the size of the loop gains.
struct DrivenLoad {
  double frequency = 2.0;  // Hz, lowest structure frequency with the motors locked
  double inertia = 0.4;    // kg m2 of the antenna, at the motor shaft
};

/// The blocks of a controller. A value type, cheap to copy. Each path is the product of its blocks;
/// a path without blocks is absent (pressure, compliance). Gain vectors contain the gains of the
/// blocks in their order. A structure may be a state space instead: without blocks and gains, it is
/// one controller.
class LoopStructure {
 public:
  /// PI with lag.
  LoopStructure();
  /// @throws InvalidInput for a rate or position path without a gain block, a block with a number
  /// of gains other than its kind has, more than max_gains in all, bounds that are not 0 < lower <
  /// upper, a duplicate symbol, more leads than lags in a path, an integral in the pressure or
  /// compliance path, a pressure path without a washout (it would oppose the static load), or a
  /// dead zone or freeze that is not alone with one integral in the position path.
  LoopStructure(std::string name, std::vector<LoopBlock> blocks);

  /// A sampled linear controller in place of blocks. Inputs tachometer, encoder and, if read,
  /// motor_torque; output valve_demand (the complete demand, before the dead time). It has one
  /// loop, through all its sensors: no rate loop of its own and no rate command. In the analysis of
  /// continuous loops its response is that at z = e^(jwT) with the hold's amplitude
  /// (SensorResponse); the dead time is that of its computation and hold, 1.5 T. Peaks and margins
  /// are those below its Nyquist frequency, and its control effort is that of the samples.
  /// @throws InvalidInput for a continuous system or other ports, and as plant::validate.
  static LoopStructure of_state_space(std::string name, const plant::StateSpace& controller);

  // The usual structures, with bounds for loads like the default of DrivenLoad.
  static const LoopStructure& pi();                 // rate and position PI
  static const LoopStructure& pi_with_lag();        // PI, lag in the rate loop
  static const LoopStructure& pressure_feedback();  // PI with lag, dynamic pressure feedback
  static const LoopStructure& lead_lag();           // PI with lag and lead
  static const LoopStructure& full();               // lead and pressure feedback
  /// Adds compliance compensation. @throws InvalidInput if the structure has it already.
  LoopStructure with_compliance_compensation() const;
  /// Replaces the integrals of rate and position loop by a lag compensator in the position loop,
  /// P = kp (1 + s/wzp)/(1 + s/wpp), a leaky integral. Without integrals no torque builds up while
  /// friction holds the motor. Apply it before the other additions. @throws InvalidInput if the
  /// structure is not one of the usual PI structures.
  LoopStructure with_position_lag() const;
  /// One integral instead of those of rate and position loop: that of the position path, which the
  /// position lag may precede, with a dead zone or frozen within an error. Friction that holds the
  /// motor then builds up no torque within it, and a steady load leaves no more than it
  /// (conditional_integral.hpp). Apply either after with_position_lag, before the other additions.
  /// @throws InvalidInput for a structure that is not usual or has a conditional integral.
  LoopStructure with_dead_zone() const;
  LoopStructure with_freeze() const;
  /// Bounds of a dead zone or freeze a factor of 4 about a width (rad of motor); other structures
  /// are returned as they are. Tuning takes the middle of the bounds: linear figures do not depend
  /// on it. @throws InvalidInput for a width that is not positive and finite.
  LoopStructure with_integral_width(double width) const;
  /// Adds a notch in the rate loop.
  LoopStructure with_notch() const;
  /// The structure with a short name: PI-0, PI, DPF, LL, FULL, each also with +L (position lag), +D
  /// (dead zone) or +F (freeze), +N (notch) and +C (compliance compensation), in this order.
  /// @throws InvalidInput, with a list of the names, for any other name.
  static LoopStructure named(std::string_view short_name);
  /// Rescales the bounds from the default load, that of the 70-m antenna DSS-14, to another load.
  /// By dynamic similarity, corners and position gain scale with the frequency w, the pressure
  /// feedback gain with 1/(J w) and the compliance with 1/(J w^2). That compliance is the
  /// structure's, because the encoder senses the deflection of the oil spring. Rate gain and
  /// damping ratios are dimensionless and do not change. The factor is rounded to the nearest power
  /// of ten, 1e-6 to 1e6: small changes of the antenna leave the bounds, which are decades wide,
  /// unchanged.
  /// @throws InvalidInput unless frequency and inertia are positive and finite
  LoopStructure with_bounds_for(const DrivenLoad& load) const;

  const std::string& name() const;
  const std::vector<LoopBlock>& blocks() const;
  const std::vector<GainDescription>& gains() const;
  /// The sampled controller and its response; null for a structure of blocks.
  const plant::StateSpace* state_space() const;
  const SensorResponse* sensor_response() const;
  /// Number of gains, or of the states of a state space: the measure of its complexity.
  std::size_t parts() const;
  /// True with an integral in the rate or position path that takes every error: no static error
  /// under a steady torque.
  bool has_integral_action() const;
  /// True with a dead zone or freeze.
  bool has_conditional_integral() const;
  /// True if the controller reads the motor torque.
  bool feeds_torque_back() const;
  bool has(LoopPath path) const;
  /// Number of blocks of that kind in the path.
  int count(LoopPath path, BlockKind kind) const;
  bool operator==(const LoopStructure& other) const;

 private:
  struct Definition;
  std::shared_ptr<const Definition> definition_;
};

std::string_view to_string(const LoopStructure& structure);
/// The gains of a structure in the order of its gain vector.
const std::vector<GainDescription>& gain_descriptions(const LoopStructure& structure);

}  // namespace boresight::control
