// One particle as a disk: what every vertex stage needs of it. Inserted into shaders at
// //Splat::Disk::Dec.
//
// There are no vertex attributes: particles are fetched by gl_VertexID, so that nothing is stored three times.
//
// Suffixes name coordinate spaces: MC model (shifted to the middle of the particles, see SplatParticles), VC view,
// DC device. Disk coordinates (u, v) are in radii along tangent and bitangent of the disk; u^2 + v^2 = 1 is the rim.

uniform samplerBuffer splatCentreRadius; // xyz: centre (MC), w: radius, 0 = draw nothing
// xyz: outward unit normal (MC); w: twice the number of the isovalue, plus 1 if the particle is translucent, plus 0.5 if
// its layer of the surface ends beside another one, plus 0.25 if it is a ghost
uniform samplerBuffer splatNormal;
// splatClipTexels texels a particle. First and second: xyz: unit normal of a plane (MC), w: distance (MC). Third: xy:
// overlaps, see splatOverlaps(); zw: curvatures (1 / MC), within the surface, of the curves that the planes touch,
// positive towards the planes' normals. If there are five texels, the fourth is a third plane's normal and distance, the
// fifth its overlap (x) and curvature (z).
uniform samplerBuffer splatClip;
// Four texels a particle: borders of its cell. xyz: from the particle to the nearest place (MC), 0 if there is no
// border; w: curvature (1 / MC), positive where the border bends along xyz.
uniform samplerBuffer splatBorders;
uniform int splatClipTexels; // 0: there are no clip planes; 3: up to two a particle; 5: up to three
uniform float splatRadiusScale;
uniform int splatFacesViewer;  // 1: the particles have no normals, their disks face the eye
uniform int splatStride;       // every splatStride-th particle is drawn
uniform int splatKind;         // which particles are drawn, see DrawnKind: 2 stands for all
uniform int splatIsovalue;        // number of the isovalue whose particles are drawn; less than 0: all are
uniform int splatGhosts;       // 0: ghosts are not drawn
uniform float splatHiddenSide; // particles seen from this side are not drawn, see CulledSide
uniform vec4 splatEyeMC;       // position of the eye, or, with w = 0, the direction to it

struct SplatDisk
{
  vec3 centreMC;
  vec3 normalMC;    // outward
  vec3 tangentMC;   // as long as the radius, as is the next; 0 if there is nothing to draw
  vec3 bitangentMC;
  float seenFrom;   // 1: from outward (the normal points at the eye), -1: from inward
  int isovalue;     // its number
  bool besideLayer; // another layer of the surface is near
  bool ghost;       // another rank draws where it is the strongest particle
};

vec3 splatTangent(vec3 normal)
{
  // Either axis is at least 37 degrees away from the normal when it is taken: |normal.x| < 0.6 means 53 degrees from x,
  // and from 0.6 on |normal.y| is at most 0.8, 37 degrees from y.
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
  float marks = normal.w - float(tag);
  disk.besideLayer = marks >= 0.5;
  disk.ghost = mod(marks, 0.5) >= 0.25;
  bool drawn = (splatKind == 2 || tag % 2 == splatKind) &&
    (splatIsovalue < 0 || disk.isovalue == splatIsovalue) && disk.seenFrom != splatHiddenSide &&
    (splatGhosts == 1 || !disk.ghost);
  float radius = drawn ? centreRadius.w * splatRadiusScale : 0.0;
  disk.tangentMC = radius * splatTangent(disk.normalMC);
  disk.bitangentMC = cross(disk.normalMC, disk.tangentMC);
  return disk;
}

// How many clip planes a particle may have.
int splatClipPlanes()
{
  return (splatClipTexels + 1) / 2;
}

// The texel with normal and distance of a clip plane.
int splatClipTexel(int particle, int plane)
{
  return splatClipTexels * particle + (plane < 2 ? plane : 3);
}

// Where a particle's clip plane, bent to the curve that it touches, crosses the disk: the disk coordinates (u, v) with
//   x u + y v > z + w (x v - y u)^2
// are cut off, where xyzw is what is returned. z is a length (MC).
vec4 splatClipLine(int particle, int plane, SplatDisk disk)
{
  if (plane >= splatClipPlanes())
  {
    return vec4(0.0);
  }
  vec4 clip = texelFetch(splatClip, splatClipTexel(particle, plane));
  vec4 both = texelFetch(splatClip, splatClipTexels * particle + (plane < 2 ? 2 : 4));
  vec2 direction = vec2(dot(clip.xyz, disk.tangentMC), dot(clip.xyz, disk.bitangentMC));
  float square = max(dot(direction, direction), 1e-30); // not 0 where there is no plane
  float bend = 0.5 * both[2 + plane % 2] * dot(disk.tangentMC, disk.tangentMC) / square;
  return vec4(direction, clip.w, bend);
}

// A border of a particle's cell, as splatClipLine() gives a plane. Where there is none, it is out of reach.
vec4 splatBorderLine(int particle, int border, SplatDisk disk)
{
  vec4 found = texelFetch(splatBorders, SPLAT_BORDERS * particle + border);
  float far = length(found.xyz);
  vec3 outward = found.xyz / max(far, 1e-30); // not divided by 0
  vec2 direction = vec2(dot(outward, disk.tangentMC), dot(outward, disk.bitangentMC));
  return far == 0.0 ? vec4(0.0, 0.0, 1e30, 0.0) : vec4(direction, far, 0.5 * found.w);
}

// How far beyond its clip planes a particle fills gaps that others leave, in radii.
vec3 splatOverlaps(int particle)
{
  int first = splatClipTexels * particle;
  return splatClipTexels == 0 ? vec3(0.0)
    : vec3(texelFetch(splatClip, first + 2).xy, splatClipTexels == 5 ? texelFetch(splatClip, first + 4).x : 0.0);
}

// The same measured across the planes, in MC. A plane is a face of an element, which may pass the disk aslant: along
// the disk it is farther. Where the surface jumps at such a face, a wider overlap hides the gap there. A whole splat
// goes on beyond open planes.
vec3 splatOverlapsAcross(int particle, SplatDisk disk)
{
  vec3 overlaps = splatOverlaps(particle);
  vec3 across = vec3(length(disk.tangentMC));
  for (int plane = 0; plane < splatClipPlanes(); ++plane)
  {
    vec3 normal = texelFetch(splatClip, splatClipTexel(particle, plane)).xyz;
    if (overlaps[plane] <= 1.0) // radii; no other overlap is near to that
    {
      across[plane] = length(vec2(dot(normal, disk.tangentMC), dot(normal, disk.bitangentMC)));
    }
  }
  return across * overlaps;
}

// Corners of the equilateral triangle around the unit circle, counter-clockwise; 1.7320508 is sqrt(3).
const vec2 splatCorner[3] =
  vec2[3](vec2(0.0, 2.0), vec2(-1.7320508, -1.0), vec2(1.7320508, -1.0));
