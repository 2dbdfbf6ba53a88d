#include <map>

#include <fmt/format.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/text_report.hpp>

namespace boresight::app {
namespace {

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

// What was guessed, once for all records that it was guessed in.
Document guesses_part(const io::CampaignNotes& notes) {
  std::map<std::string, std::vector<std::string>> guesses;
  std::vector<std::string> order;
  const auto add = [&](const std::string& sentence, const std::string& record) {
    auto& records = guesses[sentence];
    if (records.empty()) order.push_back(sentence);
    records.push_back(record);
  };
  for (const auto& record : notes.records) {
    for (const auto& source : record.sources) {
      if (source.guessed) {
        add(fmt::format("{} was taken from column '{}', by its name", source.signal, source.column),
            record.name);
      }
      if (!source.remark.empty()) {
        add(fmt::format("{} ('{}'): {}", source.signal, source.column, source.remark), record.name);
      }
    }
    if (!record.unused_columns.empty()) {
      add("not used: " + joined(record.unused_columns), record.name);
    }
    for (const auto& remark : record.remarks) add(remark, record.name);
    if (record.test_guessed) {
      add(fmt::format("the test was inferred from the data: {}", io::to_string(record.test)),
          record.name);
    }
    if (record.rate_loop_guessed) {
      add(fmt::format("the rate loop was taken as {}", record.rate_loop_closed ? "closed" : "open"),
          record.name);
    }
  }
  for (const auto& assumption : notes.assumptions) add(assumption, "");
  Document text;
  for (const auto& sentence : order) {
    const auto& records = guesses[sentence];
    std::string where;
    if (!records.front().empty()) {
      where = records.size() > 1 && records.size() == notes.records.size()
                  ? " (all records)"
                  : fmt::format(" ({})", joined(records));
    }
    text += wrapped(fmt::format("assumed: {}{}", sentence, where), "  ", "  ");
  }
  return text;
}

}  // namespace

Document document_of(const io::CampaignNotes& notes) {
  Document text = heading("Records");
  std::vector<std::vector<std::string>> rows{
      {"record", "test", "rate loop", "s", "samples/s", "rows", "defects"}};
  for (const auto& record : notes.records) {
    if (!record.refusal.empty()) {
      rows.push_back({record.name, "not used", "", "", "", fmt::format("{}", record.rows), ""});
      continue;
    }
    rows.push_back(
        {record.name, io::to_string(record.test), record.rate_loop_closed ? "closed" : "open",
         fmt::format("{:.1f}", record.duration), fmt::format("{:.6g}", 1.0 / record.sample_time),
         fmt::format("{}", record.rows), fmt::format("{}", record.defects.size())});
  }
  text += table(rows, "lllrrrr");
  for (const auto& record : notes.records) {
    if (!record.refusal.empty()) {
      text += wrapped(fmt::format("{} is not used: {}", record.name, record.refusal), "  ", "  ");
    }
    constexpr std::size_t maximum = 10;
    for (std::size_t i = 0; i < record.defects.size() && i < maximum; ++i) {
      const auto& defect = record.defects[i];
      text += wrapped(
          fmt::format("{}{}{}, {} from {:.3f} s, {} samples, {}: {}", record.name,
                      defect.channel.empty() ? "" : ", ", defect.channel,
                      identification::to_string(defect.kind), defect.first_time, defect.count,
                      identification::to_string(defect.handling), defect.explanation),
          "  ", "  ");
    }
    if (record.defects.size() > maximum) {
      text += wrapped(fmt::format("{}: {} more, all of them in the JSON report", record.name,
                                  record.defects.size() - maximum),
                      "  ");
    }
  }
  return text + guesses_part(notes);
}

}  // namespace boresight::app
