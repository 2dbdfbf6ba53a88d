#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/grey_box/grey_box_mechanics.hpp>
#include <boresight/identification/grey_box/grey_box_parameters.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Mechanical = MechanicalCoefficients;
using Hydraulic = HydraulicCoefficients;
using P = GreyBoxParameters;

void positive(double value, const char* what) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InvalidInput(fmt::format(
        "GreyBoxParameters: expected a positive {} in the drive's knowledge, found {}; state it in "
        "the case",
        what, value));
  }
}

double relative(const numerics::Uncertain& number) {
  return number.standard_uncertainty / number.value;
}

// Torque less the inertia's as a straight line on either side of standstill: level, slope and
// offset. What friction starts from.
struct Line {
  double level = 0.0, slope = 0.0, offset = 0.0;
};

Line straight_friction(const std::vector<GreyBoxRecord>& records, double inertia,
                       double largest_rate, double largest_torque) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-6;
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto& record : records) {
    for (Index k = 0; k < record.samples(); ++k) {
      const double rate = record.rate(k);
      if (!record.rate_counts[static_cast<std::size_t>(k)] ||
          std::abs(rate) < 0.05 * largest_rate) {
        continue;
      }
      const Eigen::Vector3d row{std::copysign(1.0, rate), rate / largest_rate, 1.0};
      normal += row * row.transpose();
      right += row * (record.torque(k) - inertia * record.motion_slope(k));
    }
  }
  const Eigen::MatrixXd solved = numerics::linear_solve(normal, right, "straight line of friction");
  Line line{solved(0), solved(1) / largest_rate, solved(2)};
  line.level = std::clamp(line.level, 0.02 * largest_torque, largest_torque);
  line.slope =
      std::clamp(line.slope, 0.005 * largest_torque / largest_rate, largest_torque / largest_rate);
  return line;
}

// Derivative of a value by its coordinate.
double by_coordinate(const GreyBoxParameter& parameter, double value) {
  return parameter.logarithmic ? value * parameter.spread : parameter.spread;
}

constexpr std::array from_mechanics{P::coulomb_torque,    P::stribeck_torque, P::stribeck_rate,
                                    P::saturating_torque, P::saturating_rate, P::viscous_friction,
                                    P::bristle_stiffness, P::bristle_damping, P::offset_torque,
                                    P::common_torque,     P::tachometer_zero, P::tachometer_lag,
                                    P::rate_correction,   P::mode_damping};
constexpr std::array from_hydraulics{P::cross_leakage,       P::null_leakage,    P::case_leakage,
                                     P::valve_gain,          P::valve_null,      P::valve_lag,
                                     P::valve_curvature,     P::line_resistance, P::supply_torque,
                                     P::supply_droop,        P::tachometer_zero, P::tachometer_lag,
                                     P::pressure_correction, P::valve_lap};

}  // namespace

GreyBoxParameters::GreyBoxParameters(const Campaign& campaign,
                                     const std::vector<GreyBoxRecord>& records,
                                     const std::optional<numerics::Interval>& bulk,
                                     bool bulk_guessed) {
  if (records.empty()) {
    throw InvalidInput(
        "GreyBoxParameters: expected at least one record with motor rate and pressures on both "
        "sides, found none");
  }
  for (const auto& record : records) {
    largest_rate_ = std::max(largest_rate_, record.rate.cwiseAbs().maxCoeff());
    largest_torque_ = std::max(largest_torque_, record.torque.cwiseAbs().maxCoeff());
    if (record.valve.size() > 0) {
      units_.largest_command = std::max(units_.largest_command, record.valve.cwiseAbs().maxCoeff());
    }
  }
  if (!(largest_rate_ > 0.0) || !(largest_torque_ > 0.0)) {
    throw InvalidInput(
        "GreyBoxParameters: expected records that move, found no motor rate or no "
        "torque other than 0");
  }
  tracking_rate_ = campaign.knowledge.tracking_rate;
  list_.resize(modes);
  add_drawings(campaign, bulk, bulk_guessed);
  add_friction(records);
  add_sensors(campaign, records);
  add_hydraulics(campaign, records);
  add_modes(campaign.knowledge);
}

