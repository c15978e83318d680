/**
 * @file  ComponentValue.h
 * @brief a component of an array, or its magnitude
 */
#ifndef ComponentValue_h
#define ComponentValue_h

#include "vtkDataArray.h"

#include <cmath> // for the magnitude

/**
 * The component of a tuple; the magnitude where there is no such component; the only one of arrays with one.
 */
inline double ComponentValue(vtkDataArray* array, vtkIdType tuple, int component)
{
  const int components = array->GetNumberOfComponents();
  if (components == 1 || component < components)
  {
    return array->GetComponent(tuple, components == 1 ? 0 : component);
  }
  double magnitude = 0.0;
  for (int c = 0; c < components; ++c)
  {
    magnitude = std::hypot(magnitude, array->GetComponent(tuple, c));
  }
  return magnitude;
}

#endif
