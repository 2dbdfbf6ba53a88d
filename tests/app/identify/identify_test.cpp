#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program_run.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/io/campaign/campaign_comparison.hpp>
#include <boresight/io/campaign/campaign_identification.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::app {
namespace {

using numerics::Interval;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::string folder(const std::string& campaign) {
  return std::string(BORESIGHT_CAMPAIGNS) + "/" + campaign + "/";
}

/// A campaign's case with these records only, and with one text replaced.
io::Case campaign_case(const std::string& campaign, const std::vector<std::string>& records = {},
                       const std::string& old = {}, const std::string& replacement = {}) {
  const std::string path = folder(campaign) + "case.toml";
  std::string text = content_of(path);
  const std::string mark = "[[record]]";
  std::string kept = text.substr(0, text.find(mark));
  for (std::size_t at = text.find(mark); at != std::string::npos;) {
    const std::size_t next = text.find(mark, at + 1);
    const std::string entry = text.substr(at, next - at);
    const bool wanted = std::any_of(records.begin(), records.end(), [&](const std::string& name) {
      return entry.find("\"" + name + ".csv\"") != std::string::npos;
    });
    if (records.empty() || wanted) kept += entry;
    at = next;
  }
  if (!old.empty()) {
    const std::size_t at = kept.find(old);
    if (at == std::string::npos) throw std::runtime_error("not in the case: " + old);
    kept.replace(at, old.size(), replacement);
  }
  return io::parse_case(kept, path);
}

nlohmann::json truth_of(const std::string& campaign) {
  return nlohmann::json::parse(content_of(folder(campaign) + "truth.json"));
}

double true_friction(const nlohmann::json& truth, double rate) {
  const auto& controller = truth["friction"];
  const double fc = controller["Fc"], fs = controller["Fs"], vs = controller["vs"],
               a = controller["A"], v1 = controller["v1"], b = controller["b"];
  return fc + (fs - fc) * std::exp(-std::pow(rate / vs, 2)) + a * (1.0 - std::exp(-rate / v1)) +
         b * rate;
}

void expect_close_and_covered(const Interval& found, double truth, double fraction,
                              const std::string& what) {
  EXPECT_NEAR(found.value, truth, fraction * std::abs(truth)) << what;
  EXPECT_LE(found.lower, truth) << what;
  EXPECT_GE(found.upper, truth) << what;
}

void expect_truth(const io::CampaignSection& section, const std::string& campaign) {
  const auto truth = truth_of(campaign);
  ASSERT_TRUE(section.grey_box);
  const auto check = [&](const char* quantity, const char* key, double fraction) {
    expect_close_and_covered(section.grey_box->quantity(quantity).posterior, truth[key], fraction,
                             quantity);
  };
  check("inertia", "reflected_inertia", 0.02);
  check("inertia as recorded", "reflected_inertia_as_recorded", 0.02);
  check("motor to load ratio", "motor_to_load_ratio", 0.06);
  check("oil stiffness", "hydraulic_stiffness", 0.03);
  check("bulk modulus", "bulk_modulus", 0.01);
  check("leakage rate", "leakage_rate_1_per_s", 0.15);
  check("offset torque as recorded", "offset_torque_as_recorded", 0.05);
  check("Coulomb level", "coulomb_from_line_through_high_speeds", 0.05);
  int tested = 0;
  for (const auto& row : section.friction) {
    if (row.extrapolated) continue;
    ASSERT_TRUE(row.combined);
    EXPECT_NEAR(row.combined->value, true_friction(truth, row.rate),
                0.05 * true_friction(truth, row.rate))
        << row.rate;
    ++tested;
  }
  EXPECT_GE(tested, 6);
}

const io::InertiaRow& row_named(const io::CampaignSection& section, const std::string& name) {
  for (const auto& row : section.inertia) {
    if (row.name.find(name) != std::string::npos) return row;
  }
  throw std::runtime_error("no method " + name);
}

std::string failures_of(const io::CampaignSection& section) {
  std::string all;
  for (const auto& failure : section.failures) all += failure.method + ": " + failure.reason + "\n";
  return all;
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string all;
  for (const auto& sentence : sentences) all += sentence + "\n";
  return all;
}

Report report_of(io::CampaignSection section) {
  Report report;
  report.command = "identify";
  report.campaign = std::move(section);
  return report;
}

#ifdef __SANITIZE_ADDRESS__
constexpr bool under_sanitizers = true;
#else
constexpr bool under_sanitizers = false;
#endif
constexpr const char* too_slow =
    "minutes under sanitizers, which see the same code with fewer records";

TEST(IdentifyCampaign, FindsTheTruthByThePapersTestsAndSaysWhyItsMethodsMissIt) {
  if (under_sanitizers) GTEST_SKIP() << too_slow;
  const io::Case antenna = campaign_case("paper-like");
  const io::CampaignSection section = identify_campaign(antenna, {});
  expect_truth(section, "paper-like");
  const double truth = truth_of("paper-like")["reflected_inertia"];

  const io::InertiaRow& spectrum = row_named(section, "spectrum's peak");
  EXPECT_TRUE(spectrum.of_the_paper);
  for (const auto* reason : {"Harmonic lock", "flexibility", "Efficiency convention"}) {
    EXPECT_THAT(spectrum.why, HasSubstr(reason));
  }
  // What a harmonic says of the mode is next to nothing: its interval has to show it.
  EXPECT_GT(spectrum.inertia.upper / spectrum.inertia.lower, 3.0);
  const io::InertiaRow& line = row_named(section, "two windows, straight line");
  EXPECT_TRUE(line.of_the_paper);
  EXPECT_THAT(line.why, HasSubstr("straight-line friction"));
  EXPECT_LT(line.inertia.value, 0.95 * truth);  // the known bias
  EXPECT_GT(line.inertia.upper, truth);
  const io::InertiaRow& curve = row_named(section, "whole records, curve");
  EXPECT_NEAR(curve.inertia.value, truth, 0.02 * truth);
  EXPECT_FALSE(curve.of_the_paper);

  // Nothing in this campaign rings about a moving operating point.
  EXPECT_THAT(joined(section.not_identifiable), HasSubstr("mode's damping is not identifiable"));
  EXPECT_EQ(failures_of(section), "");

  const std::string text = to_text(report_of(section));
  for (const auto* part : {"Drive parameters from the records", "combined (grey box)",
                           "* spectrum's peak", "two Coulomb levels", "Records"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  std::istringstream lines(text);
  for (std::string one; std::getline(lines, one);) EXPECT_LE(one.size(), 110U) << one;
}

TEST(IdentifyCampaign, FindsTheTruthOfAnotherAntennaInOtherUnits) {
  if (under_sanitizers) GTEST_SKIP() << too_slow;
  const io::CampaignSection section = identify_campaign(campaign_case("small-dish"), {});
  expect_truth(section, "small-dish");
  const auto truth = truth_of("small-dish");
  EXPECT_EQ(failures_of(section), "");
  EXPECT_EQ(joined(section.not_identifiable), "");
  EXPECT_FALSE(section.bulk_modulus_stated);
  ASSERT_TRUE(section.resonance && section.resonance->frequency);
  // A rigid single mass reads high by what the antenna bends.
  EXPECT_GT(row_named(section, "valve steps, K/(2 pi f)^2").inertia.lower,
            truth["reflected_inertia"].get<double>());
  EXPECT_EQ(section.test_gains.size(), 8U);
  ASSERT_TRUE(section.hold_out);
  EXPECT_EQ(section.hold_out->record, "valve_steps");
  EXPECT_LT(section.hold_out->result.error.rate_error, 0.3);
  EXPECT_LT(section.hold_out->result.error.torque_error, 0.3);
}

const std::vector<std::string> few{"constant_speed_0.02deg_s", "constant_speed_0.14deg_s"};

TEST(IdentifyCampaign, GivesTheSameForAnyNumberOfThreads) {
  const io::Case antenna = campaign_case("small-dish", few);
  std::string first;
  for (const unsigned threads : {1U, 3U}) {
    io::IdentificationOptions options;
    options.threads = threads;
    const std::string json = to_json(report_of(identify_campaign(antenna, options)));
    if (first.empty()) first = json;
    EXPECT_TRUE(json == first) << threads << " threads";
  }
  EXPECT_TRUE(nlohmann::json::accept(first));
}

TEST(IdentifyCampaign, SaysWhatACampaignLacksAndDoesTheRest) {
  const io::CampaignSection section = identify_campaign(campaign_case("small-dish", few), {});
  EXPECT_THAT(failures_of(section), HasSubstr("slosh: no record of a slosh test"));
  EXPECT_TRUE(section.bulk_modulus_stated);
  EXPECT_DOUBLE_EQ(section.bulk_modulus.value, 1.3e9);
  // The case only assumes it: nobody vouches for its digits.
  EXPECT_GT(section.bulk_modulus.standard_uncertainty, 0.1e9);
  EXPECT_THAT(joined(section.not_identifiable), HasSubstr("No slosh test shows the lines ringing"));
  ASSERT_TRUE(section.grey_box);
  // Pressures against flow show the oil's spring all the same.
  EXPECT_EQ(verdict(section, section.grey_box->quantity("oil stiffness")), "identified");
  const double truth = truth_of("small-dish")["reflected_inertia"];
  const auto inertia = section.grey_box->quantity("inertia").posterior;
  EXPECT_LT(inertia.lower, truth);
  EXPECT_GT(inertia.upper, truth);
  EXPECT_THAT(to_text(document_of(section)), HasSubstr("slosh: not done."));
}

TEST(IdentifyCampaign, ListsTheCasesNumbersThatTheRecordsContradict) {
  const std::string old =
      R"(bulk_modulus = { value = "1.3 GPa", basis = "assumed", source = "to be identified from the records" })";
  const std::vector<std::string> records{"slosh", few[1]};
  const auto contradicted = [&](const std::string& bulk_modulus) {
    const io::Case antenna =
        campaign_case("small-dish", records, old,
                      "bulk_modulus = { value = \"" + bulk_modulus +
                          "\", uncertainty = \"1 %\", "
                          "uncertainty_source = \"data sheet\", basis = \"published\" }");
    return identify_campaign(antenna, {}).contradictions;
  };
  const auto wrong = contradicted("1.60 GPa");
  ASSERT_THAT(wrong, Contains(testing::Field(&io::Contradiction::key, "oil.bulk_modulus")));
  const auto found = std::find_if(wrong.begin(), wrong.end(), [](const io::Contradiction& one) {
    return one.key == "oil.bulk_modulus";
  });
  EXPECT_EQ(found->stated, "1.60 GPa");
  EXPECT_FALSE(found->assumed);
  EXPECT_LT(found->normalised, -5.0);
  EXPECT_THAT(contradicted("1.38 GPa"),
              Not(Contains(testing::Field(&io::Contradiction::key, "oil.bulk_modulus"))));
}

TEST(IdentifyCampaign, StopsWhenProgressSaysSo) {
  io::IdentificationOptions options;
  options.progress = [](std::size_t done, std::size_t all) {
    EXPECT_GT(done, 0U);
    EXPECT_LE(done, all);
    if (done > 5) throw Interrupted("stop");
  };
  EXPECT_THROW(identify_campaign(campaign_case("small-dish", few), options), Interrupted);
}

TEST(IdentifyCampaign, SaysThatLeakageIsNotIdentifiableFromASloshTestWithoutValveCommand) {
  const io::CampaignSection section = identify_campaign(campaign_case("paper-like", {"slosh"}), {});
  const auto truth = truth_of("paper-like");
  ASSERT_TRUE(section.grey_box);
  const auto& leakage = section.grey_box->quantity("leakage rate");
  EXPECT_FALSE(leakage.identified);
  EXPECT_LT(leakage.posterior.lower, truth["leakage_rate_1_per_s"].get<double>());
  EXPECT_GT(leakage.posterior.upper, 5.0 * truth["leakage_rate_1_per_s"].get<double>());
  EXPECT_EQ(verdict(section, leakage), "not identifiable");
  EXPECT_THAT(joined(section.not_identifiable), HasSubstr("leakage rate is not identifiable"));
  EXPECT_THAT(joined(section.not_identifiable), HasSubstr("Friction speed by speed"));
  EXPECT_THAT(failures_of(section), HasSubstr("impulse and momentum: "));
  EXPECT_EQ(verdict(section, section.grey_box->quantity("bulk modulus")), "slosh");
}

TEST(IdentifyCampaign, IsPointedToByTheAudit) {
  const auto audit = run_program({"audit", folder("small-dish") + "case.toml"});
  EXPECT_EQ(audit.exit_code, 0) << audit.errors;
  EXPECT_THAT(audit.output, HasSubstr("the case's 11 records"));
  EXPECT_THAT(audit.output, HasSubstr("boresight identify"));
}

TEST(MotorToLoadRatio, HasNoUpperEndWhereTheIntervalReachesTheMotors) {
  identification::DriveKnowledge knowledge;
  knowledge.motor_count = 4.0;
  knowledge.motor_inertia = {0.3, 0.0};
  const Interval ratio = io::motor_to_load_ratio(knowledge, {1.8, 0.1, 1.6, 2.0});
  EXPECT_DOUBLE_EQ(ratio.value, 2.0);
  EXPECT_DOUBLE_EQ(ratio.lower, 1.5);
  EXPECT_DOUBLE_EQ(ratio.upper, 3.0);
  EXPECT_TRUE(std::isinf(io::motor_to_load_ratio(knowledge, {1.3, 0.1, 1.1, 1.5}).upper));
}

}  // namespace
}  // namespace boresight::app
