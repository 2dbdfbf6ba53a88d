#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/audit/audit_graph.hpp>
#include <boresight/design/audit/misprint_search.hpp>
#include <boresight/design/audit/source_reading.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

constexpr double inch = 0.0254;

/// A printed number; its last digit's place read from the text as written.
design::PrintedForm print(const std::string& text, double factor = 1.0, int column = -1) {
  const double number = std::stod(text);
  const auto blank = text.find(' ');
  const auto point = text.find('.');
  const auto end = blank == std::string::npos ? text.size() : blank;
  const double decimals = point == std::string::npos ? 0.0 : static_cast<double>(end - point - 1);
  return {text, number * factor, 0.5 * std::pow(10.0, -decimals) * factor, column};
}

design::PrintedForm exact(const std::string& text) {
  design::PrintedForm form = print(text);
  form.half_unit = 0.0;
  return form;
}

design::AuditNode input(const std::string& id, std::vector<design::PrintedForm> forms) {
  return {id, id, "m", {}, {}, {{std::move(forms), "source of " + id}}, false};
}

design::AuditNode product(const std::string& id, std::vector<std::string> parents,
                          std::vector<design::Statement> statements = {}) {
  return {id,
          id,
          "m2",
          std::move(parents),
          [](std::span<const double> factors) {
            double value = 1.0;
            for (const double factor : factors) value *= factor;
            return value;
          },
          std::move(statements),
          false};
}

design::Statement stated(std::vector<design::PrintedForm> forms) {
  return {std::move(forms), "table"};
}

std::vector<design::Finding> find(std::vector<design::AuditNode> nodes) {
  return design::find_misprints(design::AuditGraph(std::move(nodes)));
}

// x is exact, so only the product's own print decides.
design::Finding only_finding_of(const std::string& factor, const std::string& printed_product) {
  const auto findings = find({{input("x", {exact(factor)})},
                              {input("y", {exact("2")})},
                              {product("p", {"x", "y"}, {stated({print(printed_product)})})}});
  EXPECT_THAT(findings, SizeIs(1));
  return findings.empty() ? design::Finding{} : findings.front();
}

TEST(AuditGraph, FindsNothingWhereEverythingFollows) {
  EXPECT_THAT(find({input("x", {print("2.54 cm", 0.01, 0), print("1.00 in", inch, 1)}),
                    input("y", {print("3.0")}),
                    product("p", {"x", "y"},
                            {stated({print("7.62 cm", 0.01, 0), print("3.00 in", inch, 1)})})}),
              IsEmpty());
}

TEST(AuditGraph, ToleratesExactlyTheRoundingOfThePrintAndOfWhatItComesFrom) {
  // 2.00 +- 0.005 times 3.0 +- 0.05: 0.1 + 0.015 from the factors, 0.005 from the print.
  const auto with_print = [](const std::string& text) {
    return find({input("x", {print("2.00")}), input("y", {print("3.0")}),
                 product("p", {"x", "y"}, {stated({print(text)})})});
  };
  EXPECT_THAT(with_print("6.00"), IsEmpty());
  for (const std::string text : {"6.12", "5.88", "6.01"}) {
    ASSERT_THAT(with_print(text), SizeIs(1)) << text;
    EXPECT_TRUE(with_print(text)[0].within_parents_rounding) << text;
  }
  for (const std::string text : {"6.13", "5.87"}) {
    const auto findings = with_print(text);
    ASSERT_THAT(findings, SizeIs(1)) << text;
    EXPECT_FALSE(findings[0].within_parents_rounding) << text;
    EXPECT_NEAR(findings[0].forms[0].tolerance, 0.12, 1e-9);
    EXPECT_DOUBLE_EQ(findings[0].forms[0].would_be, 6.0);
    EXPECT_EQ(findings[0].forms[0].would_be_text, "6.000");
    EXPECT_EQ(findings[0].source, "table");
  }
}

TEST(AuditGraph, TakesAConversionThatHitsTheLastDigitForExact) {
  const design::Statement drawing = stated({print("5.08 cm", 0.01, 0), print("2 in", inch, 1)});
  EXPECT_EQ(design::hidden_rounding(drawing, 0), 0.0);
  EXPECT_EQ(design::hidden_rounding(drawing, 1), 0.0);
  const design::Statement measured = stated({print("5.09 cm", 0.01, 0), print("2 in", inch, 1)});
  EXPECT_DOUBLE_EQ(design::hidden_rounding(measured, 0), 0.00005);
  // The coarse column is as certain as the fine one beside it, and their difference.
  EXPECT_NEAR(design::hidden_rounding(measured, 1), 0.00005 + 0.0001, 1e-12);
}

