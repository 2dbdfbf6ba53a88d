#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/audit/case_graph.hpp>

namespace boresight::io {
namespace {

TEST(CaseGraph, DerivesWhatTheCaseMayPrint) {
  const Case antenna = read_case(case_path("dss14-70m"));
  const design::AuditGraph graph = case_graph(antenna);
  const std::size_t motors = graph.index("motor_inertia");
  EXPECT_FALSE(graph.is_input(motors));
  EXPECT_EQ(graph.node(motors).unit, "kg.m2");
  EXPECT_TRUE(graph.is_input(graph.index("motor.inertia")));
  EXPECT_TRUE(graph.node(graph.index("load_inertia")).headline);
  // Teeth are exact.
  EXPECT_EQ(graph.node(graph.index("gear_train.stage[0].driven_teeth"))
                .statements.at(0)
                .forms.at(0)
                .half_unit,
            0.0);
}

TEST(CaseGraph, TellsInchPoundUnitsFromMetric) {
  EXPECT_EQ(column_of("0.22177 lbf.ft.s2", Kind::inertia), UnitColumn::inch_pound);
  EXPECT_EQ(column_of("1498.1 in3", Kind::volume), UnitColumn::inch_pound);
  EXPECT_EQ(column_of("46.1 in.lbf/rpm", Kind::viscous_friction), UnitColumn::inch_pound);
  EXPECT_EQ(column_of("5.21 N.m/rpm", Kind::viscous_friction), UnitColumn::metric);
  EXPECT_EQ(column_of("500 mL/min", Kind::flow), UnitColumn::metric);
  EXPECT_EQ(column_of("46.3 Hz", Kind::frequency), UnitColumn::either);
  EXPECT_EQ(column_of("2.09", Kind::number), UnitColumn::either);
}

}  // namespace
}  // namespace boresight::io
