//VTK::System::Dec

// Vertex stage of the resolve pass, inside VTK's template for polygonal data: the picture in square
// tiles, each a point, of which those are left out that have nothing to draw. Outlines are looked for
// in tiles around them only, for they cost more than all the rest.

uniform sampler2D splatSeen;  // r: 1 where there is surface; with two levels of averages
uniform vec4 splatViewport;   // left, bottom, width, height in pixels
uniform ivec2 splatFirstTile; // its left and bottom in pixels
uniform int splatTilesInRow;
uniform int splatTilesWith;   // 1: surface but no edge of it; 2: an edge; 3: either

//VTK::CustomUniforms::Dec

// 0: the tile and its neighbourhood are empty; 1: they are covered; 2: in part.
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
  return covered == 0.0 ? 0 : (covered > 3.999 ? 1 : 2);
}

void main()
{
  ivec2 tile = ivec2(gl_VertexID % splatTilesInRow, gl_VertexID / splatTilesInRow);
  vec2 low = vec2(splatFirstTile) + SPLAT_TILE_SIZE * vec2(tile);
  vec2 middleDC = 2.0 * (low + 0.5 * SPLAT_TILE_SIZE) / splatViewport.zw - 1.0;
  bool drawn = (splatTileKind(low) & splatTilesWith) != 0;
  gl_Position = drawn ? vec4(middleDC, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = SPLAT_TILE_SIZE;
}
