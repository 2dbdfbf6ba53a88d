#include <cmath>

#include <fmt/format.h>

#include <boresight/app/report/table_columns.hpp>

namespace boresight::app {

void TableColumnVisitor::on_number(const io::Member& /*member*/, const std::optional<double>& value,
                                   const io::KeyUnit& unit, const io::NumberForm& form) {
  if (form.column.heading.empty()) return;
  const double shown = value ? form.column.multiplier * io::in_unit(*value, unit) : NAN;
  columns.headings.emplace_back(form.column.heading);
  columns.cells.push_back(std::isfinite(shown) ? fmt::format("{:.{}f}", shown, form.column.decimals)
                                               : "none");
}

}  // namespace boresight::app
