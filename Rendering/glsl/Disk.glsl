// One particle as a disk: what every vertex stage needs of it. Inserted into shaders at
// //Splat::Disk::Dec.
//
// No vertex attributes: particles are fetched by gl_VertexID, so that nothing is stored three times.
//
// Coordinate spaces by suffix: MC model (shifted to the middle of the particles, see
// SplatParticles), VC view, DC device.

uniform samplerBuffer splatCentreRadius; // xyz: centre (MC), w: radius, 0 = draw nothing
// xyz: outward unit normal (MC), w: 1 if translucent, else 0, and twice the number of the isovalue more
uniform samplerBuffer splatNormal;
// 3 texels a particle: xyz: unit normal of a plane (MC), w: distance; the same of another; xy: overlaps, see
// splatOverlaps(); zw: curvatures (1 / MC) of the edges, along the surface, towards the planes' normals
uniform samplerBuffer splatClip;
uniform int splatHasClip; // 0: there are no such planes
uniform float splatRadiusScale;
uniform int splatFacesViewer;  // 1: the particles have no normals, their disks face the eye
uniform int splatStride;       // every how-manieth particle is drawn
uniform int splatKind;         // particles drawn, see DrawnKind: 2 stands for all
uniform int splatIsovalue;        // of these, the ones of this isovalue; less than 0: of all
uniform float splatHiddenSide; // of these, those not seen from this side, see CulledSide
uniform vec4 splatEyeMC;       // position of the eye, or, with w = 0, the direction to it

struct SplatDisk
{
  vec3 centreMC;
  vec3 normalMC;    // outward
  vec3 tangentMC;   // as long as the radius, as is the next; 0 if there is nothing to draw
  vec3 bitangentMC;
  float seenFrom;   // 1: from outward (the normal points at the eye), -1: from inward
  int isovalue;
};

vec3 splatTangent(vec3 normal)
{
  // Either axis is at least 37 degrees away from the normal when it is taken.
  vec3 axis = abs(normal.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  return normalize(cross(axis, normal));
}

SplatDisk splatDiskOf(int particle)
{
  SplatDisk disk;
  vec4 centreRadius = texelFetch(splatCentreRadius, particle);
  disk.centreMC = centreRadius.xyz;
  vec3 toEyeMC = splatEyeMC.xyz - splatEyeMC.w * disk.centreMC;
  vec4 normal = texelFetch(splatNormal, particle);
  disk.normalMC = splatFacesViewer == 1 ? normalize(toEyeMC) : normal.xyz;
  // The eye lies on one side of the whole disk, so the centre decides for all its fragments.
  disk.seenFrom = dot(disk.normalMC, toEyeMC) < 0.0 ? -1.0 : 1.0;
  int tag = int(normal.w);
  disk.isovalue = tag / 2;
  bool drawn = (splatKind == 2 || tag % 2 == splatKind) &&
    (splatIsovalue < 0 || disk.isovalue == splatIsovalue) && disk.seenFrom != splatHiddenSide;
  float radius = drawn ? centreRadius.w * splatRadiusScale : 0.0;
  disk.tangentMC = radius * splatTangent(disk.normalMC);
  disk.bitangentMC = cross(disk.normalMC, disk.tangentMC);
  return disk;
}

// Where the edge that touches a particle's clip plane crosses its disk: of the disk coordinates (u, v), those
// with x u + y v > z + w (x v - y u)^2 are cut off.
vec4 splatClipLine(int particle, int plane, SplatDisk disk)
{
  if (splatHasClip == 0)
  {
    return vec4(0.0);
  }
  vec4 clip = texelFetch(splatClip, 3 * particle + plane);
  vec4 both = texelFetch(splatClip, 3 * particle + 2);
  vec2 direction = vec2(dot(clip.xyz, disk.tangentMC), dot(clip.xyz, disk.bitangentMC));
  float square = max(dot(direction, direction), 1e-30);
  float bend = 0.5 * both[2 + plane] * dot(disk.tangentMC, disk.tangentMC) / square;
  return vec4(direction, clip.w, bend);
}

// How many radii beyond its clip planes a particle fills gaps that others leave.
vec2 splatOverlaps(int particle)
{
  return splatHasClip == 0 ? vec2(0.0) : texelFetch(splatClip, 3 * particle + 2).xy;
}

// Corners of the equilateral triangle around the unit circle, counter-clockwise.
const vec2 splatCorner[3] =
  vec2[3](vec2(0.0, 2.0), vec2(-1.7320508, -1.0), vec2(1.7320508, -1.0));
