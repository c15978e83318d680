// How far a place with these disk coordinates lies behind an edge of the surface, see splatClipLine().
float splatBehindLine(vec4 line, vec2 place)
{
  float along = line.x * place.y - line.y * place.x;
  return dot(line.xy, place) - line.z - line.w * along * along;
}
