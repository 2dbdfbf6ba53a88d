#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <boresight/io/description/visitor.hpp>

namespace boresight::app {

/// The described numbers of one result that tables show: headings with their unit, and cells;
/// "none" where there is no finite number.
struct TableColumns {
  std::vector<std::string> headings, cells;  // of one length
};

/// Collects them.
class TableColumnVisitor final : public io::Visitor {
 public:
  bool by_example() const override { return false; }

  TableColumns columns;

 protected:
  void on_number(const io::Member& member, const std::optional<double>& value,
                 const io::KeyUnit& unit, const io::NumberForm& form) override;
};

/// Those of a described result.
template <typename Result>
TableColumns columns_of(const Result& result) {
  TableColumnVisitor visitor;
  describe(visitor, result);
  return std::move(visitor.columns);
}

}  // namespace boresight::app