void GreyBoxParameters::add_drawings(const Campaign& campaign,
                                     const std::optional<numerics::Interval>& bulk, bool guessed) {
  const DriveKnowledge& k = campaign.knowledge;
  positive(k.motor_count, "number of motors");
  positive(k.motor_inertia.value, "motor inertia");
  positive(k.antenna_inertia.value, "antenna inertia");
  positive(k.displacement.value, "displacement");
  positive(k.torque_efficiency.value, "torque efficiency");
  positive(k.volumetric_efficiency.value, "volumetric efficiency");
  positive(k.volume_1.value, "volume of side 1");
  positive(k.volume_2.value, "volume of side 2");
  positive(k.supply_pressure - k.return_pressure, "supply pressure above the return's");
  const auto set = [this](Index index, const char* name, const char* unit, double prior,
                          double spread) {
    list_[static_cast<std::size_t>(index)] = {name, unit, true, prior, spread, true};
  };
  set(motor_inertia, "motor inertia", "kg m2", k.motor_count * k.motor_inertia.value,
      relative(k.motor_inertia));
  // Nobody's drawings: none, for certain. Its logarithm is not needed then.
  if (!(k.gear_inertia.value >= 0.0) || !std::isfinite(k.gear_inertia.value)) {
    positive(k.gear_inertia.value, "gear inertia");
  }
  const bool gears = k.gear_inertia.value > 0.0;
  set(gear_inertia, "gear inertia", "kg m2", k.gear_inertia.value,
      gears ? relative(k.gear_inertia) : 0.0);
  set(antenna_inertia, "antenna inertia", "kg m2", k.antenna_inertia.value,
      relative(k.antenna_inertia));
  const double displaced = relative(k.displacement);
  set(pressure_gain, "pressure gain", "", 1.0,
      campaign.instruments.pressure_gain / std::sqrt(2.0 * k.motor_count));
  set(torque_factor, "torque per pressure", "", 1.0,
      std::hypot(displaced, relative(k.torque_efficiency)));
  set(flow_factor, "flow per rate", "", 1.0,
      std::hypot(displaced, relative(k.volumetric_efficiency)));
  set(tachometer_gain, "tachometer scale", "", 1.0, campaign.instruments.tachometer_scale);
  if (bulk) {
    positive(bulk->value, "bulk modulus");
    set(bulk_modulus, "bulk modulus", "Pa", bulk->value, bulk->standard_uncertainty / bulk->value);
    list_[bulk_modulus].from_drawings = !guessed;
  } else {
    // Mineral oils with a little air.
    set(bulk_modulus, "bulk modulus", "Pa", 1.3e9, 0.2);
    list_[bulk_modulus].from_drawings = false;
  }
  set(volume_1, "volume of side 1", "m3", k.volume_1.value, relative(k.volume_1));
  set(volume_2, "volume of side 2", "m3", k.volume_2.value, relative(k.volume_2));
  plant::HydraulicDrive drive;
  drive.motor_count = k.motor_count;
  drive.displacement = k.displacement.value;
  drive.torque_efficiency = k.torque_efficiency.value;
  drive.volumetric_efficiency = k.volumetric_efficiency.value;
  drive.bulk_modulus = 1.0;
  drive.volume_1 = drive.volume_2 = 2.0;  // so that 1/V1 + 1/V2 = 1
  // Whatever the convention of K is: torque counts with one efficiency, flow with the other.
  drive.efficiency_in_stiffness = plant::EfficiencyInStiffness::both;
  stiffness_scale_ = plant::oil_stiffness(drive);
}

