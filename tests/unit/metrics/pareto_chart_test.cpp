// The Pareto front of methods.
#include "metrics/pareto_chart.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace etendue::metrics {
namespace {

// A method whose curve ends after these seconds with this error; the sample count is ten times the seconds.
MethodCurves method(const std::string& name, double seconds, double error) {
  const auto point = [&](double share, double e) {
    return ErrorPoint{.seconds = share * seconds,
                      .spp = 10 * share * seconds,
                      .mse = e * e,
                      .relmse = 4 * e * e,
                      .displayed_mse = 9 * e * e};
  };
  return {name, {{.repeat = 0, .points = {point(0.5, 2 * error), point(1, error)}}}};
}

std::vector<size_t> best(const std::vector<MethodCurves>& methods) {
  std::vector<size_t> list;
  for (const auto& p : pareto_points(methods, Abscissa::seconds, film::ErrorMeasure::rmse))
    if (p.is_best) list.push_back(p.method);
  return list;
}

TEST(ParetoChart, FrontHasTheMethodsThatNoOtherBeatsInBoth) {
  EXPECT_EQ(best({method("a", 1, 0.5), method("b", 2, 0.2), method("c", 3, 0.3), method("d", 4, 0.1)}),
            (std::vector<size_t>{0, 1, 3}));
  // Equal costs: the smaller error. Equal errors: the lower cost. Equal in both: each.
  EXPECT_EQ(best({method("a", 1, 0.5), method("b", 1, 0.4)}), std::vector<size_t>{1});
  EXPECT_EQ(best({method("a", 2, 0.5), method("b", 1, 0.5)}), std::vector<size_t>{1});
  EXPECT_EQ(best({method("a", 1, 0.5), method("b", 1, 0.5)}), (std::vector<size_t>{0, 1}));
  EXPECT_TRUE(best({}).empty());
}

TEST(ParetoChart, PointsAreTheEndsOfTheCurvesInTheMeasure) {
  const std::vector<MethodCurves> methods{method("a", 2, 0.5), {"without repeats", {}}};
  const auto seconds = pareto_points(methods, Abscissa::seconds, film::ErrorMeasure::rmse);
  ASSERT_EQ(seconds.size(), 1U);
  EXPECT_DOUBLE_EQ(seconds[0].x, 2);
  EXPECT_DOUBLE_EQ(seconds[0].error, 0.5);
  const auto samples = pareto_points(methods, Abscissa::samples, film::ErrorMeasure::relative);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_DOUBLE_EQ(samples[0].x, 20);
  EXPECT_DOUBLE_EQ(samples[0].error, 1);
}

TEST(ParetoChart, DrawsADotForEachMethodAndNamesTheBest) {
  const std::vector<MethodCurves> methods{method("good", 1, 0.5), method("poor", 2, 0.9), method("slow", 4, 0.1)};
  ChartOptions options;
  options.embedded = true;
  const Drawing drawing = pareto_chart(methods, options);
  const auto count_texts = [&](const std::string& text) {
    return std::ranges::count_if(drawing.shapes, [&](const auto& shape) {
      const auto* t = std::get_if<Text>(&shape);
      return t && t->text == text;
    });
  };
  // The legend of a file states which methods have no point.
  options.embedded = false;
  std::vector<MethodCurves> with_empty = methods;
  with_empty.push_back({"without repeats", {}});
  const Drawing file = pareto_chart(with_empty, options);
  EXPECT_EQ(std::ranges::count_if(file.shapes,
                                  [](const auto& shape) {
                                    const auto* t = std::get_if<Text>(&shape);
                                    return t && t->text == "no error to draw";
                                  }),
            1);
  const auto dots = std::ranges::count_if(
      drawing.shapes, [](const auto& shape) { return std::holds_alternative<Dot>(shape); });
  EXPECT_EQ(dots, 3);
  EXPECT_EQ(count_texts("good"), 1);
  EXPECT_EQ(count_texts("slow"), 1);
  EXPECT_EQ(count_texts("poor"), 0);
}

}  // namespace
}  // namespace etendue::metrics