TEST(AuditGraph, FindsColumnsThatDisagreeBeyondBothHalfUnits) {
  EXPECT_THAT(find({input("x", {print("10.1 cm", 0.01, 0), print("4.0 in", inch, 1)})}), IsEmpty());
  const auto findings = find({input("x", {print("10.4 cm", 0.01, 0), print("4.0 in", inch, 1)})});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].kind, design::FindingKind::conversion);
  EXPECT_EQ(findings[0].forms[0].would_be_text, "10.16 cm");
  EXPECT_EQ(findings[0].forms[1].would_be_text, "4.09 in");
}

TEST(AuditGraph, RecognisesARoundedConversionFactor) {
  // 812.3456 in / 0.394 = 2061.79 cm; exactly it is 2063.36 cm.
  const auto rounded =
      find({input("x", {print("2061.8 cm", 0.01, 0), print("812.3456 in", inch, 1)})});
  ASSERT_THAT(rounded, SizeIs(1));
  EXPECT_THAT(rounded[0].explanations,
              Contains("'2061.8 cm' as '812.3456 in' divided by 0.394 instead of 0.3937"));
}

TEST(AuditGraph, RecognisesAPowerOfTen) {
  EXPECT_THAT(only_finding_of("1.2345", "24.690").explanations, Contains("with a factor of 0.1"));
}

TEST(AuditGraph, RecognisesTwoDigitsSwapped) {
  EXPECT_THAT(only_finding_of("1.2345", "2.4960").explanations,
              Contains("as '2.4690', two digits swapped"));
}

TEST(AuditGraph, RecognisesOneDigitChanged) {
  EXPECT_THAT(only_finding_of("1.2345", "2.7690").explanations,
              Contains("as '2.4690', one digit different"));
}

TEST(AuditGraph, RecognisesDigitsCutOff) {
  EXPECT_THAT(only_finding_of("1.2348", "2.46").explanations,
              Contains("with its digits cut off instead of rounded"));
}

TEST(AuditGraph, DoesNotExplainByAnEditThatCoincidenceWouldAllow) {
  const auto findings = find({input("x", {print("2.0")}), input("y", {exact("3")}),
                              product("p", {"x", "y"}, {stated({print("6.83")})})});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].explanations, Each(Not(HasSubstr("digit"))));
}

TEST(AuditGraph, RecognisesAParentRounded) {
  const auto findings = find({input("x", {print("1.2345")}), input("y", {print("2.0000")}),
                              product("p", {"x", "y"}, {stated({print("2.4600")})})});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].explanations, Contains("with x '1.2345' rounded to 1.23"));
}

TEST(AuditGraph, RecognisesAParentFromTheOtherColumnAndCountsItAsEvidence) {
  const auto findings =
      find({input("x", {print("10.40 cm", 0.01, 0), print("4.00 in", inch, 1)}),
            input("y", {exact("3")}),
            product("p", {"x", "y"},
                    {stated({print("31.20 cm", 0.01, 0), print("12.28 in", inch, 1)})})});
  ASSERT_THAT(findings, SizeIs(2));
  EXPECT_EQ(findings[0].kind, design::FindingKind::conversion);
  EXPECT_THAT(findings[0].evidence, Contains(HasSubstr("with '10.40 cm' follow: p")));
  EXPECT_EQ(findings[1].id, "p");
  EXPECT_EQ(findings[1].forms[0].text, "12.28 in");
  EXPECT_EQ(findings[1].forms[0].would_be_text, "12.000 in");
  EXPECT_THAT(findings[1].explanations, Contains(HasSubstr("x '10.40 cm'")));
}

TEST(AuditGraph, LetsANumberWithoutColumnFollowFromAnyAndFromAnyStatementOfAParent) {
  const auto nodes = [](const std::string& printed) {
    return std::vector<design::AuditNode>{
        input("x", {print("1.00")}),
        product("q", {"x"},
                {stated({print("1.00 m", 1.0, 0), print("1.01 yd", 1.0, 1)}),
                 stated({print("0.996 m", 1.0, 0)})}),
        product("p", {"q"}, {stated({print(printed)})})};
  };
  for (const std::string text : {"1.000", "1.010", "0.996"}) {
    for (const design::Finding& finding : find(nodes(text))) EXPECT_NE(finding.id, "p") << text;
  }
  EXPECT_THAT(find(nodes("1.100")), Contains(testing::Field(&design::Finding::id, "p")));
}

TEST(AuditGraph, RecognisesTheNumberOfAnotherQuantity) {
  const auto findings = find({input("x", {print("1.234 m", 1.0, 0)}), input("y", {exact("2")}),
                              input("z", {print("7.891 m", 1.0, 0)}),
                              product("p", {"x", "y"}, {stated({print("7.891 m", 1.0, 0)})})});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].explanations, Contains("as the number of z, printed the same"));
}

