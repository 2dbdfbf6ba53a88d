#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/io/campaign/campaign_comparison.hpp>
#include <boresight/io/campaign/campaign_wording.hpp>
#include <boresight/io/campaign/recommended_values.hpp>

namespace boresight::app {
namespace {

using io::advised_quantity;
using io::range;
using io::ranked;
using io::shown_unit;
using io::ShownUnit;
using io::significant;
using numerics::Interval;
using Rows = std::vector<std::vector<std::string>>;

std::string with_unit(const std::string& name, const ShownUnit& unit) {
  return unit.name == "1" ? name : fmt::format("{}, {}", name, unit.name);
}

Document combined_part(const io::CampaignSection& section) {
  if (section.mean_of_methods) {
    const auto& mean = *section.mean_of_methods;
    return wrapped(
        fmt::format(
            "No value to design on: mean of {} methods (random effects) J = {:.4g} kg.m2, 95 % "
            "interval {:.4g} "
            ".. {:.4g}; R = {:.3f}. Cochran's Q {:.1f} on {} degrees of freedom{}.",
            mean.degrees_of_freedom + 1, mean.value, mean.lower, mean.upper,
            mean.motor_to_load_ratio, mean.heterogeneity, mean.degrees_of_freedom,
            mean.heterogeneity > 2.0 * mean.degrees_of_freedom ? ": they differ strongly" : ""),
        "  ");
  }
  if (!section.grey_box) return {};
  Rows rows{{"quantity", "value", "95 % interval", "+-%", "before records", "learnt", "verdict"}};
  for (const auto& q : section.grey_box->quantities) {
    const auto unit = shown_unit(q.unit);
    const double half = 50.0 * (q.posterior.upper - q.posterior.lower);
    rows.push_back({with_unit(q.name, unit), significant(q.posterior.value * unit.scale),
                    range(q.posterior, unit.scale),
                    fmt::format("{:.2g}", half / std::abs(q.posterior.value)),
                    range(q.prior, unit.scale), fmt::format("{:.0f} %", 100.0 * q.learnt),
                    verdict(section, q)});
  }
  return table(rows, "lrrrrrl");
}

Document methods_part(const io::CampaignSection& section) {
  Document text = heading("Inertia at the motor shaft, by method (95 % intervals)");
  Rows rows{{"method", "J kg.m2", "interval", "R", "interval", "off by", "sigmas"}};
  const auto row_of = [](const std::string& name, const Interval& inertia, const Interval& ratio,
                         const std::optional<io::Difference>& difference) {
    return std::vector<std::string>{
        name,
        significant(inertia.value),
        range(inertia),
        std::isfinite(ratio.value) ? significant(ratio.value) : "none: J < Jm",
        range(ratio),
        difference ? fmt::format("{:+.1f} %", 100.0 * difference->relative) : "-",
        difference ? fmt::format("{:+.1f}", difference->normalised) : "-"};
  };
  if (const auto values = io::recommended(section)) {
    rows.push_back(
        row_of("combined (grey box)", values->inertia, values->motor_to_load_ratio, std::nullopt));
  }
  for (const auto& row : section.inertia) {
    rows.push_back(row_of((row.of_the_paper ? "* " : "") + row.name, row.inertia,
                          row.motor_to_load_ratio, row.difference));
  }
  text += essential(table(rows, "lrrrrrr"));
  text += wrapped(
      "* procedures of the founding paper. R = Jm/(J - Jm), all motors over everything else. "
      "Sigmas: difference over the combined standard uncertainty.",
      "  ");
  text += "\n";
  for (const auto& row : section.inertia) {
    text += wrapped(fmt::format("{}: assumes {}. {}", row.name, row.assumes, row.why), "  ", "  ");
  }
  for (const auto& failure : section.failures) {
    text += essential(
        wrapped(fmt::format("{}: not done. {}", failure.method, failure.reason), "  ", "  "));
  }
  return text;
}

Document stated_numbers_part(const io::CampaignSection& section) {
  if (!section.grey_box || section.grey_box->stated_numbers.empty()) return {};
  Document text = heading("Stated numbers against the records and one another");
  Rows rows{{"number", "1 sigma", "by all else", "sigmas", "shown from", "effect", "J without it"}};
  for (const auto& one : section.grey_box->stated_numbers) {
    rows.push_back({one.name, fmt::format("{:.2g} %", 100.0 * one.stated_uncertainty),
                    range(one.by_others), fmt::format("{:+.1f}", one.departure),
                    fmt::format("{:.1f} %", 100.0 * one.visible_error),
                    fmt::format("{:+.2f}", one.inertia_effect), range(one.inertia)});
  }
  text += table(rows, "lrrrrrr");
  return text +
         wrapped(
             "By all else: 95 % interval of what the records and all other stated numbers give, 1 "
             "if the number is right. Sigmas: its distance from 1 in standard uncertainties of "
             "both. Shown from: smallest error of the number that makes 3.5 of them. Effect: per "
             "cent of inertia per per cent of the number. One wrong number makes others depart "
             "that it stands against.",
             "  ");
}

Document influences_part(const io::CampaignSection& section) {
  if (!section.grey_box || section.grey_box->influences.size() < 2) return {};
  Document text = heading("Inertia without one record");
  Rows rows{{"without", "J kg.m2", "95 % interval", "change by it", "information"}};
  for (const auto& one : section.grey_box->influences) {
    rows.push_back({one.record, significant(one.inertia.value), range(one.inertia),
                    fmt::format("{:+.2f} %", 100.0 * one.change),
                    fmt::format("{:.0f} %", 100.0 * one.information)});
  }
  text += table(rows, "lrrrr");
  return text + wrapped(
                    "By the first step of a fit without the record. Information: what is the "
                    "record's alone of that about the inertia as recorded.",
                    "  ");
}

Document quantities_part(const io::CampaignSection& section) {
  if (section.quantities.empty()) return {};
  Document text = heading("Other quantities, by method");
  Rows rows{{"quantity", "method", "value", "95 % interval", "off by", "sigmas"}};
  for (const auto& row : section.quantities) {
    const auto unit = shown_unit(row.unit);
    rows.push_back(
        {with_unit(row.quantity, unit), row.method, significant(row.interval.value * unit.scale),
         range(row.interval, unit.scale),
         row.difference ? fmt::format("{:+.1f} %", 100.0 * row.difference->relative) : "-",
         row.difference ? fmt::format("{:+.1f}", row.difference->normalised) : "-"});
  }
  return text + table(rows, "llrrrr");
}

Document lines_part(const io::SloshTest& test) {
  Document text = heading(fmt::format("Oil lines and bulk modulus ({})", test.record));
  Rows rows{
      {"line", "length m", "Hz", "interval", "damping", "events", "bulk modulus MPa", "interval"}};
  const auto modulus = [&](const std::optional<Interval>& interval, std::vector<std::string>& row) {
    row.push_back(interval ? significant(interval->value / megapascal) : "-");
    row.push_back(interval ? range(*interval, 1.0 / megapascal) : "-");
  };
  for (const auto& line : test.result.lines) {
    std::vector<std::string> row{
        fmt::format("motor {}, {}", line.motor + 1,
                    line.side == identification::LineSide::inlet ? "inlet" : "outlet"),
        line.length ? fmt::format("{:.2f}", line.length->value) : "-",
        fmt::format("{:.3f}", line.frequency.value),
        fmt::format("{:.3f} .. {:.3f}", line.frequency.lower, line.frequency.upper),
        fmt::format("{:.4f}", line.damping_ratio.value),
        fmt::format("{}", line.events)};
    modulus(line.bulk_modulus, row);
    rows.push_back(std::move(row));
  }
  std::vector<std::string> pooled{"all lines", "", "", "", "", ""};
  modulus(test.result.bulk_modulus, pooled);
  rows.push_back(std::move(pooled));
  if (const auto& extreme = test.result.extreme_lines) {
    std::vector<std::string> paper{"* extremes only",
                                   "",
                                   fmt::format("{:.3f}", extreme->highest_frequency),
                                   fmt::format("and {:.3f}", extreme->lowest_frequency),
                                   "",
                                   ""};
    modulus(extreme->mean, paper);
    rows.push_back(std::move(paper));
  }
  text += table(rows);
  for (const auto& note : test.result.notes) text += wrapped(note, "  ", "  ");
  return text;
}

Document friction_part(const io::CampaignSection& section) {
  if (section.friction.empty()) return {};
  Document text = heading("Friction at the motor shaft, N.m (95 % intervals)");
  Rows rows{{"rate rad/s", "combined", "interval", "curve fit", "interval", "constant speed",
             "interval", ""}};
  for (const auto& row : section.friction) {
    std::vector<std::string> cells{fmt::format("{:.3f}", row.rate)};
    for (const auto* interval : {&row.combined, &row.curve, &row.tested}) {
      cells.push_back(*interval ? significant((*interval)->value) : "-");
      cells.push_back(*interval ? range(**interval) : "-");
    }
    cells.push_back(fmt::format("{}{}", row.tracking ? "t" : "", row.extrapolated ? "x" : ""));
    rows.push_back(std::move(cells));
  }
  text += table(rows, "rrrrrrrl");
  const bool tested = section.impulse && section.impulse->constant_speed;
  text += wrapped(fmt::format("Curve fit: one curve through windows of all tests. t: the tracking "
                              "rate. x: outside the range of the {}.",
                              tested ? "constant-speed tests" : "fitted speeds"),
                  "  ");
  std::string levels;
  if (section.impulse && section.impulse->constant_speed &&
      section.impulse->constant_speed->has_line) {
    const auto& tests = *section.impulse->constant_speed;
    levels += fmt::format(
        "constant speeds give {} N.m ({}) as the intercept of a line with slope {} N.m.s/rad ({}), "
        "from which the tests are off by up to {:.2g} N.m; ",
        significant(tests.intercept.value), range(tests.intercept), significant(tests.slope.value),
        range(tests.slope), tests.line_misfit);
  }
  if (section.impulse && section.impulse->slow_ramp) {
    const auto& ramp = *section.impulse->slow_ramp;
    levels += fmt::format("the slow ramp gives {} N.m ({}) just after breakaway at {} N.m ({}); ",
                          significant(ramp.coulomb.value), range(ramp.coulomb),
                          significant(ramp.breakaway.value), range(ramp.breakaway));
  }
  if (!levels.empty()) {
    text += wrapped("The paper's two Coulomb levels: " + levels +
                        "both are points of one curve that rises quickly with speed and then "
                        "saturates.",
                    "  ", "  ");
  }
  return text;
}

Document contradictions_part(const io::CampaignSection& section) {
  Document text = heading("Stated numbers that the records contradict");
  if (section.contradictions.empty()) {
    return text + "  none by more than two combined standard uncertainties\n";
  }
  Rows rows{{"key", "stated", "", "unit", "records give", "95 % interval", "sigmas", "by"}};
  for (const auto& one : section.contradictions) {
    const auto unit = shown_unit(one.unit);
    rows.push_back(
        {one.key, one.stated, one.assumed ? "assumed" : "", unit.name,
         significant(one.records.value * unit.scale), range(one.records, unit.scale),
         std::abs(one.normalised) < 100.0 ? fmt::format("{:+.1f}", one.normalised) : "> 100",
         one.by});
  }
  return text + essential(table(rows, "llllrrrl"));
}

Document advice_part(const io::CampaignSection& section) {
  if (section.test_gains.empty() || !section.grey_box) return {};
  Document text = heading("Fraction of each interval left after a further test");
  const auto& quantities = section.grey_box->quantities;
  Rows rows{{"test", "in this campaign"}};
  std::vector<std::size_t> shown;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    if (!advised_quantity(quantities[q].name)) continue;
    shown.push_back(q);
    rows.front().push_back(quantities[q].name);
  }
  for (const auto& gain : section.test_gains) {
    rows.push_back({gain.test, gain.done_before ? "yes" : "no"});
    for (const std::size_t q : shown)
      rows.back().push_back(fmt::format("{:.2f}", gain.remaining[q]));
  }
  text += table(rows, "ll");
  for (const std::size_t q : shown) {
    const auto best = ranked(section.test_gains, q);
    std::string names;
    for (std::size_t i = 0; i < best.size() && i < 3; ++i) {
      if (best[i]->remaining[q] > 0.98) break;
      names += fmt::format("{}{} ({:.0f} % of the interval left)", i == 0 ? "" : ", then ",
                           best[i]->test, 100.0 * best[i]->remaining[q]);
    }
    text += wrapped(
        fmt::format(
            "{}: {}.", quantities[q].name,
            names.empty() ? "none of these tests helps; instruments and model limit it" : names),
        "  ", "  ");
  }
  return text;
}

Document fit_part(const io::CampaignSection& section) {
  if (!section.grey_box) return {};
  const auto& fit = *section.grey_box;
  Document text = heading("Fit of one model to all records");
  Rows rows{{"record", "prediction of", "rms", "unit", "counted", "left out", "neighbours",
             "effective", "white"}};
  for (const auto& r : fit.residuals) {
    rows.push_back({r.record, r.pressures ? "pressures" : "rate", fmt::format("{:.3g}", r.rms),
                    r.pressures ? "N.m" : "rad/s", fmt::format("{}", r.counted),
                    fmt::format("{}", r.outliers), fmt::format("{:+.2f}", r.neighbours),
                    fmt::format("{:.0f}", r.effective), r.white ? "yes" : "no"});
  }
  text += table(rows, "llrlrrrrl");
  std::string starts;
  for (const auto& start : fit.starts) {
    starts += fmt::format("{}{:.6g}", starts.empty() ? "" : ", ", start.cost);
  }
  text += wrapped(fmt::format("Rank {} of {} varied parameters, condition {:.3g}. Sum of squares "
                              "by start: {}. The search ended because {}.",
                              fit.rank, fit.varied, fit.condition, starts,
                              std::string(numerics::describe(fit.status))),
                  "  ");
  if (const auto& held = section.hold_out) {
    text += wrapped(fmt::format("Hold-out: fitted to the other records and driven by the valve "
                                "command of {}, the model has errors of {:.0f} % in rate and "
                                "{:.0f} % in torque (rms over the record's about its mean).",
                                held->record, 100.0 * held->result.error.rate_error,
                                100.0 * held->result.error.torque_error),
                    "  ", "  ");
  }
  for (const auto& note : fit.notes) text += wrapped(note, "  ", "  ");
  text += subheading("correlation of the estimates");
  rows = {{""}};
  for (std::size_t i = 0; i < fit.quantities.size(); ++i) {
    if (i + 1 < fit.quantities.size()) rows.front().push_back(fmt::format("{}", i + 1));
    rows.push_back({fmt::format("{} {}", i + 1, fit.quantities[i].name)});
    for (std::size_t j = 0; j < i; ++j) {
      rows.back().push_back(fmt::format(
          "{:+.2f}", fit.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))));
    }
  }
  return text + table(rows);
}

Document method_notes_part(const io::CampaignSection& section) {
  Document text;
  const auto add = [&](const char* title, const std::vector<std::string>& notes) {
    if (notes.empty()) return;
    text += heading(title);
    for (const auto& note : notes) text += wrapped(note, "  ", "  ");
  };
  if (section.resonance) add("What the resonance alone shows", section.resonance->notes);
  if (section.impulse) add("What impulse and friction tests alone show", section.impulse->notes);
  return text;
}

}  // namespace

Document document_of(const io::CampaignSection& section) {
  Document text = heading("Drive parameters from the records");
  for (const auto& sentence : section.not_identifiable) {
    text += essential(wrapped(sentence, "  ", "  "));
  }
  if (!section.not_identifiable.empty()) text += "\n";
  text += combined_part(section);
  text += methods_part(section);
  text += quantities_part(section);
  for (const auto& test : section.slosh) text += lines_part(test);
  text += friction_part(section);
  text += contradictions_part(section);
  text += stated_numbers_part(section);
  text += influences_part(section);
  text += advice_part(section);
  text += fit_part(section);
  text += method_notes_part(section);
  text += document_of(section.channels);
  return text + document_of(section.notes);
}

}  // namespace boresight::app
