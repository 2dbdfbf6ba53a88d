#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/report/servo_record_wording.hpp>

namespace boresight::app {

std::vector<std::string> reading_of(const io::ServoRecordNotes& notes) {
  std::vector<std::string> sentences;
  for (const auto& source : notes.sources) {
    if (source.column.empty()) continue;
    sentences.push_back(fmt::format("{}: column '{}'{}{}{}", source.signal, source.column,
                                    source.unit.empty() ? "" : " in " + source.unit,
                                    source.guessed ? ", by its name" : "",
                                    source.remark.empty() ? "" : "; " + source.remark));
  }
  if (!notes.unused_columns.empty()) {
    sentences.push_back(fmt::format("not used: {}", fmt::join(notes.unused_columns, ", ")));
  }
  for (const auto& defect : notes.defects) {
    sentences.push_back(fmt::format("{}{}, {} samples from {:.6g} s, {}: {}",
                                    defect.channel.empty() ? "" : defect.channel + ": ",
                                    to_string(defect.kind), defect.count, defect.first_time,
                                    to_string(defect.handling), defect.explanation));
  }
  sentences.insert(sentences.end(), notes.remarks.begin(), notes.remarks.end());
  return sentences;
}

}  // namespace boresight::app