TEST(AuditGraph, FindsTheOneParentValueThatExplainsSeveralDepartures) {
  std::vector<design::AuditNode> nodes{input("density", {print("7.832")})};
  for (const auto& [name, size, printed] :
       {std::tuple{"a", "1.2345", "9.5443"}, std::tuple{"b", "3.4567", "26.7245"},
        std::tuple{"c", "7.1231", "55.0708"}}) {
    nodes.push_back(input(std::string("size.") + name, {exact(size)}));
    nodes.push_back(product(name, {std::string("size.") + name, "density"},
                            {stated({print(printed)})}));  // with 7.7313
  }
  const auto findings = find(nodes);
  ASSERT_THAT(findings, SizeIs(3));
  for (const design::Finding& finding : findings) {
    EXPECT_THAT(finding.explanations[0], HasSubstr("if density were '7.7313' instead of '7.832'"));
  }
}

TEST(AuditGraph, SaysWhatSingleParentsWouldHaveToBeWhenNothingElseExplains) {
  const auto findings = find({input("x", {print("2.000")}), input("y", {exact("3")}),
                              product("p", {"x", "y"}, {stated({print("6.5190")})})});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].explanations, ElementsAre("if x were '2.1730' instead of '2.000'"));
}

TEST(AuditGraph, FindsAnInputPrintedAgainWithAnotherValue) {
  design::AuditNode frequency = input("f", {print("38.3 Hz")});
  frequency.statements.push_back(stated({print("33.3 Hz")}));
  frequency.statements.push_back(stated({print("38 Hz")}));
  const auto findings = find({frequency});
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].kind, design::FindingKind::restatement);
  EXPECT_EQ(findings[0].forms[0].text, "33.3 Hz");
  EXPECT_THAT(findings[0].explanations, ElementsAre("as '38.3 Hz', one digit different"));
}

TEST(AuditGraph, TellsWhatHeadlineResultsBecome) {
  design::AuditNode headline = product("h", {"p", "p"});
  headline.headline = true;
  design::AuditNode apart = product("apart", {"y"});
  apart.headline = true;
  const auto findings = find({input("x", {exact("2")}), input("y", {exact("3")}),
                              product("p", {"x", "y"}, {stated({print("6.6")})}), headline, apart});
  ASSERT_THAT(findings, SizeIs(1));
  ASSERT_THAT(findings[0].derived_quantities, SizeIs(1));
  EXPECT_EQ(findings[0].derived_quantities[0].id, "h");
  EXPECT_DOUBLE_EQ(findings[0].derived_quantities[0].as_printed, 6.6 * 6.6);
  EXPECT_DOUBLE_EQ(findings[0].derived_quantities[0].as_corrected, 36.0);
  EXPECT_NEAR(findings[0].derived_quantities[0].relative_change(), 0.21, 1e-12);
}

TEST(AuditGraph, FindsTheSameInAnyOrderOfTheNodes) {
  std::vector<design::AuditNode> nodes{
      input("x", {print("10.40 cm", 0.01, 0), print("4.00 in", inch, 1)}),
      input("y", {print("3.00")}),
      input("z", {print("1.2345")}),
      product("p", {"x", "y"}, {stated({print("31.20 cm", 0.01, 0), print("12.28 in", inch, 1)})}),
      product("q", {"y", "z"}, {stated({print("3.69")}), stated({print("37.0")})}),
      product("r", {"q", "p"}, {stated({print("9.9999")})})};
  const auto texts = [](const std::vector<design::AuditNode>& order) {
    std::vector<std::string> all;
    for (const design::Finding& finding : find(order)) {
      std::string text = std::string(to_string(finding.kind)) + " " + finding.id;
      for (const design::DepartingForm& form : finding.forms) {
        text += " " + form.text + " " + form.would_be_text;
      }
      for (const std::string& explanation : finding.explanations) text += " " + explanation;
      all.push_back(text);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto expected = texts(nodes);
  EXPECT_GE(expected.size(), 4U);
  std::mt19937 generator(7);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(nodes.begin(), nodes.end(), generator);
    EXPECT_EQ(texts(nodes), expected);
  }
}

TEST(AuditGraph, RefusesWhatIsNoGraph) {
  const auto refusal = [](std::vector<design::AuditNode> nodes) -> std::string {
    try {
      design::AuditGraph graph(std::move(nodes));
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal({input("x", {exact("1")}), input("x", {exact("1")})}),
              HasSubstr("expected each id once, found 'x' again"));
  EXPECT_THAT(refusal({product("p", {"y"})}), HasSubstr("expected the parent 'y' of 'p'"));
  EXPECT_THAT(refusal({product("p", {"q"}), product("q", {"p"})}),
              HasSubstr("expected no circle, found 'p' in one"));
  EXPECT_THAT(refusal({{"x", "", "", {}, {}, {}, false}}),
              HasSubstr("expected a value of the input 'x'"));
  EXPECT_THAT(refusal({input("x", {})}), HasSubstr("expected a number in each statement of 'x'"));
}

}  // namespace
}  // namespace boresight::identification
