#pragma once

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/one_record.hpp"

namespace boresight::io {

/// Spoils the cells of a row; `header` names the columns without their units.
using Spoil =
    std::function<void(const std::vector<std::string>& header, std::vector<std::string>& cells)>;

inline std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

inline std::string& cell(const std::vector<std::string>& header, std::vector<std::string>& cells,
                         const std::string& column) {
  const auto at = std::ranges::find(header, column);
  if (at == header.end()) throw InvalidInput("no column " + column);
  return cells.at(static_cast<std::size_t>(at - header.begin()));
}

/// A campaign of these records, of which those of `spoiled` are. `further`: columns that the
/// spoiling appends to each row, ",name [unit]".
inline Case broken_campaign(const std::string& campaign, const std::vector<std::string>& records,
                            const std::vector<std::string>& spoiled, const Spoil& spoil,
                            const std::string& further = "") {
  const auto among = [](const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  Case antenna = case_of(campaign);
  std::erase_if(antenna.campaign->records,
                [&](const RecordEntry& entry) { return !among(records, entry.name); });
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  for (RecordEntry& entry : antenna.campaign->records) {
    if (!among(spoiled, entry.name)) continue;
    std::ifstream source(folder_of(campaign) + "/" + entry.file);
    entry.file = testing::TempDir() + "/" + test + "_" + entry.name + ".csv";
    std::ofstream target(entry.file);
    std::string line;
    std::getline(source, line);
    line += further;
    target << line << "\n";
    std::vector<std::string> header = cells_of(line);
    for (std::string& name : header) name.resize(std::min(name.find(' '), name.size()));
    while (std::getline(source, line)) {
      std::vector<std::string> cells = cells_of(line);
      spoil(header, cells);
      for (std::size_t i = 0; i < cells.size(); ++i) target << (i == 0 ? "" : ",") << cells[i];
      target << "\n";
    }
  }
  return antenna;
}

}  // namespace boresight::io
