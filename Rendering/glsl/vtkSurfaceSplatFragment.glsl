// What the fragment stages of the splat passes share. Inserted at //Splat::Fragment::Dec.

in vec2 splatDiskCoord;
flat in vec3 splatClipLines[2];
in vec3 splatPointMC;
in vec3 splatOffsetVC;
in float splatDepthVC;
flat in vec3 splatNormalVC;
flat in float splatSeenFromSide;
flat in int splatParticle;

uniform float splatSharpness;
uniform int splatClippingPlanes;
uniform vec4 splatClippingPlane[6]; // MC

bool splatOutside()
{
  if (dot(splatDiskCoord, splatDiskCoord) > 1.0 ||
    dot(splatClipLines[0].xy, splatDiskCoord) > splatClipLines[0].z ||
    dot(splatClipLines[1].xy, splatDiskCoord) > splatClipLines[1].z)
  {
    return true;
  }
  for (int i = 0; i < splatClippingPlanes; ++i)
  {
    if (dot(splatClippingPlane[i], vec4(splatPointMC, 1.0)) < 0.0)
    {
      return true;
    }
  }
  return false;
}

// A Gaussian, lowered so that it ends with zero at the rim of the disk; 1 in the middle.
float splatWeight()
{
  float rim = exp(-splatSharpness);
  return (exp(-splatSharpness * dot(splatDiskCoord, splatDiskCoord)) - rim) / (1.0 - rim);
}
