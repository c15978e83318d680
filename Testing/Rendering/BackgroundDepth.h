#pragma once

// Depths in a depth buffer, from 0 to 1, from which on a pixel shows no surface, as vtkWorldPointPicker has it: splats
// mix outlines into the background at a depth a little below 1 (splatBackground of Resolve.glsl).
constexpr double BackgroundDepth = 0.999999;
