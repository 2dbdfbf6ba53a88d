#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <boresight/io/case/field.hpp>
#include <boresight/io/records/column_names.hpp>
#include <boresight/io/records/column_words.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {

bool is_named(const RecordColumn& column, const std::string& name) {
  const std::string wanted = lower(name);
  const std::string own = lower(column.name);
  const std::string unit = lower(column.unit);
  return wanted == own ||
         (!unit.empty() && (wanted == own + " [" + unit + "]" || wanted == own + "[" + unit + "]" ||
                            wanted == own + " (" + unit + ")" || wanted == own + "(" + unit + ")"));
}

std::string columns_of(const RecordTable& table) {
  constexpr std::size_t maximum = 20;
  std::vector<std::string_view> names;
  for (const RecordColumn& column : table.columns) names.push_back(column.name);
  names.resize(std::min(maximum, names.size()));
  const std::size_t more = table.columns.size() - names.size();
  return quoted_list(names) + (more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace boresight::io
