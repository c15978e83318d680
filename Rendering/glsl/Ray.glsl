// The view rays of pixels. Inserted at //Splat::Ray::Dec.

uniform mat4 splatVCDC;
uniform vec4 splatViewport; // left, bottom, width, height in pixels

// The place (VC) at a depth z (VC) on the view ray of a place in the picture (-1 to 1).
vec3 splatOnRay(vec2 pixelDC, float z)
{
  // Solves the projection for x and y. Its last row has no terms in x and y.
  float w = splatVCDC[2][3] * z + splatVCDC[3][3];
  vec2 fixedPart = vec2(splatVCDC[2][0], splatVCDC[2][1]) * z +
    vec2(splatVCDC[3][0], splatVCDC[3][1]);
  return vec3((pixelDC * w - fixedPart) / vec2(splatVCDC[0][0], splatVCDC[1][1]), z);
}