void GreyBoxParameters::add_friction(const std::vector<GreyBoxRecord>& records) {
  const double inertia =
      list_[motor_inertia].prior + list_[gear_inertia].prior + list_[antenna_inertia].prior;
  const Line line = straight_friction(records, inertia, largest_rate_, largest_torque_);
  const double knee = 0.05 * largest_rate_;
  const auto set = [this](Index index, const char* name, const char* unit, double prior,
                          double spread) {
    list_[static_cast<std::size_t>(index)] = {name, unit, true, prior, spread, false};
  };
  set(coulomb_torque, "Coulomb torque at standstill", "N m", 0.3 * line.level, 1.0);
  set(stribeck_torque, "breakaway less Coulomb torque", "N m", 0.1 * line.level, 1.0);
  set(stribeck_rate, "Stribeck rate", "rad/s", 0.1 * knee, 1.0);
  set(saturating_torque, "saturating friction", "N m", 0.7 * line.level, 1.0);
  set(saturating_rate, "saturating rate", "rad/s", knee, 1.0);
  set(viscous_friction, "viscous friction", "N m s/rad", line.slope, 1.0);
  const double bristles = 40.0 * line.level;  // breaks away after some hundredths of a radian
  set(bristle_stiffness, "bristle stiffness", "N m/rad", bristles, 1.5);
  set(bristle_damping, "bristle damping", "N m s/rad", 0.1 * std::sqrt(bristles * inertia), 1.0);
  set(mode_damping, "damping of the structure", "", 0.01, 0.7);
  list_[offset_torque] = {"offset torque", "N m", false, line.offset, 0.3 * largest_torque_, false};
}

void GreyBoxParameters::add_sensors(const Campaign& campaign,
                                    const std::vector<GreyBoxRecord>& records) {
  const double channels = campaign.knowledge.motor_count;
  list_[common_torque] = {"unlike gains of inlets and outlets",
                          "",
                          false,
                          0.0,
                          campaign.instruments.pressure_gain * std::sqrt(2.0 / channels),
                          true};
  list_[tachometer_zero] = {"tachometer zero", "rad/s", false, 0.0, 0.005 * largest_rate_, false};
  list_[tachometer_lag] = {"tachometer lag", "s", true, 0.002, 1.0, false};
  // How fast the valve's rate command is followed, at a glance.
  double command = 0.0, rate = 0.0;
  for (const auto& record : records) {
    if (record.valve.size() == 0 || record.valve_calibrated) continue;
    command += record.valve.squaredNorm();
    rate += record.rate.squaredNorm();
  }
  const double followed = command > 0.0 && rate > 0.0 ? std::sqrt(rate / command) : 1.0;
  list_[command_gain] = {"opening per rate command", "",   true, followed,
                         command > 0.0 ? 0.5 : 0.0,  false};
}

void GreyBoxParameters::add_hydraulics(const Campaign& campaign,
                                       const std::vector<GreyBoxRecord>& records) {
  const DriveKnowledge& k = campaign.knowledge;
  const double torque = torque_per_pressure(k) * k.motor_count;
  units_.supply_torque = torque * k.supply_pressure;
  units_.return_torque = torque * k.return_pressure;
  if (!(units_.largest_command > 0.0)) units_.largest_command = largest_rate_;
  const double modulus = list_[bulk_modulus].prior;
  const double stiffness =
      stiffness_scale_ * modulus * (1.0 / k.volume_1.value + 1.0 / k.volume_2.value);
  // Damping ratios of some hundredths to tenths of the hydraulic mode.
  const double inertia =
      list_[motor_inertia].prior + list_[gear_inertia].prior + list_[antenna_inertia].prior;
  const double leakage = 0.2 * std::sqrt(stiffness / inertia) / stiffness;
  const auto set = [this](Index index, const char* name, const char* unit, double prior,
                          double spread, bool drawings) {
    list_[static_cast<std::size_t>(index)] = {name, unit, true, prior, spread, drawings};
  };
  set(cross_leakage, "leakage across the motors", "rad/s per N m", 0.8 * leakage, 1.2, false);
  set(null_leakage, "leakage through the valve's centre", "rad/s per N m", 0.1 * leakage, 1.2,
      false);
  set(case_leakage, "leakage to the case", "rad/s per N m", 0.1 * leakage, 1.2, false);
  set(valve_gain, "valve scale", "", 1.0, campaign.instruments.valve_scale, true);
  set(valve_lag, "valve lag", "s", 0.005, 0.8, false);
  constexpr double min_supply_spread = 0.01;
  set(supply_torque, "supply pressure as torque", "N m", units_.supply_torque,
      std::max(min_supply_spread, k.supply_uncertainty / k.supply_pressure), true);
  // Predictions reach ahead over a quarter radian of the hydraulic mode: far enough that torque and
  // flow balances count and not only the recorder's last sample, near enough that wind and small
  // errors of the flow do not add up. Fixed: left to the fit, they would serve ripple and noise at
  // the highest frequencies. No step may correct more than it was off.
  double longest = 0.0;
  for (const auto& record : records) longest = std::max(longest, record.sample_time);
  const double correction = std::min(4.0 * std::sqrt(stiffness / inertia), 0.5 / longest);
  set(rate_correction, "correction by the rate", "N m s/rad", correction * inertia, 0.0, false);
  set(pressure_correction, "correction by the pressures", "1/s", correction, 0.0, false);
  // What flow curves and lines usually show beyond the model's orifice: a few parts in a hundred of
  // the flow, and of the supply's pressure at full speed. Without them the leakage would take the
  // blame, and be far too sure of itself.
  list_[valve_curvature] = {"valve curvature", "", false, 0.0, 0.03, false};
  list_[line_resistance] = {"line resistance",
                            "N m s/rad",
                            false,
                            0.0,
                            0.01 * units_.supply_torque / largest_rate_,
                            false};
  // Ground to the ports within a few thousandths of the stroke.
  list_[valve_lap] = {"valve lap", "rad/s", false, 0.0, 0.005 * units_.largest_command, false};
  list_[valve_null] = {"valve null", "rad/s", false, 0.0, 0.02 * units_.largest_command, false};
  list_[supply_droop] = {"supply droop", "", false, 0.0, 0.05, false};
}

