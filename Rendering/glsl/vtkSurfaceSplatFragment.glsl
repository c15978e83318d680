// What the fragment stages of the splat passes share. Inserted at //Splat::Fragment::Dec, behind
// definitions of SPLAT_POINTS (splats are points: 0 or 1), SPLAT_HAS_CLIP (particles have clip planes: 0 or 1) and SPLAT_CLIPPING_PLANES (the
// number of the mapper's).

#if SPLAT_POINTS
flat in vec4 splatPixelToDisk;
flat in vec2 splatCentrePixel;
flat in vec3 splatDepths;
vec2 splatDiskCoord;
vec3 splatOffsetVC;
float splatDepthVC;
#else
in vec2 splatDiskCoord;
in vec3 splatOffsetVC;
in float splatDepthVC;
#endif
flat in vec3 splatClipLines[2];
in vec3 splatPointMC;
flat in vec3 splatNormalVC;
flat in float splatSeenFromSide;
flat in int splatParticle;

uniform vec3 splatFalloff; // sharpness; the Gaussian at the rim; where the weight is the least, squared
uniform vec4 splatClippingPlane[6]; // MC

#if SPLAT_POINTS
//Splat::Ray::Dec

// The private framebuffers begin at the viewport's corner.
vec3 splatBehindPixel(vec2 pixel, float z)
{
  return splatOnRay(2.0 * pixel / splatViewport.zw - 1.0, z);
}

// Where the pixel's view ray meets the disk's plane, to first order.
void splatMeetDisk()
{
  splatDiskCoord = mat2(splatPixelToDisk.xy, splatPixelToDisk.zw) * (gl_FragCoord.xy - splatCentrePixel);
  splatDepthVC = splatDepths.x + dot(splatDepths.yz, splatDiskCoord);
  splatOffsetVC = splatBehindPixel(gl_FragCoord.xy, splatDepthVC) -
    splatBehindPixel(splatCentrePixel, splatDepths.x);
}
#endif

// Call this first. Whether the fragment is no part of the splat.
bool splatOutside()
{
#if SPLAT_POINTS
  splatMeetDisk();
#endif
  bool outside = !(dot(splatDiskCoord, splatDiskCoord) <= 1.0); // also where there is no such place
#if SPLAT_HAS_CLIP
  outside = outside || dot(splatClipLines[0].xy, splatDiskCoord) > splatClipLines[0].z ||
    dot(splatClipLines[1].xy, splatDiskCoord) > splatClipLines[1].z;
#endif
#if SPLAT_CLIPPING_PLANES
  for (int i = 0; i < SPLAT_CLIPPING_PLANES; ++i)
  {
    outside = outside || dot(splatClippingPlane[i], vec4(splatPointMC, 1.0)) < 0.0;
  }
#endif
  return outside;
}

// Whether the fragment belongs to the outermost rim, which counts too little to be seen alone.
bool splatAtRim()
{
  return dot(splatDiskCoord, splatDiskCoord) > splatFalloff.z;
}

// A Gaussian, lowered so that it ends with zero at the rim of the disk; 1 in the middle.
float splatWeight()
{
  float gaussian = exp(-splatFalloff.x * dot(splatDiskCoord, splatDiskCoord));
  return (gaussian - splatFalloff.y) / (1.0 - splatFalloff.y);
}
