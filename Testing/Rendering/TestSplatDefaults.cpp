// The defaults of ParaView's properties are those of the mapper.
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkXMLDataElement.h"
#include "vtkXMLUtilities.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace
{
vtkXMLDataElement* FindProperty(vtkXMLDataElement* element, const std::string& name)
{
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* nested = element->GetNestedElement(i);
    const char* nestedName = nested->GetAttribute("name");
    if (nestedName && name == nestedName && nested->GetAttribute("default_values"))
    {
      return nested;
    }
    if (vtkXMLDataElement* found = FindProperty(nested, name))
    {
      return found;
    }
  }
  return nullptr;
}

std::vector<double> NumbersOf(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number = 0.; stream >> number;)
  {
    numbers.push_back(number);
  }
  return numbers;
}

class SplatDefaults : public testing::Test
{
protected:
  vtkSmartPointer<vtkXMLDataElement> Root;
  vtkNew<vtkSurfaceSplatMapper> Mapper;

  void SetUp() override
  {
    this->Root.TakeReference(vtkXMLUtilities::ReadElementFromFile(HOP_REPRESENTATION_XML));
    ASSERT_TRUE(this->Root);
  }

  std::string Default(const std::string& name)
  {
    vtkXMLDataElement* property = FindProperty(this->Root, name);
    EXPECT_TRUE(property) << name;
    return property ? property->GetAttribute("default_values") : "";
  }

  void ExpectDefault(const std::string& name, const std::vector<double>& values)
  {
    EXPECT_EQ(NumbersOf(this->Default(name)), values) << name;
  }

  static std::vector<double> Three(const double* v) { return { v[0], v[1], v[2] }; }
};
}

TEST_F(SplatDefaults, AreTheMappers)
{
  ExpectDefault("Mode", { double(this->Mapper->GetMode()) });
  ExpectDefault("RadiusScale", { this->Mapper->GetRadiusScale() });
  ExpectDefault("DefaultRadius", { this->Mapper->GetRadius() });
  ExpectDefault("Sharpness", { this->Mapper->GetSharpness() });
  ExpectDefault("ColorByNormalDirection", { double(this->Mapper->GetColorByNormalDirection()) });
  ExpectDefault("OutwardColor", Three(this->Mapper->GetOutwardColor()));
  ExpectDefault("InwardColor", Three(this->Mapper->GetInwardColor()));
  ExpectDefault("InterpolateScalarsBeforeMapping",
    { double(this->Mapper->GetInterpolateScalarsBeforeMapping()) });
  EXPECT_EQ(this->Default("RadiusArray"), this->Mapper->GetRadiusArrayName());
}
