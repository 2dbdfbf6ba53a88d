#include <cmath>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/one_record.hpp"
#include <boresight/io/campaign/campaign_identification.hpp>
#include <boresight/io/case/case_campaign.hpp>

namespace boresight::io {
namespace {

using testing::Contains;
using testing::HasSubstr;

// A record with its second column, the inlet pressure of motor 1, at one value.
void write_dead(const std::string& from, const std::string& to) {
  std::ifstream source(from);
  std::ofstream target(to);
  std::string line;
  std::getline(source, line);
  target << line << "\n";
  while (std::getline(source, line)) {
    const std::size_t first = line.find(',');
    target << line.substr(0, first + 1) << "14.7" << line.substr(line.find(',', first + 1)) << "\n";
  }
}

TEST(DeadPressure, LeavesTheCampaignItsMethodsAndIsSaid) {
  Case antenna = case_of("small-dish");
  std::erase_if(antenna.campaign->records, [](const RecordEntry& entry) {
    return entry.name != "slosh" && entry.name != "valve_steps" &&
           entry.name != "constant_speed_0.02deg_s" && entry.name != "constant_speed_0.22deg_s";
  });
  for (RecordEntry& record : antenna.campaign->records) {
    const std::string dead = testing::TempDir() + "/dead_" + record.name + ".csv";
    write_dead(folder_of("small-dish") + "/" + record.file, dead);
    record.file = dead;
  }
  const CampaignSection section = identify_campaign(antenna, {});
  EXPECT_TRUE(section.impulse);
  ASSERT_TRUE(section.grey_box);
  std::ifstream file(folder_of("small-dish") + "/truth.json");
  const double truth = nlohmann::json::parse(file)["reflected_inertia"];
  EXPECT_NEAR(section.inertia.front().inertia.value, truth, 0.03 * truth);
  EXPECT_LT(section.inertia.front().inertia.lower, truth);
  EXPECT_GT(section.inertia.front().inertia.upper, truth);
  // The slosh test has the other three lines.
  ASSERT_EQ(section.slosh.size(), 1U);
  EXPECT_NEAR(section.bulk_modulus.value, 1.38e9, 0.02 * 1.38e9);
  EXPECT_FALSE(section.bulk_modulus_stated);
  EXPECT_THAT(section.notes.assumptions,
              Contains(HasSubstr("a dead pressure was replaced by the mean of the other motors'")));
  for (const RecordNotes& note : section.notes.records) {
    EXPECT_EQ(note.refusal, "");
    ASSERT_FALSE(note.defects.empty());
    EXPECT_EQ(note.defects.front().kind, identification::DefectKind::dead_channel);
  }
}

}  // namespace
}  // namespace boresight::io
