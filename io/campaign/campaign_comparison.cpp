#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/io/campaign/campaign_comparison.hpp>

namespace boresight::io {

using numerics::Interval;
using numerics::Uncertain;

std::optional<Interval> combined(const CampaignSection& section, const std::string& quantity) {
  if (section.grey_box) return section.grey_box->quantity(quantity).posterior;
  if (quantity == "inertia" && section.mean_of_methods) {
    const auto& mean = *section.mean_of_methods;
    return Interval{mean.value, mean.standard_uncertainty, mean.lower, mean.upper};
  }
  return std::nullopt;
}

std::optional<Difference> difference_from_combined(const CampaignSection& section,
                                                   const std::string& quantity,
                                                   const Interval& other) {
  const auto own = combined(section, quantity);
  if (!own) return std::nullopt;
  const double difference = other.value - own->value;
  return Difference{difference / std::abs(own->value),
                    difference / std::hypot(own->standard_uncertainty, other.standard_uncertainty)};
}

std::vector<QuantityRow> quantity_rows(const CampaignSection& section) {
  std::vector<QuantityRow> rows;
  const auto add = [&](const char* quantity, const char* unit, std::string method,
                       const std::optional<Interval>& interval) {
    if (!interval) return;
    rows.push_back({quantity, unit, std::move(method), *interval,
                    difference_from_combined(section, quantity, *interval)});
  };
  for (const auto& test : section.slosh) {
    add("bulk modulus", "Pa", fmt::format("{}, all lines", test.record), test.result.bulk_modulus);
    if (const auto& extreme = test.result.extreme_lines) {
      add("bulk modulus", "Pa", fmt::format("{}, extreme lines (paper)", test.record),
          extreme->mean);
    }
  }
  if (section.resonance) {
    const auto& resonance = *section.resonance;
    add("oil stiffness", "N m/rad", "oil data", resonance.stiffness);
    add("oil stiffness", "N m/rad", "torque and rate alone", resonance.stiffness_from_motion);
    add("leakage rate", "1/s", "steps and sweep, less orifices", resonance.leakage_rate);
    add("leakage rate", "1/s", "damping of rings, less friction", resonance.leakage_from_damping);
  }
  if (section.impulse) {
    const auto& impulse = *section.impulse;
    if (impulse.constant_speed) {
      if (impulse.constant_speed->has_line) {
        add("Coulomb level", "N m", "constant speeds' line (paper)",
            impulse.constant_speed->intercept);
      }
      add("offset torque as recorded", "N m", "constant speed, half sum",
          impulse.constant_speed->offset);
    }
    if (impulse.slow_ramp) {
      add("Coulomb level", "N m", "slow ramp (paper)", impulse.slow_ramp->coulomb);
      add("offset torque as recorded", "N m", "slow ramp, half sum", impulse.slow_ramp->offset);
    }
    if (impulse.friction) {
      add("offset torque as recorded", "N m", "friction curve",
          identification::offset_as_recorded(*impulse.friction));
    }
  }
  return rows;
}

void average_methods(CampaignSection& section) {
  const auto& knowledge = section.knowledge;
  const double motors = knowledge.motor_count * knowledge.motor_inertia.value;
  std::vector<Uncertain> estimates{
      {motors + knowledge.gear_inertia.value + knowledge.antenna_inertia.value,
       std::hypot(knowledge.motor_count * knowledge.motor_inertia.standard_uncertainty,
                  knowledge.gear_inertia.standard_uncertainty,
                  knowledge.antenna_inertia.standard_uncertainty)}};
  std::string names = fmt::format("mass properties {:.4g}", estimates.front().value);
  const auto add = [&](const char* method, const Interval& inertia) {
    estimates.push_back({inertia.value, inertia.standard_uncertainty});
    names += fmt::format(", {} {:.4g}", method, inertia.value);
  };
  if (section.resonance && section.resonance->best) {
    add("resonance", section.resonance->best->inertia);
  }
  if (section.impulse && section.impulse->best) {
    add("impulse", section.impulse->estimates[*section.impulse->best].inertia);
  }
  names += " kg m2";
  std::erase_if(estimates, [](const Uncertain& one) {
    return !(one.standard_uncertainty > 0.0) || !std::isfinite(one.standard_uncertainty);
  });
  if (estimates.size() < 2) return;
  const auto mean = identification::combine(estimates, motors);
  if (mean.contradictory()) {
    section.contradiction = fmt::format(
        "The methods contradict one another (Cochran's Q {:.1f} on {} degrees of freedom, between "
        "{}): no mean of them is an inertia. Look at the columns, units and stated numbers first.",
        mean.heterogeneity, mean.degrees_of_freedom, names);
    return;
  }
  section.mean_of_methods = mean;
}

std::vector<FrictionRow> friction_rows(const CampaignSection& section,
                                       const identification::Campaign& campaign) {
  std::vector<FrictionRow> rows;
  const auto* tests = section.impulse && section.impulse->constant_speed
                          ? &section.impulse->constant_speed->points
                          : nullptr;
  const auto* fit =
      section.impulse && section.impulse->friction ? &*section.impulse->friction : nullptr;
  if (!section.grey_box && fit == nullptr && tests == nullptr) return rows;
  std::vector<double> rates;
  if (tests != nullptr) {
    for (const auto& point : *tests) rates.push_back(std::abs(point.rate));
  } else if (fit != nullptr) {
    rates = {fit->lowest_rate, fit->highest_rate};
  }
  std::erase_if(rates, [](double rate) { return !(rate > 0.0); });
  if (rates.empty()) return rows;
  std::sort(rates.begin(), rates.end());
  const double lowest = rates.front(), highest = rates.back();
  constexpr std::size_t fewest = 6;
  if (rates.size() < fewest && highest > lowest) {
    for (std::size_t i = 1; i + 1 < fewest; ++i) {
      const double fraction = static_cast<double>(i) / static_cast<double>(fewest - 1);
      const double between = lowest * std::pow(highest / lowest, fraction);
      const bool near = std::any_of(rates.begin(), rates.end(), [&](double rate) {
        return std::abs(std::log(rate / between)) < 0.1;
      });
      if (!near) rates.push_back(between);
    }
  }
  const double tracking = section.knowledge.tracking_rate;
  if (tracking > 0.0) rates.push_back(tracking);
  std::sort(rates.begin(), rates.end());
  for (const double rate : rates) {
    FrictionRow row;
    row.rate = rate;
    row.tracking = rate == tracking;
    row.extrapolated = rate < lowest || rate > highest;
    if (section.grey_box) {
      row.combined = identification::friction_interval(*section.grey_box, rate);
    }
    if (fit != nullptr) row.curve = identification::friction_of_antenna(*fit, campaign, rate);
    if (tests != nullptr) {
      for (const auto& point : *tests) {
        if (std::abs(point.rate) == rate) row.tested = point.coulomb;
      }
    }
    rows.push_back(row);
  }
  return rows;
}

std::string verdict(const CampaignSection& section,
                    const identification::GreyBoxQuantity& quantity) {
  if (section.grey_box && section.grey_box->conflict.widening > 1.0) return "contradicts the case";
  if (quantity.identified) return "identified";
  const bool oil = quantity.name == "bulk modulus" || quantity.name == "oil stiffness";
  const bool slosh = oil && !section.bulk_modulus_stated;
  if (!slosh && !quantity.prior_from_drawings) return "not identifiable";
  const std::string origin = slosh ? "slosh" : "drawings";
  constexpr double away = 2.5;  // of the prior's uncertainties
  const double apart = std::abs(quantity.posterior.value - quantity.prior.value);
  return apart > away * quantity.prior.standard_uncertainty ? "contradicts " + origin : origin;
}

std::string departures_of(const std::vector<identification::StatedNumberCheck>& numbers) {
  std::vector<std::string> all;
  for (const auto& one : numbers) {
    all.push_back(fmt::format("{}: {:.3g} times the stated value, {:.1f} standard uncertainties",
                              one.name, one.by_others.value, std::abs(one.departure)));
  }
  return fmt::format("{}", fmt::join(all, "; "));
}

std::string contradiction_with_case(const identification::GreyBoxResult& found) {
  const auto& conflict = found.conflict;
  std::string text;
  if (!conflict.contradicted.empty()) {
    text = fmt::format(
        "Records and all other stated numbers contradict {} ({}).",
        conflict.contradicted.size() == 1 ? "one stated number" : "one of these stated numbers",
        departures_of(conflict.contradicted));
  }
  if (!conflict.beyond_scatter()) return text;
  if (!text.empty()) text += ' ';
  text += fmt::format(
      "The records and the stated numbers contradict one another: the squares of the distances of "
      "{} of them, in their uncertainties, add up to {:.0f} where random scatter makes {} and "
      "hardly ever "
      "{:.0f}; the {} is {:.1f} uncertainties off.",
      conflict.count, conflict.sum, conflict.count, conflict.limit, conflict.largest,
      std::abs(conflict.departure));
  if (conflict.widening > 1.0) {
    text += fmt::format(
        " The intervals below were widened {:.1f} times for it and hold only if this number is "
        "what is wrong: look for a wrong number, unit, column or sign first.",
        std::sqrt(conflict.widening));
  }
  return text;
}

namespace {

// Whether a slosh test has given the lines' frequencies.
bool lines_rang(const CampaignSection& section) {
  return std::any_of(section.slosh.begin(), section.slosh.end(),
                     [](const SloshTest& test) { return !test.result.lines.empty(); });
}

// What besides the records' length keeps friction and offset apart from each other, or does not.
std::string why_not_identifiable(const identification::GreyBoxResult& found,
                                 const identification::GreyBoxQuantity& quantity) {
  const bool level = quantity.name == "Coulomb level";
  if (found.posterior.one_way != 0.0 && (level || quantity.name == "offset torque as recorded")) {
    return "the drive moves one way only, where friction's level and the offset are one number";
  }
  if (level && found.posterior.unsaturated > 0.0) {
    return fmt::format("at {:.3g} rad/s at most the drive is too slow for friction to saturate",
                       found.motion.highest_rate);
  }
  return fmt::format("{:.0f} % of its variance learnt", 100.0 * quantity.learnt);
}

}  // namespace

std::vector<std::string> not_identifiable(const CampaignSection& section) {
  std::vector<std::string> sentences;
  const auto add = [&](const std::string& what, const std::string& why) {
    sentences.push_back(fmt::format("{} is not identifiable from these records: {}", what, why));
  };
  if (!section.contradiction.empty()) sentences.push_back(section.contradiction);
  if (section.grey_box) {
    for (const auto& q : section.grey_box->quantities) {
      const std::string origin = verdict(section, q);
      const std::string range = fmt::format("{:.4g} to {:.4g}{}{}", q.posterior.lower,
                                            q.posterior.upper, q.unit.empty() ? "" : " ", q.unit);
      if (origin == "drawings") {
        sentences.push_back(fmt::format(
            "The {} comes from drawings and data sheets, not from the records ({:.0f} % of its "
            "variance learnt): {}.",
            q.name, 100.0 * q.learnt, range));
      } else if (origin == "contradicts drawings" || origin == "contradicts slosh") {
        sentences.push_back(fmt::format(
            "The {} that fits the records, {}, contradicts {} ({:.4g} to {:.4g}), and the records "
            "alone do not tell it ({:.0f} % of its variance learnt).",
            q.name, range,
            origin == "contradicts slosh" ? "what the slosh test gives"
                                          : "drawings and data sheets",
            q.prior.lower, q.prior.upper, 100.0 * q.learnt));
      } else if (!q.identified && !q.prior_from_drawings && origin != "slosh") {
        sentences.push_back(fmt::format(
            "The {} is not identifiable from these records ({}): {} is a wide guess, do not build "
            "on it.",
            q.name, why_not_identifiable(*section.grey_box, q), range));
      }
    }
  } else if (section.mean_of_methods) {
    sentences.emplace_back(
        "No model explains all records at once (see below): the combined inertia is a mean of "
        "methods that differ in what they leave out.");
  } else {
    sentences.emplace_back(
        "No model explains all records at once (see below), and there is no combined inertia.");
  }
  if (section.bulk_modulus_stated) {
    sentences.push_back(fmt::format(
        "{}: methods that need the oil's bulk modulus take what "
        "the case states, {:.4g} +- {:.2g} GPa.",
        lines_rang(section)
            ? "Without the lines' lengths (oil.line) their ringing gives no bulk modulus"
            : "No slosh test shows the lines ringing",
        1e-9 * section.bulk_modulus.value, 1e-9 * section.bulk_modulus.standard_uncertainty));
  }
  if (section.resonance && !section.resonance->rings && section.resonance->responses.empty()) {
    add("The hydraulic mode's damping",
        "no valve steps or valve sweep show it ringing about a moving operating point.");
  }
  if (!section.impulse || !section.impulse->constant_speed) {
    add("Friction speed by speed", "no constant-speed test with settled ends both ways.");
  }
  return sentences;
}

}  // namespace boresight::io