void GreyBoxParameters::add_modes(const DriveKnowledge& knowledge) {
  double sum = 0.0;
  const std::size_t count = knowledge.locked_rotor_frequencies.size();
  for (std::size_t i = 1; i <= count; ++i) sum += 1.0 / static_cast<double>(i * i);
  // The rigid part is uncertain by a factor of e however many modes there are.
  const double apart = std::sqrt(static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const numerics::Uncertain& f = knowledge.locked_rotor_frequencies[i];
    positive(f.value, "locked-rotor frequency");
    // On a locked rotor all of the antenna depends on springs: what seems to turn rigidly is the
    // mass of the modes that are not stated, by the usual rule of modal analysis a tenth; the lower
    // modes are those of more inertia. A larger rigid part would have to come out of the motors'
    // inertia, which is known well, and so out of the transducers' gains.
    const double rank = static_cast<double>(i + 1);
    const double against_rest = 9.0 / (rank * rank * sum);
    list_.push_back({fmt::format("fraction of structural mode {} against the rigid part", i + 1),
                     "", true, against_rest, apart, false});
    list_.push_back(
        {fmt::format("locked-rotor frequency {}", i + 1), "Hz", true, f.value, relative(f), true});
  }
}

VectorXd GreyBoxParameters::values(const VectorXd& point) const {
  VectorXd values(size());
  for (Index i = 0; i < size(); ++i) {
    const auto& p = list_[static_cast<std::size_t>(i)];
    values(i) =
        p.logarithmic ? p.prior * std::exp(p.spread * point(i)) : p.prior + p.spread * point(i);
  }
  return values;
}

GreyBoxParameters GreyBoxParameters::with_correction(double factor) const {
  GreyBoxParameters changed = *this;
  changed.list_[rate_correction].prior *= factor;
  changed.list_[pressure_correction].prior *= factor;
  return changed;
}

double GreyBoxParameters::recorded_inertia_factor(const VectorXd& v) {
  return v(pressure_gain) / (v(torque_factor) * v(tachometer_gain));
}

double GreyBoxParameters::oil_stiffness(const VectorXd& v) const {
  return stiffness_scale_ * v(torque_factor) * v(flow_factor) * v(bulk_modulus) *
         (1.0 / v(volume_1) + 1.0 / v(volume_2));
}

