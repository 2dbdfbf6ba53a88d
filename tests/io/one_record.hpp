#pragma once

#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <boresight/io/campaign/campaign.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {

inline std::string folder_of(const std::string& campaign) {
  return std::string(BORESIGHT_CAMPAIGNS) + "/" + campaign;
}

inline Case case_of(const std::string& campaign) {
  return read_case(folder_of(campaign) + "/case.toml");
}

// The whole of a campaign with one record of it, whose text is edited.
struct OneRecord {
  explicit OneRecord(const std::string& campaign, const std::string& record)
      : antenna(case_of(campaign)) {
    std::erase_if(antenna.campaign->records,
                  [&](const RecordEntry& entry) { return entry.name != record; });
    std::ifstream file(folder_of(campaign) + "/" + record + ".csv");
    std::stringstream content;
    content << file.rdbuf();
    text = content.str();
    // A name for each test: they run side by side.
    path = testing::TempDir() + "/" +
           testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
    antenna.campaign->records.at(0).file = path;
  }
  identification::Campaign make() {
    std::ofstream(path) << text;
    notes = {};
    return make_campaign(antenna, notes);
  }
  std::string refusal() {
    try {
      make();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  }
  void replace(const std::string& old, const std::string& replacement) {
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    text.replace(at, old.size(), replacement);
  }
  Case antenna;
  std::string text, path;
  CampaignNotes notes;
};

}  // namespace boresight::io
