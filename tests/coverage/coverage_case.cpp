#include "coverage_case.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "simulated_campaign.hpp"
#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/identification/impulse/impulse_momentum.hpp>
#include <boresight/identification/lines/slosh.hpp>
#include <boresight/identification/resonance/hydraulic_resonance.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::coverage {
namespace {

using numerics::Interval;

// What each method gave, as identify runs them.
struct Identified {
  std::optional<identification::SloshResult> slosh;
  Interval bulk_modulus;
  std::optional<identification::ImpulseMomentum> impulse;
  std::optional<identification::ResonanceResult> resonance;
  std::optional<identification::GreyBoxResult> grey_box;
};

template <typename Function>
void attempt(const char* method, CoverageCase& into, const Function& function) {
  try {
    function();
  } catch (const InvalidInput& failure) {
    into.failures.push_back(fmt::format("{}: {}", method, failure.what()));
  } catch (const NumericalFailure& failure) {
    into.failures.push_back(fmt::format("{}: {}", method, failure.what()));
  }
}

Identified identify(const identification::Campaign& campaign, const CoverageSetting& setting,
                    CoverageCase& into) {
  Identified found;
  attempt("slosh", into, [&] {
    found.slosh = identification::identify_slosh(campaign.records.front(), campaign.knowledge);
  });
  const bool heard = found.slosh && found.slosh->bulk_modulus;
  // Without it the guess of a case that states nothing.
  found.bulk_modulus =
      heard ? *found.slosh->bulk_modulus : numerics::normal_interval(1.3e9, 0.15 * 1.3e9);
  attempt("impulse and momentum", into, [&] {
    identification::ImpulseMomentumOptions options;
    options.random_samples = setting.random_samples;
    found.impulse = identification::impulse_momentum(campaign, options);
  });
  attempt("hydraulic resonance", into, [&] {
    found.resonance = identification::identify_resonance(campaign, found.bulk_modulus);
  });
  attempt("grey box", into, [&] {
    identification::GreyBoxOptions options;
    options.further_starts = setting.further_starts;
    options.random_samples = setting.random_samples;
    options.threads = 1;
    options.bulk_modulus_guessed = !heard;
    found.grey_box = identification::fit_grey_box(campaign, found.bulk_modulus, options);
  });
  return found;
}

void evaluate_grey_box(const RandomDrive& drive, const SimulatedCampaign& simulated,
                       const std::optional<identification::GreyBoxResult>& result,
                       CoverageCase& into) {
  const char* const method = "combined";
  const auto& curve = drive.antenna.friction.curve;
  const auto add = [&](const char* quantity, double truth) {
    std::optional<Interval> interval;
    if (result) interval = result->quantity(quantity).posterior;
    into.rows.push_back({quantity, method, truth, interval});
  };
  add("inertia", drive.inertia);
  add("inertia as recorded", simulated.inertia_as_recorded);
  add("motor to load ratio", drive.motor_inertia / (drive.inertia - drive.motor_inertia));
  add("oil stiffness", simulated.oil_stiffness);
  add("bulk modulus", drive.bulk_modulus);
  add("leakage rate", drive.leakage_rate);
  add("Coulomb level", curve.coulomb_torque + curve.saturating_torque);
  add("offset torque as recorded", simulated.offset_as_recorded);
  const auto friction = [&](const char* name, double rate) {
    std::optional<Interval> interval;
    if (result) interval = identification::friction_interval(*result, rate);
    into.rows.push_back({name, method, friction_torque(curve, rate), interval});
  };
  friction("friction at the slowest speed", simulated.speeds.front());
  friction("friction at a tenth of the limit", simulated.speeds.at(2));
  friction("friction at the fastest speed", simulated.speeds.back());
  if (!result) return;
  for (const auto& one : result->stated_numbers) {
    into.largest_departure = std::max(into.largest_departure, std::abs(one.departure));
  }
}

void evaluate_simple_methods(const RandomDrive& drive, const SimulatedCampaign& simulated,
                             const Identified& found, CoverageCase& into) {
  std::optional<Interval> inertia, leakage;
  if (found.resonance) {
    leakage = found.resonance->leakage_rate;
    if (found.resonance->best) inertia = found.resonance->best->inertia;
  }
  const char* const by_resonance = "method 2, best";
  into.rows.push_back({"inertia", by_resonance, drive.inertia, inertia});
  std::optional<Interval> stiffness;
  if (found.resonance) stiffness = found.resonance->stiffness;
  into.rows.push_back({"oil stiffness", by_resonance, simulated.oil_stiffness, stiffness});
  into.rows.push_back({"leakage rate", by_resonance, drive.leakage_rate, leakage});
  std::optional<Interval> bulk;
  if (found.slosh) bulk = found.slosh->bulk_modulus;
  into.rows.push_back({"bulk modulus", "slosh", drive.bulk_modulus, bulk});
  std::optional<Interval> true_inertia, as_recorded, offset;
  if (found.impulse && found.impulse->best) {
    const auto& best = found.impulse->estimates[*found.impulse->best];
    true_inertia = best.inertia;
    as_recorded = best.as_recorded;
  }
  if (found.impulse && found.impulse->friction) {
    offset = identification::offset_as_recorded(*found.impulse->friction);
  }
  const char* const by_impulse = "method 3, best";
  into.rows.push_back({"inertia", by_impulse, drive.inertia, true_inertia});
  into.rows.push_back(
      {"inertia as recorded", by_impulse, simulated.inertia_as_recorded, as_recorded});
  into.rows.push_back(
      {"offset torque as recorded", by_impulse, simulated.offset_as_recorded, offset});
}

}  // namespace

CoverageCase coverage_case(std::uint64_t seed, std::uint64_t number,
                           const CoverageSetting& setting) {
  CoverageCase result;
  result.seed = seed;
  result.number = number;
  const RandomDrive drive = random_drive(seed, number);
  SimulatedCampaign simulated;
  attempt("simulation", result,
          [&] { simulated = simulate_campaign(drive, seed + (number << 20U)); });
  Identified found;
  if (result.failures.empty()) found = identify(simulated.campaign, setting, result);
  if (simulated.speeds.empty()) simulated.speeds.assign(6, drive.rate_limit);
  evaluate_grey_box(drive, simulated, found.grey_box, result);
  evaluate_simple_methods(drive, simulated, found, result);
  return result;
}

}  // namespace boresight::coverage
