#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace boresight::control {

/// The compensators of a control law:
///   rate       R  of rate command less tachometer
///   pressure   Q  of motor torque (dynamic pressure feedback)
///   position   P  of the corrected angle
///   compliance C  of motor torque: what the encoder does not see of the bending
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
};
std::string_view to_string(BlockKind kind);
std::size_t gain_count(BlockKind kind);

/// What a gain is called, its SI unit, and the bounds a search keeps to.
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

inline constexpr std::size_t most_gains = 16;

/// What a drive moves, as far as it says how large the gains of its loops can be.
struct DrivenLoad {
  double frequency = 2.0;  // Hz: the structure's lowest with the motors held
  double inertia = 0.4;    // kg m2 of the antenna, at the motor shaft
};

/// Which blocks a control law is made of: a value, cheap to copy. Each path is the product of its
/// blocks; a path without blocks is absent (pressure, compliance). Gain vectors hold the blocks'
/// gains in their order.
class LoopStructure {
 public:
  /// PI with lag.
  LoopStructure();
  /// @throws InvalidInput without a gain block in rate or position path, for a block with another
  /// number of gains than its kind has, more than most_gains in all, bounds that are not 0 < lower
  /// < upper, a symbol given twice, more leads than lags in a path, an integral in the pressure or
  /// compliance path, or no washout in the pressure path (it would fight the load).
  LoopStructure(std::string name, std::vector<LoopBlock> blocks);

  // The usual ones, with bounds for loads like the default of DrivenLoad.
  static const LoopStructure& pi();                 // rate and position PI
  static const LoopStructure& pi_with_lag();        // PI, lag in the rate loop
  static const LoopStructure& pressure_feedback();  // PI with lag, dynamic pressure feedback
  static const LoopStructure& lead_lag();           // PI with lag and lead
  static const LoopStructure& full();               // lead and pressure feedback
  /// With compliance compensation added; @throws InvalidInput if it has one.
  LoopStructure with_compliance_compensation() const;
  /// With a notch in the rate loop added.
  LoopStructure with_notch() const;
  /// By its short name: PI-0, PI, DPF, LL, FULL, each also with +N (notch) and +C (compliance
  /// compensation). @throws InvalidInput listing them.
  static LoopStructure named(std::string_view short_name);
  /// With the bounds moved to another load than the default, that of the 70-m antenna DSS-14.
  /// Plants that are alike but for their units of time and torque have laws that are alike but for
  /// them: corners and position gain go with the frequency w, the pressure feedback's gain with
  /// 1/(J w) and the compliance with 1/(J w^2); it is the structure's, as the encoder sees the oil
  /// spring give way. Rate gain and damping ratios are plain numbers and stay. Bounds move by the
  /// whole power of ten that is nearest to that factor, 1e-6 to 1e6: they are decades wide, and so
  /// stand still while an antenna changes a little.
  /// @throws InvalidInput unless frequency and inertia are positive and finite
  LoopStructure with_bounds_for(const DrivenLoad& load) const;

  const std::string& name() const;
  const std::vector<LoopBlock>& blocks() const;
  const std::vector<GainDescription>& gains() const;
  bool has(LoopPath path) const;
  bool operator==(const LoopStructure& other) const;

 private:
  struct Definition;
  std::shared_ptr<const Definition> definition_;
};

std::string_view to_string(const LoopStructure& structure);
/// The gains of a structure in the order of its gain vector.
const std::vector<GainDescription>& gain_descriptions(const LoopStructure& structure);

}  // namespace boresight::control
