//VTK::System::Dec

// Vertex stage of the oriented disks, inside VTK's template for polygonal data: the replacements
// below are VTK's own, and they find the names they expect (vertexMC, MCDCMatrix ...).
//
// No vertex attributes: three vertices a particle, which fetch their particle by gl_VertexID, so
// that gl_PrimitiveID is the number of the particle and nothing is stored three times.
//
// Coordinate spaces by suffix: MC model (shifted to the middle of the particles, see
// vtkSurfaceSplatParticles), VC view, DC device.

uniform samplerBuffer splatCentreRadius; // xyz: centre (MC), w: radius, 0 = draw nothing
uniform samplerBuffer splatNormal;       // xyz: outward unit normal (MC)
uniform float splatRadiusScale;
uniform int splatFacesViewer; // 1: the particles have no normals, their disks face the eye
uniform vec4 splatEyeMC;      // position of the eye, or, with w = 0, the direction to it
uniform mat3 normalMatrix;

out vec2 splatDiskCoord;          // inside the unit circle = inside the disk
flat out vec3 splatNormalVC;      // normal of the side that is seen
flat out float splatSeenFromSide; // 1: from outward (the normal points at the eye), -1: from inward

//VTK::CustomUniforms::Dec

//VTK::PositionVC::Dec

//VTK::Normal::Dec

//VTK::Light::Dec

//VTK::TCoord::Dec

//VTK::Color::Dec

//VTK::Clip::Dec

//VTK::Camera::Dec

//VTK::PrimID::Dec

//VTK::ValuePass::Dec

//VTK::Picking::Dec

// Corners of the equilateral triangle around the unit circle, counter-clockwise.
const vec2 splatCorner[3] =
  vec2[3](vec2(0.0, 2.0), vec2(-1.7320508, -1.0), vec2(1.7320508, -1.0));

vec3 splatTangent(vec3 normal)
{
  // Either axis is at least 37 degrees away from the normal when it is taken.
  vec3 axis = abs(normal.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  return normalize(cross(axis, normal));
}

void main()
{
  int particle = gl_VertexID / 3;
  vec4 centreRadius = texelFetch(splatCentreRadius, particle);
  vec3 toEyeMC = splatEyeMC.xyz - splatEyeMC.w * centreRadius.xyz;
  vec3 normalMC = splatFacesViewer == 1 ? normalize(toEyeMC)
                                        : texelFetch(splatNormal, particle).xyz;

  vec3 tangentMC = splatTangent(normalMC);
  vec3 bitangentMC = cross(normalMC, tangentMC);
  splatDiskCoord = splatCorner[gl_VertexID % 3];
  vec2 offset = centreRadius.w * splatRadiusScale * splatDiskCoord;
  vec4 vertexMC =
    vec4(centreRadius.xyz + offset.x * tangentMC + offset.y * bitangentMC, 1.0);

  // The eye lies on one side of the whole disk, so the centre decides for all its fragments.
  splatSeenFromSide = dot(normalMC, toEyeMC) < 0.0 ? -1.0 : 1.0;
  splatNormalVC = splatSeenFromSide * (normalMatrix * normalMC);

  //VTK::CustomBegin::Impl

  //VTK::Color::Impl

  //VTK::Normal::Impl

  //VTK::TCoord::Impl

  //VTK::Clip::Impl

  //VTK::PrimID::Impl

  //VTK::PositionVC::Impl

  //VTK::ValuePass::Impl

  //VTK::Light::Impl

  //VTK::Picking::Impl

  //VTK::CustomEnd::Impl
}