GreyBoxParameters::Coefficients GreyBoxParameters::mechanical(const VectorXd& point) const {
  const VectorXd v = values(point);
  const auto spread = [this](Index i) { return list_[static_cast<std::size_t>(i)].spread; };
  Coefficients c;
  c.values.resize(Mechanical::count(mode_count()));
  c.by_point.setZero(c.values.size(), size());
  for (std::size_t i = 0; i < from_mechanics.size(); ++i) {
    const auto row = static_cast<Index>(i) + Mechanical::coulomb_torque;
    const Index from = from_mechanics[i];
    c.values(row) = v(from);
    c.by_point(row, from) = by_coordinate(list_[static_cast<std::size_t>(from)], v(from));
  }
  const double factor = recorded_inertia_factor(v);
  // Fractions of the antenna: of the rigid part 1/(1 + sum), of a mode its ratio times that.
  double sum = 1.0;
  for (Index i = 0; i < mode_count(); ++i) sum += v(fraction(i));
  const auto inertia = [&](Index row, double motors_and_gears, double part, Index mode) {
    const double antenna = v(antenna_inertia) * part;
    const double value = factor * (motors_and_gears + antenna);
    c.values(row) = value;
    if (motors_and_gears > 0.0) {
      c.by_point(row, motor_inertia) = factor * v(motor_inertia) * spread(motor_inertia);
      c.by_point(row, gear_inertia) = factor * v(gear_inertia) * spread(gear_inertia);
    }
    c.by_point(row, antenna_inertia) = factor * antenna * spread(antenna_inertia);
    c.by_point(row, pressure_gain) = value * spread(pressure_gain);
    c.by_point(row, torque_factor) = -value * spread(torque_factor);
    c.by_point(row, tachometer_gain) = -value * spread(tachometer_gain);
    for (Index j = 0; j < mode_count(); ++j) {
      c.by_point(row, fraction(j)) =
          factor * antenna * ((j == mode ? 1.0 : 0.0) - v(fraction(j)) / sum) * spread(fraction(j));
    }
  };
  inertia(Mechanical::rigid_inertia, v(motor_inertia) + v(gear_inertia), 1.0 / sum, -1);
  for (Index i = 0; i < mode_count(); ++i) {
    inertia(Mechanical::inertia(i), 0.0, v(fraction(i)) / sum, i);
    const Index row = Mechanical::frequency(i);
    c.values(row) = two_pi * v(frequency(i));
    c.by_point(row, frequency(i)) = c.values(row) * spread(frequency(i));
  }
  return c;
}

GreyBoxParameters::Coefficients GreyBoxParameters::hydraulic(const VectorXd& point,
                                                             bool valve_calibrated) const {
  const VectorXd v = values(point);
  const auto spread = [this](Index i) { return list_[static_cast<std::size_t>(i)].spread; };
  Coefficients c;
  c.values.resize(Hydraulic::count);
  c.by_point.setZero(c.values.size(), size());
  for (std::size_t i = 0; i < from_hydraulics.size(); ++i) {
    const auto row = static_cast<Index>(i) + Hydraulic::cross_leakage;
    Index from = from_hydraulics[i];
    if (from == valve_gain && !valve_calibrated) from = command_gain;
    c.values(row) = v(from);
    c.by_point(row, from) = by_coordinate(list_[static_cast<std::size_t>(from)], v(from));
  }
  // As recorded: pressures by the transducers' gain, flow counted in recorded rate.
  const double factor = v(pressure_gain) * v(flow_factor) / v(tachometer_gain);
  for (Index side = 0; side < 2; ++side) {
    const Index row = Hydraulic::stiffness_1 + side;
    // The inlets' transducers may read higher than the outlets'.
    const double unlike = side == 0 ? 0.5 : -0.5;
    const double gain = 1.0 + unlike * v(common_torque);
    const double value = stiffness_scale_ * factor * gain * v(bulk_modulus) / v(volume_1 + side);
    c.values(row) = value;
    c.by_point(row, common_torque) = value / gain * unlike * spread(common_torque);
    c.by_point(row, bulk_modulus) = value * spread(bulk_modulus);
    c.by_point(row, volume_1 + side) = -value * spread(volume_1 + side);
    c.by_point(row, pressure_gain) = value * spread(pressure_gain);
    c.by_point(row, flow_factor) = value * spread(flow_factor);
    c.by_point(row, tachometer_gain) = -value * spread(tachometer_gain);
  }
  return c;
}

}  // namespace boresight::identification
