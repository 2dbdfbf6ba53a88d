#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <boresight/identification/resonance/drive_response.hpp>
#include <boresight/io/campaign/campaign_comparison.hpp>
#include <boresight/io/campaign/campaign_identification.hpp>
#include <boresight/io/campaign/channel_findings.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::io {
namespace {

using identification::Campaign;
using identification::TestKind;
using numerics::Interval;
using numerics::Uncertain;

/// Several methods at once, each telling how far it is, as one number of hundredths.
class SharedProgress {
 public:
  explicit SharedProgress(const IdentificationOptions& options) : options_(options) {}
  enum Part : std::size_t { reading, simple_methods, grey_box, hold_out, ranking };
  void tell(Part part, double fraction) {
    if (!options_.progress) return;
    const std::lock_guard lock(mutex_);
    done_.at(part) = std::max(done_.at(part), fraction * weights.at(part));
    const double sum = std::accumulate(done_.begin(), done_.end(), 0.0);
    options_.progress(static_cast<std::size_t>(std::clamp(std::round(sum), 1.0, 100.0)), 100);
  }

 private:
  static constexpr std::array<double, 5> weights{5.0, 20.0, 50.0, 20.0, 5.0};
  const IdentificationOptions& options_;
  std::mutex mutex_;
  std::array<double, 5> done_{};
};

// A method that the campaign does not allow is listed, not fatal.
template <typename Function>
void attempt(const std::string& method, std::vector<MethodFailure>& failures,
             const Function& function) {
  try {
    function();
  } catch (const InvalidInput& failure) {
    failures.push_back({method, failure.what()});
  } catch (const NumericalFailure& failure) {
    failures.push_back({method, failure.what()});
  }
}

std::vector<identification::ChannelCheck> checked_channels(const LoadedCampaign& loaded) {
  std::vector<identification::EvaluatedRecord> records;
  records.reserve(loaded.records.size());
  for (const LoadedRecord& one : loaded.records) records.push_back({&one.raw, &one.clean});
  return identification::channel_consistency(records, loaded.knowledge, loaded.instruments);
}

void run_slosh(const Campaign& campaign, CampaignSection& section) {
  bool any = false;
  for (const auto& record : campaign.records) {
    if (record.test != TestKind::slosh) continue;
    any = true;
    attempt(fmt::format("slosh, {}", record.name), section.failures, [&] {
      section.slosh.push_back(
          {record.name, identification::identify_slosh(record, campaign.knowledge)});
    });
  }
  if (!any) {
    section.failures.push_back(
        {"slosh", "no record of a slosh test (the valve opened and closed suddenly)"});
  }
}

bool is_vouched_for(const Quantity& stated) {
  return stated.uncertainty_given && stated.basis != Basis::assumed;
}

// What the case says where no line was heard to ring. A number that nobody vouches for may be off
// by the air in the oil.
Interval stated_bulk_modulus(const Case& antenna) {
  const double value = bulk_modulus(antenna);
  constexpr double by_air = 0.15;
  double uncertainty = by_air * value;
  if (const auto& stated = antenna.oil->bulk_modulus; stated && is_vouched_for(*stated)) {
    uncertainty = stated->standard_uncertainty;
  }
  return numerics::normal_interval(value, uncertainty);
}

void choose_bulk_modulus(const Case& antenna, CampaignSection& section) {
  const Interval* best = nullptr;
  for (const auto& test : section.slosh) {
    const auto& found = test.result.bulk_modulus;
    if (found && (best == nullptr || found->standard_uncertainty < best->standard_uncertainty)) {
      best = &*found;
    }
  }
  section.bulk_modulus_stated = best == nullptr;
  const auto& stated = antenna.oil->bulk_modulus;
  const bool vouched_for = stated && is_vouched_for(*stated);
  section.bulk_modulus_guessed = best == nullptr && !vouched_for;
  section.bulk_modulus = best != nullptr ? *best : stated_bulk_modulus(antenna);
}

// Slope of friction at the mean speed of the valve steps, for leakage from the rings' damping.
std::optional<Uncertain> friction_slope(const Campaign& campaign,
                                        const std::optional<identification::ImpulseMomentum>& by) {
  if (!by || !by->friction) return std::nullopt;
  const auto& fit = *by->friction;
  for (const auto& record : campaign.records) {
    if (record.test != TestKind::valve_steps) continue;
    const auto part = identification::moving_part(record);
    if (part.samples < 2) continue;
    const double rate = std::abs(record.motor_rate.values.segment(part.first, part.samples).mean());
    const double step = 0.01 * rate;
    if (!(step > 0.0)) continue;
    const Eigen::VectorXd by_parameters =
        (identification::friction_gradient(fit.curve, rate + step) -
         identification::friction_gradient(fit.curve, rate - step)) /
        (2.0 * step);
    const Eigen::Index n = by_parameters.size();
    const double variance = by_parameters.dot(fit.covariance.topLeftCorner(n, n) * by_parameters);
    return Uncertain{plant::friction_slope(fit.curve, rate), std::sqrt(std::max(0.0, variance))};
  }
  return std::nullopt;
}

void run_simple_methods(const Campaign& campaign, const IdentificationOptions& options,
                        SharedProgress& progress, CampaignSection& section,
                        std::vector<MethodFailure>& failures) {
  attempt("impulse and momentum", failures, [&] {
    identification::ImpulseMomentumOptions impulse;
    impulse.seed = options.seed;
    section.impulse = identification::impulse_momentum(campaign, impulse);
  });
  progress.tell(SharedProgress::simple_methods, 0.5);
  attempt("hydraulic resonance", failures, [&] {
    identification::ResonanceOptions resonance;
    resonance.friction_slope = friction_slope(campaign, section.impulse);
    section.resonance =
        identification::identify_resonance(campaign, section.bulk_modulus, resonance);
  });
  progress.tell(SharedProgress::simple_methods, 1.0);
}

void run_grey_box(const Campaign& campaign, const IdentificationOptions& options,
                  SharedProgress& progress, CampaignSection& section,
                  std::vector<MethodFailure>& failures) {
  attempt("grey box", failures, [&] {
    identification::GreyBoxOptions grey;
    grey.seed = options.seed;
    grey.threads = options.threads;
    grey.progress = [&](const std::string&, double fraction) {
      progress.tell(SharedProgress::grey_box, fraction);
      return true;
    };
    grey.bulk_modulus_guessed = section.bulk_modulus_guessed;
    section.grey_box = identification::fit_grey_box(campaign, section.bulk_modulus, grey);
  });
  progress.tell(SharedProgress::grey_box, 1.0);
}

// Small steps are nearest to what the antenna does in service.
const identification::DriveRecord* record_to_hold_out(const Campaign& campaign) {
  if (campaign.records.size() < 3) return nullptr;
  for (const auto kind : {TestKind::valve_steps, TestKind::valve_chirp, TestKind::fast_ramp}) {
    for (const auto& record : campaign.records) {
      if (record.test == kind && record.valve_command && !record.inlet_pressure.empty()) {
        return &record;
      }
    }
  }
  return nullptr;
}

void run_hold_out(const Campaign& campaign, const IdentificationOptions& options,
                  SharedProgress& progress, CampaignSection& section,
                  std::vector<MethodFailure>& failures) {
  if (const auto* record = record_to_hold_out(campaign)) {
    attempt(fmt::format("predicting {}", record->name), failures, [&] {
      identification::GreyBoxOptions grey;
      grey.seed = options.seed;
      grey.threads = options.threads;
      grey.further_starts = 0;
      grey.random_samples = 100;
      grey.progress = [&](const std::string&, double fraction) {
        progress.tell(SharedProgress::hold_out, fraction);
        return true;
      };
      grey.bulk_modulus_guessed = section.bulk_modulus_guessed;
      section.hold_out = HoldOut{
          record->name,
          identification::hold_out_record(campaign, record->name, section.bulk_modulus, grey)};
    });
  }
  progress.tell(SharedProgress::hold_out, 1.0);
}

void require_something(const CampaignSection& section) {
  const bool resonance = section.resonance && section.resonance->best;
  if (section.grey_box || section.impulse || resonance) return;
  std::string reasons;
  for (const auto& record : section.notes.records) {
    if (!record.refusal.empty()) {
      reasons += fmt::format("; {} not used: {}", record.name, record.refusal);
    }
  }
  for (const auto& failure : section.failures) {
    reasons += fmt::format("; {}: {}", failure.method, failure.reason);
  }
  throw NumericalFailure(
      fmt::format("the records of this campaign give no inertia by any method{}", reasons));
}

}  // namespace

