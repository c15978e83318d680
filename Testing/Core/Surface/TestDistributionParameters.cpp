#include "Surface/DistributionParameters.h"

#include <gtest/gtest.h>

#include <limits>

namespace hop
{
namespace
{

DistributionParameters limitedTo(std::int64_t most)
{
  DistributionParameters parameters;
  parameters.particleLimit = most;
  return parameters;
}

bool holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST(DistributionParameters, ARequestIsRefusedAboveTheLimitOnly)
{
  const DistributionParameters parameters = limitedTo(1000);
  EXPECT_EQ(parameters.refusal(0.0), "");
  EXPECT_EQ(parameters.refusal(999.5), "");
  EXPECT_EQ(parameters.refusal(1000.0), "");
  EXPECT_NE(parameters.refusal(1000.5), "");
}

TEST(DistributionParameters, ARefusalNamesTheNumberAndTheLimit)
{
  const std::string text = limitedTo(1000).refusal(123456.7);
  EXPECT_TRUE(holds(text, "the spacing asks for about 123457 particles")) << text;
  EXPECT_TRUE(holds(text, "limit of 1000")) << text;
}

TEST(DistributionParameters, ARefusalOfAGivenNumberDoesNotBlameTheSpacing)
{
  DistributionParameters parameters = limitedTo(1000);
  parameters.particleCount = 5000;
  const std::string text = parameters.refusal(5000.0);
  EXPECT_TRUE(holds(text, "there are to be 5000 particles")) << text;
  EXPECT_FALSE(holds(text, "spacing")) << text;
}

TEST(DistributionParameters, NumbersThatOverflowAreRefusedWithANumber)
{
  const DistributionParameters parameters = limitedTo(1000);
  for (const double count :
    { 1e200, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() })
  {
    const std::string text = parameters.refusal(count);
    EXPECT_TRUE(holds(text, "about 1e+")) << text;
    EXPECT_FALSE(holds(text, "inf") || holds(text, "nan")) << text;
  }
}

} // namespace
} // namespace hop
