#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include <boresight/io/description/what_if_description.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {
namespace {

namespace unit = key_units;

constexpr NumberForm known{.finite = true};
constexpr KeyUnit millidegrees{.suffix = "mdeg"};  // of what is divided already
constexpr KeyUnit slope_unit{.suffix = "N_m_s_per_rad"};

double rounded(double value, int digits) {
  if (!std::isfinite(value)) return value;
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

std::vector<double> rounded(const std::vector<double>& values, int digits, double divisor = 1.0) {
  std::vector<double> result;
  for (const double value : values) result.push_back(rounded(value / divisor, digits));
  return result;
}

void describe_start(Visitor& v, const design::WhatIfTable& table) {
  v.number("flywheel_disks", rounded(table.disks_as_built, 6), unit::ratio, "As built.", known);
  v.number("leakage_rate", rounded(table.leakage_rate, 6), unit::per_second, "Nominal.", known);
  v.number("friction_slope", rounded(table.friction_slope, 6), slope_unit, "Of the linear plant.",
           known);
  v.number("wind_speed", rounded(table.wind_speed, 6), unit::metre_per_second, "Of the design.",
           known);
}

}  // namespace

void describe(Visitor& v, const design::WhatIfTable& table) {
  v.texts("structures", table.structures, "As the series.");
  v.numbers("flywheel_disks", rounded(table.disks, 6), unit::ratio,
            "On each motor, rising; each controller is the one tuned there.", known);
  v.numbers("leakage_rates", rounded(table.leakage_rates, 6), unit::per_second, "Rising.", known);
  v.numbers("friction_slopes", rounded(table.friction_slopes, 6), slope_unit,
            "At the motor shaft, rising.", known);
  v.numbers("wind_speeds", rounded(table.wind_speeds, 6), unit::metre_per_second, "Mean, rising.",
            known);
  v.group("start", "The case's own values.", [&] { describe_start(v, table); });
  v.number("friction_slope_at_tracking_rate", rounded(table.tracking_friction, 4), slope_unit,
           "Of the friction curve.", known);
  v.list("bands", table.bands, "Frequency bands.", [&](const design::PointingBand& band) {
    v.text("name", band.name, "Its name.");
    v.number("frequency", band.frequency, unit::hertz, "Centre.", known);
    v.number("beamwidth", rounded(band.beamwidth / millidegree, 6), millidegrees,
             "Half-power width of the beam.", known);
  });
  v.list("budgets", table.budgets, "Pointing budgets.", [&](const design::PointingBudget& budget) {
    v.text("name", budget.name, "Its name.");
    v.text("band", budget.band, "Of which band.");
    v.number("rms", rounded(budget.rms / millidegree, 5), millidegrees, "One axis.", known);
  });
  v.numbers("boresight_rms", rounded(table.boresight_rms, 5, millidegree), millidegrees,
            "By structure, disks, leakage, friction and wind speed, the last fastest; null: "
            "unstable.");
  std::vector<std::uint64_t> states;
  for (const auto state : table.states) states.push_back(static_cast<std::uint64_t>(state));
  v.counts("states_1", states,
           "In the same order. 0: unstable, 1: stable, a constraint is missed, 2: every constraint "
           "holds.",
           {.maximum = 2});
}

}  // namespace boresight::io