CampaignSection identify_campaign(const Case& antenna, const IdentificationOptions& options) {
  return identify_campaign(antenna, load_campaign(antenna, options.threads), options);
}

CampaignSection identify_campaign(const Case& antenna, LoadedCampaign loaded,
                                  const IdentificationOptions& options) {
  CampaignSection section;
  SharedProgress progress(options);
  section.channels = checked_channels(loaded);
  const Campaign campaign = make_campaign(antenna, std::move(loaded), section.notes);
  section.knowledge = campaign.knowledge;
  section.instruments = campaign.instruments;
  progress.tell(SharedProgress::reading, 0.5);
  run_slosh(campaign, section);
  choose_bulk_modulus(antenna, section);
  progress.tell(SharedProgress::reading, 1.0);

  // Each with a list of failures of its own: their order must not depend on the threads.
  std::array<std::vector<MethodFailure>, 3> failures;
  numerics::for_each_index(3, options.threads, [&](std::size_t which) {
    if (which == 0) {
      run_grey_box(campaign, options, progress, section, failures[0]);
    } else if (which == 1) {
      run_simple_methods(campaign, options, progress, section, failures[1]);
    } else {
      run_hold_out(campaign, options, progress, section, failures[2]);
    }
  });
  for (const auto& some : {failures[1], failures[0], failures[2]}) {
    section.failures.insert(section.failures.end(), some.begin(), some.end());
  }
  require_something(section);
  if (section.grey_box) {
    attempt("gain of further tests", section.failures, [&] {
      section.test_gains = identification::rank_tests(*section.grey_box, campaign, "inertia");
    });
  } else {
    average_methods(section);
  }
  progress.tell(SharedProgress::ranking, 1.0);
  if (section.grey_box) section.contradiction = contradiction_with_case(*section.grey_box);
  if (std::string channels = channel_contradiction(section); !channels.empty()) {
    if (!section.contradiction.empty()) channels += " " + section.contradiction;
    section.contradiction = std::move(channels);
  }
  section.inertia = inertia_rows(section, antenna);
  section.quantities = quantity_rows(section);
  section.friction = friction_rows(section, campaign);
  section.not_identifiable = not_identifiable(section);
  section.contradictions = contradictions(section, antenna);
  return section;
}

}  // namespace boresight::io
