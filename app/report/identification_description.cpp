#include <string>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/report/identification_description.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

using numerics::PropagatedResult;

constexpr io::KeyUnit inertia_unit{.suffix = "kg_m2"};
constexpr io::KeyUnit stiffness_unit{.suffix = "N_m_per_rad"};
constexpr io::KeyUnit scale_unit{.suffix = "rad_per_s_V"};
constexpr io::NumberForm positive{.minimum = 0.0};

// Its keys name the unit.
void describe_members(io::Visitor& v, const PropagatedResult& result, const io::KeyUnit& of) {
  v.defined_as(fmt::format("propagated_{}", of.suffix),
               "A result of uncertain inputs, in the unit that its keys end in.");
  v.text("name", result.name, "What it is.");
  v.number("value", result.value, of, "At the inputs' values.");
  v.number("standard_uncertainty", result.standard_uncertainty, of, "1 sigma, to first order.",
           positive);
  v.number("lower_95", result.lower, of, "Lower end of the 95 % interval, by random samples.");
  v.number("upper_95", result.upper, of, "Upper end; null where it has none.");
  v.list("contributions", result.contributions,
         "Inputs by their fraction of the variance, largest first.", [&](const auto& contribution) {
           v.defined_as("contribution", "One input's part in a variance.");
           v.text("input", contribution.input, "The input.");
           v.number("variance_fraction", contribution.fraction, unit::ratio,
                    "Its fraction, 0 to 1.", positive);
         });
}

void describe_propagated(io::Visitor& v, std::string_view key, const PropagatedResult& result,
                         const io::KeyUnit& of, std::string_view meaning) {
  v.group(key, meaning, [&] { describe_members(v, result, of); });
}

void describe_propagated(io::Visitor& v, std::string_view key,
                         const std::optional<PropagatedResult>& result, const io::KeyUnit& of,
                         std::string_view meaning) {
  v.optional_group(key, result, meaning,
                   [&](const PropagatedResult& there) { describe_members(v, there, of); });
}

void describe_all(io::Visitor& v, std::string_view key,
                  const std::vector<PropagatedResult>& results, const io::KeyUnit& of,
                  std::string_view meaning) {
  v.list(key, results, meaning,
         [&](const PropagatedResult& result) { describe_members(v, result, of); });
}

// A method, and what the source prints of it.
struct PrintedMethod {
  identification::InertiaMethod method;
  IdentificationSection::Printed printed;
};

void describe_method(io::Visitor& v, const PrintedMethod& one) {
  const auto& method = one.method;
  v.text("name", method.name, "The method.");
  v.text("assumes", method.assumes, "What it takes for granted.");
  describe_propagated(v, "reflected_inertia", method.reflected_inertia, inertia_unit,
                      "Motors and load at the motor shaft.");
  describe_propagated(v, "motor_to_load_ratio", method.motor_to_load_ratio, unit::ratio,
                      "All motors against the load; without meaning where the inertia is below "
                      "the motors'.");
  v.number("samples_below_motor_inertia", method.motor_to_load_ratio.beyond_pole, unit::ratio,
           "Fraction of the samples in which the inertia is below the motors' own.",
           {.minimum = 0.0, .maximum = 1.0});
  describe_propagated(v, "antenna_remainder", method.antenna_remainder, inertia_unit,
                      "What the method leaves for the antenna.");
  v.text_or_null("printed_reflected_inertia", one.printed.inertia,
                 "What the source prints, as text.");
  v.text_or_null("printed_motor_to_load_ratio", one.printed.ratio,
                 "What the source prints, as text.");
}

void describe_combined(io::Visitor& v, const identification::CombinedInertia& one) {
  v.defined_as("combined", "Random-effects mean of the methods.");
  v.number("reflected_inertia", one.value, inertia_unit, "Best estimate.");
  v.number("standard_uncertainty", one.standard_uncertainty, inertia_unit, "1 sigma.", positive);
  v.number("lower_95", one.lower, inertia_unit, "Lower end of the 95 % interval.");
  v.number("upper_95", one.upper, inertia_unit, "Upper end.");
  v.number("between_methods", one.between_methods, inertia_unit,
           "Standard deviation between methods beyond their own uncertainties.", positive);
  v.number("cochran_q", one.heterogeneity, unit::ratio,
           "Cochran's Q: far above the degrees of freedom, the methods contradict one another.",
           positive);
  v.count("degrees_of_freedom", one.degrees_of_freedom, "Methods less one.");
  v.flag("contradictory", one.degrees_of_freedom > 0 && one.contradictory(),
         "Q is beyond what random scatter exceeds once in a thousand times: the mean stands for "
         "none of "
         "the methods, and there is no combined inertia.");
  v.number("motor_to_load_ratio", one.motor_to_load_ratio, unit::ratio, "At the estimate.");
  v.number("motor_to_load_ratio_lower_95", one.ratio_lower, unit::ratio, "Lower end.");
  v.number("motor_to_load_ratio_upper_95", one.ratio_upper, unit::ratio,
           "Upper end; null where the interval reaches the motors' own inertia.");
}

}  // namespace

void describe(io::Visitor& v, const IdentificationSection& section) {
  const auto& found = section.inertia;
  std::vector<PrintedMethod> methods;
  for (std::size_t i = 0; i < found.methods.size(); ++i) {
    methods.push_back({found.methods[i], section.printed.at(i)});
  }
  v.defined_as("identification", "The inertia the motors drive, by each method.");
  v.number("gear_ratio", found.gear_ratio, unit::ratio, "Motor turns per turn of the axis.",
           {.above = 0.0, .finite = true});
  v.list("methods", methods,
         "Mass properties with each antenna inertia, hydraulic resonance, impulses.",
         [&](const PrintedMethod& one) { describe_method(v, one); }, {.minimum = 1});
  v.optional_group("combined", section.combined,
                   "One estimate from all methods; null with fewer than two.",
                   [&](const auto& one) { describe_combined(v, one); });
  describe_all(v, "load_rows", found.load_rows, inertia_unit,
               "Each assembly and each antenna inertia at the motor shaft.");
  describe_all(v, "line_bulk_modulus", found.line_bulk_modulus, unit::pascal,
               "Bulk modulus from each line.");
  describe_propagated(v, "bulk_modulus", found.bulk_modulus, unit::pascal, "As used.");
  describe_propagated(v, "oil_stiffness", found.oil_stiffness, stiffness_unit,
                      "Oil spring at the motor shaft.");
  describe_propagated(v, "expected_hydraulic_frequency", found.expected_frequency, unit::hertz,
                      "That masses and oil spring give, all masses rigid.");
  describe_propagated(v, "tachometer_scale", section.tachometer_scale, scale_unit,
                      "Motor rate per volt; null without a calibration.");
  describe_propagated(v, "slow_ramp_coulomb_friction", section.slow_ramp_coulomb,
                      unit::newton_metre, "Null without slow ramps.");
  describe_propagated(v, "slow_ramp_offset_torque", section.slow_ramp_offset, unit::newton_metre,
                      "Null without slow ramps.");
}

}  // namespace boresight::app
