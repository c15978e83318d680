//VTK::System::Dec

// Vertex stage of the resolve pass, inside VTK's template for polygonal data: the picture in square tiles, each a
// point. Tiles that have nothing to draw are left out. Programs of outlines, which cost more than all the rest, draw
// only tiles with an edge of the surface; programs of folds draw only tiles in which the depth of the surface jumps.

uniform sampler2D splatSeen;  // r: 1 where there is surface; has two levels of averages
uniform vec4 splatViewport;   // left, bottom, width, height in pixels
uniform ivec2 splatFirstTile; // left and bottom of the first tile in pixels
uniform int splatTilesInRow;
uniform int splatTilesWith;   // what drawn tiles hold: 1: surface but no edge of it; 2: an edge; 3: either

//VTK::CustomUniforms::Dec

// 0: the tile and its neighbourhood are empty; 1: they are covered; 2: they are covered in part.
int splatTileKind(vec2 low)
{
  vec2 size = vec2(textureSize(splatSeen, 0));
  float covered = 0.0;
  for (int corner = 0; corner < 4; ++corner)
  {
    // The mean over the 8 x 8 pixels around the corner.
    vec2 place = low + SPLAT_TILE_SIZE * vec2(corner % 2, corner / 2);
    covered += textureLod(splatSeen, place / size, 2.0).r;
  }
  // Four means of 1, less rounding; a single empty pixel leaves at most 4 - 1 / 64.
  return covered == 0.0 ? 0 : (covered > 3.999 ? 1 : 2);
}

#if SPLAT_FOLDS
uniform sampler2D splatVisibleDepth;
uniform mat4 splatVCDC;
uniform float splatJump; // VC; in a tile the depths of one part of the surface differ by less

// z (VC) of a depth of the depth buffer.
float splatDepthOf(float depth)
{
  float z = 2.0 * depth - 1.0;
  return (splatVCDC[3][2] - z * splatVCDC[3][3]) / (z * splatVCDC[2][3] - splatVCDC[2][2]);
}

// Whether depths in a tile and right beside it differ by more than a jump. Looks at 4 x 4 pixels, evenly spread from
// one pixel before the tile on.
bool splatHasJump(vec2 low)
{
  ivec2 last = textureSize(splatVisibleDepth, 0) - 1;
  float nearest = -1e30; // beyond all depths, as is the next
  float farthest = 1e30;
  for (int i = 0; i < 16; ++i)
  {
    ivec2 offset = ivec2(i % 4, i / 4) * (SPLAT_TILE_SIZE + 1) / 3 - 1;
    float depth = texelFetch(splatVisibleDepth, clamp(ivec2(low) + offset, ivec2(0), last), 0).r;
    float z = splatDepthOf(depth);
    nearest = depth < 1.0 ? max(nearest, z) : nearest;
    farthest = depth < 1.0 ? min(farthest, z) : farthest;
  }
  return nearest - farthest > splatJump;
}
#endif

void main()
{
  ivec2 tile = ivec2(gl_VertexID % splatTilesInRow, gl_VertexID / splatTilesInRow);
  vec2 low = vec2(splatFirstTile) + SPLAT_TILE_SIZE * vec2(tile);
  vec2 middleDC = 2.0 * (low + 0.5 * SPLAT_TILE_SIZE) / splatViewport.zw - 1.0;
#if SPLAT_FOLDS
  bool drawn = splatHasJump(low);
#else
  bool drawn = (splatTileKind(low) & splatTilesWith) != 0;
#endif
  gl_Position = drawn ? vec4(middleDC, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = SPLAT_TILE_SIZE;
}
