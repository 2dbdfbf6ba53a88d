#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>

namespace boresight::app {
namespace {

using numerics::PropagatedResult;

std::string bound(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "infinity";
}

std::string interval(const PropagatedResult& result, int decimals, double unit = 1.0) {
  return fmt::format("{} .. {}", bound(result.lower / unit, decimals),
                     bound(result.upper / unit, decimals));
}

std::string ratio_value(const PropagatedResult& ratio) {
  return ratio.value > 0.0 ? fmt::format("{:.3f}", ratio.value) : "none: J < Jm";
}

std::string deciding(const PropagatedResult& result) {
  std::string text;
  for (std::size_t i = 0; i < result.contributions.size() && i < 2; ++i) {
    text += fmt::format("{}{} {:.0f} %", i == 0 ? "" : ", ", result.contributions[i].input,
                        100.0 * result.contributions[i].fraction);
  }
  return text;
}

// The table's first column: the whole name stands below it.
std::string shortened(const std::string& name) {
  constexpr std::string_view mass = "mass properties, antenna from ";
  constexpr std::string_view printed = "mass properties, ";
  constexpr std::string_view impulse = "impulse-momentum, ";
  if (name.starts_with(mass)) return fmt::format("masses, {}", name.substr(mass.size()));
  if (name.starts_with(printed)) return fmt::format("masses, {}", name.substr(printed.size()));
  if (name.starts_with(impulse)) return fmt::format("impulse, {}", name.substr(impulse.size()));
  return name;
}

std::string either(const std::string& text) {
  return text.empty() ? "-" : text;
}

// Columns that no row fills are left out.
Document methods_table(const IdentificationSection& section) {
  using Printed = IdentificationSection::Printed;
  const bool printed_inertia = std::ranges::any_of(
      section.printed, [](const Printed& printed) { return !printed.inertia.empty(); });
  const bool printed_ratio = std::ranges::any_of(
      section.printed, [](const Printed& printed) { return !printed.ratio.empty(); });
  std::vector<std::vector<std::string>> rows{{"method", "J kg.m2", "interval"}};
  if (section.pounds_force) rows.front().emplace_back("lbf.ft.s2");
  if (printed_inertia) rows.front().emplace_back("printed J");
  rows.front().insert(rows.front().end(), {"R", "interval"});
  if (printed_ratio) rows.front().emplace_back("printed R");
  for (std::size_t i = 0; i < section.inertia.methods.size(); ++i) {
    const auto& method = section.inertia.methods[i];
    const double inertia = method.reflected_inertia.value;
    std::vector<std::string> row{shortened(method.name), fmt::format("{:.4f}", inertia),
                                 interval(method.reflected_inertia, 3)};
    if (section.pounds_force) {
      row.push_back(fmt::format("{:.4f}", inertia / pound_foot_second_squared));
    }
    if (printed_inertia) row.push_back(either(section.printed[i].inertia));
    row.push_back(ratio_value(method.motor_to_load_ratio));
    row.push_back(interval(method.motor_to_load_ratio, 2));
    if (printed_ratio) row.push_back(either(section.printed[i].ratio));
    rows.push_back(std::move(row));
  }
  return table(rows);
}

// `without_antenna`: the inertia of motors and gear train; `impulses`: results of impulse tests.
std::string combined_text(const identification::CombinedInertia& one, double without_antenna,
                          std::ptrdiff_t impulses) {
  const std::string counted = impulses > 1 ? " (the impulse results count as one)" : "";
  const std::string ratio = fmt::format("R = {:.2f}, interval {} .. {}", one.motor_to_load_ratio,
                                        bound(one.ratio_lower, 2), bound(one.ratio_upper, 2));
  const std::string scatter = fmt::format("Cochran's Q {:.1f} on {} degrees of freedom",
                                          one.heterogeneity, one.degrees_of_freedom);
  if (one.contradictory()) {
    return fmt::format(
        "No combined estimate: the methods contradict one another ({}; motors and gear train "
        "alone are {:.3f} kg.m2). A random-effects mean of {} methods{} would be {:.3f} kg.m2 "
        "({:.2f} .. {:.2f}; {}), which represents none of them.",
        scatter, without_antenna, one.degrees_of_freedom + 1, counted, one.value, one.lower,
        one.upper, ratio);
  }
  return fmt::format(
      "Combined estimate: J = {:.3f} kg.m2, 95 % interval {:.2f} .. {:.2f} (motors and gear train "
      "alone "
      "are {:.3f}); {}. Random-effects mean of {} methods{}; standard deviation "
      "between methods {:.3f} kg.m2; {}{}.",
      one.value, one.lower, one.upper, without_antenna, ratio, one.degrees_of_freedom + 1, counted,
      one.between_methods, scatter,
      one.heterogeneity > 2.0 * one.degrees_of_freedom ? ": they differ strongly" : "");
}

}  // namespace

Document document_of(const IdentificationSection& section) {
  const auto& inertia = section.inertia;
  Document text = heading(
      "Inertia at the motor shaft, by method (95 % intervals from the inputs' uncertainties)");
  text += essential(methods_table(section));
  text += essential(wrapped(
      "R = Jm/(J - Jm), all motors over everything else. Intervals exclude the methods' model "
      "errors (flexible antenna, efficiencies in the oil spring, friction model).",
      "  "));
  text += "\n";
  for (const auto& method : inertia.methods) {
    const auto& left = method.antenna_remainder;
    text += wrapped(
        fmt::format("{}: assumes {}; leaves {:.3f} kg.m2 ({}) for the antenna; decided by {}.",
                    method.name, method.assumes, left.value, interval(left, 3),
                    deciding(method.reflected_inertia)),
        "  ");
    if (method.motor_to_load_ratio.beyond_pole > 0.0) {
      const double beyond = 100.0 * method.motor_to_load_ratio.beyond_pole;
      text += wrapped(fmt::format("In {} % of samples J < Jm and R is undefined.",
                                  beyond < 10.0 ? fmt::format("{:.2g}", beyond)
                                                : fmt::format("{:.0f}", beyond)),
                      "    ");
    }
  }
  if (section.combined) {
    const auto& methods = inertia.methods.front();
    const auto impulses = std::ranges::count(inertia.methods, identification::MethodKind::impulse,
                                             &identification::InertiaMethod::kind);
    text += "\n" + essential(wrapped(combined_text(*section.combined,
                                                   methods.reflected_inertia.value -
                                                       methods.antenna_remainder.value,
                                                   impulses),
                                     "  "));
  }
  text += heading("Inputs of the methods");
  std::vector<std::vector<std::string>> rows{
      {"quantity", "value", "interval", "unit", "decided by"}};
  for (const auto& line : inertia.line_bulk_modulus) {
    rows.push_back({line.name, fmt::format("{:.1f}", line.value / megapascal),
                    interval(line, 0, megapascal), "MPa", deciding(line)});
  }
  rows.push_back(
      {"bulk modulus as used", fmt::format("{:.1f}", inertia.bulk_modulus.value / megapascal),
       interval(inertia.bulk_modulus, 0, megapascal), "MPa", deciding(inertia.bulk_modulus)});
  rows.push_back({"oil stiffness", fmt::format("{:.2f}", inertia.oil_stiffness.value),
                  interval(inertia.oil_stiffness, 2), "N.m/rad", deciding(inertia.oil_stiffness)});
  rows.push_back(
      {"hydraulic frequency, masses rigid", fmt::format("{:.4f}", inertia.expected_frequency.value),
       interval(inertia.expected_frequency, 3), "Hz", deciding(inertia.expected_frequency)});
  for (const auto& row : inertia.load_rows) {
    rows.push_back(
        {fmt::format("reflected: {}", row.name), fmt::format("{:.6f}", row.value), interval(row, 4),
         section.pounds_force
             ? fmt::format("kg.m2 ({:.5f} lbf.ft.s2)", row.value / pound_foot_second_squared)
             : std::string("kg.m2"),
         deciding(row)});
  }
  if (section.tachometer_scale) {
    rows.push_back({"tachometer scale", fmt::format("{:.4f}", section.tachometer_scale->value),
                    interval(*section.tachometer_scale, 3), "rad/(s.V)",
                    deciding(*section.tachometer_scale)});
  }
  for (const auto& friction : {section.slow_ramp_coulomb, section.slow_ramp_offset}) {
    if (!friction) continue;
    rows.push_back({friction->name, fmt::format("{:.2f}", friction->value), interval(*friction, 2),
                    "N.m", deciding(*friction)});
  }
  return text + table(rows, "lrrll");
}

}  // namespace boresight::app
