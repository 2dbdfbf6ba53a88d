#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <boresight/app/figures/axis_ticks.hpp>
#include <boresight/app/figures/figure_csv.hpp>
#include <boresight/app/figures/figure_json.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

Figure example() {
  Figure figure;
  figure.id = "example";
  figure.section = "Section";
  figure.x = {"frequency", "Hz", AxisScale::logarithmic, {}};
  figure.panels.resize(2);
  figure.panels[0].y = {"magnitude", "dB"};
  figure.panels[1].y = {"phase", "deg"};
  for (auto& panel : figure.panels) {
    FigureSeries series{"one, \"two\""};
    for (int i = 0; i < 40; ++i) {
      series.x.push_back(0.01 * std::pow(1.37, i));
      series.y.push_back(i == 7 ? std::nan("") : std::sin(i) * std::pow(10.0, i % 9 - 4));
      series.y_lower.push_back(series.y.back() - 1.0 / 3.0);
      series.y_upper.push_back(series.y.back() + 1.0 / 3.0);
    }
    panel.series = {series,
                    {"points", SeriesStyle::points, {1.0}, {2.0}, {}, {}, {}, {}, {"a\nb"}}};
  }
  return figure;
}

// RFC 4180.
std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const char c = csv[i];
    if (quoted && c == '"' && i + 1 < csv.size() && csv[i + 1] == '"') {
      rows.back().back() += csv[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!quoted && c == '\n') {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

TEST(FigureCsv, HoldsTheNumbersOfTheJson) {
  const Figure figure = example();
  const auto rows = rows_of(to_csv(figure));
  const auto json = figures_json({figure}).at(0);
  ASSERT_EQ(rows.front(), (std::vector<std::string>{"panel", "series", "frequency [Hz]", "y",
                                                    "y lower", "y upper", "label"}));
  std::size_t row = 1;
  for (const auto& panel : json.at("panels")) {
    for (const auto& series : panel.at("series")) {
      for (std::size_t i = 0; i < series.at("x").size(); ++i, ++row) {
        ASSERT_LT(row, rows.size());
        ASSERT_EQ(rows[row].size(), rows[0].size());
        EXPECT_EQ(rows[row][1], series.at("name"));
        EXPECT_EQ(std::stod(rows[row][2]), series.at("x")[i].get<double>());
        const auto same = [&](std::size_t column, const char* key) {
          if (!series.contains(key) || series.at(key)[i].is_null()) {
            EXPECT_EQ(rows[row][column], "");
          } else {
            EXPECT_EQ(std::stod(rows[row][column]), series.at(key)[i].get<double>());
          }
        };
        same(3, "y");
        same(4, "y_lower");
        same(5, "y_upper");
      }
    }
  }
  EXPECT_EQ(row, rows.size());
  EXPECT_EQ(rows[1][0], "magnitude [dB]");
  EXPECT_EQ(rows.back()[0], "phase [deg]");
  EXPECT_EQ(rows.back()[6], "a\nb");
}

TEST(FigureCsv, NamesTheUnitInTheHeaderWherePanelsShareIt) {
  Figure figure = example();
  figure.panels[1].y = figure.panels[0].y;
  EXPECT_EQ(rows_of(to_csv(figure))[0][3], "magnitude [dB]");
}

TEST(FigureCsv, IsWrittenOneFileAFigure) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "boresight_curves" / "inner";
  std::filesystem::remove_all(folder.parent_path());
  write_curves({example()}, folder.string());
  std::ifstream file(folder / "example.csv", std::ios::binary);
  std::stringstream content;
  content << file.rdbuf();
  EXPECT_EQ(content.str(), to_csv(example()));
  EXPECT_THROW(write_curves({example()}, (folder / "example.csv").string()), InvalidInput);
  std::filesystem::remove_all(folder.parent_path());
}

TEST(FigureJson, KeepsSixDigitsAndWritesGapsAsNull) {
  Figure figure = example();
  figure.panels[0].series[0].y[3] = 1.0 / 3.0;
  figure.panels[0].series[0].y[4] = std::numeric_limits<double>::infinity();
  const auto json = figures_json({figure}).at(0);
  const auto& y = json.at("panels")[0].at("series")[0].at("y");
  EXPECT_EQ(y[3].get<double>(), 0.333333);
  EXPECT_TRUE(y[4].is_null());
  EXPECT_TRUE(y[7].is_null());
  EXPECT_EQ(json.at("x").at("scale"), "logarithmic");
}

// Two digits at most, the first of them 1, 2 or 5 (times the step's multiple).
void expect_round(const std::vector<double>& ticks, double step_digits) {
  ASSERT_GE(ticks.size(), 2U);
  const double step = ticks[1] - ticks[0];
  const double power = std::pow(10.0, std::floor(std::log10(step * (1.0 + 1e-9))));
  const double digit = step / power;
  EXPECT_TRUE(std::abs(digit - 1.0) < 1e-6 || std::abs(digit - 2.0) < 1e-6 ||
              std::abs(digit - 5.0) < 1e-6)
      << step << " " << step_digits;
  for (const double tick : ticks) {
    EXPECT_NEAR(std::round(tick / step), tick / step, 1e-6);
  }
}

TEST(AxisTicks, AreRoundAndSome) {
  for (double span = 1e-9; span < 1e9; span *= 1.73) {
    for (const double offset : {-2.3, -0.4, 0.0, 0.7, 31.0}) {
      const double from = offset * span, to = from + span;
      const auto ticks = axis_ticks({}, from, to, 6);
      expect_round(ticks.major, span);
      EXPECT_GE(ticks.major.size(), 3U);
      EXPECT_LE(ticks.major.size(), 10U);
      EXPECT_EQ(ticks.major.size(), ticks.labels.size());
      EXPECT_GE(ticks.major.front(), from - 1e-6 * span);
      EXPECT_LE(ticks.major.back(), to + 1e-6 * span);
      for (std::size_t i = 1; i < ticks.labels.size(); ++i) {
        EXPECT_NE(ticks.labels[i], ticks.labels[i - 1]);
      }
    }
  }
}

TEST(AxisTicks, ReadAsTheyAreSpoken) {
  EXPECT_EQ(axis_ticks({}, -1.0, 1.0, 4).labels,
            (std::vector<std::string>{"\u22121.0", "\u22120.5", "0", "0.5", "1.0"}));
  const auto angles = axis_ticks({"phase", "deg"}, -360.0, 0.0, 4);
  EXPECT_EQ(angles.major, (std::vector<double>{-360.0, -270.0, -180.0, -90.0, 0.0}));
  FigureAxis names;
  names.categories = {"a", "b"};
  EXPECT_EQ(axis_ticks(names, -0.5, 1.5, 9).labels, names.categories);
}

TEST(AxisTicks, OfLogarithmsArePowersOfTenWithTheRestBetween) {
  const FigureAxis axis{"frequency", "Hz", AxisScale::logarithmic, {}};
  const auto wide = axis_ticks(axis, 0.01, 100.0, 5);
  EXPECT_EQ(wide.labels, (std::vector<std::string>{"0.01", "0.1", "1", "10", "100"}));
  EXPECT_EQ(wide.minor.size(), 4U * 8U);
  const auto decade = axis_ticks(axis, 0.9, 11.0, 5);
  EXPECT_EQ(decade.labels, (std::vector<std::string>{"1", "2", "5", "10"}));
  const auto far = axis_ticks(axis, 1e-7, 1e-1, 6);
  EXPECT_EQ(far.labels.front(), "10\u207b\u2077");
  const auto narrow = axis_ticks(axis, 0.42, 0.58, 5);
  EXPECT_GE(narrow.major.size(), 3U);
  const auto huge = axis_ticks(axis, 1e-20, 1e20, 5);
  EXPECT_LE(huge.major.size(), 10U);
  EXPECT_GE(huge.major.size(), 3U);
}

}  // namespace
}  // namespace boresight::app
