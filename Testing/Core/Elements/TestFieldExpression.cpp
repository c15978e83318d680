#include "Elements/FieldExpression.h"

#include "ElementCases.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hop::testing
{
namespace
{

const std::vector<NamedArray> arrays{ { "p", 1 }, { "u", 3 }, { "a b", 1 }, { "t_1", 1 },
  { "many", 5 } };

double valueOf(const std::string& text)
{
  const FieldExpression expression(text, arrays);
  FieldPoint at;
  at.x = { 2.0, 3.0, 5.0 };
  for (const NamedArray& array : expression.arrays())
  {
    for (int c = 0; c < array.components; ++c)
    {
      at.values.push_back(array.name == "u" ? 1.0 + c : 7.0 + c);
      at.gradients.emplace_back(glm::dvec3(1.0 + c, 10.0 * c, 0.5));
    }
  }
  return expression(at);
}

std::string faultOf(const std::string& text)
{
  try
  {
    valueOf(text);
  }
  catch (const std::invalid_argument& wrong)
  {
    return wrong.what();
  }
  return "";
}

TEST(FieldExpression, CalculatesAsTheCalculatorDoes)
{
  EXPECT_DOUBLE_EQ(valueOf("1 + 2*3 - 4/8"), 6.5);
  EXPECT_DOUBLE_EQ(valueOf("-2^2"), -4.0);
  EXPECT_DOUBLE_EQ(valueOf("2^3^2"), 512.0);
  EXPECT_DOUBLE_EQ(valueOf("2^-1 * (1e1 - .5)"), 4.75);
  EXPECT_DOUBLE_EQ(valueOf("p - \"a b\" + t_1"), 7.0);
  EXPECT_DOUBLE_EQ(valueOf("u_X + 10*u_Y + 100*u_2"), 321.0);
  EXPECT_DOUBLE_EQ(valueOf("many_4"), 11.0);
  EXPECT_DOUBLE_EQ(valueOf("coordsX*coordsY*coordsZ"), 30.0);
  EXPECT_DOUBLE_EQ(valueOf("mag(u*2)/magnitude(u)"), 2.0);
  EXPECT_DOUBLE_EQ(valueOf("dot(cross(u, coords), u)"), 0.0);
  EXPECT_DOUBLE_EQ(valueOf("max(min(p, 3), sqrt(abs(-16)))"), 4.0);
  EXPECT_DOUBLE_EQ(valueOf("mag(norm(u))"), 1.0);
}

TEST(FieldExpression, KnowsDerivatives)
{
  EXPECT_DOUBLE_EQ(valueOf("mag(gradient(p))^2"), 1.25);
  EXPECT_DOUBLE_EQ(valueOf("mag(gradient(u_Y))^2"), 4.0 + 100.0 + 0.25);
  EXPECT_DOUBLE_EQ(valueOf("divergence(u)"), 1.0 + 10.0 + 0.5);
  // Rows (1, 0, .5), (2, 10, .5), (3, 20, .5).
  EXPECT_DOUBLE_EQ(valueOf("dot(curl(u), u)"), 19.5 - 5.0 + 6.0);
  EXPECT_DOUBLE_EQ(
    valueOf("q_criterion(u)"), -0.5 * (1.0 + 100.0 + 0.25) - 0.0 * 2.0 - 0.5 * 20.0 - 3.0 * 0.5);
  EXPECT_TRUE(std::isfinite(valueOf("lambda2(u)")));
}

TEST(FieldExpression, SaysWhatIsWrong)
{
  EXPECT_NE(faultOf("").find("missing"), std::string::npos);
  EXPECT_NE(faultOf("1 +").find("missing"), std::string::npos);
  EXPECT_NE(faultOf("(1").find("')' is missing"), std::string::npos);
  EXPECT_NE(faultOf("1 2").find("character 3"), std::string::npos);
  EXPECT_NE(faultOf("q").find("no point array 'q'"), std::string::npos);
  EXPECT_NE(faultOf("u_W").find("no point array 'u_W'"), std::string::npos);
  EXPECT_NE(faultOf("u").find("magnitude()"), std::string::npos);
  EXPECT_NE(faultOf("many").find("many_0"), std::string::npos);
  EXPECT_NE(faultOf("p + u").find("cannot be added"), std::string::npos);
  EXPECT_NE(faultOf("u*u").find("dot()"), std::string::npos);
  EXPECT_NE(faultOf("sinus(p)").find("no function 'sinus'"), std::string::npos);
  EXPECT_NE(faultOf("mag(gradient(p*p))").find("derivatives of formulas"), std::string::npos);
  EXPECT_NE(faultOf("curl(p)").find("three components"), std::string::npos);
  EXPECT_NE(faultOf(std::string(5000, '(')).find("too many"), std::string::npos);
}

/// Ranges of x, p and u with their gradients, and points within.
struct Box
{
  explicit Box(Random& random)
  {
    const auto range = [&]()
    {
      const double a = randomNumber(random);
      const double b = randomNumber(random);
      return Range{ std::min(a, b), std::max(a, b) };
    };
    for (Range& one : this->bounds.x)
    {
      one = range();
    }
    for (int c = 0; c < 4; ++c)
    {
      this->bounds.values.push_back(range());
      this->bounds.gradients.push_back({ range(), range(), range() });
    }
  }

  FieldPoint point(Random& random) const
  {
    const auto inside = [&](const Range& range)
    { return range.lower + (range.upper - range.lower) * random.uniform(); };
    FieldPoint at;
    for (int a = 0; a < 3; ++a)
    {
      at.x[a] = inside(this->bounds.x[a]);
    }
    for (int c = 0; c < 4; ++c)
    {
      const std::array<Range, 3>& row = this->bounds.gradients[c];
      at.values.push_back(inside(this->bounds.values[c]));
      at.gradients.emplace_back(inside(row[0]), inside(row[1]), inside(row[2]));
    }
    return at;
  }

  FieldBounds bounds;
};

TEST(FieldExpression, HasBoundsThatHoldAllValues)
{
  Random random(41);
  for (const char* text :
    { "p + u_X - 2*u_Y/(3 + u_Z^2)", "p^3 - u_X^2 + u_Y^0", "(2 + p)^u_X + u_Y",
      "abs(p) + sqrt(2 + u_X) + exp(u_Y)*sin(u_Z)", "ln(3 + p) - acos(u_X/2) + cosh(u_Y) + u_Z",
      "min(p, u_X) + max(u_Y, u_Z) + floor(4*p) + sign(u_X) + atan(u_Y)",
      "p + mag(u) + dot(u, coords) + magnitude(cross(coords, u))",
      "p + mag(curl(u)) + divergence(u) + q_criterion(u)", "p + lambda2(u) + mag(gradient(u))",
      "p*0 + u_X + dot(gradient(p), coords) + coordsX" })
  {
    const FieldExpression expression(text, { { "p", 1 }, { "u", 3 } });
    ASSERT_EQ(expression.arrays().size(), 2u);
    ASSERT_EQ(expression.arrays()[0].name, "p") << "the box has it first";
    int known = 0;
    for (int n = 0; n < 40; ++n)
    {
      const Box box(random);
      const Range bounds = expression.bounds(box.bounds);
      known += std::isfinite(bounds.lower) && std::isfinite(bounds.upper);
      for (int m = 0; m < 20; ++m)
      {
        const double value = expression(box.point(random));
        EXPECT_LE(bounds.lower, value) << text;
        EXPECT_GE(bounds.upper, value) << text;
      }
    }
    EXPECT_EQ(known, 40) << text;
  }
}

TEST(FieldExpression, HasInfiniteBoundsWhereItMayNotBeFinite)
{
  FieldBounds in;
  in.values = { { -1.0, 2.0 } };
  in.gradients.resize(1);
  for (const char* text : { "1/p", "sqrt(p)", "ln(p)", "asin(p)", "p^0.5", "p^(-1)", "tan(p)",
         "min(1/p, 3)", "0*(1/p)", "exp(1000*p)" })
  {
    const Range bounds = FieldExpression(text, arrays).bounds(in);
    EXPECT_FALSE(std::isfinite(bounds.lower) || std::isfinite(bounds.upper)) << text;
  }
  EXPECT_NEAR(FieldExpression("p^2", arrays).bounds(in).lower, 0.0, 1e-12);
  EXPECT_NEAR(FieldExpression("p^2", arrays).bounds(in).upper, 4.0, 1e-12);
  EXPECT_NEAR(FieldExpression("p^3", arrays).bounds(in).lower, -1.0, 1e-12);
}

} // namespace
} // namespace hop::testing
