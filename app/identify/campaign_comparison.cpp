#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/identify/campaign_comparison.hpp>

namespace boresight::app {

using identification::Interval;

std::optional<Interval> reconciled(const CampaignSection& section, const std::string& quantity) {
  if (section.grey_box) return section.grey_box->quantity(quantity).posterior;
  if (quantity == "inertia" && section.mean_of_methods) {
    const auto& mean = *section.mean_of_methods;
    return Interval{mean.value, mean.standard_uncertainty, mean.lower, mean.upper};
  }
  return std::nullopt;
}

std::optional<Difference> difference_from_reconciled(const CampaignSection& section,
                                                     const std::string& quantity,
                                                     const Interval& other) {
  const auto own = reconciled(section, quantity);
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
                    difference_from_reconciled(section, quantity, *interval)});
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
      const double share = static_cast<double>(i) / static_cast<double>(fewest - 1);
      const double between = lowest * std::pow(highest / lowest, share);
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
      row.reconciled = identification::friction_interval(*section.grey_box, rate);
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
  if (quantity.identified) return "identified";
  const bool oil = quantity.name == "bulk modulus" || quantity.name == "oil stiffness";
  if (oil && !section.bulk_modulus_stated) return "slosh";
  return quantity.prior_from_drawings ? "drawings" : "not identifiable";
}

std::vector<std::string> not_identifiable(const CampaignSection& section) {
  std::vector<std::string> sentences;
  const auto add = [&](const std::string& what, const std::string& why) {
    sentences.push_back(fmt::format("{} is not identifiable from these records: {}", what, why));
  };
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
      } else if (origin == "not identifiable") {
        sentences.push_back(fmt::format(
            "The {} is not identifiable from these records ({:.0f} % of its variance learnt): {} "
            "is a wide guess, do not build on it.",
            q.name, 100.0 * q.learnt, range));
      }
    }
  } else {
    sentences.emplace_back(
        "No model explains all records at once (see below): the reconciled inertia is a mean of "
        "methods that differ in what they leave out.");
  }
  if (section.bulk_modulus_stated) {
    sentences.push_back(fmt::format(
        "No slosh test shows the lines ringing: methods that need the oil's bulk modulus take what "
        "the case states, {:.4g} +- {:.2g} GPa.",
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

}  // namespace boresight::app
