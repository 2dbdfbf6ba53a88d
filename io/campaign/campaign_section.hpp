#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/identification/grey_box/grey_box_hold_out.hpp>
#include <boresight/identification/grey_box/grey_box_information_gain.hpp>
#include <boresight/identification/impulse/impulse_momentum.hpp>
#include <boresight/identification/lines/slosh.hpp>
#include <boresight/identification/records/channel_consistency.hpp>
#include <boresight/identification/resonance/hydraulic_resonance.hpp>
#include <boresight/io/campaign/campaign.hpp>

namespace boresight::io {

/// What one slosh test gave.
struct SloshTest {
  std::string record;
  identification::SloshResult result;
};

/// A method that this campaign does not allow, and why.
struct MethodFailure {
  std::string method;
  std::string reason;
};

/// Difference of another estimate from the combined one.
struct Difference {
  double relative = 0.0;    // over the combined value
  double normalised = 0.0;  // over both standard uncertainties' root sum of squares
};

/// A method's reflected inertia, compared with the combined estimate.
struct InertiaRow {
  std::string name;
  /// Whether this is one of the founding paper's own procedures.
  bool of_the_paper = false;
  numerics::Interval inertia;  // kg m2
  /// All motors over everything else, eq. 27; upper end infinite where the inertia's interval
  /// reaches the motors' own.
  numerics::Interval motor_to_load_ratio;
  std::optional<Difference> difference;  // where there is a combined inertia
  std::string assumes;
  /// Causes of its difference from the combined estimate of the inertia, in words and numbers.
  std::string why;
};

/// Another estimate of a quantity that has a combined one.
struct QuantityRow {
  std::string quantity;  // as GreyBoxQuantity::name
  std::string unit;
  std::string method;
  numerics::Interval interval;
  std::optional<Difference> difference;
};

/// Friction at one motor speed, N m.
struct FrictionRow {
  double rate = 0.0;                           // rad/s of motor
  bool tracking = false;                       // at which the antenna follows a star
  bool extrapolated = false;                   // slower or faster than the constant-speed tests
  std::optional<numerics::Interval> combined;  // grey box
  std::optional<numerics::Interval> curve;     // curve fitted to all tests' windows
  std::optional<numerics::Interval> tested;    // constant-speed test at this speed
};

/// A number of the case that the records contradict.
struct Contradiction {
  std::string key;            // of the case, or the [[stated]] id
  std::string stated;         // as written
  bool assumed = false;       // the case says itself that it assumes it
  double stated_value = 0.0;  // SI
  double stated_uncertainty = 0.0;
  std::string unit;
  numerics::Interval records;
  std::string by;  // which method
  /// Records less stated, over both standard uncertainties' root sum of squares.
  double normalised = 0.0;
};

/// A record that was not fitted, and how well the drive fitted to the others predicts it.
struct HoldOut {
  std::string record;
  identification::GreyBoxHoldOut result;
};

/// What the records of a campaign say.
struct CampaignSection {
  CampaignNotes notes;
  identification::DriveKnowledge knowledge;
  identification::Instruments instruments;
  /// What each channel must be for the others to be right.
  std::vector<identification::ChannelCheck> channels;
  std::vector<SloshTest> slosh;
  /// Of the slosh test with the smallest uncertainty; without one what the case states, and then
  /// `bulk_modulus_stated`.
  numerics::Interval bulk_modulus;  // Pa
  bool bulk_modulus_stated = false;
  /// Stated, but nobody vouches for it: records may contradict it.
  bool bulk_modulus_guessed = false;
  std::optional<identification::ResonanceResult> resonance;
  std::optional<identification::ImpulseMomentum> impulse;
  /// The combined estimate: one model that explains all records. A plant ensemble uses its samples.
  std::optional<identification::GreyBoxResult> grey_box;
  /// In its place where it could not be had: the random-effects mean of the methods,
  /// unless they contradict one another significantly.
  std::optional<identification::CombinedInertia> mean_of_methods;
  std::optional<HoldOut> hold_out;  // where a record has a valve command and others are left
  std::vector<MethodFailure> failures;
  /// Sentences where channels contradict one another, where records contradict stated numbers or
  /// where methods contradict one another significantly; otherwise empty.
  std::string contradiction;
  /// Quantities that these records do not determine.
  std::vector<std::string> not_identifiable;
  std::vector<InertiaRow> inertia;
  std::vector<QuantityRow> quantities;
  std::vector<FrictionRow> friction;
  std::vector<identification::GreyBoxInformationGain> test_gains;  // by gain for the inertia
  std::vector<Contradiction> contradictions;
};

}  // namespace boresight::io
